// Stability maps: over a grid of one or two parameters of a case, which runs keep all limits.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/hard_run.hpp"

namespace gannet {

/// One parameter of a map: a key of the case with a number, and the range it is taken over.
struct MapAxis {
  std::string key;    ///< "effects.time_step.scale"
  std::string unit;   ///< SI, for labels; "-" for plain numbers
  double lowest = 0;  ///< SI
  double highest = 0;
  std::optional<double> standard;  ///< what the case has where nothing is set
  /// True where the ends differ by a factor of 8 or more: points are then spread by factors.
  [[nodiscard]] bool logarithmic() const { return lowest > 0 && highest / lowest >= 8; }
  /// n values from lowest to highest, evenly or by equal factors.
  [[nodiscard]] std::vector<double> values(int n) const;
  /// The value halfway between two, evenly or by factors.
  [[nodiscard]] double middle(double a, double b) const;
};

/// Reads "key=lowest..highest". Throws InputError.
MapAxis read_map_axis(const std::string& text);

/// Where stability ends on one side of the standard value, the other parameter at its standard.
struct MapEdge {
  std::string key;
  bool upward = true;
  bool found = false;  ///< false: all values of the range on that side are stable
  double stable = 0;   ///< the furthest value known to be stable
  double broken = 0;   ///< the nearest value known not to be
  std::string why;
};

struct StabilityMap {
  std::string case_name;
  MapAxis x;
  std::optional<MapAxis> y;
  std::vector<double> x_values, y_values;  ///< y_values: one entry, unused, without y
  std::vector<HardResult> results;         ///< x runs fastest
  std::vector<MapEdge> edges;
};

/// "key=value" with all digits.
std::string override_text(const MapAxis& axis, double value);

/// Runs the case at each point of the grid; then, along each axis that has a standard value,
/// bisects from it to the edge of stability. told: called with each result, for progress.
StabilityMap make_stability_map(const std::string& case_name, const HardBuilder& build,
                                const std::vector<MapAxis>& axes, int points, std::int64_t steps,
                                const std::function<void(const std::string&)>& told);

/// The map as a picture, one cell a run: SVG.
std::string svg_of(const StabilityMap& map);

/// The margins in sentences: "the standard effects.time_step.scale 1 is stable up to 1.6 (...)".
std::vector<std::string> margins_of(const StabilityMap& map);

}  // namespace gannet
