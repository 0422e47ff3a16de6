#include "input/language.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "input/nearest.hpp"

namespace gannet {

namespace {

Key* find_exact(std::vector<Key>& keys, const std::string& name) {
  const auto it =
      std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == name; });
  return it == keys.end() ? nullptr : &*it;
}

void merge_key(std::vector<Key>& keys, const Key& key, const std::string& path) {
  Key* known = find_exact(keys, key.name);
  if (known == nullptr) {
    Key added = key;
    added.keys.clear();
    keys.push_back(added);
    known = &keys.back();
  } else if (known->kind != key.kind || known->unit != key.unit) {
    throw std::logic_error(fmt::format("two tables differ on the key {}.{}", path, key.name));
  }
  if (known->text.empty()) known->text = key.text;
  if (known->fallback.empty()) known->fallback = key.fallback;
  known->required = known->required || key.required;
  for (const std::string& choice : key.choices) {
    auto& all = known->choices;
    if (std::find(all.begin(), all.end(), choice) == all.end()) all.push_back(choice);
  }
  for (const std::string& name : key.variables) {
    auto& all = known->variables;
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  }
  for (const Key& child : key.keys) merge_key(known->keys, child, path + "." + key.name);
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  return parts;
}

void add_entry(Key& root, const SchemaEntry& entry) {
  std::vector<Key>* keys = &root.keys;
  for (const std::string& name : parts_of(entry.path)) {
    Key* next = find_exact(*keys, name);
    if (next == nullptr) {
      keys->push_back({.name = name, .kind = Kind::map});
      next = &keys->back();
    }
    if (next->kind != Kind::map) {
      throw std::logic_error(fmt::format("{} is no map: {} cannot stand there", name, entry.path));
    }
    keys = &next->keys;
  }
  merge_key(*keys, entry.key, entry.path);
}

void add_card_keys(Key& root) {
  Key* materials = find_exact(root.keys, "materials");
  if (materials->keys.empty()) return;
  add_entry(root, {"materials.*",
                   {.name = "card", .kind = Kind::text, .text = "card of the material library"}});
  add_entry(root, {"materials.*", {.name = "name", .kind = Kind::text, .text = "full name"}});
  add_entry(root, {"materials.*",
                   {.name = "source", .kind = Kind::names, .text = "where the numbers are from"}});
}

/// " or a formula of t or a table"
std::string or_function(const Key& key) {
  const auto& of = key.variables;
  const bool timed = std::find(of.begin(), of.end(), "t") != of.end();
  return fmt::format(" or a formula of {}{}", comma_list(of), timed ? " or a table in time" : "");
}

std::string kind_name(const Key& key) {
  switch (key.kind) {
    case Kind::number:
      return name_of(key.unit);
    case Kind::integer:
      return "whole number";
    case Kind::flag:
      return "yes or no";
    case Kind::text:
      return "text";
    case Kind::choice:
      return fmt::format("one of {}", comma_list(key.choices));
    case Kind::vector:
      return fmt::format("[x, y, z], each {}", with_article(name_of(key.unit)));
    case Kind::function:
      return name_of(key.unit) + or_function(key);
    case Kind::vector_function:
      return fmt::format("[x, y, z], each {}{}", with_article(name_of(key.unit)), or_function(key));
    case Kind::formula:
      return "formula";
    case Kind::numbers:
      return fmt::format("list, each {}", with_article(name_of(key.unit)));
    case Kind::names:
      return "list of names";
    case Kind::path:
      return "file";
    case Kind::reference:
      return fmt::format("name under '{}'", key.refers_to);
    case Kind::map:
      return "map";
    case Kind::any:
      break;
  }
  return key.text;
}

}  // namespace

const std::vector<std::string>& reserved_keys() {
  static const std::vector<std::string> keys = {
      "materials", "parts",    "contacts", "ties",   "bodies", "boundaries", "loads", "models",
      "sea",       "moorings", "effects",  "probes", "output", "study",      "hard"};
  return keys;
}

Key language(const Schema& schema) {
  Key root{.name = "", .kind = Kind::map};
  root.keys.push_back({.name = "gannet",
                       .kind = Kind::integer,
                       .text = "version of the case language",
                       .required = true});
  root.keys.push_back({.name = "title", .kind = Kind::text, .text = "what the case shows"});
  Key let{.name = "let", .kind = Kind::map, .text = "names for formulas"};
  let.keys.push_back({.name = "*", .kind = Kind::number, .text = "a quantity or a formula"});
  root.keys.push_back(let);
  root.keys.push_back({.name = "curves",
                       .kind = Kind::map,
                       .text = "tables in time, as functions for formulas",
                       .keys = {{.name = "*", .kind = Kind::any, .text = "a table"}}});
  for (const std::string& name : reserved_keys()) {
    root.keys.push_back({.name = name, .kind = Kind::map});
  }
  for (const SchemaEntry& entry : schema) add_entry(root, entry);
  add_card_keys(root);
  return root;
}

const Key* find_key(const Key& map, const std::string& name) {
  const Key* any_name = nullptr;
  for (const Key& key : map.keys) {
    if (key.name == "*") any_name = &key;
    if (key.name == name && name != "*") return &key;
  }
  return any_name;
}

bool has_user_names(const Key& map) { return find_key(map, "*") != nullptr; }

std::string text_of(const Limits& limits) {
  const bool below = std::isfinite(limits.highest);
  const bool above = std::isfinite(limits.lowest);
  if (below && above) {
    return fmt::format("in {}{}, {}{}", limits.lowest_open ? '(' : '[', limits.lowest,
                       limits.highest, limits.highest_open ? ')' : ']');
  }
  if (above) return fmt::format("{} {}", limits.lowest_open ? ">" : ">=", limits.lowest);
  if (below) return fmt::format("{} {}", limits.highest_open ? "<" : "<=", limits.highest);
  return "";
}

std::string summary(const Key& key) {
  const std::string limits = text_of(key.limits);
  std::string text = kind_name(key);
  if (!limits.empty()) text += ", " + limits;
  if (key.kind != Kind::choice && !key.choices.empty()) text += ", or " + comma_list(key.choices);
  return text;
}

namespace {

std::string each_of(const Dimension& unit) {
  return fmt::format("each {} ({}, ...)", with_article(name_of(unit)), example_units_of(unit));
}

std::string wanted_names(const Key& key) {
  if (!key.refers_to.empty()) return fmt::format("names under '{}' are wanted", key.refers_to);
  if (key.choices.empty()) return "a list of names is wanted";
  return fmt::format("one or more of {} are wanted", comma_list(key.choices));
}

std::string wanted_map(const Key& key) {
  if (has_user_names(key)) return "a map is wanted";
  return fmt::format("a map of {} is wanted", comma_list(key_names(key)));
}

}  // namespace

std::vector<std::string> key_names(const Key& map) {
  std::vector<std::string> names;
  for (const Key& key : map.keys) {
    if (key.name != "*") names.push_back(key.name);
  }
  return names;
}

std::string wanted_text(const Key& key) {
  const std::string or_words = key.choices.empty() ? "" : ", or " + comma_list(key.choices);
  switch (key.kind) {
    case Kind::number:
      return wanted_text(key.unit) + or_words;
    case Kind::integer:
      return "a whole number is wanted" + or_words;
    case Kind::flag:
      return "yes or no is wanted";
    case Kind::text:
      return "a text is wanted";
    case Kind::choice:
      return fmt::format("one of {} is wanted", comma_list(key.choices));
    case Kind::vector:
      return fmt::format("[x, y, z] is wanted, {}{}", each_of(key.unit), or_words);
    case Kind::function:
      return wanted_text(key.unit) + or_function(key) + or_words;
    case Kind::vector_function:
      return fmt::format("[x, y, z] is wanted, {}{}{}", each_of(key.unit), or_function(key),
                         or_words);
    case Kind::formula:
      return "a formula is wanted";
    case Kind::numbers:
      return fmt::format("a list of numbers is wanted, {}{}", each_of(key.unit), or_words);
    case Kind::names:
      return wanted_names(key);
    case Kind::path:
      return "a file is wanted";
    case Kind::reference:
      return fmt::format("a name under '{}' is wanted", key.refers_to);
    case Kind::map:
      return wanted_map(key) + or_words;
    case Kind::any:
      break;
  }
  return key.text.empty() ? "a value is wanted" : key.text + " is wanted";
}

}  // namespace gannet
