#include "output/stop.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cmath>
#include <stdexcept>

#include "output/history.hpp"

namespace gannet {

namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// True where a word stands alone in a text.
bool mentions(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) {
      return true;
    }
  }
  return false;
}

/// What a formula may name: one component of a measure.
struct Named {
  std::string name;
  const Measure* measure;
  std::size_t component;
};

/// Every history by name, "NAME" or "NAME_x"; '-' becomes '_' for formulas.
std::vector<Named> named_components(const Scene& scene) {
  std::vector<Named> all;
  for (const Measure& m : scene.measures) {
    std::string name = history_name(m);
    if (name.empty()) continue;
    for (char& c : name) {
      if (c == '-' || c == '.') c = '_';
    }
    for (std::size_t c = 0; c < m.components.size(); ++c) {
      all.push_back({m.components.size() == 1 ? name : name + "_" + m.components[c], &m, c});
    }
  }
  return all;
}

double sample(const Measure& m, std::size_t component) {
  std::vector<double> values(m.components.size());
  m.sample(values.data());
  return values[component];
}

StopCheck stop_when(const Keys& stop, const Scene& scene) {
  const std::string text = stop.word("when");
  const std::vector<Named> all = named_components(scene);
  std::vector<std::string> names{"t"};
  for (const Named& n : all) names.push_back(n.name);
  std::function<double(const double*)> formula;
  try {
    formula = stop.value("when").formula(names);
  } catch (const std::invalid_argument& error) {
    stop.complain("when", error.what());
    return {};
  }
  std::vector<bool> used{true};
  for (const Named& n : all) used.push_back(mentions(text, n.name));
  return [all, used, formula, text](double t) {
    std::vector<double> values(used.size(), 0.0);
    values[0] = t;
    std::vector<std::string> seen;
    for (std::size_t k = 1; k < used.size(); ++k) {
      if (!used[k]) continue;
      values[k] = sample(*all[k - 1].measure, all[k - 1].component);
      seen.push_back(fmt::format("{} = {:.6g}", all[k - 1].name, values[k]));
    }
    if (formula(values.data()) == 0) return std::string();
    return fmt::format("{}{}{}", text, seen.empty() ? "" : ", with ", fmt::join(seen, ", "));
  };
}

/// The measure that the probe names, or nullptr and a mistake.
const Measure* watched(const Keys& stop, const Scene& scene) {
  std::vector<std::string> names;
  for (const Measure& m : scene.measures) {
    const std::string name = history_name(m);
    if (name == stop.word("probe")) return &m;
    if (!name.empty()) names.push_back(name);
  }
  stop.complain("probe",
                fmt::format("there is no history '{}' (there: {})", stop.word("probe"),
                            names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  return nullptr;
}

/// A limit in the unit of what is watched [SI].
double limit_of(const Keys& stop, const char* key, const Measure& m) {
  Dimension unit = dim::none;
  if (!m.unit.empty() && m.unit != "-" && m.unit != "1")
    unit = parse_quantity("1 " + m.unit).dimension;
  return stop.quantity(stop.value(key), unit);
}

/// Component of a measure; its length where none is named and there are several.
int component_of(const Keys& stop, const Measure& m) {
  if (!stop.has("component")) return -1;
  for (std::size_t c = 0; c < m.components.size(); ++c) {
    if (m.components[c] == stop.word("component")) return static_cast<int>(c);
  }
  stop.complain("component",
                fmt::format("'{}' has no component '{}' (there: {})", stop.word("probe"),
                            stop.word("component"), fmt::join(m.components, ", ")));
  return -1;
}

double value_of(const Measure& m, int component) {
  std::vector<double> values(m.components.size());
  m.sample(values.data());
  if (component >= 0) return values[static_cast<std::size_t>(component)];
  if (values.size() == 1) return values[0];
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum);
}

StopCheck stop_at_limit(const Keys& stop, const Scene& scene) {
  const Measure* m = watched(stop, scene);
  if (m == nullptr) return {};
  const int component = component_of(stop, *m);
  const bool above = stop.has("above");
  if (above == stop.has("below")) {
    stop.complain(above ? "below" : "probe", "a limit is given by one of above and below");
    return {};
  }
  const char* side = above ? "above" : "below";
  const double limit = limit_of(stop, side, *m);
  std::string what = stop.word("probe");
  if (stop.has("component")) what += " " + stop.word("component");
  return [m, component, above, limit, what, side](double) {
    const double value = value_of(*m, component);
    if (!(above ? value > limit : value < limit)) return std::string();
    return fmt::format("{} = {:.6g} {}, {} {:.6g} {}", what, value, m->unit, side, limit, m->unit);
  };
}

}  // namespace

Key stop_key() {
  Key stop{.name = "stop",
           .kind = Kind::map,
           .text =
               "ends the run early: {when: \"slam_force_z > 5000\"} or {probe: slam_force, "
               "component: z, above: 5 kN}"};
  stop.keys = {{.name = "when",
                .kind = Kind::formula,
                .text = "a condition of histories (NAME, or NAME_x, NAME_y, NAME_z) and the time "
                        "t, in SI"},
               {.name = "probe", .kind = Kind::text, .text = "the history that is watched"},
               {.name = "component",
                .kind = Kind::text,
                .text = "x, y or z of a vector; its length where absent"},
               {.name = "above", .kind = Kind::any, .text = "it ends once the value is above this"},
               {.name = "below", .kind = Kind::any, .text = "it ends once the value is below this"},
               {.name = "after", .unit = dim::time, .text = "it does not end before"}};
  return stop;
}

StopCheck make_stop(const Keys& output, const Scene& scene) {
  if (!output.has("stop")) return {};
  const Keys stop = output.map("stop");
  if (stop.has("when") == stop.has("probe")) {
    stop.complain("", "a criterion is given by one of when and probe");
    return {};
  }
  for (const char* key : {"component", "above", "below"}) {
    if (stop.has("when") && stop.has(key)) stop.complain(key, "goes with probe");
  }
  const StopCheck check = stop.has("when") ? stop_when(stop, scene) : stop_at_limit(stop, scene);
  if (!check || !stop.has("after")) return check;
  return [check, after = stop.number("after")](double t) {
    return t < after ? std::string() : check(t);
  };
}

}  // namespace gannet
