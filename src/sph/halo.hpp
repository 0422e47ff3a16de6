// Periodic images: ghost particles behind the owned ones. Kernels see them as any other source and
// never ask about periodicity; halo operations copy to them and add back from them.
#pragma once

#include <array>

#include "base/array.hpp"
#include "base/math.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Directions in which the domain repeats, and the images that stand for the repetition.
struct Halo {
  std::array<bool, 3> periodic{};
  Vec3 low = Vec3::Zero();   ///< lower faces of the domain [m], in periodic directions
  Vec3 high = Vec3::Zero();  ///< upper faces [m]; high - low is the period
  /// Source of ghost g, whose node is particles.end + g: index among the particles.
  Array<Index> source;
  Array<Line> shift;  ///< position of a ghost minus that of its source [m]
  [[nodiscard]] bool active() const { return periodic[0] || periodic[1] || periodic[2]; }
};

/// Moves each particle that left the domain to the other side, so that low <= x < high in periodic
/// directions. Positions only; nodes of other parts are never wrapped. Throws nothing.
void wrap_particles(const Halo& halo, Scene& scene);

/// Chooses the images of n particles at `x`: every shift by whole periods (-1, 0 or 1 in each
/// periodic direction, not all 0) that brings a particle within `reach` of the domain.
///   x: n [m], in the domain; reach: [m], at most one period
/// Images are in order of their shift, then of their source, so they do not depend on threads.
void choose_images(const Line* x, Index n, double reach, Halo& halo);

/// Makes room for as many ghosts as halo.source has entries (or none), in every field over nodes
/// and over particles. The values of owned entries stay.
void resize_ghosts(const Halo& halo, Scene& scene);

/// Copies the values of sources to ghosts, in every field with ghost rule copy or copy_shifted.
void copy_out(const Halo& halo, Scene& scene);

/// Adds what ghosts collected to their sources, in every field with ghost rule add_back, and
/// clears it on the ghosts. Ghosts are taken in order, so that the bits do not depend on threads.
void add_back(const Halo& halo, Scene& scene);

}  // namespace gannet
