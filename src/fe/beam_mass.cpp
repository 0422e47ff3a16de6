#include "fe/beam_mass.hpp"

#include <algorithm>

#include "fe/element_blocks.hpp"

namespace gannet {

namespace {

BeamNodeMass mass_of(const BeamLaw& law, double l0) {
  const BeamSection& s = law.section;
  const double m = 0.5 * law.rho * s.A * l0;
  const RotaryRatios r = rotary_ratios(law, l0);
  return {m, m / s.A * Vec3(s.I_y + s.I_z, r.y * s.I_y, r.z * s.I_z)};
}

}  // namespace

RotaryRatios rotary_ratios(const BeamLaw& law, double l0) {
  if (law.rotary_inertia > 0) return {law.rotary_inertia, law.rotary_inertia};
  const BeamSection& s = law.section;
  const auto wanted = [&](double I, double A_s) {
    const double room = 1 + shear_ratio(law, I, A_s, l0) - 12 * I / (s.A * l0 * l0);
    return std::max(1.0, 3 / std::max(1.0, room));
  };
  return {wanted(s.I_y, s.A_z), wanted(s.I_z, s.A_y)};
}

double omega2_of(const BeamLaw& law, double l0, double l, double N) {
  const BeamSection& s = law.section;
  const BeamNodeMass mass = mass_of(law, l0);
  const auto bending = [&](double I_s, double A_s, double J_r) {
    const double k = 12 * law.E * I_s / (l0 * (1 + shear_ratio(law, I_s, A_s, l0)));
    return std::max(k * (2 / (mass.m * l * l) + 0.5 / J_r) + 4 * std::max(N, 0.0) / (l * mass.m),
                    2 * law.E * I_s / (l0 * J_r));
  };
  return std::max({2 * law.E * s.A / (l0 * mass.m), 2 * law.G * s.J / (l0 * mass.I.x()),
                   bending(s.I_y, s.A_z, mass.I.y()), bending(s.I_z, s.A_y, mass.I.z())});
}

BeamNodeMass node_mass(const BeamBlock& block, Index e) {
  return mass_of(block.law, block.l0[static_cast<std::size_t>(e)]);
}

Array<double> bounds_of(const BeamBlock& block) {
  Array<double> bounds(static_cast<std::size_t>(lanes * blocks_for(block.n_elements())), 0);
  for (std::size_t e = 0; e < block.l0.size(); ++e) {
    bounds[e] = omega2_of(block.law, block.l0[e], block.l0[e], 0);
  }
  return bounds;
}

void add_beam_masses(const BeamBlock& block, Nodes& nodes) {
  for (std::size_t k = 0; k < block.ends.size(); ++k) {
    const auto i = static_cast<std::size_t>(block.ends[k]);
    const BeamNodeMass mass = node_mass(block, static_cast<Index>(k / 2));
    nodes.x[i].w += mass.m;
    nodes.torque[i].w += mass.largest();
  }
}

void prepare_damping(BeamBlock& block) {
  if (!block.law.damping.given()) return;
  block.damping_time = damping_times(block.law.damping, bounds_of(block));
}

}  // namespace gannet
