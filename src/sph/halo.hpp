// Images: ghost particles behind the owned ones, for directions in which the
// domain repeats and for walls, which mirror the water. Kernels see them as any
// other source and never ask what they stand for; halo operations copy to them
// and add back from them.
#pragma once

#include <algorithm>
#include <array>

#include "base/array.hpp"
#include "base/math.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// How an image follows from its source, x_image = (+-x) + shift in each
/// direction.
struct Image {
  Vec3 sign = Vec3::Ones();   ///< -1 in directions that a wall mirrors: vectors
                              ///< change theirs too
  Vec3 shift = Vec3::Zero();  ///< [m]
  [[nodiscard]] Vec3 vector(const Vec3& v) const { return sign.cwiseProduct(v); }
  [[nodiscard]] Vec3 point(const Vec3& x) const { return vector(x) + shift; }
};

/// Directions in which the domain repeats or ends at a wall, and the images
/// that follow.
struct Halo {
  std::array<bool, 3> periodic{};
  /// A wall across the lower, upper end of a direction mirrors the water; never
  /// in periodic ones.
  std::array<bool, 3> wall_low{};
  std::array<bool, 3> wall_high{};
  Vec3 low = Vec3::Zero();   ///< lower faces of the domain [m], where periodic or a wall
  Vec3 high = Vec3::Zero();  ///< upper faces [m]; in periodic directions high -
                             ///< low is the period
  /// Source of ghost g, whose node is particles.end + g: index among the
  /// particles.
  Array<Index> source;
  Array<Image> image;  ///< of ghost g
  [[nodiscard]] bool has_walls() const {
    return std::ranges::find(wall_low, true) != wall_low.end() ||
           std::ranges::find(wall_high, true) != wall_high.end();
  }
  [[nodiscard]] bool active() const {
    return periodic[0] || periodic[1] || periodic[2] || has_walls();
  }
};

/// Moves each particle that left the domain to the other side, so that low <= x
/// < high in periodic directions. Positions only; nodes of other parts are
/// never wrapped. Throws nothing.
void wrap_particles(const Halo& halo, Scene& scene);

/// Chooses the images of n particles at `x`: in each direction one of the lower
/// end (a shift by a period, the mirror image at a wall), of the upper end, or
/// none, not all none, that lie within `reach` of the domain.
///   x: n [m], in the domain; reach: [m], at most one period
/// Images are in order of their kind, then of their source, so they do not
/// depend on threads.
void choose_images(const Line* x, Index n, double reach, Halo& halo);

/// Makes room for as many ghosts as halo.source has entries (or none), in every
/// field over nodes and over particles. The values of owned entries stay.
void resize_ghosts(const Halo& halo, Scene& scene);

/// Copies the values of sources to ghosts, in every field with ghost rule copy
/// or copy_shifted. Fields of three components are vectors: a wall mirrors
/// them.
void copy_out(const Halo& halo, Scene& scene);

/// Adds what ghosts collected to their sources, in every field with ghost rule
/// add_back, and clears it on the ghosts. Ghosts are taken in order, so that
/// the bits do not depend on threads.
void add_back(const Halo& halo, Scene& scene);

}  // namespace gannet
