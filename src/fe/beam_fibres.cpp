#include "fe/beam_fibres.hpp"

#include <algorithm>
#include <cmath>

namespace gannet {

namespace {

/// Slope of Y [Pa].
double hardening_at(const UniaxialLaw& law, double eps_p) {
  double slope = law.isotropic;
  if (law.power_factor > 0) {
    slope += law.power_factor * law.power * std::pow(std::max(eps_p, 1e-12), law.power - 1);
  }
  for (std::size_t k = 1; k < law.curve_strain.size(); ++k) {
    if (eps_p >= law.curve_strain[k]) continue;
    return slope + (law.curve_stress[k] - law.curve_stress[k - 1]) /
                       (law.curve_strain[k] - law.curve_strain[k - 1]);
  }
  return slope;
}

/// The flow of a fibre whose |xi| is above Y.
double flow_of(const UniaxialLaw& law, double size, double eps_p) {
  const double stiffness = law.E + law.kinematic;
  double low = 0;
  double high = (size - yield_stress(law, eps_p)) / stiffness;
  double d = high;
  for (int i = 0; i < 60; ++i) {
    const double left = size - stiffness * d - yield_stress(law, eps_p + d);
    if (std::abs(left) <= 1e-12 * size) break;
    (left > 0 ? low : high) = d;
    d += left / (stiffness + hardening_at(law, eps_p + d));
    if (!(d > low && d < high)) d = 0.5 * (low + high);
  }
  return d;
}

}  // namespace

UniaxialLaw uniaxial_law(const ElasticPlastic& m) {
  return {.E = m.E,
          .sigma_y = m.sigma_y,
          .isotropic = (1 - m.kinematic_fraction) * m.H,
          .kinematic = m.kinematic_fraction * m.H,
          .curve_strain = m.curve_strain,
          .curve_stress = m.curve_stress,
          .power_factor = m.power_factor,
          .power = m.power};
}

double yield_stress(const UniaxialLaw& law, double eps_p) {
  double Y = law.sigma_y + law.isotropic * eps_p;
  if (law.power_factor > 0) Y += law.power_factor * std::pow(eps_p, law.power);
  if (law.curve_strain.empty()) return Y;
  Y += law.curve_stress.back() - law.curve_stress.front();
  for (std::size_t k = 1; k < law.curve_strain.size(); ++k) {
    if (eps_p >= law.curve_strain[k]) continue;
    const double share =
        (eps_p - law.curve_strain[k - 1]) / (law.curve_strain[k] - law.curve_strain[k - 1]);
    const double at =
        law.curve_stress[k - 1] + share * (law.curve_stress[k] - law.curve_stress[k - 1]);
    return Y - law.curve_stress.back() + at;
  }
  return Y;
}

double uniaxial_stress(const UniaxialLaw& law, double strain, FibreState& state,
                       double& dissipated) {
  const double trial = law.E * (strain - state.strain);
  const double xi = trial - law.kinematic * state.strain;
  const double Y = yield_stress(law, state.accumulated);
  dissipated = 0;
  if (std::abs(xi) <= Y) return trial;
  const double sign = xi > 0 ? 1.0 : -1.0;
  const double d = flow_of(law, std::abs(xi), state.accumulated);
  state.strain += sign * d;
  state.accumulated += d;
  const double sigma = trial - sign * law.E * d;
  const double rise = yield_stress(law, state.accumulated) - Y + law.kinematic * d;
  dissipated = (sign * sigma - 0.5 * rise) * d;
  return sigma;
}

double work_of(const BeamStress& a, const BeamStress& b, const BeamStrain& from,
               const BeamStrain& to) {
  return 0.5 * ((a.N + b.N) * (to.u - from.u) + (a.m_1 + b.m_1).dot(to.theta_1 - from.theta_1) +
                (a.m_2 + b.m_2).dot(to.theta_2 - from.theta_2));
}

BeamStress yielding_stress(const YieldingBeam& beam, const BeamStrain& strain,
                           std::span<double> states, double& dissipated) {
  const double l0 = beam.l0;
  const Vec3 apart = strain.theta_2 - strain.theta_1;
  const Vec3 alike = strain.theta_1 + strain.theta_2;
  const double share_y = 3 / (1 + beam.phi_y);
  const double share_z = 3 / (1 + beam.phi_z);
  BeamStress f;
  dissipated = 0;
  double* state = states.data();
  for (const double s : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
    const double stretch = strain.u / l0;
    const double k_y = (apart.y() + s * share_y * alike.y()) / l0;
    const double k_z = (apart.z() + s * share_z * alike.z()) / l0;
    double N = 0;
    double M_y = 0;
    double M_z = 0;
    for (const BeamFibre& fibre : beam.section.fibres) {
      const double eps = stretch + fibre.z * k_y - fibre.y * k_z;
      double sigma = beam.law.E * (eps - state[0]);
      // A first look without the curve, which only rises.
      const double xi = sigma - beam.law.kinematic * state[0];
      if (std::abs(xi) > beam.law.sigma_y + beam.law.isotropic * state[1]) {
        FibreState of{state[0], state[1]};
        double lost = 0;
        sigma = uniaxial_stress(beam.law, eps, of, lost);
        state[0] = of.strain;
        state[1] = of.accumulated;
        dissipated += 0.5 * l0 * fibre.A * lost;
      }
      state += 2;
      N += fibre.A * sigma;
      M_y += fibre.A * sigma * fibre.z;
      M_z -= fibre.A * sigma * fibre.y;
    }
    f.N += 0.5 * N;
    f.m_1 += 0.5 * Vec3(0, M_y * (s * share_y - 1), M_z * (s * share_z - 1));
    f.m_2 += 0.5 * Vec3(0, M_y * (s * share_y + 1), M_z * (s * share_z + 1));
  }
  const auto shear = [&](double I, double phi) {
    return 3 * beam.law.E * I * phi / (l0 * (1 + phi) * (1 + phi));
  };
  const double T = beam.G * beam.section.J / l0 * apart.x();
  const Vec3 across(0, shear(beam.section.I_y, beam.phi_y) * alike.y(),
                    shear(beam.section.I_z, beam.phi_z) * alike.z());
  f.m_1 += across - T * Vec3::UnitX();
  f.m_2 += across + T * Vec3::UnitX();
  return f;
}

}  // namespace gannet
