#include "input/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "input/language.hpp"
#include "input/nearest.hpp"

namespace gannet {

namespace {

std::vector<std::string> names_of(const TextNode& map) {
  std::vector<std::string> names;
  for (const TextNode& item : map.items) names.push_back(item.key);
  return names;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

TextNode* find_at(TextNode& root, const std::vector<std::string>& path) {
  TextNode* node = &root;
  for (const std::string& name : path) node = find(*node, name);
  return node;
}

/// The entry of that key, made where it is missing; nullptr and a mistake where it cannot be.
TextNode* step_into(TextNode& map, const Key* key, const std::string& name, const Location& place,
                    Mistakes& mistakes) {
  if (map.form == TextNode::Form::nothing) map.form = TextNode::Form::map;
  if (map.form != TextNode::Form::map) {
    mistakes.add(place, fmt::format("'{}' is not a map; it has no '{}'", map.key, name));
    return nullptr;
  }
  if (TextNode* known = find(map, name)) return known;
  const Key* entry = key != nullptr ? find_key(*key, name) : nullptr;
  if (entry != nullptr && entry->name == "*") {
    const std::vector<std::string> names = names_of(map);
    mistakes.add(place, fmt::format("the case has no '{}' under '{}'{} (there: {})", name, map.key,
                                    did_you_mean(name, names), comma_list(names)));
    return nullptr;
  }
  TextNode added;
  added.key = name;
  added.where = added.key_where = place;
  map.items.push_back(added);
  return &map.items.back();
}

/// "effects.xsph=off" or "models=off" takes a map out of the case; "=on" leaves the one that is
/// there, or makes one of defaults. Returns false where the key is no map or the value another one.
bool switch_map(TextNode& root, const std::vector<std::string>& path, const Key* key,
                const std::string& value) {
  if (key == nullptr || key->kind != Kind::map || path.empty()) return false;
  const Key* active = find_key(*key, "active");
  if (active != nullptr && active->name == "active") return false;  // written as in the file
  if (value == "on") return true;
  if (value != "off") return false;
  TextNode* parent = path.size() == 1 ? &root : find_at(root, {path.begin(), path.end() - 1});
  std::erase_if(parent->items, [&](const TextNode& item) { return item.key == path.back(); });
  return true;
}

/// Whether a path is more than the name and ends with it.
bool ends_with_name(const std::string& path, const std::string& name) {
  return path.size() > name.size() + 1 && path.ends_with("." + name);
}

/// What varies or judges a case is no part of it.
bool is_aside(const std::string& path, const std::string& key) {
  return path.empty() && (key == "study" || key == "hard");
}

/// Paths of the text that end with the name.
void find_written(const TextNode& at, const std::string& path, const std::string& name,
                  std::vector<std::string>& found) {
  for (const TextNode& item : at.items) {
    if (item.key.empty() || is_aside(path, item.key)) continue;
    const std::string whole = path.empty() ? item.key : path + "." + item.key;
    if (ends_with_name(whole, name)) found.push_back(whole);
    if (item.form == TextNode::Form::map) find_written(item, whole, name, found);
  }
}

/// Paths that end with the name and that the language knows at the places that the case has.
void find_allowed(const Key& at, TextNode* map, const std::string& path, const std::string& name,
                  std::vector<std::string>& found) {
  for (const Key& key : at.keys) {
    if (is_aside(path, key.name)) continue;
    std::vector<std::string> names{key.name};
    if (key.name == "*") names = map != nullptr ? names_of(*map) : std::vector<std::string>{};
    for (const std::string& one : names) {
      const std::string whole = path.empty() ? one : path + "." + one;
      if (ends_with_name(whole, name)) found.push_back(whole);
      find_allowed(key, map != nullptr ? find(*map, one) : nullptr, whole, name, found);
    }
  }
}

/// "let.dx" for "dx": the one key whose path ends so, first of those that the case writes, then of
/// all that the language allows in it. What begins at the top of the language, or what nothing ends
/// with, stays; "" and a mistake where several are meant.
std::string whole_path(const std::string& name, TextNode& root, const Key& language,
                       const Location& place, Mistakes& mistakes) {
  if (find_key(language, split(name).front()) != nullptr) return name;
  std::vector<std::string> found;
  find_written(root, "", name, found);
  if (found.empty()) find_allowed(language, &root, "", name, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  if (found.empty()) return name;
  if (found.size() == 1) return found.front();
  mistakes.add(place, fmt::format("'{}' may be {}; write more of the one that is meant", name,
                                  fmt::join(found, " or ")));
  return "";
}

void apply(TextNode& root, const Key& language, const std::string& text, Mistakes& mistakes) {
  const Location place{"--set " + text, 0, 0};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    mistakes.add(place, "key.path=value is wanted, such as let.dx=8mm");
    return;
  }
  const std::string whole = whole_path(text.substr(0, equals), root, language, place, mistakes);
  if (whole.empty()) return;
  const std::vector<std::string> path = split(whole);
  if (path.front() == "gannet") {
    mistakes.add(place, "gannet: the version belongs to the file and cannot be set");
    return;
  }
  TextNode* node = &root;
  const Key* key = &language;
  for (const std::string& name : path) {
    if (name.empty()) {
      mistakes.add(place, "key.path=value is wanted, such as let.dx=8mm");
      return;
    }
    TextNode* next = step_into(*node, key, name, place, mistakes);
    if (next == nullptr) return;
    key = key != nullptr ? find_key(*key, name) : nullptr;
    node = next;
  }
  if (switch_map(root, path, key, text.substr(equals + 1))) return;
  TextNode value = read_yaml_piece(text.substr(equals + 1), place, mistakes);
  value.key = node->key;
  *node = value;
}

}  // namespace

void apply_overrides(TextNode& root, const Key& language, const std::vector<std::string>& overrides,
                     Mistakes& mistakes) {
  for (const std::string& text : overrides) apply(root, language, text, mistakes);
}

}  // namespace gannet
