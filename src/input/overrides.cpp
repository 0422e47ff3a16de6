#include "input/overrides.hpp"

#include <fmt/format.h>

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

/// "effects.xsph=off" takes a map out of the case; "=on" leaves the one that is there, or makes one
/// of defaults. Returns false where the key is no map or the value another one.
bool switch_map(TextNode& root, const std::vector<std::string>& path, const Key* key,
                const std::string& value) {
  if (key == nullptr || key->kind != Kind::map || path.size() < 2) return false;
  const Key* active = find_key(*key, "active");
  if (active != nullptr && active->name == "active") return false;  // written as in the file
  if (value == "on") return true;
  if (value != "off") return false;
  TextNode* parent = find_at(root, {path.begin(), path.end() - 1});
  std::erase_if(parent->items, [&](const TextNode& item) { return item.key == path.back(); });
  return true;
}

void apply(TextNode& root, const Key& language, const std::string& text, Mistakes& mistakes) {
  const Location place{"--set " + text, 0, 0};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    mistakes.add(place, "key.path=value is wanted, such as let.dx=8mm");
    return;
  }
  const std::vector<std::string> path = split(text.substr(0, equals));
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
