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

/// Y and its slope after a flow d > 0 [Pa].
WithSlope<double> yield_after(const UniaxialLaw& law, const FibreState& state, double d,
                              double inverse_dt) {
  const double eps_p = state.accumulated + d;
  if (!law.full) return {yield_stress(law, eps_p), hardening_at(law, eps_p)};
  const WithSlope<double> hard = hardened(law.j2, eps_p);
  const WithSlope<double> rate = rate_factor(law.j2, std::max(d, 1e-300), inverse_dt);
  const double thermal = law.j2.heat > 0 ? thermal_factor(law.j2, state.rise) : 1.0;
  return {thermal * hard.value * rate.value,
          thermal * (hard.slope * rate.value + hard.value * rate.slope)};
}

/// Y at rest [Pa].
double yield_at_rest(const UniaxialLaw& law, const FibreState& state) {
  if (!law.full) return yield_stress(law, state.accumulated);
  const double thermal = law.j2.heat > 0 ? thermal_factor(law.j2, state.rise) : 1.0;
  return thermal * hardened(law.j2, state.accumulated).value;
}

/// The flow of a fibre whose |xi| is above Y at rest.
double flow_of(const UniaxialLaw& law, double size, const FibreState& state, double inverse_dt) {
  const double stiffness = law.E + law.kinematic;
  double low = 0;
  double high = (size - yield_at_rest(law, state)) / stiffness;
  double d = high;
  for (int i = 0; i < 100; ++i) {
    const WithSlope<double> Y = yield_after(law, state, d, inverse_dt);
    const double left = size - stiffness * d - Y.value;
    if (std::abs(left) <= 1e-12 * size) break;
    (left > 0 ? low : high) = d;
    d += left / (stiffness + Y.slope);
    if (!(d > low && d < high)) d = 0.5 * (low + high);
    if (high - low <= 1e-15 * high) break;
  }
  return d;
}

/// Strain of a fibre at s in [-1, 1] along an element.
struct SectionStrain {
  double stretch, k_y, k_z;
  SectionStrain(const YieldingBeam& beam, const BeamStrain& q, double s) {
    const Vec3 apart = q.theta_2 - q.theta_1;
    const Vec3 alike = q.theta_1 + q.theta_2;
    stretch = q.u / beam.l0;
    k_y = (apart.y() + s * (3 / (1 + beam.phi_y)) * alike.y()) / beam.l0;
    k_z = (apart.z() + s * (3 / (1 + beam.phi_z)) * alike.z()) / beam.l0;
  }
  [[nodiscard]] double at(const BeamFibre& f) const { return stretch + f.z * k_y - f.y * k_z; }
};

/// One step of a fibre of a full law; its energies are added to the step. eps_old: strain of n-1.
double full_stress(const YieldingBeam& beam, double volume, double eps_old, double eps,
                   double* values, FibreStep& step) {
  FibreState state{values[0], values[1], values[2], values[3]};
  if (state.damage >= 1) return 0;
  const double old = beam.law.E * (eps_old - state.strain);
  double lost = 0;
  const double sigma = uniaxial_stress(beam.law, eps, state, lost, step.inverse_dt);
  if (state.damage >= 1) {
    step.eroded += volume * (0.5 * old * (eps - eps_old) + 0.5 * old * old / beam.law.E);
  } else {
    step.plastic += volume * lost;
  }
  values[0] = state.strain;
  values[1] = state.accumulated;
  values[2] = state.rise;
  values[3] = state.damage;
  return sigma;
}

}  // namespace

UniaxialLaw uniaxial_law(const ElasticPlastic& m) {
  UniaxialLaw law{.E = m.E,
                  .sigma_y = m.sigma_y,
                  .isotropic = (1 - m.kinematic_fraction) * m.H,
                  .kinematic = m.kinematic_fraction * m.H,
                  .curve_strain = m.curve_strain,
                  .curve_stress = m.curve_stress,
                  .power_factor = m.power_factor,
                  .power = m.power};
  law.full = m.rate_law != RateLaw::none || m.heating.specific_heat > 0 || m.failure.given();
  if (law.full) law.j2 = j2_law(m);
  return law;
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

double uniaxial_stress(const UniaxialLaw& law, double strain, FibreState& state, double& dissipated,
                       double inverse_dt) {
  const double trial = law.E * (strain - state.strain);
  const double xi = trial - law.kinematic * state.strain;
  const double Y = yield_at_rest(law, state);
  dissipated = 0;
  if (std::abs(xi) <= Y) return trial;
  const double sign = xi > 0 ? 1.0 : -1.0;
  const double d = flow_of(law, std::abs(xi), state, inverse_dt);
  state.strain += sign * d;
  state.accumulated += d;
  const double sigma = trial - sign * law.E * d;
  if (!law.full) {
    const double rise = yield_stress(law, state.accumulated) - Y + law.kinematic * d;
    dissipated = (sign * sigma - 0.5 * rise) * d;
    return sigma;
  }
  // What is above Y at rest while it flows is taken up at once.
  dissipated = sign * sigma * d;
  if (law.j2.fails) {
    state.damage += damage_of(law.j2, d, sigma / 3, sigma * sigma, state.rise, inverse_dt);
  }
  if (law.j2.heat > 0) state.rise += law.j2.heat * dissipated;
  return state.damage < 1 ? sigma : 0;
}

double work_of(const BeamStress& a, const BeamStress& b, const BeamStrain& from,
               const BeamStrain& to) {
  return 0.5 * ((a.N + b.N) * (to.u - from.u) + (a.m_1 + b.m_1).dot(to.theta_1 - from.theta_1) +
                (a.m_2 + b.m_2).dot(to.theta_2 - from.theta_2));
}

BeamStress elastic_part(const YieldingBeam& beam, const BeamStrain& strain) {
  const double l0 = beam.l0;
  const Vec3 alike = strain.theta_1 + strain.theta_2;
  const auto shear = [&](double I, double phi) {
    return 3 * beam.law.E * I * phi / (l0 * (1 + phi) * (1 + phi));
  };
  const double T = beam.G * beam.section.J / l0 * (strain.theta_2.x() - strain.theta_1.x());
  const Vec3 across(0, shear(beam.section.I_y, beam.phi_y) * alike.y(),
                    shear(beam.section.I_z, beam.phi_z) * alike.z());
  return {0, across - T * Vec3::UnitX(), across + T * Vec3::UnitX()};
}

double held_by_fibres(const YieldingBeam& beam, std::span<const double> states,
                      const BeamStrain& from, const BeamStrain& to) {
  const double* state = states.data();
  double held = 0;
  for (const double s : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
    const SectionStrain before(beam, from, s);
    const SectionStrain now(beam, to, s);
    for (const BeamFibre& fibre : beam.section.fibres) {
      if (state[3] < 1) {
        const double eps = before.at(fibre);
        const double sigma = beam.law.E * (eps - state[0]);
        held += 0.5 * beam.l0 * fibre.A * 0.5 * sigma * (now.at(fibre) - eps + sigma / beam.law.E);
      }
      state += beam.law.n_values();
    }
  }
  return held;
}

BeamStress yielding_stress(const YieldingBeam& beam, const BeamStrain& strain,
                           std::span<double> states, FibreStep& step) {
  const double share_y = 3 / (1 + beam.phi_y);
  const double share_z = 3 / (1 + beam.phi_z);
  const std::size_t n = beam.law.n_values();
  BeamStress f = elastic_part(beam, strain);
  double* state = states.data();
  for (const double s : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
    const SectionStrain now(beam, strain, s);
    const SectionStrain before(beam, step.from, s);
    bool carries = false;
    double N = 0;
    double M_y = 0;
    double M_z = 0;
    for (const BeamFibre& fibre : beam.section.fibres) {
      const double eps = now.at(fibre);
      const double volume = 0.5 * beam.l0 * fibre.A;
      double sigma = beam.law.E * (eps - state[0]);
      if (beam.law.full) {
        sigma = full_stress(beam, volume, before.at(fibre), eps, state, step);
        carries = carries || state[3] < 1;
      } else if (std::abs(sigma - beam.law.kinematic * state[0]) >
                 beam.law.sigma_y + beam.law.isotropic * state[1]) {
        // A first look without the curve, which only rises.
        FibreState of{state[0], state[1]};
        double lost = 0;
        sigma = uniaxial_stress(beam.law, eps, of, lost);
        state[0] = of.strain;
        state[1] = of.accumulated;
        step.plastic += volume * lost;
      }
      state += n;
      N += fibre.A * sigma;
      M_y += fibre.A * sigma * fibre.z;
      M_z -= fibre.A * sigma * fibre.y;
    }
    step.broken = step.broken || (beam.law.fails() && !carries);
    f.N += 0.5 * N;
    f.m_1 += 0.5 * Vec3(0, M_y * (s * share_y - 1), M_z * (s * share_z - 1));
    f.m_2 += 0.5 * Vec3(0, M_y * (s * share_y + 1), M_z * (s * share_z + 1));
  }
  return f;
}

}  // namespace gannet
