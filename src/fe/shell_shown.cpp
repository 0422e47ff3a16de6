#include "fe/shell_shown.hpp"

#include <algorithm>
#include <cassert>

#include "base/parallel.hpp"
#include "fe/shell_frame.hpp"

namespace gannet {

namespace {

/// Local stress at the middle surface of element e: the point at z = 0 or the two next to it.
Mat3 middle_stress(const ShellBlock& block, Index e) {
  const int n = block.layout.n_points;
  const int lower = (n - 1) / 2;
  const int upper = n / 2;
  const int in_plane = block.layout.in_plane();
  const auto at = [&](int component) {
    double sum = 0;
    for (int g = 0; g < in_plane; ++g) {
      const int first = block.layout.stress(g) + component;
      sum += 0.5 * (block.value(e, first + lower * block.layout.per_point) +
                    block.value(e, first + upper * block.layout.per_point));
    }
    return sum / in_plane;
  };
  double xz = 0;
  double yz = 0;
  for (int g = 0; g < in_plane; ++g) {
    xz += block.value(e, block.layout.shear() + 2 * g) / in_plane;
    yz += block.value(e, block.layout.shear() + 2 * g + 1) / in_plane;
  }
  Mat3 s;
  s << at(0), at(2), xz, at(2), at(1), yz, xz, yz, 0;
  return s;
}

/// A symmetric tensor in the plane of the element, with its shear to the normal, as the six global
/// components xx, yy, zz, xy, yz, xz.
void write_global(const Mat3& axes, const Mat3& local, double* out) {
  const Mat3 s = axes * local * axes.transpose();
  out[0] = s(0, 0);
  out[1] = s(1, 1);
  out[2] = s(2, 2);
  out[3] = s(0, 1);
  out[4] = s(1, 2);
  out[5] = s(0, 2);
}

/// The largest of number j of the history of the points of each element that is there; `gone` of
/// those that have left.
void show_largest(const ShellBlock& block, int j, double gone, Array<double>& shown) {
  shown.assign(static_cast<std::size_t>(block.n_elements), 0);
  parallel_for(block.n_elements, node_chunk, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      double& largest = shown[static_cast<std::size_t>(e)];
      if (!(block.value(e, block.layout.thickness()) > 0)) {
        largest = gone;
        continue;
      }
      for (int k = 0; k < block.layout.in_plane() * block.layout.n_points; ++k) {
        largest = std::max(largest, block.value(e, block.layout.per_point * k + 3 + j));
      }
    }
  });
}

}  // namespace

void show_stress(ShellBlock& block, std::span<const Line> x) {
  block.stress_shown.resize(6 * static_cast<std::size_t>(block.n_elements));
  parallel_for(block.n_elements, node_chunk, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      // Who has left goes on being strained by corners that others move, and stands for nothing.
      const bool there = block.value(e, block.layout.thickness()) > 0;
      const Mat3 stress = there ? middle_stress(block, e) : Mat3::Zero();
      write_global(frame_of(block, e, x).axes, stress,
                   &block.stress_shown[6 * static_cast<std::size_t>(e)]);
    }
  });
}

void show_section_forces(ShellBlock& block, std::span<const Line> x) {
  const ShellLayout& layout = block.layout;
  const int in_plane = layout.in_plane();
  block.forces_shown.resize(15 * static_cast<std::size_t>(block.n_elements));
  parallel_for(block.n_elements, node_chunk, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const double t = block.value(e, layout.thickness());
      Mat3 N = Mat3::Zero();
      Mat3 M = Mat3::Zero();
      Vec3 Q = Vec3::Zero();
      for (int g = 0; g < in_plane; ++g) {
        for (int k = 0; k < layout.n_points; ++k) {
          const PlaneStress<double> sigma = stress_at(block, e, g * layout.n_points + k);
          Mat3 plane = Mat3::Zero();
          plane.topLeftCorner<2, 2>() << sigma.xx, sigma.xy, sigma.xy, sigma.yy;
          N += block.constants.weight[k] * t / in_plane * plane;
          M += block.constants.weight[k] * t / in_plane * (0.5 * t * block.constants.point[k]) *
               plane;
        }
        const double share = block.constants.shear_factor * t / in_plane;
        Q.x() += share * block.value(e, layout.shear() + 2 * g);
        Q.y() += share * block.value(e, layout.shear() + 2 * g + 1);
      }
      const Mat3 axes = frame_of(block, e, x).axes;
      double* out = &block.forces_shown[15 * static_cast<std::size_t>(e)];
      write_global(axes, N, out);
      write_global(axes, M, out + 6);
      const Vec3 global = axes * Q;
      for (int d = 0; d < 3; ++d) out[12 + d] = global[d];
    }
  });
}

void show_plastic_strain(ShellBlock& block) {
  assert(block.material.plastic());
  show_largest(block, 0, 0, block.plastic_shown);
}

void show_damage(ShellBlock& block) {
  assert(block.constants.history.damage >= 0);
  show_largest(block, block.constants.history.damage, 1, block.damage_shown);
}

}  // namespace gannet
