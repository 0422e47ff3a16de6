#include "contact/kernel_start.hpp"

#include <algorithm>
#include <cmath>

namespace gannet {

namespace {

constexpr double share_of_force = 0.01;    // of rho0 c0^2 V/dp: where a contact begins to push
constexpr double share_of_spacing = 0.05;  // that a particle may stand nearer than there

/// Energy of the pairs of a row at the places that the list was made from [J].
double energy_of_row(const KernelContact& c, Index row) {
  const Vec3 x = xyz(c.x_search[static_cast<std::size_t>(c.candidates.point[row])]);
  double energy = 0;
  for (Index e = c.candidates.begin[row]; e < c.candidates.begin[row + 1]; ++e) {
    const auto j = static_cast<std::size_t>(c.candidates.segment[e]);
    const Vec3 here =
        c.candidates.image.empty() ? x : image_of(*c.periods, x, c.candidates.image[e]);
    const double r = (here - xyz(c.surface.x[j])).norm();
    if (r < c.law.kernel.reach()) energy += c.V_particle * c.V_node[j] * c.law.potential(r);
  }
  return energy;
}

}  // namespace

KernelStart look_at_start(Scene& scene, KernelContact& c, double rho0, double c0) {
  const double dp = std::pow(c.V_particle, 1.0 / c.law.kernel.dimension);
  KernelStart start;
  start.stand_off = height_of_force(c.law, c.V_particle, c.thickness,
                                    share_of_force * rho0 * c0 * c0 * c.V_particle / dp);
  const double nearest = start.stand_off - share_of_spacing * dp;
  const double allowed = energy_of_plane(c.law, c.V_particle, c.thickness, std::max(0.0, nearest));
  list_pairs_of_now(scene, c);
  double most = 0;
  for (Index row = 0; row < c.candidates.n_rows(); ++row) {
    const double energy = energy_of_row(c, row);
    if (energy > allowed) ++start.count;
    most = std::max(most, energy);
  }
  if (start.count > 0) {
    start.depth = start.stand_off - height_of_energy(c.law, c.V_particle, c.thickness, most);
    start.speed = std::sqrt(2 * most / (rho0 * c.V_particle));
  }
  c.search_numbers[1] = static_cast<double>(start.count);
  c.search_numbers[2] = start.depth;
  return start;
}

}  // namespace gannet
