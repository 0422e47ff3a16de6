#include "fe/shell_frame.hpp"

#include <algorithm>

namespace gannet {

namespace {

Vec3 corner(std::span<const Line> x, Index node) { return xyz(x[static_cast<std::size_t>(node)]); }

}  // namespace

ElementFrame frame_of(const ShellBlock& block, Index e, std::span<const Line> x) {
  const int n_corners = block.n_corners();
  Vec3 p[4];
  for (int a = 0; a < 4; ++a) {
    p[a] = corner(x, corner_of(block.corners, n_corners, e, std::min(a, n_corners - 1)));
  }
  const Vec3 n = (p[2] - p[0]).cross(p[3] - p[1]);
  ElementFrame frame;
  frame.area = 0.5 * n.norm();
  const Vec3 e3 = n.normalized();
  Vec3 side = p[1] - p[0];
  if (block.section.kind == ShellKind::quad) {
    side = (p[1] + p[2]) - (p[0] + p[3]) + ((p[2] + p[3]) - (p[0] + p[1])).cross(e3);
  } else if (block.section.kind == ShellKind::triangle) {
    side += (p[2] - p[0]).cross(e3);
  }
  const Vec3 e1 = (side - side.dot(e3) * e3).normalized();
  frame.axes << e1, e3.cross(e1), e3;
  return frame;
}

}  // namespace gannet
