// Passes over the shells of shell_assumed.hpp.
#include "fe/shell_assumed.hpp"
#include "fe/shell_damping.hpp"
#include "fe/shell_general.hpp"
#include "fe/shell_kernel.hpp"
#include "fe/shell_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

constexpr double gauss = 0.57735026918962576451;  // 1/sqrt(3)
constexpr double xi_of[4] = {-gauss, gauss, gauss, -gauss};
constexpr double eta_of[4] = {-gauss, -gauss, gauss, gauss};

/// What a quadrilateral has beyond the frame.
struct QuadGeometry : FlatGeometry<4> {
  Vec8 gamma[4];
  Vec8 hx, hy;     ///< h.x, h.y
  Vec8x3 xi, eta;  ///< sums of xi_a x_a, eta_a x_a in the frame (z unused)
};

GANNET_INLINE QuadGeometry quad_geometry(const Vec8x3 x[4]) {
  QuadGeometry g;
  const Vec8x3 r31 = x[2] - x[0];
  const Vec8x3 r42 = x[3] - x[1];
  const Vec8 inverse_2A = flat_frame<4>(cross(r31, r42), r31 - r42, r31 + r42, g);
  place_corners<4>(x, g);
  const Vec8 x31 = g.x[2] - g.x[0];
  const Vec8 y31 = g.y[2] - g.y[0];
  const Vec8 x42 = g.x[3] - g.x[1];
  const Vec8 y42 = g.y[3] - g.y[1];
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
  g.xi = {x31 - x42, y31 - y42, Vec8(0.0)};
  g.eta = {x31 + x42, y31 + y42, Vec8(0.0)};
  const Vec8 quarter(0.25);
  for (int a = 0; a < 4; ++a) {
    const Vec8 h(a % 2 == 0 ? 1.0 : -1.0);
    g.gamma[a] = quarter * (h - g.hx * g.B1[a] - g.hy * g.B2[a]);
  }
  return g;
}

/// The map at a point of the plane: tangents along xi and eta, their determinant, grad h.
struct PointOfQuad {
  Vec8 xx, xy, ex, ey;  ///< (x, y) along xi; along eta [m]
  Vec8 J, inverse_J;    ///< [m^2]
  Vec8 hX, hY;          ///< [1/m]
};

GANNET_INLINE PointOfQuad point_of_quad(const QuadGeometry& g, double xi, double eta) {
  const Vec8 quarter(0.25);
  PointOfQuad p;
  p.xx = quarter * (g.xi.x + Vec8(eta) * g.hx);
  p.xy = quarter * (g.xi.y + Vec8(eta) * g.hy);
  p.ex = quarter * (g.eta.x + Vec8(xi) * g.hx);
  p.ey = quarter * (g.eta.y + Vec8(xi) * g.hy);
  p.J = p.xx * p.ey - p.xy * p.ex;
  p.inverse_J = Vec8(1.0) / p.J;
  p.hX = (Vec8(eta) * p.ey - Vec8(xi) * p.xy) * p.inverse_J;
  p.hY = (Vec8(xi) * p.xx - Vec8(eta) * p.ex) * p.inverse_J;
  return p;
}

/// Four times the smallest determinant of the map at the points: the area that they make of it.
GANNET_INLINE Vec8 smallest_area(const QuadGeometry& g) {
  // J is linear: (xi x eta + xi_p (xi x h) + eta_p (h x eta))/16.
  const Vec8 along = g.xi.x * g.hy - g.xi.y * g.hx;
  const Vec8 across = g.hx * g.eta.y - g.hy * g.eta.x;
  const Vec8 sizes = max(along, -along) + max(across, -across);
  return Vec8(0.25) * (g.xi.x * g.eta.y - g.xi.y * g.eta.x - Vec8(gauss) * sizes);
}

/// Sides 1-2, 4-3 (along xi) and 1-4, 2-3 (along eta).
constexpr int side_from[4] = {0, 3, 0, 1};
constexpr int side_to[4] = {1, 2, 3, 2};

/// Strain, curvature and shear at the points of a quadrilateral.
struct QuadFields {
  ShellIncrements middle;
  Vec8 qx, qy;  ///< gamma.u
  Vec8 px, py;  ///< gamma.psi
  Vec8 side[4];
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

GANNET_INLINE ShellIncrements increments_at(const QuadFields& q, const PointOfQuad& p, Vec8 nu,
                                            double xi, double eta) {
  ShellIncrements d = q.middle;
  d.xx += p.hX * q.qx - nu * p.hY * q.qy;
  d.yy += p.hY * q.qy - nu * p.hX * q.qx;
  d.kxx += p.hX * q.px;
  d.kyy += p.hY * q.py;
  d.kxy += p.hY * q.px + p.hX * q.py;
  const Vec8 along_xi = Vec8(0.25 * (1 - eta)) * q.side[0] + Vec8(0.25 * (1 + eta)) * q.side[1];
  const Vec8 along_eta = Vec8(0.25 * (1 - xi)) * q.side[2] + Vec8(0.25 * (1 + xi)) * q.side[3];
  d.xz = (p.ey * along_xi - p.xy * along_eta) * p.inverse_J;
  d.yz = (p.xx * along_eta - p.ex * along_xi) * p.inverse_J;
  return d;
}

/// What belongs to QuadFields in power, summed over the points.
struct QuadForces {
  MiddleForces middle;
  Vec8 qx = Vec8(0.0), qy = Vec8(0.0);
  Vec8 px = Vec8(0.0), py = Vec8(0.0);
  Vec8 side[4] = {Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0)};
};

/// Adds a point with the resultants r, at the geometry of n.
GANNET_INLINE void add_point(const PointOfQuad& p, const ShellResultants& r, Vec8 nu, double xi,
                             double eta, QuadForces& s) {
  s.middle.add(r, p.J);
  const Vec8 JX = p.J * p.hX;
  const Vec8 JY = p.J * p.hY;
  s.qx += JX * (r.nxx - nu * r.nyy);
  s.qy += JY * (r.nyy - nu * r.nxx);
  s.px += JX * r.mxx + JY * r.mxy;
  s.py += JY * r.myy + JX * r.mxy;
  const Vec8 along_xi = Vec8(0.25) * (p.ey * r.nxz - p.ex * r.nyz);
  const Vec8 along_eta = Vec8(0.25) * (p.xx * r.nyz - p.xy * r.nxz);
  s.side[0] += Vec8(1 - eta) * along_xi;
  s.side[1] += Vec8(1 + eta) * along_xi;
  s.side[2] += Vec8(1 - xi) * along_eta;
  s.side[3] += Vec8(1 + xi) * along_eta;
}

/// Forces on the corners, negative as they are added to f.
GANNET_INLINE void quad_forces(const QuadGeometry& g, const Leaning<4>& t, const QuadForces& s,
                               Vec8x3 f[4], Vec8x3 m[4]) {
  Relative<4> r;
  for (int a = 0; a < 4; ++a) {
    r.ux[a] = g.gamma[a] * s.qx;
    r.uy[a] = g.gamma[a] * s.qy;
    r.uz[a] = Vec8(0.0);
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
GANNET_INLINE Vec8 shear_of_quad(const QuadGeometry& g, Vec8 inverse_alpha) {
  Vec8 rx[4];
  Vec8 ry[4];
  for (int k = 0; k < 4; ++k) {
    rx[k] = g.x[side_to[k]] - g.x[side_from[k]];
    ry[k] = g.y[side_to[k]] - g.y[side_from[k]];
  }
  const auto own = [&](int k) {
    return Vec8(2.0) + Vec8(0.5) * inverse_alpha * (rx[k] * rx[k] + ry[k] * ry[k]);
  };
  const auto meet = [&](int k, int l, double sign) {
    return Vec8(sign) + Vec8(0.25) * inverse_alpha * (rx[k] * rx[l] + ry[k] * ry[l]);
  };
  const Vec8 own_of[4] = {own(0), own(1), own(2), own(3)};
  const Vec8 corner[4] = {meet(0, 2, 1), meet(0, 3, -1), meet(1, 3, 1), meet(1, 2, -1)};
  Vec8 largest(0.0);
  for (int k = 0; k < 4; ++k) {
    const double xi = xi_of[k];
    const double eta = eta_of[k];
    const PointOfQuad p = point_of_quad(g, xi, eta);
    const double below = 0.25 * (1 - eta);
    const double above = 0.25 * (1 + eta);
    const double left = 0.25 * (1 - xi);
    const double right = 0.25 * (1 + xi);
    const Vec8 S11 = Vec8(below * below) * own_of[0] + Vec8(above * above) * own_of[1];
    const Vec8 S22 = Vec8(left * left) * own_of[2] + Vec8(right * right) * own_of[3];
    const Vec8 S12 = Vec8(below * left) * corner[0] + Vec8(below * right) * corner[1] +
                     Vec8(above * right) * corner[2] + Vec8(above * left) * corner[3];
    const Vec8 two(2.0);
    const Vec8 G11 = p.ey * p.ey * S11 - two * p.ey * p.xy * S12 + p.xy * p.xy * S22;
    const Vec8 G22 = p.ex * p.ex * S11 - two * p.ex * p.xx * S12 + p.xx * p.xx * S22;
    const Vec8 G12 = (p.ey * p.xx + p.xy * p.ex) * S12 - p.ey * p.ex * S11 - p.xy * p.xx * S22;
    largest = max(largest, larger_eigenvalue(G11, G22, G12) * p.inverse_J * p.inverse_J);
  }
  return g.area * largest;
}

/// Bound of the largest squared frequency [1/s^2] as in shell_omega2(). Fields of the middle and of
/// gamma are orthogonal but for c^2 = (h.x, h.y) G (h.x, h.y)/(4 + the same), the square of the
/// cosine between gamma and the gradients.
GANNET_INLINE Vec8 quad_omega2(const ShellConstants& c, const QuadGeometry& g, const Leaning<4>& t,
                               Vec8 thickness, Vec8 inverse_A0, Vec8 inverse_alpha) {
  const Vec8 lambda = largest_gradient<4>(g);
  Vec8 XX(0.0);
  Vec8 YY(0.0);
  for (int k = 0; k < 4; ++k) {
    const PointOfQuad p = point_of_quad(g, xi_of[k], eta_of[k]);
    XX += p.J * p.hX * p.hX;
    YY += p.J * p.hY * p.hY;
  }
  const Vec8 hGh = g.hx * g.hx * g.g11 + Vec8(2.0) * g.hx * g.hy * g.g12 + g.hy * g.hy * g.g22;
  const Vec8 gamma2 = Vec8(1.0 / 16.0) * (Vec8(4.0) + hGh);
  const Vec8 overlap2 = hGh / (Vec8(4.0) + hGh);
  const Vec8 h_z = (g.z[0] + g.z[2]) - (g.z[1] + g.z[3]);
  const Vec8 Ct = Vec8(c.membrane_modulus) * thickness;
  const auto together = [&](Vec8 a, Vec8 b) {
    return larger_eigenvalue(a, b, sqrt(overlap2 * a * b));
  };
  // E (1 + nu) <= E/(1 - nu)
  const Vec8 hourglass = Ct * max(XX, YY);
  const Vec8 middle = Ct * g.area * lambda;
  const Vec8 ratio = thickness * thickness * inverse_alpha * Vec8(1.0 / 12.0);
  Vec8 membrane =
      together(middle, hourglass * gamma2) + Vec8(1.0 / 16.0) * hourglass * h_z * h_z * lambda;
  Vec8 bending = ratio * together(middle, Ct * (XX + YY) * gamma2);
  if (c.offset != 0) {
    membrane = bending =
        together(middle, Ct * (XX + YY) * gamma2) * share_of_offset(c.offset, ratio, inverse_alpha);
  }
  const Vec8 shear =
      Vec8(c.shear_factor * c.law.shear) * thickness * shear_of_quad(g, inverse_alpha);
  return Vec8(1.0 / c.nodal_mass_factor) * inverse_A0 *
         bound_of_leaning<4>(t, membrane, bending + shear);
}

struct Quad {
  static constexpr int n_corners = 4;
  template <PointLaw law>
  static GANNET_INLINE void block(const ShellPass& pass, std::int32_t number, ShellLaneSums& sums);
};

/// Thickness and what else is kept of a block after the points.
struct BlockState {
  double* all;
  double* shear;
  double* fibres;
  double* thickness;
  Vec8 inverse_A0;
};

GANNET_INLINE BlockState block_state(const ShellPass& pass, std::int32_t number) {
  const ShellLayout& layout = pass.layout;
  double* all = pass.state + static_cast<std::int64_t>(number) * layout.n_values() * 8;
  return {all, all + 8 * layout.shear(), all + 8 * layout.fibres(), all + 8 * layout.thickness(),
          Vec8::load(all + 8 * layout.inverse_area())};
}

/// The thickness over a point of the plane that still carries something [m].
template <PointLaw law>
GANNET_INLINE Vec8 carrying(Vec8 t, const ColumnStress& column) {
  if constexpr (law != PointLaw::general) return t;
  return select(less(column.least_damage, Vec8(1.0)), t, Vec8(0.0));
}

/// The thickness [m], 0 from now on where every point has failed.
GANNET_INLINE Vec8 left_of(Vec8 t, Vec8 least_damage, double* thickness) {
  const Vec8 left = select(less(least_damage, Vec8(1.0)), t, Vec8(0.0));
  left.store(thickness);
  return left;
}

template <PointLaw law>
GANNET_INLINE void Quad::block(const ShellPass& pass, std::int32_t number, ShellLaneSums& sums) {
  const ShellConstants& c = *pass.constants;
  const BlockState state = block_state(pass, number);
  CornersOf<4> corners = gather_all<4>(pass, number);
  const Vec8 nu(c.law.c12 / c.law.c11);
  Vec8 t = Vec8::load(state.thickness);

  QuadGeometry half = quad_geometry(corners.middle);
  QuadGeometry now = quad_geometry(corners.x);
  const auto goes_on = sums.shrunk_to(
      min(smallest_area(half), smallest_area(now)) * state.inverse_A0, c.smallest_ratio, t, number);
  if (leaves_out(goes_on)) {
    make_harmless(corners, goes_on);
    t = select(goes_on, t, Vec8(0.0));
    half = quad_geometry(corners.middle);
    now = quad_geometry(corners.x);
  }
  const Leaning<4> old = load_leaning<4>(state.fibres);
  const Vec8 dt(pass.dt);
  const Leaning<4> middle =
      leaning_halfway<4>(old, relative_motion<4>(half, old, corners.v, corners.w, dt));
  const Relative<4> motion = relative_motion<4>(half, middle, corners.v, corners.w, dt);
  const QuadFields fields = quad_fields(half, middle, motion);
  follow_leaning<4>(old, motion, state.fibres);
  QuadForces forces;
  Vec8 growth(0.0);
  Vec8 least_damage(1.0);
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
  Vec8x3 f[4];
  Vec8x3 m[4];
  quad_forces(now, leaning, forces, f, m);
  scatter_all<4>(pass, number, f, m);
  const Vec8 inverse_alpha = min(Vec8(1.0 / c.smallest_alpha), Vec8(8.0) * state.inverse_A0);
  sums.vote(pass, quad_omega2(c, now, leaning, t, state.inverse_A0, inverse_alpha), number);
}

/// The triangle.
GANNET_INLINE FlatGeometry<3> triangle_geometry(const Vec8x3 x[3]) {
  FlatGeometry<3> g;
  const Vec8x3 xi = x[1] - x[0];
  const Vec8x3 eta = x[2] - x[0];
  const Vec8 inverse_2A = flat_frame<3>(cross(xi, eta), xi, eta, g);
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
GANNET_INLINE Vec8 sides_squared(const FlatGeometry<3>& g) {
  Vec8 sum(0.0);
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const Vec8 x = g.x[b] - g.x[a];
    const Vec8 y = g.y[b] - g.y[a];
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
GANNET_INLINE Vec8 triangle_omega2(const ShellConstants& c, const FlatGeometry<3>& g,
                                   const Leaning<3>& t, Vec8 thickness, Vec8 inverse_A0,
                                   Vec8 inverse_alpha) {
  const Vec8 lambda = largest_gradient<3>(g);
  Vec8 membrane = Vec8(c.membrane_modulus) * thickness * g.area * lambda;
  const Vec8 ratio = thickness * thickness * inverse_alpha * Vec8(1.0 / 12.0);
  Vec8 bending = membrane * ratio;
  if (c.offset != 0) {
    membrane = bending = membrane * share_of_offset(c.offset, ratio, inverse_alpha);
  }
  const Vec8 Gt = Vec8(c.shear_factor * c.law.shear) * thickness;
  // Mean shear: rows of corner a in w: grad N_a; in turning about x and y: a 2 x 2 matrix
  // sum over its sides of r (grad N_j - grad N_i)/6.
  Vec8 G11 = g.g11;
  Vec8 G22 = g.g22;
  Vec8 G12 = g.g12;
  const Vec8 sixth(1.0 / 6.0);
  for (int a = 0; a < 3; ++a) {
    Vec8 Rxx(0.0);
    Vec8 Rxy(0.0);
    Vec8 Ryx(0.0);
    Vec8 Ryy(0.0);
    for (int side = 0; side < 2; ++side) {
      const int i = (a + 2 * side) % 3;
      const int j = (i + 1) % 3;
      const Vec8 gx = sixth * (g.B1[j] - g.B1[i]);
      const Vec8 gy = sixth * (g.B2[j] - g.B2[i]);
      const Vec8 rx = g.x[j] - g.x[i];
      const Vec8 ry = g.y[j] - g.y[i];
      Rxx += gx * rx;
      Rxy += gx * ry;
      Ryx += gy * rx;
      Ryy += gy * ry;
    }
    G11 += inverse_alpha * (Rxx * Rxx + Rxy * Rxy);
    G22 += inverse_alpha * (Ryx * Ryx + Ryy * Ryy);
    G12 += inverse_alpha * (Rxx * Ryx + Rxy * Ryy);
  }
  const Vec8 sides = sides_squared(g);
  const Vec8 mean_shear = Gt * g.area * larger_eigenvalue(G11, G22, G12);
  const Vec8 turning = Gt * sides * sides * inverse_alpha * Vec8(1.0 / 576.0) / g.area;
  return Vec8(1.0 / c.nodal_mass_factor) * inverse_A0 *
         bound_of_leaning<3>(t, membrane, bending + mean_shear + turning);
}

template <PointLaw law>
GANNET_INLINE void Triangle::block(const ShellPass& pass, std::int32_t number,
                                   ShellLaneSums& sums) {
  const ShellConstants& c = *pass.constants;
  const BlockState state = block_state(pass, number);
  CornersOf<3> corners = gather_all<3>(pass, number);
  Vec8 t = Vec8::load(state.thickness);

  FlatGeometry<3> half = triangle_geometry(corners.middle);
  FlatGeometry<3> now = triangle_geometry(corners.x);
  const auto goes_on =
      sums.shrunk_to(min(half.area, now.area) * state.inverse_A0, c.smallest_ratio, t, number);
  if (leaves_out(goes_on)) {
    make_harmless(corners, goes_on);
    t = select(goes_on, t, Vec8(0.0));
    half = triangle_geometry(corners.middle);
    now = triangle_geometry(corners.x);
  }
  const Leaning<3> old = load_leaning<3>(state.fibres);
  const Vec8 dt(pass.dt);
  const Leaning<3> middle =
      leaning_halfway<3>(old, relative_motion<3>(half, old, corners.v, corners.w, dt));
  const Relative<3> motion = relative_motion<3>(half, middle, corners.v, corners.w, dt);
  follow_leaning<3>(old, motion, state.fibres);
  ShellIncrements d = middle_increments<3>(half, motion);
  d.xz = d.yz = Vec8(0.0);
  Vec8 around(0.0);
  const Vec8 third(1.0 / 3.0);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec8 side = side_shear<3>(half, middle, motion, i, j);
    d.xz += third * (half.B1[j] - half.B1[i]) * side;
    d.yz += third * (half.B2[j] - half.B2[i]) * side;
    around += side;
  }
  ShellResultants r;
  ColumnStress column;
  column_stress<law>(c, pass.layout, pass.dt, state.all, d, t, r, column);
  Vec8& work = column.work.internal;
  shell_shear(c, state.shear, d, t, r, work);
  // The turning of shear: energy kappa G t (sum g)^2 sum l^2/(288 A); kept is G sum g.
  const Vec8 kept = Vec8::load(state.shear + 16);
  Vec8 turned = kept + Vec8(c.law.shear) * around;
  if constexpr (law == PointLaw::general) {
    drop_failed_shear(state.shear, d, column.least_damage, r, work);
    turned = select(less(column.least_damage, Vec8(1.0)), turned, Vec8(0.0));
    sums.eroded += column.work.eroded * half.area;
  }
  turned.store(state.shear + 16);
  add_damping(pass, number, 0, state.all, d, carrying<law>(t, column), half.area, r, sums);
  const auto factor = [&](const FlatGeometry<3>& g) {
    return Vec8(c.shear_factor / 144.0) * t * sides_squared(g) / g.area;
  };
  sums.internal += work * half.area + Vec8(0.5) * factor(half) * (kept + turned) * around;
  if constexpr (law != PointLaw::elastic) sums.plastic += column.work.plastic * half.area;
  if constexpr (law == PointLaw::general) t = left_of(t, column.least_damage, state.thickness);
  if (c.thickness_changes) grown(t, column.growth).store(state.thickness);

  const Leaning<3> leaning = load_leaning<3>(state.fibres);
  Relative<3> forces{};
  for (int a = 0; a < 3; ++a) {
    forces.ux[a] = forces.uy[a] = forces.uz[a] = forces.px[a] = forces.py[a] = Vec8(0.0);
  }
  MiddleForces of_middle;
  of_middle.add(r, now.area);
  add_middle<3>(now, of_middle, forces);
  const Vec8 Q = factor(now) * turned;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec8 mean =
        now.area * third * ((now.B1[j] - now.B1[i]) * r.nxz + (now.B2[j] - now.B2[i]) * r.nyz);
    add_side_shear<3>(now, leaning, i, j, mean + Q, forces);
  }
  Vec8x3 f[3];
  Vec8x3 m[3];
  nodal_forces<3>(now, leaning, forces, f, m);
  for (int a = 0; a < 3; ++a) {
    f[a] = -f[a];
    m[a] = -m[a];
  }
  scatter_all<3>(pass, number, f, m);
  const Vec8 inverse_alpha = min(Vec8(1.0 / c.smallest_alpha), Vec8(6.0) * state.inverse_A0);
  sums.vote(pass, triangle_omega2(c, now, leaning, t, state.inverse_A0, inverse_alpha), number);
}

}  // namespace

__attribute__((flatten)) void shell_quad_force(const ShellPass& pass, std::int32_t begin,
                                               std::int32_t end, ShellSums& sums) {
  with_law<Quad>(pass, begin, end, sums);
}

__attribute__((flatten)) void shell_triangle_force(const ShellPass& pass, std::int32_t begin,
                                                   std::int32_t end, ShellSums& sums) {
  with_law<Triangle>(pass, begin, end, sums);
}

}  // namespace gannet::GANNET_ISA_NS
