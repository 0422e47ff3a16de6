// Dummy particles of walls: what the fluid near them says their pressure and velocity are.
//
// A wall particle is an ordinary particle whose velocity is given. Its pressure makes the pressure
// gradient between it and the fluid what the motion of the wall wants (Adami, Hu and Adams 2012, J.
// Comput. Phys. 231, 7057):
//   p_w = [sum_f p_f W_wf + (g - a_w) . sum_f rho_f r_wf W_wf] / sum_f W_wf,   r_wf = x_w - x_f
//   v~_w = sum_f v_f W_wf / sum_f W_wf
// with sums over fluid particles alone. W is the cubic spline over the reach of the case's kernel:
// any positive weight does for a mean.
#pragma once

#include <span>

#include "base/array.hpp"
#include "base/math.hpp"
#include "search/cluster_list.hpp"
#include "sph/pair_pass.hpp"

namespace gannet {

/// Sums over the fluid near one wall particle.
struct alignas(64) WallSums {
  double W = 0;                            ///< [1/m^dimension]
  double p = 0;                            ///< sum p W
  double rho_x = 0, rho_y = 0, rho_z = 0;  ///< sum rho r_wf W
  double v_x = 0, v_y = 0, v_z = 0;        ///< sum v W
};

/// What the fluid gives a wall particle.
struct WallValues {
  double p = 0;           ///< [Pa]
  Vec3 v = Vec3::Zero();  ///< v~ [m/s]
};

/// p_w and v~_w from the sums; needs sums.W > 0. g_minus_a: g - a_w, 3 [m/s^2].
WallValues wall_values(const WallSums& sums, const Vec3& g_minus_a);

/// Which pairs of fluid and wall a list keeps.
enum class Across { fluid_near_walls, walls_near_fluid };

/// The lists of the active clusters that hold wall particles, with the fluid among their sources
/// alone; or of those that hold fluid, with the walls alone.
///   list: of all particles; is_wall: n_sources, 1 for wall particles
/// kept: the same clusters as `list`, empty where there is nothing to do; `clusters`: numbers of
/// those that are not empty, rising.
void keep_across(const ClusterList& list, std::span<const std::uint8_t> is_wall, Across across,
                 ClusterList& kept, Array<Index>& clusters);

/// The sums for every lane of the listed clusters: sums[8 c + k] for lane k of clusters[c]. Lanes
/// that are no wall particles get sums that mean nothing.
/// view: with p. reach: radius of W's support [m], > 0, at most that of the list.
void wall_sums(const ClusterList& near, std::span<const Index> clusters, const ParticleView& view,
               int dimension, double reach, Array<WallSums>& sums);

}  // namespace gannet
