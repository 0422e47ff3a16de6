#include "input/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "input/cards.hpp"
#include "input/checker.hpp"
#include "input/functions.hpp"
#include "input/language.hpp"
#include "input/overrides.hpp"
#include "input/resolved.hpp"
#include "input/text_tree.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

/// Everything else is read only if this holds: the file is a map that starts with `gannet: 1`.
void check_version(const TextNode& root, const std::string& file) {
  const std::string start = fmt::format("'gannet: {}'", language_version);
  const Location top{file, 1, 1};
  if (root.form == TextNode::Form::nothing) {
    throw InputError(top, "the file is empty; a case starts with " + start);
  }
  if (root.form != TextNode::Form::map) {
    throw InputError(top, "a case is a map of keys, the first " + start);
  }
  const TextNode* version = find(root, "gannet");
  if (version == nullptr) {
    throw InputError(top, "gannet: missing; a case starts with " + start);
  }
  if (version != &root.items.front()) {
    throw InputError(version->key_where, "gannet: must be the first key of the file");
  }
  if (version->text != std::to_string(language_version)) {
    throw InputError(version->where,
                     fmt::format("gannet: '{}' is not a version of the case language that this "
                                 "program reads; it reads {}",
                                 version->text, language_version));
  }
}

/// Keys that are set aside and that nothing reads yet leave the text, noted as mistakes.
void remove_unbuilt(TextNode& root, Key& top, Mistakes& mistakes) {
  std::vector<std::string> unbuilt;
  for (const std::string& name : reserved_keys()) {
    const Key* key = find_key(top, name);
    if (key->kind == Kind::map && key->keys.empty()) unbuilt.push_back(name);
  }
  const auto is_unbuilt = [&unbuilt](const std::string& name) {
    return std::find(unbuilt.begin(), unbuilt.end(), name) != unbuilt.end();
  };
  for (const TextNode& entry : root.items) {
    if (!is_unbuilt(entry.key)) continue;
    mistakes.add(
        entry.key_where,
        fmt::format("{}: not built yet; the key is set aside for a later version", entry.key));
  }
  std::erase_if(root.items, [&](const TextNode& entry) { return is_unbuilt(entry.key); });
  std::erase_if(top.keys, [&](const Key& key) { return is_unbuilt(key.name); });
}

void check_root(TextNode& root, Key top, Case& result) {
  CheckContext context;
  context.mistakes = &result.mistakes;
  context.file = result.file;
  context.folder = result.folder;
  remove_unbuilt(root, top, result.mistakes);
  Value let;
  if (TextNode* names = find(root, "let")) {
    let = check_let(*names, context);
    names->items.clear();  // checked here, with formulas that grow from name to name
    names->form = TextNode::Form::nothing;
  }
  if (const TextNode* curves = find(root, "curves")) check_curves(*curves, context);
  result.root = check(root, top, "", context);
  check_references(root, context);
  for (Value& child : result.root.children) {
    if (child.name == "let") child = let;
  }
}

std::string text_of_file(const std::string& file) {
  if (!fs::exists(file)) throw InputError({file, 0, 0}, "no such file");
  if (!fs::is_regular_file(file)) throw InputError({file, 0, 0}, "is not a file");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError({file, 0, 0}, "cannot be read");
  return text.str();
}

}  // namespace

std::unique_ptr<Case> read_case_text(const std::string& text, const std::string& file,
                                     const Schema& schema,
                                     const std::vector<std::string>& overrides) {
  auto result = std::make_unique<Case>();
  result->file = file;
  result->folder = fs::path(file).parent_path().string();
  if (result->folder.empty()) result->folder = ".";
  Mistakes& mistakes = result->mistakes;
  TextNode root = read_yaml(text, file, mistakes);
  if (root.broken) mistakes.throw_if_any();
  check_version(root, file);
  const Key top = language(schema);
  apply_overrides(root, top, overrides, mistakes);
  merge_cards(root, result->folder, mistakes);
  check_root(root, top, *result);
  mistakes.throw_if_any();
  const Keys keys = result->keys();
  result->title = keys.has("title") ? keys.word("title") : fs::path(file).stem().string();
  result->resolved = resolved_text(result->root);
  result->hash = fnv1a(result->resolved);
  return result;
}

std::unique_ptr<Case> read_case(const std::string& file, const Schema& schema,
                                const std::vector<std::string>& overrides) {
  return read_case_text(text_of_file(file), file, schema, overrides);
}

}  // namespace gannet
