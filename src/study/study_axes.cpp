#include "study/study_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gannet {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Cuts at commas that stand outside of brackets and quotes.
std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == '[' || c == '{' || c == '(') ++depth;
    if (c == ']' || c == '}' || c == ')') --depth;
    if (c == ',' && depth == 0 && !quoted) {
      values.emplace_back();
    } else {
      values.back() += c;
    }
  }
  for (std::string& value : values) value = trimmed(value);
  return values;
}

}  // namespace

StudyAxis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string wanted = "key=value,value is wanted, such as let.dx=8mm,4mm,2mm";
  if (equals == std::string::npos) throw std::invalid_argument(wanted);
  StudyAxis axis{trimmed(text.substr(0, equals)), split_values(text.substr(equals + 1))};
  if (axis.key.empty()) throw std::invalid_argument(wanted);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    if (axis.values[i].empty()) throw std::invalid_argument("an empty value; " + wanted);
    if (std::find(axis.values.begin(), axis.values.begin() + static_cast<long>(i),
                  axis.values[i]) != axis.values.begin() + static_cast<long>(i)) {
      throw std::invalid_argument(fmt::format("'{}' stands twice", axis.values[i]));
    }
  }
  return axis;
}

std::vector<std::vector<std::string>> combinations(const std::vector<StudyAxis>& axes) {
  std::vector<std::vector<std::string>> all(1);
  for (const StudyAxis& axis : axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& choices : all) {
      for (const std::string& value : axis.values) {
        longer.push_back(choices);
        longer.back().push_back(value);
      }
    }
    all = longer;
  }
  return all;
}

std::vector<std::string> overrides_of(const std::vector<StudyAxis>& axes,
                                      const std::vector<std::string>& choices) {
  std::vector<std::string> set;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].sets.empty()) {
      set.push_back(axes[i].key + "=" + choices[i]);
      continue;
    }
    const auto at = std::find(axes[i].values.begin(), axes[i].values.end(), choices[i]);
    const auto& keys = axes[i].sets.at(static_cast<std::size_t>(at - axes[i].values.begin()));
    set.insert(set.end(), keys.begin(), keys.end());
  }
  return set;
}

const Value* value_at(const Value& root, const std::string& path) {
  const Value* value = &root;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    const std::string name = path.substr(begin, dot - begin);
    const auto it = std::find_if(value->children.begin(), value->children.end(),
                                 [&](const Value& child) { return child.name == name; });
    if (it == value->children.end()) return nullptr;
    value = &*it;
    begin = dot + 1;
  }
  return value;
}

std::vector<double> sizes_of(const std::vector<double>& numbers) {
  const bool counts = std::all_of(numbers.begin(), numbers.end(),
                                  [](double x) { return x >= 1 && x == std::floor(x); });
  std::vector<double> sizes;
  for (const double x : numbers) {
    if (!(x > 0) || !std::isfinite(x)) return {};
    sizes.push_back(counts ? 1 / x : x);
  }
  std::vector<double> sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
  return sizes;
}

bool is_resolution(const std::string& key, const Dimension& dimension) {
  if (dimension == dim::length) return true;
  const std::string last = key.substr(key.rfind('.') + 1);
  return last == "dx" || last == "spacing" || last == "elements";
}

namespace {

/// Without its first part, and at most the last two of the others.
std::string last_parts(const std::string& key) {
  const std::size_t first = key.find('.');
  if (first == std::string::npos) return key;
  const std::size_t last = key.rfind('.');
  const std::size_t before = last == first ? first : key.rfind('.', last - 1);
  return key.substr(before + 1);
}

}  // namespace

std::string short_key(const std::vector<StudyAxis>& axes, const std::string& key) {
  const std::string words = last_parts(key);
  const auto same = std::count_if(axes.begin(), axes.end(), [&](const StudyAxis& axis) {
    return last_parts(axis.key) == words;
  });
  return same > 1 ? key : words;
}

std::string setting_text(const std::vector<StudyAxis>& axes,
                         const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    text +=
        fmt::format("{}{} = {}", i == 0 ? "" : ", ", short_key(axes, axes[i].key), choices.at(i));
  }
  return text.empty() ? "the case as it is" : text;
}

std::string size_text(const StudySpec& spec, double h) {
  if (spec.refine_counts) return fmt::format("{:.0f}", 1 / h);
  if (h >= 1) return fmt::format("{:.3g} m", h);
  return h >= 1e-3 ? fmt::format("{:.3g} mm", 1e3 * h) : fmt::format("{:.3g} um", 1e6 * h);
}

std::string wall_text(double seconds) {
  if (!std::isfinite(seconds)) return "an unknown time";
  if (seconds < 99.5) return fmt::format("{:.2g} s", seconds);
  if (seconds < 5400) return fmt::format("{:.2g} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.2g} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

}  // namespace gannet
