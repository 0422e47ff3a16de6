// Checked values of a case, put together by hand in place of a reader.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/keys.hpp"

namespace gannet::test {

inline Value numbers(std::string name, std::vector<double> values) {
  Value value;
  value.name = std::move(name);
  value.numbers = std::move(values);
  return value;
}

inline Value word(std::string name, std::string text) {
  Value value;
  value.name = std::move(name);
  value.text = text;
  value.words = {std::move(text)};
  return value;
}

inline Value map(std::string name, std::vector<Value> children) {
  Value value;
  value.name = std::move(name);
  value.is_map = true;
  value.children = std::move(children);
  return value;
}

// Gives every value its path and a place: each on a line of its own, in order, from line 10.
inline void place(Value& value, const std::string& parent, int& line) {
  value.path = parent + "." + value.name;
  value.where = {"case.yaml", line++, 5};
  for (Value& child : value.children) place(child, value.path, line);
}

/// parts.skin with the given keys; `case.yaml:10` is the line of "skin".
inline Value part(std::vector<Value> keys) {
  Value value = map("skin", std::move(keys));
  int line = 10;
  place(value, "parts", line);
  return value;
}

/// All messages noted so far, one a line.
inline std::string messages(const Mistakes& mistakes) {
  try {
    mistakes.throw_if_any();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace gannet::test
