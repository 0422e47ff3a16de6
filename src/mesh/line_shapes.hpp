// Lines that a case describes with a few numbers, as chains of elements of two nodes.
#pragma once

#include <span>
#include <vector>

#include "base/array.hpp"
#include "base/keys.hpp"
#include "base/math.hpp"

namespace gannet {

/// Elements of two nodes over their own points: a chain, or a frame from a file.
struct LineMesh {
  std::vector<Vec3> points;  ///< along the line [m]
  std::vector<Index> cells;  ///< 2 indices into points an element
  [[nodiscard]] bool empty() const { return cells.empty(); }
};

/// Straight legs from corner to corner, leg k in n[k] equal elements. corners: 2 or more [m], no
/// two that follow each other the same; n: one a leg, >= 1. Throws nothing.
LineMesh polyline_mesh(std::span<const Vec3> corners, std::span<const int> n);

/// Keys of these shapes, under `shape` of a part.
std::vector<Key> line_shape_keys();

/// Whether the map `shape` names one of them.
bool is_line_shape(const Keys& shape);

/// The lines that the part asks for under `shape` or `mesh`. Notes every mistake that it finds in
/// the case's list and then returns an empty mesh. Throws nothing else.
LineMesh line_mesh(const Keys& part);

}  // namespace gannet
