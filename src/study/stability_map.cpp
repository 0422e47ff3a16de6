#include "study/stability_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"
#include "base/units.hpp"

namespace gannet {

namespace {

constexpr int bisections = 4;  // an edge known to one part in 16 of a cell of the grid

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(fmt::format(
      "--map {}: {}; key=lowest..highest is wanted, such as effects.time_step.scale=0.5..2", text,
      why));
}

Quantity read_bound(const std::string& text, const std::string& piece) {
  try {
    return parse_quantity(piece);
  } catch (const std::invalid_argument& error) {
    refuse(text, error.what());
  }
}

/// Runs with one parameter moved from the standard and the others left alone.
struct Prober {
  const HardBuilder& build;
  const MapAxis& axis;
  std::int64_t steps;
  [[nodiscard]] HardResult at(double value) const {
    return run_hard(build, {override_text(axis, value)}, false, steps);
  }
};

/// Goes from the standard value outward over the values of the grid, then bisects.
MapEdge find_edge(const Prober& probe, std::vector<double> outward, bool upward) {
  const MapAxis& axis = probe.axis;
  MapEdge edge{.key = axis.key, .upward = upward, .stable = *axis.standard};
  for (const double value : outward) {
    const HardResult result = probe.at(value);
    edge.found = !result.stable;
    (result.stable ? edge.stable : edge.broken) = value;
    edge.why = result.why;
    if (edge.found) break;
  }
  for (int k = 0; edge.found && k < bisections; ++k) {
    const double value = axis.middle(edge.stable, edge.broken);
    const HardResult result = probe.at(value);
    (result.stable ? edge.stable : edge.broken) = value;
    if (!result.stable) edge.why = result.why;
  }
  return edge;
}

/// "key 1.5, other key 0.2: "
std::string point_text(const StabilityMap& map, double x, double y) {
  std::string text = fmt::format("{} {:.4g}", map.x.key, x);
  if (map.y) text += fmt::format(", {} {:.4g}", map.y->key, y);
  return text + ": ";
}

void find_edges(const Prober& probe, const std::vector<double>& values,
                std::vector<MapEdge>& edges) {
  if (!probe.axis.standard) return;
  if (const HardResult r = probe.at(*probe.axis.standard); !r.stable) {
    const double value = *probe.axis.standard;
    edges.push_back({probe.axis.key, true, true, value, value, r.why});
    return;
  }
  for (const bool upward : {true, false}) {
    std::vector<double> outward;
    for (const double v : values) {
      if (upward ? v > *probe.axis.standard : v < *probe.axis.standard) outward.push_back(v);
    }
    if (!upward) std::reverse(outward.begin(), outward.end());
    if (!outward.empty()) edges.push_back(find_edge(probe, outward, upward));
  }
}

// The picture

constexpr double cell = 44;
constexpr double left = 120;
constexpr double top = 56;

/// Where a value stands between the centres of the cells of its axis, in cells; may be outside.
double place(const std::vector<double>& values, double value, bool logarithmic) {
  const double a = logarithmic ? std::log(values.front()) : values.front();
  const double b = logarithmic ? std::log(values.back()) : values.back();
  const double v = logarithmic ? std::log(value) : value;
  return 0.5 + (v - a) / (b - a) * static_cast<double>(values.size() - 1);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escaped(text));
}

std::string cells_of(const StabilityMap& map) {
  std::string out;
  const std::size_t nx = map.x_values.size();
  const std::size_t ny = map.y_values.size();
  for (std::size_t k = 0; k < map.results.size(); ++k) {
    const HardResult& r = map.results[k];
    const double x = left + cell * static_cast<double>(k % nx);
    const double y = top + cell * static_cast<double>(ny - 1 - k / nx);
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"white\">"
        "<title>{}</title></rect>\n",
        x, y, cell, cell, r.stable ? "#88ccee" : "#cc6677", escaped(r.stable ? "stable" : r.why));
    if (!r.stable) out += text_at(x + cell / 2, y + cell / 2 + 5, "middle", "x", " fill=\"white\"");
  }
  return out;
}

std::string labels_of(const StabilityMap& map) {
  std::string out;
  const auto ny = static_cast<double>(map.y_values.size());
  const auto nx = static_cast<double>(map.x_values.size());
  const double bottom = top + cell * ny;
  const auto name = [](const MapAxis& axis) {
    return axis.unit == "-" ? axis.key : fmt::format("{} [{}]", axis.key, axis.unit);
  };
  for (std::size_t i = 0; i < map.x_values.size(); ++i) {
    out += text_at(left + cell * (static_cast<double>(i) + 0.5), bottom + 16, "middle",
                   fmt::format("{:.3g}", map.x_values[i]));
  }
  out += text_at(left + cell * nx / 2, bottom + 36, "middle", name(map.x));
  if (!map.y) return out;
  for (std::size_t j = 0; j < map.y_values.size(); ++j) {
    out += text_at(left - 8, bottom - cell * (static_cast<double>(j) + 0.5) + 4, "end",
                   fmt::format("{:.3g}", map.y_values[j]));
  }
  const double middle = top + cell * ny / 2;
  out += text_at(24, middle, "middle", name(*map.y),
                 fmt::format(" transform=\"rotate(-90 24 {:.1f})\"", middle));
  return out;
}

/// A ring where the standard values are, if they are on the map.
std::string mark_of(const StabilityMap& map) {
  if (!map.x.standard || (map.y && !map.y->standard)) return "";
  const double i = place(map.x_values, *map.x.standard, map.x.logarithmic());
  const double j = map.y ? place(map.y_values, *map.y->standard, map.y->logarithmic()) : 0.5;
  const auto nx = static_cast<double>(map.x_values.size());
  const auto ny = static_cast<double>(map.y_values.size());
  if (i < 0 || i > nx || j < 0 || j > ny) return "";
  return fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\" fill=\"none\" stroke=\"black\" "
      "stroke-width=\"3\"><title>standard</title></circle>\n",
      left + cell * i, top + cell * (ny - j));
}

}  // namespace

std::vector<double> MapAxis::values(int n) const {
  std::vector<double> out;
  for (int k = 0; k < n; ++k) {
    const double s = n > 1 ? static_cast<double>(k) / (n - 1) : 0;
    out.push_back(logarithmic() ? lowest * std::pow(highest / lowest, s)
                                : lowest + (highest - lowest) * s);
  }
  return out;
}

double MapAxis::middle(double a, double b) const {
  return logarithmic() ? std::sqrt(a * b) : 0.5 * (a + b);
}

MapAxis read_map_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::size_t dots = text.find("..", equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || equals == 0) refuse(text, "there is no '='");
  if (dots == std::string::npos) refuse(text, "there is no '..'");
  const Quantity low = read_bound(text, text.substr(equals + 1, dots - equals - 1));
  const Quantity high = read_bound(text, text.substr(dots + 2));
  if (!(low.dimension == high.dimension)) refuse(text, "the two ends have different units");
  if (!(low.value < high.value)) refuse(text, "the range is empty");
  return {.key = text.substr(0, equals),
          .unit = si_unit_of(low.dimension),
          .lowest = low.value,
          .highest = high.value};
}

std::string override_text(const MapAxis& axis, double value) {
  const std::string number = fmt::format("{}={:.17g}", axis.key, value);
  return axis.unit == "-" ? number : number + " " + axis.unit;
}

StabilityMap make_stability_map(const std::string& case_name, const HardBuilder& build,
                                const std::vector<MapAxis>& axes, int points, std::int64_t steps,
                                const std::function<void(const std::string&)>& told) {
  StabilityMap map;
  map.case_name = case_name;
  map.x = axes.at(0);
  map.x_values = map.x.values(points);
  map.y_values = {0};
  if (axes.size() > 1) {
    map.y = axes[1];
    map.y_values = map.y->values(points);
  }
  for (const double y : map.y_values) {
    for (const double x : map.x_values) {
      std::vector<std::string> set{override_text(map.x, x)};
      if (map.y) set.push_back(override_text(*map.y, y));
      map.results.push_back(run_hard(build, set, false, steps));
      const HardResult& r = map.results.back();
      told(point_text(map, x, y) + (r.stable ? "stable" : r.why));
    }
  }
  find_edges({build, map.x, steps}, map.x_values, map.edges);
  if (map.y) find_edges({build, *map.y, steps}, map.y_values, map.edges);
  return map;
}

std::string svg_of(const StabilityMap& map) {
  const double width = std::max(left + cell * static_cast<double>(map.x_values.size()) + 20, 640.0);
  const std::vector<std::string> margins = margins_of(map);
  const double below = top + cell * static_cast<double>(map.y_values.size()) + 62;
  const double height = below + 16 * static_cast<double>(margins.size());
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
  out += text_at(16, 22, "start", "Stability of " + map.case_name, " font-size=\"15\"");
  out += text_at(16, 42, "start", "blue: all limits kept; red x: a limit broken; ring: standard");
  out += cells_of(map) + labels_of(map) + mark_of(map);
  for (std::size_t k = 0; k < margins.size(); ++k) {
    out +=
        text_at(16, below + 16 * static_cast<double>(k), "start", margins[k], " font-size=\"11\"");
  }
  return out + "</svg>\n";
}

std::vector<std::string> margins_of(const StabilityMap& map) {
  std::vector<std::string> lines;
  for (const MapAxis* axis : {&map.x, map.y ? &*map.y : nullptr}) {
    if (axis == nullptr) continue;
    if (!axis->standard) {
      lines.push_back(fmt::format("{} has no standard value in this case", axis->key));
      continue;
    }
    for (const MapEdge& e : map.edges) {
      if (e.key != axis->key) continue;
      const double standard = *axis->standard;
      const std::string what = fmt::format("standard {} {:.4g}", e.key, standard);
      if (e.found && e.stable == e.broken) {
        lines.push_back(fmt::format("the {} is not stable itself: {}", what, e.why));
      } else if (!e.found) {
        lines.push_back(fmt::format("the {} is stable {} to the end of the range, {:.4g}", what,
                                    e.upward ? "up" : "down", e.stable));
      } else {
        const double margin = e.upward ? e.stable / standard : standard / e.stable;
        lines.push_back(
            fmt::format("the {} has a margin of {:.3g} {}: stable at {:.4g}, not at "
                        "{:.4g}",
                        what, margin, e.upward ? "upward" : "downward", e.stable, e.broken));
      }
    }
  }
  return lines;
}

}  // namespace gannet
