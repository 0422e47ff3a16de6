#include "study/hard_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "study/hard_watch.hpp"

namespace gannet {

namespace {

Key end_steps() {
  return {.name = "steps",
          .kind = Kind::integer,
          .text = "the run ends after this many steps",
          .limits = at_least(1)};
}

Key end_until() {
  return {.name = "until",
          .unit = dim::time,
          .text = "the run ends at this time; absent: at output.until",
          .limits = positive()};
}

std::vector<Key> limit_keys() {
  return {
      {.name = "energy_growth",
       .text = "largest energy held over the energy at the start and the work put in",
       .fallback = "1.02",
       .limits = {1, std::numeric_limits<double>::infinity(), true, false}},
      {.name = "energy_error",
       .text = "largest energy imbalance over the largest total energy so far",
       .limits = positive()},
      {.name = "momentum",
       .text = "largest change of sum m v over the largest sum m |v|; for scenes that nothing "
               "outside acts on",
       .limits = positive()},
      {.name = "penetration",
       .unit = dim::length,
       .text = "how far a particle's centre may get behind a plane or a shell",
       .limits = at_least(0)},
      {.name = "smallest_spacing",
       .unit = dim::length,
       .text = "the least distance of two particles",
       .limits = positive()},
      {.name = "smallest_dt",
       .text = "the least time step over the first one",
       .limits = between(0, 1)},
  };
}

Key exact_key() {
  Key one{.name = "*", .kind = Kind::map, .text = "what a probe must show"};
  one.keys = {
      {.name = "probe",
       .kind = Kind::text,
       .text = "a probe, or another measure by its whole name",
       .required = true},
      {.name = "component", .kind = Kind::text, .text = "x, y, z; absent: the only or first one"},
      {.name = "value", .kind = Kind::any, .text = "a quantity"},
      {.name = "csv",
       .kind = Kind::path,
       .text = "a table: time in s and value in SI, in place of "
               "'value'"},
      {.name = "tolerance",
       .kind = Kind::any,
       .text = "a quantity like the value, or a share of it (5 %)",
       .required = true},
      {.name = "when",
       .kind = Kind::choice,
       .text = "at every look, at the end, or the mean over time",
       .fallback = "always",
       .choices = {"always", "end", "mean"}},
      {.name = "from",
       .unit = dim::time,
       .text = "looks before this time do not count",
       .limits = at_least(0)}};
  return {
      .name = "exact", .kind = Kind::map, .text = "deviations from what is known", .keys = {one}};
}

Key variants_key() {
  Key one{.name = "*", .kind = Kind::map, .text = "another start of the case"};
  one.keys = {
      {.name = "set", .kind = Kind::any, .text = "{key.path: value, ...}", .required = true},
      {.name = "must_fail",
       .kind = Kind::flag,
       .text = "the case is sound only if this variant breaks a limit",
       .fallback = "no"},
      {.name = "by",
       .kind = Kind::names,
       .text = "limits of which one must be broken; absent: any",
       .choices = limit_names()},
      {.name = "because", .kind = Kind::text, .text = "why"}};
  return {.name = "variants", .kind = Kind::map, .text = "other starts", .keys = {one}};
}

Schema hard_schema() {
  Key hard{.name = "hard", .kind = Kind::map, .text = "limits that `gannet hard` holds a case to"};
  hard.keys = limit_keys();
  hard.keys.push_back({.name = "provokes", .kind = Kind::text, .text = "what the case provokes"});
  hard.keys.push_back({.name = "cure", .kind = Kind::text, .text = "what keeps it sound"});
  hard.keys.push_back(end_steps());
  hard.keys.push_back(end_until());
  hard.keys.push_back({.name = "every",
                       .kind = Kind::integer,
                       .text = "steps between two looks",
                       .fallback = "10",
                       .limits = at_least(1)});
  hard.keys.push_back({.name = "long",
                       .kind = Kind::map,
                       .text = "end of the run with --long",
                       .keys = {end_steps(), end_until()}});
  hard.keys.push_back(exact_key());
  hard.keys.push_back(variants_key());
  return {{"", hard}};
}

std::optional<double> optional_number(const Keys& keys, const char* key) {
  if (!keys.has(key)) return {};
  return keys.number(key);
}

HardEnd read_end(const Keys& keys, const HardEnd& otherwise) {
  if (!keys.has("steps") && !keys.has("until")) return otherwise;
  HardEnd end;
  if (keys.has("steps")) end.steps = keys.integer("steps");
  if (keys.has("until")) end.until = keys.number("until");
  return end;
}

/// Two columns of numbers; lines that do not start with a number are headers.
void read_table(const Keys& keys, Exact& exact) {
  std::ifstream in(keys.word("csv"));
  for (std::string line; std::getline(in, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    double t = 0;
    double y = 0;
    if (!(cells >> t >> y)) continue;
    exact.t.push_back(t);
    exact.y.push_back(y);
  }
  if (exact.t.empty()) keys.complain("csv", "holds no line of two numbers");
}

/// The tolerance in the unit of the value: as given, or a share of the value.
double read_tolerance(const Keys& keys, const Exact& exact) {
  const Value& given = keys.value("tolerance");
  const double number = keys.quantity(given, given.dimension);
  const bool has_value = keys.has("value");
  const Dimension unit = has_value ? keys.value("value").dimension : given.dimension;
  if (!(given.dimension == dim::none)) {
    if (!(given.dimension == unit)) keys.complain("tolerance", "has another unit than the value");
    return number;
  }
  double scale = std::abs(exact.value);
  for (const double y : exact.y) scale = std::max(scale, std::abs(y));
  if (scale == 0) keys.complain("tolerance", "a share of zero; give a quantity with its unit");
  return number * scale;
}

Exact read_exact(const Keys& keys) {
  Exact exact;
  exact.name = keys.name();
  const std::string probe = keys.word("probe");
  exact.measure = probe.find('.') == std::string::npos ? "probe." + probe : probe;
  exact.component = keys.word("component");
  if (keys.has("csv") == keys.has("value")) keys.complain("", "one of 'value' and 'csv' is wanted");
  if (keys.has("value")) {
    const Value& value = keys.value("value");
    exact.value = keys.quantity(value, value.dimension);
  }
  if (keys.has("csv")) read_table(keys, exact);
  exact.tolerance = read_tolerance(keys, exact);
  const std::string when = keys.word("when");
  if (when == "end") exact.when = Exact::When::end;
  if (when == "mean") exact.when = Exact::When::mean;
  exact.from = keys.number_or("from", 0);
  return exact;
}

std::string text_of(const Value& value) {
  if (!value.is_list && !value.is_map) return value.text;
  std::vector<std::string> items;
  for (const Value& child : value.children) {
    items.push_back(value.is_map ? child.name + ": " + text_of(child) : text_of(child));
  }
  const bool map = value.is_map;
  return fmt::format("{}{}{}", map ? '{' : '[', fmt::join(items, ", "), map ? '}' : ']');
}

HardVariant read_variant(const Keys& keys) {
  HardVariant variant;
  variant.name = keys.name();
  variant.must_fail = keys.flag("must_fail");
  variant.because = keys.word("because");
  if (keys.has("by")) variant.by = keys.words("by");
  const Value& set = keys.value("set");
  if (!set.is_map) keys.complain(set, "a map is wanted: {effects.xsph.epsilon: 0}");
  for (const Value& entry : set.children) {
    variant.set.push_back(entry.name + "=" + text_of(entry));
  }
  return variant;
}

}  // namespace

double Exact::expected(double time) const {
  if (t.empty()) return value;
  if (time <= t.front()) return y.front();
  const auto k = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time) - t.begin());
  if (k == t.size()) return y.back();
  return y[k - 1] + (y[k] - y[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
}

Effect hard_effect() { return {.name = "hard", .schema = hard_schema}; }

HardCase read_hard_case(const Keys& root) {
  HardCase hard;
  hard.end.until = root.map("output").number("until");
  hard.long_end = hard.end;
  if (!root.has("hard")) return hard;
  const Keys keys = root.map("hard");
  hard.provokes = keys.word("provokes");
  hard.cure = keys.word("cure");
  hard.end = read_end(keys, hard.end);
  hard.long_end = keys.has("long") ? read_end(keys.map("long"), hard.end) : hard.end;
  hard.every = keys.integer("every");
  hard.energy_growth = keys.number("energy_growth");
  hard.energy_error = optional_number(keys, "energy_error");
  hard.momentum = optional_number(keys, "momentum");
  hard.penetration = optional_number(keys, "penetration");
  hard.smallest_spacing = optional_number(keys, "smallest_spacing");
  hard.smallest_dt = optional_number(keys, "smallest_dt");
  const Keys exact = keys.map("exact");
  for (const std::string& name : exact.names()) hard.exact.push_back(read_exact(exact.map(name)));
  const Keys variants = keys.map("variants");
  for (const std::string& name : variants.names()) {
    hard.variants.push_back(read_variant(variants.map(name)));
  }
  return hard;
}

}  // namespace gannet
