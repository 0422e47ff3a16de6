// What all pictures of a series share: view, extent, colours.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.hpp"
#include "output/picture.hpp"
#include "output/picture_cut.hpp"

namespace gannet {

namespace {

constexpr double outermost = 0.002;   ///< share of particles at each side that may be strays
constexpr double near_enough = 0.15;  ///< strays this far out, in widths of all others, still count
constexpr double extreme = 0.005;     ///< share of values at each end that may exceed the colours
constexpr double radius_per_spacing = 0.55;

/// Particles of a plane scene lie on one z.
bool lies_in_plane(const DrawnFrame& frame) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const DrawnPart& part : frame.parts) {
    if (!part.particles) continue;
    for (const Vec3& x : part.points) {
      low = std::min(low, x.z());
      high = std::max(high, x.z());
    }
  }
  return low == high;
}

/// Least and largest, but strays count only where they are near enough.
Span span_without_strays(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const Span most = trimmed_span(values, outermost);
  const double reach = near_enough * (most.high - most.low);
  return {std::max(*low, most.low - reach), std::min(*high, most.high + reach)};
}

void include_part(PictureSetup& setup, const DrawnPart& part, double radius,
                  const PointTest& shows) {
  std::vector<double> across;
  std::vector<double> upward;
  for (const Vec3& x : part.points) {
    if (!shows(x) || !x.allFinite()) continue;
    across.push_back(setup.view.right.dot(x));
    upward.push_back(setup.view.up.dot(x));
  }
  if (across.empty()) return;
  const Span a = span_without_strays(across);
  const Span u = span_without_strays(upward);
  setup.extent.include(a.low - radius, u.low - radius);
  setup.extent.include(a.high + radius, u.high + radius);
}

void include_points(PictureSetup& setup, const DrawnFrame& frame, const PictureOptions& options) {
  const PointTest shows = test_of(options.cut, setup.view);
  for (std::size_t k = 0; k < frame.parts.size(); ++k) {
    include_part(setup, frame.parts[k], k < setup.radius.size() ? setup.radius[k] : 0, shows);
  }
}

}  // namespace

Cut cut_of(const std::string& text) {
  char axis = 0;
  char rest = 0;
  Cut cut;
  const int n = std::sscanf(text.c_str(), " %c = %lf %c", &axis, &cut.at, &rest);
  if (n != 2 || axis < 'x' || axis > 'z') {
    throw InputError({"--cut " + text + ": must be x, y or z, '=', and metres (\"y=0.1\")"});
  }
  cut.axis = axis - 'x';
  return cut;
}

double spacing_of(const std::vector<Vec3>& points) {
  if (points.size() < 2) return 0;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 64);
  std::vector<double> nearest;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) least = std::min(least, (points[j] - points[i]).squaredNorm());
    }
    nearest.push_back(std::sqrt(least));
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

PictureSetup setup_of(const DrawnFrame& first, const PictureOptions& options) {
  PictureSetup setup;
  const std::string standard = lies_in_plane(first) ? "z" : "iso";
  setup.view = view_of(options.view.empty() ? standard : options.view);
  setup.colours_particles = false;
  for (const DrawnPart& part : first.parts) {
    setup.radius.push_back(part.particles ? radius_per_spacing * spacing_of(part.points) : 0);
    setup.colours_particles |= part.particles && !part.values.empty();
  }
  include_points(setup, first, options);
  return setup;
}

void include_frame(PictureSetup& setup, const DrawnFrame& frame, const PictureOptions& options) {
  const PointTest shows = test_of(options.cut, setup.view);
  include_points(setup, frame, options);
  std::vector<double> values;
  for (const DrawnPart& part : frame.parts) {
    if (part.particles != setup.colours_particles) continue;
    for (std::size_t i = 0; i < part.values.size(); ++i) {
      if (!part.particles || shows(part.points[i])) values.push_back(part.values[i]);
    }
  }
  if (values.empty()) return;
  const Span span = trimmed_span(std::move(values), extreme);
  if (!setup.has_values) setup.values = span;
  setup.values = {std::min(setup.values.low, span.low), std::max(setup.values.high, span.high)};
  setup.has_values = true;
}

}  // namespace gannet
