// Filling a region with particles.
#pragma once

#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/math.hpp"

namespace gannet {

/// Particles on a lattice that fills `fill.box` of the part.
///   n_k = round(L_k / spacing),  x_k = from_k + (i + 1/2) L_k / n_k
/// so that the first layer stands half a cell off every face. x runs fastest, z slowest. Of
/// `fill.ellipsoid` (in the plane an ellipse) and `fill.cylinder` (along an axis) those points of a
/// lattice of the spacing, centred, that lie inside.
/// spacing: [m], > 0. dimension: 3, or 2 for the x-y plane, where all points have z = 0.
/// `fill.jitter` moves each point by a random part of a cell, the same one in every run.
/// A box thinner than one spacing, or turned inside out, is a mistake: it is noted in the case's
/// list and no point is returned. Throws nothing.
std::vector<Vec3> fill_points(const Keys& part, double spacing, int dimension);

/// Volume of one cell of that lattice, so that n cells are the box exactly (spacing^dimension
/// where the box is a whole number of spacings): [m^3], in 2D [m^2]. 0 where nothing is filled.
double fill_cell_volume(const Keys& part, double spacing, int dimension);

/// What a user should know of how the fill meets its box: where the spacing does not divide an
/// edge, how far apart particles stand in that direction, and by how much the volume of a particle
/// differs from spacing^dimension; of other shapes, by how much the cells inside differ from them.
/// "" where every edge is a whole number of spacings (to 1e-6).
std::string fill_note(const Keys& part, double spacing, int dimension);

}  // namespace gannet
