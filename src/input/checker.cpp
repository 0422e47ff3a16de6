#include "input/checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "input/language.hpp"
#include "input/nearest.hpp"

namespace gannet {

namespace {

Value start_value(const TextNode& node, const Key& key, const std::string& path) {
  Value value;
  value.name = node.key;
  value.path = path;
  // A map is placed at its key: in block style the value starts a line below.
  const bool at_key = node.form == TextNode::Form::map && !node.key.empty();
  value.where = at_key ? node.key_where : node.where;
  value.kind = key.kind;
  value.text = node.text;
  value.dimension = key.unit;
  value.is_map = node.form == TextNode::Form::map;
  value.is_list = node.form == TextNode::Form::list;
  return value;
}

void mark_as_default(Value& value) {
  value.given = false;
  for (Value& child : value.children) mark_as_default(child);
}

/// A kept value: any form, numbers read where they can be.
Value check_any(const TextNode& node, const Key& key, const std::string& path,
                CheckContext& context) {
  Value value = start_value(node, key, path);
  value.dimension = dim::none;
  std::set<std::string> seen;
  for (const TextNode& item : node.items) {
    if (value.is_map && !seen.insert(item.key).second) {
      context.complain(item.key_where, join_path(path, item.key), "duplicate key");
      continue;
    }
    value.children.push_back(check_any(item, key, join_path(path, item.key), context));
  }
  if (node.form == TextNode::Form::nothing) value.trouble = "no value";
  if (node.form != TextNode::Form::scalar) return value;
  value.words = {node.text};
  try {
    const Quantity q = context.formulas.read(node.text);
    value.numbers = {q.value};
    value.dimension = q.dimension;
    value.bare = q.bare;
  } catch (const std::invalid_argument& error) {
    value.trouble = error.what();
    value.formula = maker_of(node.text, context.formulas);
  }
  return value;
}

/// Names become names of files and stand in dotted paths.
bool is_good_name(const std::string& name) {
  return std::isalnum(static_cast<unsigned char>(name[0])) != 0 &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

void complain_unknown(const TextNode& entry, const Key& map, const std::string& path,
                      CheckContext& context) {
  const std::vector<std::string> known = key_names(map);
  const std::string near = nearest(entry.key, known);
  std::string message = "unknown key; ";
  if (!near.empty()) {
    message += fmt::format("did you mean '{}' ({})? ", near, summary(*find_key(map, near)));
  }
  message += (near.empty() ? "allowed here: " : "Allowed here: ") + comma_list(known);
  if (has_user_names(map)) message += ", and names of your own";
  context.complain(entry.key_where, path, message);
}

/// Where keys and names of the user's stand in one map (loads: gravity, and named loads): what
/// could be a name, is near a key, and is not the map that a name stands for.
bool is_misspelt(const TextNode& entry, const Key& known, const Key& map) {
  if (known.name != "*" || known.kind != Kind::map || entry.form == TextNode::Form::map) {
    return false;
  }
  return !nearest(entry.key, key_names(map)).empty();
}

/// True where the key is new in its map; else notes where it stood first.
bool is_first(const TextNode& map, const TextNode& entry, bool is_name, const std::string& path,
              CheckContext& context) {
  const TextNode* first = find(map, entry.key);
  if (first == &entry) return true;
  context.complain(entry.key_where, path,
                   fmt::format("duplicate {}; it stands at line {} already",
                               is_name ? "name" : "key", first->key_where.line));
  return false;
}

void check_entry(const TextNode& map, const TextNode& entry, const Key& key, Value& value,
                 CheckContext& context) {
  const std::string path = join_path(value.path, entry.key);
  const Key* known = find_key(key, entry.key);
  if (known == nullptr || is_misspelt(entry, *known, key)) {
    return complain_unknown(entry, key, path, context);
  }
  const bool is_name = known->name == "*";
  if (!is_first(map, entry, is_name, path, context)) return;
  if (is_name && known->kind == Kind::map && !is_good_name(entry.key)) {
    context.complain(entry.key_where, path,
                     fmt::format("'{}' cannot be a name: letters, digits, '_' and '-' are allowed, "
                                 "a letter or digit first",
                                 entry.key));
    return;
  }
  value.children.push_back(check(entry, *known, path, context));
}

/// Adds what the user left out: the default, or a mistake where the key is required.
void add_missing(const TextNode& node, const Key& map, Value& value, CheckContext& context) {
  for (const Key& key : map.keys) {
    if (key.name == "*" || find(node, key.name) != nullptr) continue;
    const std::string path = join_path(value.path, key.name);
    if (!key.fallback.empty()) {
      TextNode piece = read_yaml_piece(key.fallback, value.where, *context.mistakes);
      piece.key = key.name;
      value.children.push_back(check(piece, key, path, context));
      mark_as_default(value.children.back());
    } else if (key.required && !node.broken) {
      const std::string about = key.text.empty() ? "" : fmt::format(": {}", key.text);
      context.complain(value.where, path, fmt::format("missing; {}{}", wanted_text(key), about));
    }
  }
}

/// `guards: off` for a map that has the switch `active`: {active: off}.
bool is_switch(const TextNode& node, const Key& map) {
  static const std::array<std::string, 6> words{"on", "off", "yes", "no", "true", "false"};
  const Key* active = find_key(map, "active");
  return node.form == TextNode::Form::scalar && active != nullptr && active->name == "active" &&
         std::find(words.begin(), words.end(), node.text) != words.end();
}

TextNode map_of_switch(const TextNode& node) {
  TextNode map = node;
  TextNode item = node;
  item.key = "active";
  item.key_where = node.where;
  map.form = TextNode::Form::map;
  map.items = {item};
  return map;
}

Value check_map(const TextNode& node, const Key& key, const std::string& path,
                CheckContext& context) {
  if (is_switch(node, key)) return check_map(map_of_switch(node), key, path, context);
  Value value = start_value(node, key, path);
  if (node.form == TextNode::Form::scalar &&
      std::find(key.choices.begin(), key.choices.end(), node.text) != key.choices.end()) {
    value.words = {node.text};
    return value;
  }
  if (node.form == TextNode::Form::scalar || node.form == TextNode::Form::list) {
    const std::string found = node.form == TextNode::Form::list
                                  ? "a list stands here"
                                  : fmt::format("'{}' is not a map", node.text);
    context.complain(node.where, path, fmt::format("{}; {}", found, wanted_text(key)));
    return value;
  }
  value.is_map = true;
  for (const TextNode& entry : node.items) check_entry(node, entry, key, value, context);
  add_missing(node, key, value, context);
  return value;
}

}  // namespace

void CheckContext::complain(const Location& where, const std::string& path,
                            const std::string& message) const {
  mistakes->add(where, path.empty() ? message : path + ": " + message);
}

std::string join_path(const std::string& path, const std::string& key) {
  if (path.empty() || key.empty()) return path + key;
  return path + "." + key;
}

Value check(const TextNode& node, const Key& key, const std::string& path, CheckContext& context) {
  if (key.kind == Kind::map) return check_map(node, key, path, context);
  if (key.kind == Kind::any) return check_any(node, key, path, context);
  Value value = start_value(node, key, path);
  check_simple(node, key, value, context);
  return value;
}

Value check_let(const TextNode& let, CheckContext& context) {
  const Key number{.name = "*", .kind = Kind::number};
  Value value = start_value(let, {.name = "let", .kind = Kind::map}, "let");
  value.is_map = true;
  if (let.form == TextNode::Form::scalar || let.form == TextNode::Form::list) {
    context.complain(let.where, "let", "a map of names is wanted: {V: 6 m/s, dx: 10 mm}");
    return value;
  }
  for (const TextNode& entry : let.items) {
    const std::string path = join_path("let", entry.key);
    if (!is_first(let, entry, true, path, context)) continue;
    Value item = start_value(entry, number, path);
    try {
      if (entry.form != TextNode::Form::scalar) {
        throw std::invalid_argument("a quantity or a formula is wanted");
      }
      const Quantity q = context.formulas.read(entry.text);
      item.numbers = {q.value};
      item.dimension = q.dimension;
      item.bare = q.bare;
      context.formulas.define(entry.key, q);
      value.children.push_back(item);
    } catch (const std::invalid_argument& error) {
      const std::string why = error.what();
      if (!why.empty()) context.complain(entry.where, path, why);
      context.formulas.define_broken(entry.key);
    }
  }
  return value;
}

namespace {

/// Names under the top-level maps that a reference may mean: "parts", "parts or moorings".
std::vector<std::string> names_under(const TextNode& root, const std::string& maps) {
  constexpr std::string_view between = " or ";
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < maps.size();) {
    const std::size_t end = std::min(maps.find(between, begin), maps.size());
    if (const TextNode* map = find(root, maps.substr(begin, end - begin))) {
      for (const TextNode& entry : map->items) names.push_back(entry.key);
    }
    begin = end + between.size();
  }
  return names;
}

}  // namespace

void check_references(const TextNode& root, const CheckContext& context) {
  for (const ReferenceToCheck& r : context.references) {
    const std::vector<std::string> names = names_under(root, r.refers_to);
    if (std::find(names.begin(), names.end(), r.name) != names.end()) continue;
    context.complain(r.where, r.path,
                     fmt::format("no '{}' under '{}'{} (there: {})", r.name, r.refers_to,
                                 did_you_mean(r.name, names), comma_list(names)));
  }
}

}  // namespace gannet
