#include "fe/solid_kernel.hpp"

#include "fe/solid_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// The mean of the logarithms of volume changes around the corners of tetrahedra; what it has
/// become since n-1 is the dilatation of the step. Kept in the state.
GANNET_INLINE Vec nodal_dilatation(const SolidPass& pass, const std::int32_t* corners,
                                   double* state) {
  Vec mean(0.0);
  for (int a = 0; a < 4; ++a) mean += gather_corner(pass.nodal, corners, a).z;
  mean = Vec(0.25) * mean;
  double* kept = state + 8 * pass.layout.dilatation();
  const Vec change = mean - Vec::load(kept);
  mean.store(kept);
  return change;
}

/// solid_stress() of tetrahedra: their dilatation is that of their nodes, and the work that of
/// their own motion. e: strain of their own motion, which gets that dilatation.
template <PointLaw law>
GANNET_INLINE Symmetric<Vec> tetrahedron_stress(const SolidPass& pass, const SolidMotion& m,
                                                const std::int32_t* corners, const Tensor& R,
                                                double* state, Symmetric<Vec>& e,
                                                J2Work<Vec>& work) {
  const Vec trace = m.e.xx + m.e.yy + m.e.zz;
  const Vec dilatation = m.of_alive(nodal_dilatation(pass, corners, state));
  const Vec change = Vec(1.0 / 3.0) * (dilatation - trace);
  e.xx += change;
  e.yy += change;
  e.zz += change;
  const Symmetric<Vec> old = load_stress(state);
  const Symmetric<Vec> sigma = solid_stress<law>(*pass.constants, pass.dt, state, e, R, work);
  const Vec twice_traces = old.xx + old.yy + old.zz + sigma.xx + sigma.yy + sigma.zz;
  work.internal -= Vec(0.5) * twice_traces * change;
  return sigma;
}

/// bricks: the block is known to have no other cells, and what is of others is left out.
template <bool bricks>
struct OnePoint {
  static GANNET_INLINE SolidShape shape_of(const SolidLayout& layout) {
    return bricks ? SolidShape::brick : layout.shape;
  }
  template <PointLaw law>
  static GANNET_INLINE void block(const SolidPass& pass, std::int32_t block, SolidLaneSums& sums);
};

/// The elements of one vector of a block.
template <bool bricks>
template <PointLaw law>
GANNET_INLINE void OnePoint<bricks>::block(const SolidPass& pass, std::int32_t block,
                                           SolidLaneSums& sums) {
  const SolidShape shape = shape_of(pass.layout);
  const SolidConstants& c = *pass.constants;
  const std::int32_t* corners = corners_of_block(pass, block);
  double* state = pass.state + static_cast<std::int64_t>(block) * pass.layout.n_values() * 8;
  const SolidMotion m = solid_motion(pass, shape, corners, state);
  const Tensor R = rotation_of(m.L);
  Symmetric<Vec> sigma{};
  Symmetric<Vec> e = m.e;
  RubberPoint rubber;
  Lame now{Vec(c.law.bulk - 2.0 / 3.0 * c.law.shear), Vec(2.0 * c.law.shear)};
  if constexpr (law == PointLaw::hyperelastic) {
    rubber = rubber_point(c, pass.layout, pass.dt, m.x, m.v, state);
    sums.internal += m.of_alive(rubber.work);
    now = {rubber.now.bulk - Vec(2.0 / 3.0) * rubber.now.shear, Vec(2.0) * rubber.now.shear};
  } else {
    J2Work<Vec> work;
    if (shape == SolidShape::tetrahedron) {
      sigma = tetrahedron_stress<law>(pass, m, corners, R, state, e, work);
    } else {
      sigma = solid_stress<law>(c, pass.dt, state, m.e, R, work);
    }
    add_work<law>(m, work, m.half.volume(), sums);
  }
  const auto keep = keeper<law>(pass, state);
  add_damping(pass, m, block, 0, keep, e, m.e, m.half.volume(), state, sums, sigma);
  const BulkViscosity bulk = add_bulk_viscosity(pass, m, keep, state, sums);
  sigma.xx -= bulk.q;
  sigma.yy -= bulk.q;
  sigma.zz -= bulk.q;
  const Vec k_h = Vec(8.0 * c.hourglass * c.hourglass_modulus) * m.gram.trace * m.inverse_volume;
  VecX3 Q[4];
  add_hourglass(pass, m, R, k_h, keep, state, sums, Q);
  SolidModes F = solid_forces(m.now, m.x, sigma, Q, m.inverse_volume_192);
  if constexpr (law == PointLaw::hyperelastic) add_forces(rubber, F);
  const Vec omega2 = solid_omega2(shape, now.lambda, now.two_mu, m.gram, m.x, m.inverse_volume,
                                  m.inverse_mass, k_h);
  if constexpr (law == PointLaw::general) take_out_failed(pass, keep, state);
  finish_block(pass, shape, m, corners, block, F, keep(damped(pass, block, omega2, bulk.zeta)),
               state, sums);
}

}  // namespace

__attribute__((flatten)) void solid_volumes(const SolidPass& all, std::int32_t begin,
                                            std::int32_t end) {
  const Vec quarter(0.25);
  for (std::int32_t part = begin * vecs_per_block; part < end * vecs_per_block; ++part) {
    const std::int32_t block = part / vecs_per_block;
    const SolidPass pass = from_lane(all, part % vecs_per_block * vec_lanes);
    const std::int32_t* corners = corners_of_block(pass, block);
    const double* state =
        pass.state + static_cast<std::int64_t>(block) * pass.layout.n_values() * 8;
    VecX3 at[4];
    for (int a = 0; a < 4; ++a) at[a] = gather_corner(pass.x, corners, a);
    const SolidModes x = tetrahedron_modes_of(at);
    const Vec volume = Vec(1.0 / 64.0) * dot(x.a[0], cross(x.a[1], x.a[2]));
    const Vec inverse_V0 = Vec::load(state + 8 * pass.layout.inverse_volume());
    const auto there = less(Vec(0.0), inverse_V0);
    const Vec V0 = select(there, reciprocal(select(there, inverse_V0, Vec(1.0))), Vec(0.0));
    // An element that has collapsed is seen later; until then its nodes have a volume.
    const Vec least = Vec(pass.constants->smallest_ratio) * V0;
    const VecX3 share{quarter * select(there, max(volume, least), Vec(0.0)), quarter * V0,
                      Vec(0.0)};
    for (int a = 0; a < 4; ++a) scatter_corner(pass.nodal, corners, a, share);
  }
}

__attribute__((flatten)) void solid_force(const SolidPass& pass, std::int32_t begin,
                                          std::int32_t end, SolidSums& sums) {
  if (pass.layout.n_points == 8) {
    solid_eight_points(pass, begin, end, sums);
    return;
  }
  if (pass.layout.shape == SolidShape::brick) {
    solids_of_law<OnePoint<true>>(pass, begin, end, sums);
  } else {
    solids_of_law<OnePoint<false>>(pass, begin, end, sums);
  }
}

}  // namespace gannet::GANNET_ISA_NS
