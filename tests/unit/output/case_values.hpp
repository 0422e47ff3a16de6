// The key `output` of a case, put together by hand in place of a reader.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/keys.hpp"

namespace gannet::test {

/// Line 40 of case.yaml: output: {until: ..., name: text, ...}
inline Value output_case(double until,
                         const std::vector<std::pair<std::string, std::string>>& texts) {
  Value end;
  end.name = "until";
  end.path = "output.until";
  end.where = {"case.yaml", 41, 3};
  end.numbers = {until};
  Value output;
  output.name = "output";
  output.path = "output";
  output.where = {"case.yaml", 40, 1};
  output.is_map = true;
  output.children = {end};
  int line = 42;
  for (const auto& [name, text] : texts) {
    Value v;
    v.name = name;
    v.path = "output." + name;
    v.where = {"case.yaml", line++, 3};
    v.text = text;
    v.words = {text};
    output.children.push_back(v);
  }
  Value root;
  root.is_map = true;
  root.where = {"case.yaml", 1, 1};
  root.children = {output};
  return root;
}

}  // namespace gannet::test
