#include "fe/beam_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fe/gauss.hpp"

namespace gannet {

namespace {

/// kappa of a full circle at nu = 0.3: 6 (1 + nu)/(7 + 6 nu), Cowper 1966, J. Appl. Mech. 33.
constexpr double kappa_round = 7.8 / 8.8;

double fourth(double x) { return x * x * x * x; }

/// Gauss points of n pieces of equal length over a length about 0, with their lengths.
struct LinePoint {
  double x = 0;
  double length = 0;
};

std::vector<LinePoint> line_points(double length, int pieces, int per_piece) {
  const GaussRule rule = gauss_rule(per_piece);
  const double half = 0.5 * length / pieces;
  std::vector<LinePoint> points;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = (2 * piece + 1 - pieces) * half;
    for (int k = 0; k < per_piece; ++k) {
      const auto i = static_cast<std::size_t>(k);
      points.push_back({middle + half * rule.point[i], half * rule.weight[i]});
    }
  }
  return points;
}

/// Fibres of a rectangle about (y, z): quarters of two points along its long sides, so that a fully
/// plastic one has its exact moment, and two points through a wall.
void add_rectangle(double y, double z, const std::vector<LinePoint>& along_y,
                   const std::vector<LinePoint>& along_z, std::vector<BeamFibre>& fibres) {
  for (const LinePoint& b : along_y) {
    for (const LinePoint& h : along_z) fibres.push_back({y + b.x, z + h.x, b.length * h.length});
  }
}

std::vector<LinePoint> along_side(double length) { return line_points(length, 4, 2); }
std::vector<LinePoint> through_wall(double thickness) { return line_points(thickness, 1, 2); }

/// Fibres of a ring between two radii: two along a radius, sixteen around.
std::vector<BeamFibre> ring_fibres(double inner, double outer) {
  constexpr int n = 16;
  std::vector<BeamFibre> fibres;
  for (const LinePoint& at : line_points(outer - inner, 1, 2)) {
    const double r = 0.5 * (outer + inner) + at.x;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / n;
      fibres.push_back(
          {r * std::cos(angle), r * std::sin(angle), 2 * std::numbers::pi / n * r * at.length});
    }
  }
  return fibres;
}

Key side(const char* name, const char* text) {
  return {.name = name, .unit = dim::length, .text = text, .required = true, .limits = positive()};
}

Key map_of(const char* name, const char* text, std::vector<Key> keys) {
  return {.name = name, .kind = Kind::map, .text = text, .keys = std::move(keys)};
}

constexpr Dimension fourth_power{{4, 0, 0, 0, 0}};

Key moment_of_area(const char* name, const char* text) {
  return {.name = name, .unit = fourth_power, .text = text, .required = true, .limits = positive()};
}

/// A wall t that fits into the least of the sides.
bool wall_fits(const Keys& keys, double t, double side) {
  if (2 * t <= side) return true;
  keys.complain("wall", fmt::format("{:g} m is more than half of {:g} m, the side", t, side));
  return false;
}

BeamSection read_i_section(const Keys& keys) {
  const double b = keys.number("width");
  const double h = keys.number("height");
  const double f = keys.number("flange");
  const double w = keys.number("web");
  if (!(2 * f < h))
    keys.complain("flange", fmt::format("two of {:g} m do not fit into {:g} m", f, h));
  if (!(w < b))
    keys.complain("web", fmt::format("{:g} m is not less than {:g} m, the width", w, b));
  return 2 * f < h && w < b ? i_section(b, h, f, w) : BeamSection{};
}

BeamSection general_section(const Keys& keys) {
  return {.A = keys.number("area"),
          .I_y = keys.number("I_y"),
          .I_z = keys.number("I_z"),
          .J = keys.number("J"),
          .A_y = keys.number_or("shear_area_y", 0),
          .A_z = keys.number_or("shear_area_z", 0)};
}

bool complete(const Keys& keys, std::initializer_list<const char*> names) {
  return std::all_of(names.begin(), names.end(), [&](const char* n) { return keys.has(n); });
}

}  // namespace

BeamSection rectangle_section(double b, double h) {
  const double a = std::max(b, h);
  const double t = std::min(b, h);
  double sum = 0;
  for (int n = 1; n < 20; n += 2) {
    sum += std::tanh(0.5 * n * std::numbers::pi * a / t) / std::pow(n, 5);
  }
  const double J = a * t * t * t / 3 * (1 - 192 * t / (std::pow(std::numbers::pi, 5) * a) * sum);
  std::vector<BeamFibre> fibres;
  add_rectangle(0, 0, along_side(b), along_side(h), fibres);
  return {.A = b * h,
          .I_y = b * h * h * h / 12,
          .I_z = h * b * b * b / 12,
          .J = J,
          .A_y = 5.0 / 6.0 * b * h,
          .A_z = 5.0 / 6.0 * b * h,
          .fibres = std::move(fibres)};
}

BeamSection round_section(double d) { return tube_section(d, 0.5 * d); }

BeamSection tube_section(double d, double t) {
  const double inner = d - 2 * t;
  const double A = 0.25 * std::numbers::pi * (d * d - inner * inner);
  const double I = std::numbers::pi / 64 * (fourth(d) - fourth(inner));
  // Cowper 1966 for a hollow circle of radii in the ratio m, at nu = 0.3.
  const double m = inner / d;
  const double q = (1 + m * m) * (1 + m * m);
  const double kappa = m > 0 ? 7.8 * q / (8.8 * q + (20 + 12 * 0.3) * m * m) : kappa_round;
  return {.A = A,
          .I_y = I,
          .I_z = I,
          .J = 2 * I,
          .A_y = kappa * A,
          .A_z = kappa * A,
          .fibres = ring_fibres(0.5 * inner, 0.5 * d)};
}

BeamSection box_section(double b, double h, double t) {
  const double bi = b - 2 * t;
  const double hi = h - 2 * t;
  const double enclosed = (b - t) * (h - t);
  std::vector<BeamFibre> fibres;
  for (const double side : {-0.5, 0.5}) {
    add_rectangle(0, side * (h - t), along_side(b), through_wall(t), fibres);
    add_rectangle(side * (b - t), 0, through_wall(t), along_side(hi), fibres);
  }
  return {.A = b * h - bi * hi,
          .I_y = (b * h * h * h - bi * hi * hi * hi) / 12,
          .I_z = (h * b * b * b - hi * bi * bi * bi) / 12,
          .J = 2 * t * enclosed * enclosed / (b + h - 2 * t),
          .A_y = 2 * t * (b - t),
          .A_z = 2 * t * (h - t),
          .fibres = std::move(fibres)};
}

BeamSection i_section(double b, double h, double f, double w) {
  const double inner = h - 2 * f;
  const double thin = 2 * b * f * f * f + (h - f) * w * w * w;
  std::vector<BeamFibre> fibres;
  for (const double side : {-0.5, 0.5}) {
    add_rectangle(0, side * (h - f), along_side(b), through_wall(f), fibres);
  }
  add_rectangle(0, 0, through_wall(w), along_side(inner), fibres);
  return {.A = 2 * b * f + inner * w,
          .I_y = (b * h * h * h - (b - w) * inner * inner * inner) / 12,
          .I_z = (2 * f * b * b * b + inner * w * w * w) / 12,
          .J = thin / 3,
          .A_y = 5.0 / 6.0 * 2 * b * f,
          .A_z = w * (h - f),
          .fibres = std::move(fibres)};
}

std::vector<Key> beam_section_keys() {
  const Key width = side("width", "side along y");
  const Key height = side("height", "side along z, the direction of `up`");
  const Key diameter = side("diameter", "outer diameter");
  const Key wall = side("wall", "thickness of the wall");
  const auto shear = [](const char* name, const char* text) {
    return Key{.name = name, .unit = dim::area, .text = text, .limits = positive()};
  };
  return {map_of("rectangle", "a full rectangle", {width, height}),
          map_of("solid_round", "a full circle", {diameter}),
          map_of("tube", "a round tube", {diameter, wall}),
          map_of("box", "a rectangular tube", {width, height, wall}),
          map_of("i", "two flanges across `up` and a web between them",
                 {width, height, side("flange", "thickness of a flange"),
                  side("web", "thickness of the web")}),
          map_of("general", "any section, by its numbers",
                 {{.name = "area",
                   .unit = dim::area,
                   .text = "its area",
                   .required = true,
                   .limits = positive()},
                  moment_of_area("I_y", "integral of z^2: bending along z"),
                  moment_of_area("I_z", "integral of y^2: bending along y"),
                  moment_of_area("J", "torsion constant"),
                  shear("shear_area_y", "area that carries shear along y; without it stiff"),
                  shear("shear_area_z", "area that carries shear along z; without it stiff")})};
}

BeamSection read_beam_section(const Keys& section) {
  const std::vector<std::string> names = section.names();
  if (names.size() != 1) {
    section.mistakes().add(
        section.where(),
        fmt::format(
            "{}: {} sections are named; one of rectangle, solid_round, tube, box, i, general "
            "is wanted",
            section.path(), names.size()));
    return {};
  }
  const Keys keys = section.map(names[0]);
  // Keys that are required and missing: the reader has complained.
  if (names[0] == "rectangle" && complete(keys, {"width", "height"})) {
    return rectangle_section(keys.number("width"), keys.number("height"));
  }
  if (names[0] == "solid_round" && complete(keys, {"diameter"})) {
    return round_section(keys.number("diameter"));
  }
  if (names[0] == "tube" && complete(keys, {"diameter", "wall"})) {
    const double d = keys.number("diameter");
    const double t = keys.number("wall");
    return wall_fits(keys, t, d) ? tube_section(d, t) : BeamSection{};
  }
  if (names[0] == "box" && complete(keys, {"width", "height", "wall"})) {
    const double b = keys.number("width");
    const double h = keys.number("height");
    const double t = keys.number("wall");
    return wall_fits(keys, t, std::min(b, h)) ? box_section(b, h, t) : BeamSection{};
  }
  if (names[0] == "i" && complete(keys, {"width", "height", "flange", "web"})) {
    return read_i_section(keys);
  }
  if (names[0] == "general" && complete(keys, {"area", "I_y", "I_z", "J"})) {
    return general_section(keys);
  }
  return {};
}

}  // namespace gannet
