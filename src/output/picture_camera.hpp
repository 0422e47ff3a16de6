// Where the viewer stands, and where on the picture a point of the scene falls.
#pragma once

#include <limits>
#include <string>

#include "base/math.hpp"

namespace gannet {

/// Directions of a picture, orthonormal: to the right, up, and towards the viewer.
struct View {
  Vec3 right = Vec3::UnitX();
  Vec3 up = Vec3::UnitZ();
  Vec3 toward = -Vec3::UnitY();
};

/// "x": seen from +x, z up. "y": from -y (the front: x to the right), z up. "z": from +z, y up.
/// "iso": three-quarter view, the same as "-30,20". "A,E": from the front, moved A degrees about z
/// towards +x and raised by E degrees. Throws InputError for anything else.
View view_of(const std::string& text);

/// What a view has to show: least and largest right . x and up . x [m].
struct Extent {
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();

  void include(double across, double upward);
  void include(const Extent& other);
  [[nodiscard]] bool empty() const { return left > right; }
};

/// Rectangle of a picture in pixels, y downwards.
struct Area {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;
};

/// Parallel projection (a sphere stays a circle):
///   column = origin_column + scale right . x,  row = origin_row - scale up . x,
///   depth = scale toward . x
struct Camera {
  View view;
  double scale = 1;  ///< pixels per metre
  double origin_column = 0;
  double origin_row = 0;
};

/// The camera that shows `extent` as large as `area` allows, in its middle.
Camera camera_for(const View& view, const Extent& extent, const Area& area);

/// (column, row, depth) of x, in pixels; a larger depth is nearer to the viewer.
Vec3 project(const Camera& camera, const Vec3& x);

}  // namespace gannet
