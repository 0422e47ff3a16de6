// Numbers that several shapes ask a case for.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/keys.hpp"
#include "base/math.hpp"
#include "base/schema.hpp"

namespace gannet {

inline constexpr double most_cells = 1e8;  // beyond it somebody has mistaken a unit

/// The whole numbers >= 1 under `key`; nothing, and a complaint, where they are something else.
template <std::size_t N>
std::optional<std::array<int, N>> counts(const Keys& keys, std::string_view key) {
  if (!keys.has(key)) return {};  // required: the reader has complained
  const std::vector<double>& given = keys.numbers(key);
  if (given.size() != N) {
    keys.complain(
        key, fmt::format("{} numbers are given; {} are wanted, one a direction", given.size(), N));
    return {};
  }
  std::array<int, N> n{};
  double cells = 1;
  for (std::size_t k = 0; k < N; ++k) {
    if (given[k] < 1 || given[k] > most_cells || given[k] != std::floor(given[k])) {
      keys.complain(key, fmt::format("{:g} is not a number of elements; whole numbers from 1 on "
                                     "are wanted",
                                     given[k]));
      return {};
    }
    n[k] = static_cast<int>(given[k]);
    cells *= given[k];
  }
  if (cells > most_cells) {
    keys.complain(
        key, fmt::format("{:g} elements are more than the largest mesh ({:g})", cells, most_cells));
    return {};
  }
  return n;
}

/// The points under `key`, a list of three lengths each; none, and a complaint, after a mistake.
inline std::vector<Vec3> points_under(const Keys& keys, std::string_view key) {
  std::vector<Vec3> points;
  for (const Value& point : keys.value(key).children) {
    if (point.children.size() != 3) {
      keys.complain(point, "a point is wanted: [x, y, z]");
      return {};
    }
    Vec3 x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[static_cast<Eigen::Index>(k)] = keys.quantity(point.children[k], dim::length);
    }
    points.push_back(x);
  }
  return points;
}

/// Whether `to` lies beyond `from` along the first n axes; complains under 'to' where not.
inline bool box_is_open(const Keys& keys, const Vec3& from, const Vec3& to, int n) {
  for (Eigen::Index k = 0; k < n; ++k) {
    if (to[k] > from[k]) continue;
    keys.complain("to", fmt::format("{} = {:g} m must be greater than that of 'from', {:g} m",
                                    "xyz"[k], to[k], from[k]));
    return false;
  }
  return true;
}

inline Key place_key(const std::string& name, const std::string& text, bool required = false) {
  return {
      .name = name, .kind = Kind::vector, .unit = dim::length, .text = text, .required = required};
}

inline Key elements_key(const std::string& text) {
  return {.name = "elements", .kind = Kind::numbers, .text = text, .required = true};
}

inline Key length_key(const std::string& name, const std::string& text) {
  return {.name = name, .unit = dim::length, .text = text, .required = true, .limits = positive()};
}

}  // namespace gannet
