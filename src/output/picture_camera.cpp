#include "output/picture_camera.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/error.hpp"

namespace gannet {

namespace {

/// azimuth: about z from the front (-y) towards +x; elevation: above the horizontal [degrees].
View three_quarter_view(double azimuth, double elevation) {
  constexpr double degree = std::numbers::pi / 180;
  const double a = azimuth * degree;
  const double e = elevation * degree;
  View view;
  view.right = {std::cos(a), std::sin(a), 0};
  view.toward = {std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e)};
  view.up = view.toward.cross(view.right);
  return view;
}

}  // namespace

View view_of(const std::string& text) {
  if (text == "iso") return three_quarter_view(-30, 20);
  if (text == "x") return {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  if (text == "y") return {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
  if (text == "z") return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  double azimuth = 0;
  double elevation = 0;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%lf,%lf%c", &azimuth, &elevation, &rest);
  if (n != 2 || !(std::abs(azimuth) <= 360) || !(std::abs(elevation) <= 90)) {
    throw InputError({"--view " + text +
                      ": must be iso, x, y, z, or AZIMUTH,ELEVATION in degrees (\"30,20\"; "
                      "azimuth in [-360, 360], elevation in [-90, 90])"});
  }
  return three_quarter_view(azimuth, elevation);
}

void Extent::include(double across, double upward) {
  left = std::min(left, across);
  right = std::max(right, across);
  bottom = std::min(bottom, upward);
  top = std::max(top, upward);
}

void Extent::include(const Extent& other) {
  if (other.empty()) return;
  include(other.left, other.bottom);
  include(other.right, other.top);
}

Camera camera_for(const View& view, const Extent& extent, const Area& area) {
  Camera camera{.view = view};
  if (extent.empty()) return camera;
  // A scene without any width or height, such as a single particle, fills a metre of the other.
  const double width = std::max(extent.right - extent.left, 1e-12);
  const double height = std::max(extent.top - extent.bottom, 1e-12);
  camera.scale = std::max(width, height) > 1e-12
                     ? std::min(area.width / width, area.height / height)
                     : area.width;
  camera.origin_column =
      area.left + area.width / 2 - camera.scale * (extent.left + extent.right) / 2;
  camera.origin_row = area.top + area.height / 2 + camera.scale * (extent.bottom + extent.top) / 2;
  return camera;
}

Vec3 project(const Camera& camera, const Vec3& x) {
  return {camera.origin_column + camera.scale * camera.view.right.dot(x),
          camera.origin_row - camera.scale * camera.view.up.dot(x),
          camera.scale * camera.view.toward.dot(x)};
}

}  // namespace gannet
