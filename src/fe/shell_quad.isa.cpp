// Passes over the fully integrated quadrilaterals of shell_assumed.hpp.
#include "fe/shell_assumed.hpp"
#include "fe/shell_blocks.hpp"
#include "fe/shell_kernel.hpp"
#include "fe/shell_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

constexpr double gauss = 0.57735026918962576451;  // 1/sqrt(3)
constexpr double xi_of[4] = {-gauss, gauss, gauss, -gauss};
constexpr double eta_of[4] = {-gauss, -gauss, gauss, gauss};

/// What a quadrilateral has beyond the frame.
struct QuadGeometry : FlatGeometry<4> {
  Vec gamma[4];
  Vec hx, hy;     ///< h.x, h.y
  VecX3 xi, eta;  ///< sums of xi_a x_a, eta_a x_a in the frame (z unused)
};

GANNET_INLINE QuadGeometry quad_geometry(const VecX3 x[4]) {
  QuadGeometry g;
  const VecX3 r31 = x[2] - x[0];
  const VecX3 r42 = x[3] - x[1];
  const Vec inverse_2A = flat_frame<4>(cross(r31, r42), r31 - r42, r31 + r42, g);
  place_corners<4>(x, g);
  const Vec x31 = g.x[2] - g.x[0];
  const Vec y31 = g.y[2] - g.y[0];
  const Vec x42 = g.x[3] - g.x[1];
  const Vec y42 = g.y[3] - g.y[1];
  g.B1[0] = -y42 * inverse_2A;
  g.B1[1] = y31 * inverse_2A;
  g.B2[0] = x42 * inverse_2A;
  g.B2[1] = -x31 * inverse_2A;
  for (int a = 0; a < 2; ++a) {
    g.B1[a + 2] = -g.B1[a];
    g.B2[a + 2] = -g.B2[a];
  }
  add_gram<4>(g);
  g.hx = (g.x[0] + g.x[2]) - (g.x[1] + g.x[3]);
  g.hy = (g.y[0] + g.y[2]) - (g.y[1] + g.y[3]);
  g.xi = {x31 - x42, y31 - y42, Vec(0.0)};
  g.eta = {x31 + x42, y31 + y42, Vec(0.0)};
  const Vec quarter(0.25);
  for (int a = 0; a < 4; ++a) {
    const Vec h(a % 2 == 0 ? 1.0 : -1.0);
    g.gamma[a] = quarter * (h - g.hx * g.B1[a] - g.hy * g.B2[a]);
  }
  return g;
}

/// The map at a point of the plane: tangents along xi and eta, their determinant, grad h.
struct PointOfQuad {
  Vec xx, xy, ex, ey;  ///< (x, y) along xi; along eta [m]
  Vec J, inverse_J;    ///< [m^2]
  Vec hX, hY;          ///< [1/m]
};

GANNET_INLINE PointOfQuad point_of_quad(const QuadGeometry& g, double xi, double eta) {
  const Vec quarter(0.25);
  PointOfQuad p;
  p.xx = quarter * (g.xi.x + Vec(eta) * g.hx);
  p.xy = quarter * (g.xi.y + Vec(eta) * g.hy);
  p.ex = quarter * (g.eta.x + Vec(xi) * g.hx);
  p.ey = quarter * (g.eta.y + Vec(xi) * g.hy);
  p.J = p.xx * p.ey - p.xy * p.ex;
  p.inverse_J = Vec(1.0) / p.J;
  p.hX = (Vec(eta) * p.ey - Vec(xi) * p.xy) * p.inverse_J;
  p.hY = (Vec(xi) * p.xx - Vec(eta) * p.ex) * p.inverse_J;
  return p;
}

/// Four times the smallest determinant of the map at the points: the area that they make of it.
GANNET_INLINE Vec smallest_area(const QuadGeometry& g) {
  // J is linear: (xi x eta + xi_p (xi x h) + eta_p (h x eta))/16.
  const Vec along = g.xi.x * g.hy - g.xi.y * g.hx;
  const Vec across = g.hx * g.eta.y - g.hy * g.eta.x;
  const Vec sizes = max(along, -along) + max(across, -across);
  return Vec(0.25) * (g.xi.x * g.eta.y - g.xi.y * g.eta.x - Vec(gauss) * sizes);
}

/// Sides 1-2, 4-3 (along xi) and 1-4, 2-3 (along eta).
constexpr int side_from[4] = {0, 3, 0, 1};
constexpr int side_to[4] = {1, 2, 3, 2};

/// Strain, curvature and shear at the points of a quadrilateral.
struct QuadFields {
  ShellIncrements middle;
  Vec qx, qy;  ///< gamma.u
  Vec px, py;  ///< gamma.psi
  Vec side[4];
};

GANNET_INLINE QuadFields quad_fields(const QuadGeometry& g, const Leaning<4>& t,
                                     const Relative<4>& r) {
  QuadFields q;
  q.middle = middle_increments<4>(g, r);
  q.qx = weighted<4>(g.gamma, r.ux);
  q.qy = weighted<4>(g.gamma, r.uy);
  q.px = weighted<4>(g.gamma, r.px);
  q.py = weighted<4>(g.gamma, r.py);
  for (int k = 0; k < 4; ++k) q.side[k] = side_shear<4>(g, t, r, side_from[k], side_to[k]);
  return q;
}

GANNET_INLINE ShellIncrements increments_at(const QuadFields& q, const PointOfQuad& p, Vec nu,
                                            double xi, double eta) {
  ShellIncrements d = q.middle;
  d.xx += p.hX * q.qx - nu * p.hY * q.qy;
  d.yy += p.hY * q.qy - nu * p.hX * q.qx;
  d.kxx += p.hX * q.px;
  d.kyy += p.hY * q.py;
  d.kxy += p.hY * q.px + p.hX * q.py;
  const Vec along_xi = Vec(0.25 * (1 - eta)) * q.side[0] + Vec(0.25 * (1 + eta)) * q.side[1];
  const Vec along_eta = Vec(0.25 * (1 - xi)) * q.side[2] + Vec(0.25 * (1 + xi)) * q.side[3];
  d.xz = (p.ey * along_xi - p.xy * along_eta) * p.inverse_J;
  d.yz = (p.xx * along_eta - p.ex * along_xi) * p.inverse_J;
  return d;
}

/// What belongs to QuadFields in power, summed over the points.
struct QuadForces {
  MiddleForces middle;
  Vec qx = Vec(0.0), qy = Vec(0.0);
  Vec px = Vec(0.0), py = Vec(0.0);
  Vec side[4] = {Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0)};
};

/// Adds a point with the resultants r, at the geometry of n.
GANNET_INLINE void add_point(const PointOfQuad& p, const ShellResultants& r, Vec nu, double xi,
                             double eta, QuadForces& s) {
  s.middle.add(r, p.J);
  const Vec JX = p.J * p.hX;
  const Vec JY = p.J * p.hY;
  s.qx += JX * (r.nxx - nu * r.nyy);
  s.qy += JY * (r.nyy - nu * r.nxx);
  s.px += JX * r.mxx + JY * r.mxy;
  s.py += JY * r.myy + JX * r.mxy;
  const Vec along_xi = Vec(0.25) * (p.ey * r.nxz - p.ex * r.nyz);
  const Vec along_eta = Vec(0.25) * (p.xx * r.nyz - p.xy * r.nxz);
  s.side[0] += Vec(1 - eta) * along_xi;
  s.side[1] += Vec(1 + eta) * along_xi;
  s.side[2] += Vec(1 - xi) * along_eta;
  s.side[3] += Vec(1 + xi) * along_eta;
}

/// Forces on the corners, negative as they are added to f.
GANNET_INLINE void quad_forces(const QuadGeometry& g, const Leaning<4>& t, const QuadForces& s,
                               VecX3 f[4], VecX3 m[4]) {
  Relative<4> r;
  for (int a = 0; a < 4; ++a) {
    r.ux[a] = g.gamma[a] * s.qx;
    r.uy[a] = g.gamma[a] * s.qy;
    r.uz[a] = Vec(0.0);
    r.px[a] = g.gamma[a] * s.px;
    r.py[a] = g.gamma[a] * s.py;
  }
  add_middle<4>(g, s.middle, r);
  for (int k = 0; k < 4; ++k) add_side_shear<4>(g, t, side_from[k], side_to[k], s.side[k], r);
  nodal_forces<4>(g, t, r, f, m);
  for (int a = 0; a < 4; ++a) {
    f[a] = -f[a];
    m[a] = -m[a];
  }
}

/// Bound of kappa G t int |shear|^2 over the mass of a corner: the largest over the points of
/// A times the larger eigenvalue of S S^T, S the two rows of shear there, because each point may
/// keep its share of the mass. Rows of sides, with r their vectors and 1/alpha for turning:
///   side.side = 2 + |r|^2/(2 alpha), sides that meet: +-1 + r.r'/(4 alpha), opposite ones: 0.
GANNET_INLINE Vec shear_of_quad(const QuadGeometry& g, Vec inverse_alpha) {
  Vec rx[4];
  Vec ry[4];
  for (int k = 0; k < 4; ++k) {
    rx[k] = g.x[side_to[k]] - g.x[side_from[k]];
    ry[k] = g.y[side_to[k]] - g.y[side_from[k]];
  }
  const auto own = [&](int k) {
    return Vec(2.0) + Vec(0.5) * inverse_alpha * (rx[k] * rx[k] + ry[k] * ry[k]);
  };
  const auto meet = [&](int k, int l, double sign) {
    return Vec(sign) + Vec(0.25) * inverse_alpha * (rx[k] * rx[l] + ry[k] * ry[l]);
  };
  const Vec own_of[4] = {own(0), own(1), own(2), own(3)};
  const Vec corner[4] = {meet(0, 2, 1), meet(0, 3, -1), meet(1, 3, 1), meet(1, 2, -1)};
  Vec largest(0.0);
  for (int k = 0; k < 4; ++k) {
    const double xi = xi_of[k];
    const double eta = eta_of[k];
    const PointOfQuad p = point_of_quad(g, xi, eta);
    const double below = 0.25 * (1 - eta);
    const double above = 0.25 * (1 + eta);
    const double left = 0.25 * (1 - xi);
    const double right = 0.25 * (1 + xi);
    const Vec S11 = Vec(below * below) * own_of[0] + Vec(above * above) * own_of[1];
    const Vec S22 = Vec(left * left) * own_of[2] + Vec(right * right) * own_of[3];
    const Vec S12 = Vec(below * left) * corner[0] + Vec(below * right) * corner[1] +
                    Vec(above * right) * corner[2] + Vec(above * left) * corner[3];
    const Vec two(2.0);
    const Vec G11 = p.ey * p.ey * S11 - two * p.ey * p.xy * S12 + p.xy * p.xy * S22;
    const Vec G22 = p.ex * p.ex * S11 - two * p.ex * p.xx * S12 + p.xx * p.xx * S22;
    const Vec G12 = (p.ey * p.xx + p.xy * p.ex) * S12 - p.ey * p.ex * S11 - p.xy * p.xx * S22;
    largest = max(largest, larger_eigenvalue(G11, G22, G12) * p.inverse_J * p.inverse_J);
  }
  return g.area * largest;
}

/// Bound of the largest squared frequency [1/s^2] as in shell_omega2(). Fields of the middle and of
/// gamma are orthogonal but for c^2 = (h.x, h.y) G (h.x, h.y)/(4 + the same), the square of the
/// cosine between gamma and the gradients.
GANNET_INLINE Vec quad_omega2(const ShellConstants& c, const QuadGeometry& g, const Leaning<4>& t,
                              Vec thickness, Vec inverse_A0, Vec inverse_alpha) {
  const Vec lambda = largest_gradient<4>(g);
  Vec XX(0.0);
  Vec YY(0.0);
  for (int k = 0; k < 4; ++k) {
    const PointOfQuad p = point_of_quad(g, xi_of[k], eta_of[k]);
    XX += p.J * p.hX * p.hX;
    YY += p.J * p.hY * p.hY;
  }
  const Vec hGh = g.hx * g.hx * g.g11 + Vec(2.0) * g.hx * g.hy * g.g12 + g.hy * g.hy * g.g22;
  const Vec gamma2 = Vec(1.0 / 16.0) * (Vec(4.0) + hGh);
  const Vec overlap2 = hGh / (Vec(4.0) + hGh);
  const Vec h_z = (g.z[0] + g.z[2]) - (g.z[1] + g.z[3]);
  const Vec Ct = Vec(c.membrane_modulus) * thickness;
  const auto together = [&](Vec a, Vec b) {
    return larger_eigenvalue(a, b, sqrt(overlap2 * a * b));
  };
  // E (1 + nu) <= E/(1 - nu)
  const Vec hourglass = Ct * max(XX, YY);
  const Vec middle = Ct * g.area * lambda;
  const Vec ratio = thickness * thickness * inverse_alpha * Vec(1.0 / 12.0);
  Vec membrane =
      together(middle, hourglass * gamma2) + Vec(1.0 / 16.0) * hourglass * h_z * h_z * lambda;
  Vec bending = ratio * together(middle, Ct * (XX + YY) * gamma2);
  if (c.offset != 0) {
    membrane = bending =
        together(middle, Ct * (XX + YY) * gamma2) * share_of_offset(c.offset, ratio, inverse_alpha);
  }
  const Vec shear = Vec(c.shear_factor * c.law.shear) * thickness * shear_of_quad(g, inverse_alpha);
  return Vec(1.0 / c.nodal_mass_factor) * inverse_A0 *
         bound_of_leaning<4>(t, membrane, bending + shear);
}

struct Quad {
  static constexpr int n_corners = 4;
  template <PointLaw law>
  static GANNET_INLINE void block(const ShellPass& pass, std::int32_t number, ShellLaneSums& sums);
};

template <PointLaw law>
GANNET_INLINE void Quad::block(const ShellPass& pass, std::int32_t number, ShellLaneSums& sums) {
  const ShellConstants& c = *pass.constants;
  const BlockState state = block_state(pass, number);
  CornersOf<4> corners = gather_all<4>(pass, number);
  const Vec nu(c.law.c12 / c.law.c11);
  Vec t = Vec::load(state.thickness);

  QuadGeometry half = quad_geometry(corners.middle);
  QuadGeometry now = quad_geometry(corners.x);
  const auto goes_on = sums.shrunk_to(
      min(smallest_area(half), smallest_area(now)) * state.inverse_A0, c.smallest_ratio, t, number);
  if (leaves_out(goes_on)) {
    make_harmless(corners, goes_on);
    t = select(goes_on, t, Vec(0.0));
    half = quad_geometry(corners.middle);
    now = quad_geometry(corners.x);
  }
  const Leaning<4> old = load_leaning<4>(state.fibres);
  const Vec dt(pass.dt);
  const Leaning<4> middle =
      leaning_halfway<4>(old, relative_motion<4>(half, old, corners.v, corners.w, dt));
  const Relative<4> motion = relative_motion<4>(half, middle, corners.v, corners.w, dt);
  const QuadFields fields = quad_fields(half, middle, motion);
  follow_leaning<4>(old, motion, state.fibres);
  QuadForces forces;
  Vec growth(0.0);
  Vec least_damage(1.0);
  for (int k = 0; k < 4; ++k) {
    const PointOfQuad p = point_of_quad(half, xi_of[k], eta_of[k]);
    const ShellIncrements d = increments_at(fields, p, nu, xi_of[k], eta_of[k]);
    ShellResultants r;
    ColumnStress column;
    double* shear = state.shear + 16 * k;
    column_stress<law>(c, pass.layout, pass.dt, state.all + 8 * pass.layout.stress(k), d, t, r,
                       column);
    shell_shear(c, shear, d, t, r, column.work.internal);
    if constexpr (law == PointLaw::general) {
      drop_failed_shear(shear, d, column.least_damage, r, column.work.internal);
      least_damage = min(least_damage, column.least_damage);
      sums.eroded += column.work.eroded * p.J;
    }
    add_damping(pass, number, k, state.all, d, carrying<law>(t, column), p.J, r, sums);
    growth += p.J * column.growth;
    sums.internal += column.work.internal * p.J;
    if constexpr (law != PointLaw::elastic) sums.plastic += column.work.plastic * p.J;
    add_point(point_of_quad(now, xi_of[k], eta_of[k]), r, nu, xi_of[k], eta_of[k], forces);
  }
  if constexpr (law == PointLaw::general) t = left_of(t, least_damage, state.thickness);
  if (c.thickness_changes) grown(t, growth / half.area).store(state.thickness);
  const Leaning<4> leaning = load_leaning<4>(state.fibres);
  VecX3 f[4];
  VecX3 m[4];
  quad_forces(now, leaning, forces, f, m);
  scatter_all<4>(pass, number, f, m);
  const Vec inverse_alpha = min(Vec(1.0 / c.smallest_alpha), Vec(8.0) * state.inverse_A0);
  sums.vote(pass, quad_omega2(c, now, leaning, t, state.inverse_A0, inverse_alpha), number);
}

}  // namespace

__attribute__((flatten)) void shell_quad_force(const ShellPass& pass, std::int32_t begin,
                                               std::int32_t end, ShellSums& sums) {
  with_law<Quad>(pass, begin, end, sums);
}

}  // namespace gannet::GANNET_ISA_NS
