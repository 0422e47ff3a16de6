// The kinds of value that are no maps: numbers, words, names, files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include "input/checker.hpp"
#include "input/functions.hpp"
#include "input/language.hpp"
#include "input/nearest.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Where a complaint about a part of a value belongs, and what it needs.
struct Place {
  const TextNode& node;
  const Key& key;
  const std::string& path;
  CheckContext& context;
  void complain(const std::string& message) const { context.complain(node.where, path, message); }
};

/// What one number is to be, alone or within a list.
std::string wanted_number(const Key& key) {
  const bool listed = key.kind == Kind::vector || key.kind == Kind::numbers;
  return listed ? wanted_text(key.unit) : wanted_text(key);
}

std::string found_text(const TextNode& node) {
  switch (node.form) {
    case TextNode::Form::nothing:
      return "no value";
    case TextNode::Form::list:
      return "a list stands here";
    case TextNode::Form::map:
      return "a map stands here";
    case TextNode::Form::scalar:
      break;
  }
  return fmt::format("'{}'", node.text);
}

/// A scalar's text, or nothing and a complaint.
std::optional<std::string> scalar_text(const Place& place, const std::string& wanted) {
  const bool empty = place.node.text.empty();
  if (place.node.form == TextNode::Form::scalar && !empty) return place.node.text;
  const std::string found =
      place.node.form == TextNode::Form::scalar ? "no value" : found_text(place.node);
  place.complain(fmt::format("{}; {}", found, wanted));
  return std::nullopt;
}

std::optional<std::string> scalar_text(const Place& place) {
  return scalar_text(place, wanted_text(place.key));
}

/// "'-3 mm' = -0.003 [m], must be > 0"
bool within_limits(const Place& place, double value) {
  const Limits& l = place.key.limits;
  const bool low = l.lowest_open ? value > l.lowest : value >= l.lowest;
  const bool high = l.highest_open ? value < l.highest : value <= l.highest;
  if (low && high) return true;
  const bool both = std::isfinite(l.lowest) && std::isfinite(l.highest);
  place.complain(fmt::format("'{}' = {:.6g} [{}], must {} {}", place.node.text, value,
                             si_unit_of(place.key.unit), both ? "lie" : "be", text_of(l)));
  return false;
}

std::optional<Quantity> read_quantity(const Place& place, const std::string& text) {
  const Formulas& formulas = place.context.formulas;
  try {
    return formulas.read(text);
  } catch (const FormulaError& error) {
    if (!std::string_view(error.what()).empty()) place.complain(error.what());
  } catch (const std::invalid_argument& error) {
    std::vector<std::string> words = formulas.names();
    words.insert(words.end(), place.key.choices.begin(), place.key.choices.end());
    place.complain(
        fmt::format("{}; {}{}", error.what(), wanted_number(place.key), did_you_mean(text, words)));
  }
  return std::nullopt;
}

std::optional<double> read_number(const Place& place) {
  const auto text = scalar_text(place, wanted_number(place.key));
  if (!text) return std::nullopt;
  const auto q = read_quantity(place, *text);
  if (!q) return std::nullopt;
  if (!q->bare && q->dimension != place.key.unit) {
    place.complain(fmt::format("'{}' is {}; {}", *text, with_article(name_of(q->dimension)),
                               wanted_number(place.key)));
    return std::nullopt;
  }
  if (!within_limits(place, q->value)) return std::nullopt;
  return q->value;
}

std::optional<double> read_integer(const Place& place) {
  const auto value = read_number(place);
  if (!value) return std::nullopt;
  const bool fits = std::abs(*value) <= std::numeric_limits<int>::max();
  if (fits && *value == std::round(*value)) return value;
  place.complain(
      fmt::format("'{}' is not a whole number{}", place.node.text, fits ? "" : " within reach"));
  return std::nullopt;
}

/// True, and the word kept, where a number may also be one of a few words.
bool read_word_for_number(const TextNode& node, const Key& key, Value& value) {
  if (node.form != TextNode::Form::scalar || !contains(key.choices, node.text)) return false;
  value.words = {node.text};
  return true;
}

void check_flag(const Place& place, Value& value) {
  constexpr std::array<std::string_view, 3> yes{"yes", "true", "on"};
  constexpr std::array<std::string_view, 3> no{"no", "false", "off"};
  const auto text = scalar_text(place);
  if (!text) return;
  const bool is_yes = std::find(yes.begin(), yes.end(), *text) != yes.end();
  const bool is_no = std::find(no.begin(), no.end(), *text) != no.end();
  if (!is_yes && !is_no) place.complain(fmt::format("'{}'; yes or no is wanted", *text));
  value.numbers = {is_yes ? 1.0 : 0.0};
}

void check_choice(const Place& place, const std::string& word) {
  const std::vector<std::string>& choices = place.key.choices;
  if (contains(choices, word)) return;
  const std::string hint = nearest(word, choices);
  place.complain(fmt::format("unknown word '{}'; {}allowed: {}", word,
                             hint.empty() ? "" : fmt::format("did you mean '{}'? ", hint),
                             comma_list(choices)));
}

void check_vector(const Place& place, Value& value) {
  if (place.node.form != TextNode::Form::list) {
    place.complain(fmt::format("{}; {}", found_text(place.node), wanted_text(place.key)));
    return;
  }
  if (place.node.items.size() != 3) {
    place.complain(
        fmt::format("{} numbers stand here; three are wanted: [x, y, z]", place.node.items.size()));
  }
  for (const TextNode& item : place.node.items) {
    const auto x = read_number({item, place.key, place.path, place.context});
    if (x) value.numbers.push_back(*x);
  }
}

void check_numbers(const Place& place, Value& value) {
  if (place.node.form != TextNode::Form::list) {
    if (const auto x = read_number(place)) value.numbers = {*x};
    return;
  }
  if (place.node.items.empty()) place.complain("the list is empty; " + wanted_text(place.key));
  for (const TextNode& item : place.node.items) {
    const auto x = read_number({item, place.key, place.path, place.context});
    if (x) value.numbers.push_back(*x);
  }
}

void check_name(const Place& place, Value& value) {
  const auto word = scalar_text(place);
  if (!word) return;
  const Key& key = place.key;
  value.words.push_back(*word);
  if (!key.refers_to.empty()) {
    if (!contains(key.choices, *word)) {
      place.context.references.push_back({place.node.where, place.path, *word, key.refers_to});
    }
  } else if (!key.choices.empty()) {
    check_choice(place, *word);
  }
}

void check_names(const Place& place, Value& value) {
  if (place.node.form != TextNode::Form::list) return check_name(place, value);
  if (place.node.items.empty()) place.complain("the list is empty; " + wanted_text(place.key));
  for (const TextNode& item : place.node.items) {
    check_name({item, place.key, place.path, place.context}, value);
  }
}

void check_path(const Place& place, Value& value) {
  const auto text = scalar_text(place);
  if (!text) return;
  // A path in a card is relative to the card; one in an override to the case.
  const Location& where = place.node.where;
  const fs::path folder =
      where.line > 0 ? fs::path(where.file).parent_path() : fs::path(place.context.folder);
  const fs::path file = (folder / *text).lexically_normal();
  if (!fs::is_regular_file(file)) {
    place.complain(fmt::format("no file '{}' (looked for {})", *text, file.string()));
    return;
  }
  value.words = {fs::absolute(file).lexically_normal().string()};
}

void check_text(const Place& place, Value& value) {
  if (const auto text = scalar_text(place)) value.words = {*text};
}

}  // namespace

void check_simple(const TextNode& node, const Key& key, Value& value, CheckContext& context) {
  const Place place{node, key, value.path, context};
  const auto one = [&value](std::optional<double> x) {
    if (x) value.numbers = {*x};
  };
  const bool number = key.kind == Kind::number || key.kind == Kind::integer ||
                      key.kind == Kind::vector || key.kind == Kind::numbers;
  if (number && read_word_for_number(node, key, value)) return;
  switch (key.kind) {
    case Kind::number:
      return one(read_number(place));
    case Kind::integer:
      return one(read_integer(place));
    case Kind::flag:
      return check_flag(place, value);
    case Kind::vector:
      return check_vector(place, value);
    case Kind::numbers:
      return check_numbers(place, value);
    case Kind::function:
      return check_function(node, key, value, context);
    case Kind::vector_function:
      return check_vector_function(node, key, value, context);
    case Kind::formula:
      check_text(place, value);
      if (!value.words.empty()) value.formula = maker_of(node.text, context.formulas);
      return;
    case Kind::reference:
      return check_name(place, value);
    case Kind::names:
      return check_names(place, value);
    case Kind::path:
      return check_path(place, value);
    case Kind::choice:
      check_text(place, value);
      if (!value.words.empty()) check_choice(place, value.words.front());
      return;
    case Kind::text:
      return check_text(place, value);
    case Kind::map:
    case Kind::any:
      return;
  }
}

}  // namespace gannet
