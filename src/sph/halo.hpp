// Images: ghost particles behind the owned ones, for directions in which the
// domain repeats and for walls, which mirror the water. Kernels see them as any
// other source and never ask what they stand for; halo operations copy to them
// and add back from them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// Ghosts that follow from their sources in one way.
struct ImageKind {
  Image image;
  Range ghosts;  ///< numbers of the ghosts, from 0
};

/// A mirror wall, and the plane of the scene that it follows.
struct MirrorWall {
  Eigen::Index axis = 0;
  bool lower = true;  ///< the lower end of the direction
  std::size_t plane = 0;
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
  /// Of those walls, the ones that move: low and high are then where they were at
  /// the last build (tracked), and moving_walls.hpp says where they are.
  std::vector<MirrorWall> moving;
  /// Of those walls, the ones that water sticks to (sticking_walls.hpp).
  std::vector<MirrorWall> sticking;
  /// Source of ghost g, whose node is particles.end + g: index among the
  /// particles.
  Array<Index> source;
  Array<std::uint8_t> kind;      ///< of ghost g: place in `kinds`
  std::vector<ImageKind> kinds;  ///< in the order of their ghosts, none without any
  [[nodiscard]] Index n_ghosts() const { return static_cast<Index>(source.size()); }
  /// How ghost g follows from its source.
  [[nodiscard]] const Image& image_of(Index g) const { return kinds[kind[g]].image; }
  void clear_images() {
    source.clear();
    kind.clear();
    kinds.clear();
  }
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

/// Calls f(image, begin, end) for the stretches of [begin, end) whose ghosts are of one kind, in
/// order.
template <class F>
void for_kinds(const Halo& halo, Index begin, Index end, F&& f) {
  for (const ImageKind& kind : halo.kinds) {
    const Index from = std::max(begin, kind.ghosts.begin);
    const Index to = std::min(end, kind.ghosts.end);
    if (from < to) f(kind.image, from, to);
  }
}

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

/// Fields of a scene, by their place in scene.fields.
using FieldPlaces = std::vector<std::size_t>;

/// The fields that ghosts have a copy of: rule copy or copy_shifted, over nodes or particles.
FieldPlaces copied_fields(const Scene& scene);

/// Copies the values of sources to ghosts, in the fields given (all of rule copy or copy_shifted)
/// or in all that are copied. Fields of three components are vectors: a wall mirrors them.
void copy_out(const Halo& halo, Scene& scene, std::span<const std::size_t> fields);
void copy_out(const Halo& halo, Scene& scene);

/// Adds what ghosts collected to their sources, in every field with ghost rule
/// add_back, and clears it on the ghosts. What meets in one source is added in the order of the
/// ghosts, so that the bits do not depend on threads.
void add_back(const Halo& halo, Scene& scene);

}  // namespace gannet
