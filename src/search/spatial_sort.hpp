// Spatial sort: particles that are near in space stand near in memory, and eight consecutive
// particles form a compact cluster (see cluster_list.hpp).
//
// Space is cut into columns along x, of a square cross section (width, width) in y and z. Columns
// follow each other in a serpentine over y and z, and particles within a column follow x, up and
// down in turn. In 2D (all z equal) the columns are rows.
#pragma once

#include <cstdint>
#include <span>

#include "base/array.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Points sorted into columns: column c = iz n_y + iy holds the points order[start[c]] up to
/// order[start[c + 1]]. The outermost columns also hold what lies beyond them.
struct Columns {
  Index n_y = 0;
  Index n_z = 0;
  double y_min = 0;  ///< lower side of column iy = 0 [m]
  double z_min = 0;
  double width = 0;  ///< [m]
  bool serpentine = false;
  Array<Index> start;        ///< n_y n_z + 1 entries
  Array<Index> order;        ///< one entry a point
  Array<Index> column_of;    ///< work space: the column of each point
  Array<std::uint64_t> key;  ///< work space: what points are sorted by
};

/// Sorts points into columns along x; within a column by x (to 2^-32 of the extent), ties by index.
/// With `serpentine`, columns are numbered forth and back (in iz odd, iy runs down) and every
/// second column falls in x; without, all columns rise in x and c = iz n_y + iy. x: positions [m],
/// finite; width: cross section of a column [m], positive. The number of columns is limited to
/// twice the number of points (and at least 4096): beyond that, points far out share the outermost
/// columns. The same for any number of threads.
void sort_into_columns(std::span<const Line> x, double width, bool serpentine, Columns& columns);

/// The spatial order of particles: order[k] is the index of the particle that comes to place k.
/// Columns are 2 dx wide; a function of the positions alone except for ties, which keep the
/// present order, so that sorting twice changes nothing.
/// x: positions [m], finite; dx: particle spacing [m], positive.
void spatial_order(std::span<const Line> x, double dx, Array<Index>& order);

/// Moves every particle with all that belongs to it: place k gets what was at place order[k].
/// Permutes every tracked field over particles, the particle range of every tracked field over
/// nodes that reaches over it (position, mass, velocity, force, id, ...), and replaces the entries
/// of all scene.index_lists. Index lists hold particle indices, which are entries of particle
/// fields: node - scene.particles.begin; entries outside of [0, n) stay as they are.
/// Ghosts do not move: their owner makes them anew after a sort.
/// order: a permutation of [0, n), n at most scene.particles.size(); those behind stay.
void permute_particles(Scene& scene, std::span<const Index> order);

/// spatial_order() of the scene's particles that are computed, then permute_particles().
/// dx: particle spacing [m], positive.
void sort_particles(Scene& scene, double dx);

}  // namespace gannet
