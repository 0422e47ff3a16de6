// Passes over the triangles of shell_assumed.hpp.
#include "fe/shell_assumed.hpp"
#include "fe/shell_blocks.hpp"
#include "fe/shell_kernel.hpp"
#include "fe/shell_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

GANNET_INLINE FlatGeometry<3> triangle_geometry(const VecX3 x[3]) {
  FlatGeometry<3> g;
  const VecX3 xi = x[1] - x[0];
  const VecX3 eta = x[2] - x[0];
  const Vec inverse_2A = flat_frame<3>(cross(xi, eta), xi, eta, g);
  place_corners<3>(x, g);
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const int d = (a + 2) % 3;
    g.B1[a] = (g.y[b] - g.y[d]) * inverse_2A;
    g.B2[a] = (g.x[d] - g.x[b]) * inverse_2A;
  }
  add_gram<3>(g);
  return g;
}

/// Sum of the squared lengths of the sides [m^2].
GANNET_INLINE Vec sides_squared(const FlatGeometry<3>& g) {
  Vec sum(0.0);
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const Vec x = g.x[b] - g.x[a];
    const Vec y = g.y[b] - g.y[a];
    sum += x * x + y * y;
  }
  return sum;
}

struct Triangle {
  static constexpr int n_corners = 3;
  template <PointLaw law>
  static GANNET_INLINE void block(const ShellPass& pass, std::int32_t number, ShellLaneSums& sums);
};

/// Bound of the largest squared frequency [1/s^2]. Rows of the mean shear: with M_a = sum of sides
/// at a times (grad N_j - grad N_i)/3 their products follow from (grad N_j - grad N_i) = 3 grad of
/// the side; the turning of shear sees rotations only, |row|^2 = sum |side|^2/(4 alpha).
GANNET_INLINE Vec triangle_omega2(const ShellConstants& c, const FlatGeometry<3>& g,
                                  const Leaning<3>& t, Vec thickness, Vec inverse_A0,
                                  Vec inverse_alpha) {
  const Vec lambda = largest_gradient<3>(g);
  Vec membrane = Vec(c.membrane_modulus) * thickness * g.area * lambda;
  const Vec ratio = thickness * thickness * inverse_alpha * Vec(1.0 / 12.0);
  Vec bending = membrane * ratio;
  if (c.offset != 0) {
    membrane = bending = membrane * share_of_offset(c.offset, ratio, inverse_alpha);
  }
  const Vec Gt = Vec(c.shear_factor * c.law.shear) * thickness;
  // Mean shear: rows of corner a in w: grad N_a; in turning about x and y: a 2 x 2 matrix
  // sum over its sides of r (grad N_j - grad N_i)/6.
  Vec G11 = g.g11;
  Vec G22 = g.g22;
  Vec G12 = g.g12;
  const Vec sixth(1.0 / 6.0);
  for (int a = 0; a < 3; ++a) {
    Vec Rxx(0.0);
    Vec Rxy(0.0);
    Vec Ryx(0.0);
    Vec Ryy(0.0);
    for (int side = 0; side < 2; ++side) {
      const int i = (a + 2 * side) % 3;
      const int j = (i + 1) % 3;
      const Vec gx = sixth * (g.B1[j] - g.B1[i]);
      const Vec gy = sixth * (g.B2[j] - g.B2[i]);
      const Vec rx = g.x[j] - g.x[i];
      const Vec ry = g.y[j] - g.y[i];
      Rxx += gx * rx;
      Rxy += gx * ry;
      Ryx += gy * rx;
      Ryy += gy * ry;
    }
    G11 += inverse_alpha * (Rxx * Rxx + Rxy * Rxy);
    G22 += inverse_alpha * (Ryx * Ryx + Ryy * Ryy);
    G12 += inverse_alpha * (Rxx * Ryx + Rxy * Ryy);
  }
  const Vec sides = sides_squared(g);
  const Vec mean_shear = Gt * g.area * larger_eigenvalue(G11, G22, G12);
  const Vec turning = Gt * sides * sides * inverse_alpha * Vec(1.0 / 576.0) / g.area;
  return Vec(1.0 / c.nodal_mass_factor) * inverse_A0 *
         bound_of_leaning<3>(t, membrane, bending + mean_shear + turning);
}

template <PointLaw law>
GANNET_INLINE void Triangle::block(const ShellPass& pass, std::int32_t number,
                                   ShellLaneSums& sums) {
  const ShellConstants& c = *pass.constants;
  const BlockState state = block_state(pass, number);
  CornersOf<3> corners = gather_all<3>(pass, number);
  Vec t = Vec::load(state.thickness);

  FlatGeometry<3> half = triangle_geometry(corners.middle);
  FlatGeometry<3> now = triangle_geometry(corners.x);
  const auto goes_on =
      sums.shrunk_to(min(half.area, now.area) * state.inverse_A0, c.smallest_ratio, t, number);
  if (leaves_out(goes_on)) {
    make_harmless(corners, goes_on);
    t = select(goes_on, t, Vec(0.0));
    half = triangle_geometry(corners.middle);
    now = triangle_geometry(corners.x);
  }
  const Leaning<3> old = load_leaning<3>(state.fibres);
  const Vec dt(pass.dt);
  const Leaning<3> middle =
      leaning_halfway<3>(old, relative_motion<3>(half, old, corners.v, corners.w, dt));
  const Relative<3> motion = relative_motion<3>(half, middle, corners.v, corners.w, dt);
  follow_leaning<3>(old, motion, state.fibres);
  ShellIncrements d = middle_increments<3>(half, motion);
  d.xz = d.yz = Vec(0.0);
  Vec around(0.0);
  const Vec third(1.0 / 3.0);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec side = side_shear<3>(half, middle, motion, i, j);
    d.xz += third * (half.B1[j] - half.B1[i]) * side;
    d.yz += third * (half.B2[j] - half.B2[i]) * side;
    around += side;
  }
  ShellResultants r;
  ColumnStress column;
  column_stress<law>(c, pass.layout, pass.dt, state.all, d, t, r, column);
  Vec& work = column.work.internal;
  shell_shear(c, state.shear, d, t, r, work);
  // The turning of shear: energy kappa G t (sum g)^2 sum l^2/(288 A); kept is G sum g.
  const Vec kept = Vec::load(state.shear + 16);
  Vec turned = kept + Vec(c.law.shear) * around;
  if constexpr (law == PointLaw::general) {
    drop_failed_shear(state.shear, d, column.least_damage, r, work);
    turned = select(less(column.least_damage, Vec(1.0)), turned, Vec(0.0));
    sums.eroded += column.work.eroded * half.area;
  }
  turned.store(state.shear + 16);
  add_damping(pass, number, 0, state.all, d, carrying<law>(t, column), half.area, r, sums);
  const auto factor = [&](const FlatGeometry<3>& g) {
    return Vec(c.shear_factor / 144.0) * t * sides_squared(g) / g.area;
  };
  sums.internal += work * half.area + Vec(0.5) * factor(half) * (kept + turned) * around;
  if constexpr (law != PointLaw::elastic) sums.plastic += column.work.plastic * half.area;
  if constexpr (law == PointLaw::general) t = left_of(t, column.least_damage, state.thickness);
  if (c.thickness_changes) grown(t, column.growth).store(state.thickness);

  const Leaning<3> leaning = load_leaning<3>(state.fibres);
  Relative<3> forces{};
  for (int a = 0; a < 3; ++a) {
    forces.ux[a] = forces.uy[a] = forces.uz[a] = forces.px[a] = forces.py[a] = Vec(0.0);
  }
  MiddleForces of_middle;
  of_middle.add(r, now.area);
  add_middle<3>(now, of_middle, forces);
  const Vec Q = factor(now) * turned;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec mean =
        now.area * third * ((now.B1[j] - now.B1[i]) * r.nxz + (now.B2[j] - now.B2[i]) * r.nyz);
    add_side_shear<3>(now, leaning, i, j, mean + Q, forces);
  }
  VecX3 f[3];
  VecX3 m[3];
  nodal_forces<3>(now, leaning, forces, f, m);
  for (int a = 0; a < 3; ++a) {
    f[a] = -f[a];
    m[a] = -m[a];
  }
  scatter_all<3>(pass, number, f, m);
  const Vec inverse_alpha = min(Vec(1.0 / c.smallest_alpha), Vec(6.0) * state.inverse_A0);
  sums.vote(pass, triangle_omega2(c, now, leaning, t, state.inverse_A0, inverse_alpha), number);
}

}  // namespace

__attribute__((flatten)) void shell_triangle_force(const ShellPass& pass, std::int32_t begin,
                                                   std::int32_t end, ShellSums& sums) {
  with_law<Triangle>(pass, begin, end, sums);
}

}  // namespace gannet::GANNET_ISA_NS
