// Solids with eight points and a mean dilatation, see solid_element.hpp.
#include "fe/solid_kernel.hpp"
#include "fe/solid_lanes.hpp"
#include "fe/solid_points.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// Whether a point still carries something after the stress of the step.
template <PointLaw law>
GANNET_INLINE auto keeper_of_point(const SolidPass& pass, int point, const double* state) {
  if constexpr (law == PointLaw::general) {
    const int damage = pass.constants->history.damage;
    const int k = pass.layout.plastic_strain(point) + damage;
    return KeepCarrying{damage < 0 ? Vec(0.0) : Vec::load(state + 8 * k)};
  } else {
    return KeepAll{};
  }
}

struct EightPoints {
  static GANNET_INLINE SolidShape shape_of(const SolidLayout& layout) { return layout.shape; }
  template <PointLaw law>
  static GANNET_INLINE void block(const SolidPass& pass, std::int32_t block, SolidLaneSums& sums);
};

/// The elements of one vector of a block.
template <PointLaw law>
GANNET_INLINE void EightPoints::block(const SolidPass& pass, std::int32_t block,
                                      SolidLaneSums& sums) {
  const SolidShape shape = pass.layout.shape;
  const SolidConstants& c = *pass.constants;
  const std::int32_t* corners = corners_of_block(pass, block);
  double* state = pass.state + static_cast<std::int64_t>(block) * pass.layout.n_values() * 8;
  const SolidMotion m = solid_motion(pass, shape, corners, state);
  const Vec mean_e = Vec(1.0 / 3.0) * (m.e.xx + m.e.yy + m.e.zz);
  SolidModes F{};
  Vec mean_stress(0.0);  // times the volume
  Vec largest(0.0);      // of the Gram matrices, times the volume
  // Of rubber: its mean stress follows from the volume of the element.
  Vec pressure(0.0);
  Moduli moduli{Vec(c.law.bulk), Vec(c.law.shear)};
  SolidModes X{};
  if constexpr (law == PointLaw::hyperelastic) {
    X = load_start(pass.layout, state);
    const Vec ratio = max(m.now.volume() * m.inverse_V0, Vec(1e-3));
    pressure = volume_stress(c.rubber, ratio);
    moduli.bulk = volume_modulus(c.rubber, ratio);
  }
  for (int point = 0; point < 8; ++point) {
    const SolidPlace at = gauss_place(point);
    const PointGradient half = point_gradient(m.x_half, at);
    const Tensor L = gradient_at(half, m.v, at, Vec(pass.dt));
    Symmetric<Vec> e = symmetric_part(L);
    const Vec change = mean_e - Vec(1.0 / 3.0) * (e.xx + e.yy + e.zz);
    e.xx += change;
    e.yy += change;
    e.zz += change;
    J2Work<Vec> work;
    double* kept = state + 8 * pass.layout.stress(point);
    Symmetric<Vec> sigma;
    if constexpr (law == PointLaw::hyperelastic) {
      HyperelasticStress<Vec> stress;
      Vec J;
      rubber_stress(c, gradient_at(point_gradient(X, at), m.x, at, Vec(1.0)), stress, J);
      sigma = stress.deviator;
      sigma.xx += pressure;
      sigma.yy += pressure;
      sigma.zz += pressure;
      work.internal = Vec(0.5) * (contraction(load_stress(kept), e) + contraction(sigma, e));
      store_stress(sigma, kept);
      moduli.shear = max(moduli.shear, taut_shear(stress, pressure));
    } else {
      sigma = solid_stress<law>(c, pass.dt, kept, e, rotation_of(L), work);
    }
    add_work<law>(m, work, half.det, sums);
    add_damping(pass, m, block, point, keeper_of_point<law>(pass, point, state), e, e, half.det,
                state, sums, sigma);
    const PointGradient now = point_gradient(m.x, at);
    const Vec p = Vec(1.0 / 3.0) * (sigma.xx + sigma.yy + sigma.zz);
    mean_stress += p * now.det;
    largest += largest_gram(now, at, shape == SolidShape::quadrilateral) * now.det;
    add_point_forces(now, at, sigma, p, F);
  }
  const auto keep = keeper<law>(pass, state);
  const BulkViscosity bulk = add_bulk_viscosity(pass, m, keep, state, sums);
  add_mean_stress(m.now, mean_stress * m.inverse_volume - bulk.q, F);
  // tr of the mean gradient and the deviator at each point are bounded apart.
  const Vec omega2 =
      Vec(8.0) * m.inverse_mass *
      (moduli.bulk * m.gram.trace * m.inverse_volume + Vec(2.0) * moduli.shear * largest);
  if constexpr (law == PointLaw::general) take_out_failed(pass, keep, state);
  finish_block(pass, shape, m, corners, block, F, keep(damped(pass, block, omega2, bulk.zeta)),
               state, sums);
}

}  // namespace

__attribute__((flatten)) void solid_eight_points(const SolidPass& pass, std::int32_t begin,
                                                 std::int32_t end, SolidSums& sums) {
  solids_of_law<EightPoints>(pass, begin, end, sums);
}

}  // namespace gannet::GANNET_ISA_NS
