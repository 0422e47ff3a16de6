// The Belytschko-Lin-Tsay shell element, eight at a time (Belytschko, Lin & Tsay 1984, Comput.
// Methods Appl. Mech. Eng. 42, 225-251): four nodes with six velocities each, one point of
// integration in the plane, several through the thickness, in a frame that turns with the element.
//
// Frame: e3 is normal to both diagonals, e1 lies along side 1-2, e2 = e3 x e1. Gradients at the
// centre, with 2 A the cross product of the diagonals:
//   B1 = [y24, y31, y42, y13] / (2 A),  B2 = [x42, x13, x24, x31] / (2 A)
// so node 3 carries minus the gradient of node 1 and node 4 minus that of node 2; everything below
// is written in differences across the diagonals.
//   d_xx = B1.v_x, d_yy = B2.v_y, 2 d_xy = B2.v_x + B1.v_y
//   2 d_xz = B1.v_z + mean(omega_y), 2 d_yz = B2.v_z - mean(omega_x)
//   k_xx = B1.omega_y, k_yy = -B2.omega_x, 2 k_xy = B2.omega_y - B1.omega_x
//   strain at height z: d + z k. Transverse shear is elastic and constant over the thickness.
//
// Hourglass vector: gamma = h - (h.x) B1 - (h.y) B2 with h = [1, -1, 1, -1], so that no linear
// field in the plane is resisted. Two additions keep what else must be free, free; both act on the
// forces as on the rates, so that work, momentum and angular momentum stay exact:
//  - Warped elements: a rigid rotation moves the nodes in the plane by omega x z e3, which h sees;
//    the rates of v_x, v_y get (h.z) B1.v_z, (h.z) B2.v_z added, which cancels it.
//  - Bending: the deflection of a constant curvature has a bilinear part that h sees (twist above
//    all). The curvature of the rotations predicts it on a parallelogram,
//      h.w = -(X k_xx + Y 2 k_xy + Z k_yy)/4,  X = x31^2 - x42^2, Y = x31 y31 - x42 y42,
//      Z = y31^2 - y42^2,
//    and only what differs from it is resisted.
//
// Fibres (key `warping`; in place of the correction of Belytschko, Wong & Chiang 1992, Comput.
// Methods Appl. Mech. Eng. 96, 93-107, and of projections of drilling rotations). The material
// fibre of corner a, common to the elements around a node, is p_a = e3 + t_a with t_a in the plane.
// Only its turning against the element strains it: what a node spins about its fibre, beyond the
// spin s of the element in its plane, is taken out before everything else,
//   omega_a' = omega_a - t_a (omega_a.e3 - s),  s = (B1.v_y - B2.v_x)/2.
// Without it that spin, which nothing else resists, gives way in the place of bending and twist
// where elements are warped or meet at an angle. The moments go the other way, so that the
// projection keeps force and moment balance, and a rigid rotation has omega_a.e3 = s and strains
// nothing. Fibres follow their nodes, as seen from the element:
//   dt_a/dt = (omega_a'.e2 + B1.v_z) e1 + (-omega_a'.e1 + B2.v_z) e2.
//
// For *.isa.cpp files only.
#pragma once

#include "fe/shell_kernel.hpp"
#include "fe/vec_x3.hpp"

namespace gannet::GANNET_ISA_NS {

/// Frame, gradients and hourglass geometry of the elements of a vector.
struct ShellGeometry {
  VecX3 e1, e2, e3;
  Vec area;
  Vec B11, B12, B21, B22;  ///< B1 and B2 at nodes 1 and 2; nodes 3 and 4 have minus these
  Vec hx, hy, hz;          ///< h.x, h.y, h.z
  Vec X, Y, Z;             ///< see the top
};

/// Geometry of the elements of a vector from their corners [m]. Needs diagonals that cross.
GANNET_INLINE ShellGeometry shell_geometry(const VecX3 x[4]) {
  ShellGeometry g;
  const VecX3 r31 = x[2] - x[0];
  const VecX3 r42 = x[3] - x[1];
  const VecX3 r21 = x[1] - x[0];
  const VecX3 n = cross(r31, r42);
  const Vec n2 = dot(n, n);
  const Vec inverse_2A = rsqrt(n2);
  g.area = Vec(0.5) * n2 * inverse_2A;
  g.e3 = scaled(n, inverse_2A);
  const VecX3 side = r21 - scaled(g.e3, dot(r21, g.e3));
  g.e1 = scaled(side, rsqrt(dot(side, side)));
  g.e2 = cross(g.e3, g.e1);
  const Vec x31 = dot(r31, g.e1);
  const Vec y31 = dot(r31, g.e2);
  const Vec x42 = dot(r42, g.e1);
  const Vec y42 = dot(r42, g.e2);
  g.B11 = -y42 * inverse_2A;
  g.B12 = y31 * inverse_2A;
  g.B21 = x42 * inverse_2A;
  g.B22 = -x31 * inverse_2A;
  const VecX3 h = r31 - r21 - (r42 + r21);
  g.hx = dot(h, g.e1);
  g.hy = dot(h, g.e2);
  g.hz = dot(h, g.e3);
  g.X = x31 * x31 - x42 * x42;
  g.Y = x31 * y31 - x42 * y42;
  g.Z = y31 * y31 - y42 * y42;
  return g;
}

/// Fibres of the corners: components of t in the plane of the element [-].
struct ShellFibres {
  Vec x[4], y[4];
};

GANNET_INLINE ShellFibres load_fibres(const double* state) {
  ShellFibres t;
  for (int a = 0; a < 4; ++a) {
    t.x[a] = Vec::load(state + 16 * a);
    t.y[a] = Vec::load(state + 16 * a + 8);
  }
  return t;
}

GANNET_INLINE VecX3 in_plane(const ShellGeometry& g, Vec x, Vec y) {
  return scaled(g.e1, x) + scaled(g.e2, y);
}

/// Takes what nodes spin about their fibres out of the angular velocities w [rad/s], and carries
/// the fibres in `state` from n-1 to n. What is taken out belongs to the fibres halfway, half a
/// step on from those of n-1, as everything else does. v: [m/s]; dt: [s].
GANNET_INLINE void follow_fibres(const ShellGeometry& g, const VecX3 v[4], VecX3 w[4],
                                 double* state, Vec dt) {
  const VecX3 v13 = v[0] - v[2];
  const VecX3 v24 = v[1] - v[3];
  const VecX3 L1 = scaled(v13, g.B11) + scaled(v24, g.B12);
  const VecX3 L2 = scaled(v13, g.B21) + scaled(v24, g.B22);
  const Vec spin = Vec(0.5) * (dot(L1, g.e2) - dot(L2, g.e1));
  const Vec half_dt = Vec(0.5) * dt;
  const ShellFibres t = load_fibres(state);
  for (int a = 0; a < 4; ++a) {
    const Vec s = spin - dot(w[a], g.e3);
    const Vec x_rate = dot(w[a], g.e2) + dot(L1, g.e3);
    const Vec y_rate = dot(L2, g.e3) - dot(w[a], g.e1);
    const Vec x = t.x[a] + half_dt * (x_rate + t.y[a] * s);
    const Vec y = t.y[a] + half_dt * (y_rate - t.x[a] * s);
    w[a] = w[a] + in_plane(g, x * s, y * s);
    (t.x[a] + dt * (x_rate + y * s)).store(state + 16 * a);
    (t.y[a] + dt * (y_rate - x * s)).store(state + 16 * a + 8);
  }
}

/// The transpose of taking the spin out: turns moments [N m] on what is left of the angular
/// velocities into moments and forces [N] on the nodes.
GANNET_INLINE void give_back_spin(const ShellGeometry& g, const ShellFibres& t, VecX3 f[4],
                                  VecX3 m[4]) {
  Vec sum(0.0);
  for (int a = 0; a < 4; ++a) {
    const Vec s = dot(m[a], in_plane(g, t.x[a], t.y[a]));
    m[a] = m[a] - scaled(g.e3, s);
    sum += s;
  }
  const Vec half = Vec(0.5) * sum;
  const VecX3 f1 = in_plane(g, -half * g.B21, half * g.B11);
  const VecX3 f2 = in_plane(g, -half * g.B22, half * g.B12);
  f[0] = f[0] + f1;
  f[1] = f[1] + f2;
  f[2] = f[2] - f1;
  f[3] = f[3] - f2;
}

/// Increments over a step, in the frame of the element.
struct ShellIncrements {
  Vec xx, yy, xy, xz, yz;  ///< strain of the middle surface, shear as engineering shear [-]
  Vec kxx, kyy, kxy;       ///< curvature, kxy as 2 k_xy [1/m]
  Vec q[5];                ///< hourglass: displacement x, y, z [m], rotation x, y [rad]
};

/// Increments from the velocities [m/s] and angular velocities [rad/s] of the corners over dt [s].
GANNET_INLINE ShellIncrements shell_increments(const ShellGeometry& g, const VecX3 v[4],
                                               const VecX3 w[4], Vec dt) {
  const VecX3 v13 = v[0] - v[2];
  const VecX3 v24 = v[1] - v[3];
  const VecX3 vh = (v[0] + v[2]) - (v[1] + v[3]);
  const VecX3 w13 = w[0] - w[2];
  const VecX3 w24 = w[1] - w[3];
  const VecX3 wh = (w[0] + w[2]) - (w[1] + w[3]);
  const VecX3 ws = (w[0] + w[2]) + (w[1] + w[3]);
  const Vec B11 = g.B11 * dt;
  const Vec B12 = g.B12 * dt;
  const Vec B21 = g.B21 * dt;
  const Vec B22 = g.B22 * dt;
  const auto d1 = [&](const VecX3& e, const VecX3& a, const VecX3& b) {
    return B11 * dot(a, e) + B12 * dot(b, e);
  };
  const auto d2 = [&](const VecX3& e, const VecX3& a, const VecX3& b) {
    return B21 * dot(a, e) + B22 * dot(b, e);
  };
  const Vec Lxx = d1(g.e1, v13, v24);
  const Vec Lxy = d2(g.e1, v13, v24);
  const Vec Lyx = d1(g.e2, v13, v24);
  const Vec Lyy = d2(g.e2, v13, v24);
  const Vec Lzx = d1(g.e3, v13, v24);
  const Vec Lzy = d2(g.e3, v13, v24);
  const Vec Pxx = d1(g.e1, w13, w24);
  const Vec Pxy = d2(g.e1, w13, w24);
  const Vec Pyx = d1(g.e2, w13, w24);
  const Vec Pyy = d2(g.e2, w13, w24);
  const Vec quarter = Vec(0.25) * dt;
  ShellIncrements d;
  d.xx = Lxx;
  d.yy = Lyy;
  d.xy = Lxy + Lyx;
  d.xz = Lzx + quarter * dot(ws, g.e2);
  d.yz = Lzy - quarter * dot(ws, g.e1);
  d.kxx = Pyx;
  d.kyy = -Pxy;
  d.kxy = Pyy - Pxx;
  d.q[0] = dt * dot(vh, g.e1) - g.hx * Lxx - g.hy * Lxy + g.hz * Lzx;
  d.q[1] = dt * dot(vh, g.e2) - g.hx * Lyx - g.hy * Lyy + g.hz * Lzy;
  d.q[2] = dt * dot(vh, g.e3) - g.hx * Lzx - g.hy * Lzy +
           Vec(0.25) * (g.X * d.kxx + g.Y * d.kxy + g.Z * d.kyy);
  d.q[3] = dt * dot(wh, g.e1) - g.hx * Pxx - g.hy * Pxy;
  d.q[4] = dt * dot(wh, g.e2) - g.hx * Pyx - g.hy * Pyy;
  return d;
}

/// Stress resultants: forces per length [N/m], moments per length [N], hourglass forces.
struct ShellResultants {
  Vec nxx, nyy, nxy, nxz, nyz;
  Vec mxx, myy, mxy;
  Vec Q[5];
};

/// Stress from n-1 to n at every point through the thickness; fills the resultants of the section
/// and adds the work per area: w = sum (sigma(n-1) + sigma(n))/2 . d eps.
/// state: first value of the block. t: thickness [m]. work, plastic_work: [J/m^2].
/// Returns the mean strain increment through the thickness.
template <bool plastic>
GANNET_INLINE Vec shell_stress(const ShellConstants& c, const ShellLayout& layout, double* state,
                               const ShellIncrements& d, Vec t, ShellResultants& r, Vec& work,
                               Vec& plastic_work) {
  const Vec zero(0.0);
  r.nxx = r.nyy = r.nxy = r.mxx = r.myy = r.mxy = zero;
  Vec twice_work = zero;
  Vec dissipated = zero;
  Vec growth = zero;
  const Vec half_t = Vec(0.5) * t;
  constexpr int per_point = plastic ? 4 : 3;
  double* p = state;
  for (int k = 0; k < layout.n_points; ++k, p += per_point * 8) {
    const Vec z = Vec(c.point[k]) * half_t;
    const Vec exx = d.xx + z * d.kxx;
    const Vec eyy = d.yy + z * d.kyy;
    const Vec gxy = d.xy + z * d.kxy;
    const PlaneStress<Vec> old{Vec::load(p), Vec::load(p + 8), Vec::load(p + 16)};
    PlaneStress<Vec> sigma = old;
    add_elastic(c.law, exx, eyy, gxy, sigma);
    const Vec W = Vec(c.weight[k]) * t;
    if constexpr (plastic) {
      const Vec eps_p = Vec::load(p + 24);
      const Vec yield = Vec(c.law.yield) + Vec(c.law.hardening) * eps_p;
      if (any(less(yield * yield, von_mises_squared(sigma)))) {
        const Vec flow = return_to_yield(c.law, yield, sigma);
        dissipated += W * flow * (yield + Vec(0.5 * c.law.hardening) * flow);
        (eps_p + flow).store(p + 24);
      }
    }
    sigma.xx.store(p);
    sigma.yy.store(p + 8);
    sigma.xy.store(p + 16);
    twice_work +=
        W * ((old.xx + sigma.xx) * exx + (old.yy + sigma.yy) * eyy + (old.xy + sigma.xy) * gxy);
    if (c.thickness_changes) {
      growth += Vec(c.weight[k]) *
                through_thickness_strain(c.law, exx, eyy, sigma.xx - old.xx, sigma.yy - old.yy);
    }
    const Vec Wz = W * z;
    r.nxx += W * sigma.xx;
    r.nyy += W * sigma.yy;
    r.nxy += W * sigma.xy;
    r.mxx += Wz * sigma.xx;
    r.myy += Wz * sigma.yy;
    r.mxy += Wz * sigma.xy;
  }
  work = Vec(0.5) * twice_work;
  plastic_work = dissipated;
  return growth;
}

/// Elastic transverse shear, the same at all heights: the resultant is kappa G t gamma. Adds its
/// work per area [J/m^2].
GANNET_INLINE void shell_shear(const ShellConstants& c, double* q, const ShellIncrements& d, Vec t,
                               ShellResultants& r, Vec& work) {
  const Vec xz = Vec::load(q);
  const Vec yz = Vec::load(q + 8);
  const Vec new_xz = xz + Vec(c.law.shear) * d.xz;
  const Vec new_yz = yz + Vec(c.law.shear) * d.yz;
  new_xz.store(q);
  new_yz.store(q + 8);
  const Vec W = Vec(c.shear_factor) * t;
  r.nxz = W * new_xz;
  r.nyz = W * new_yz;
  work += Vec(0.5) * W * ((xz + new_xz) * d.xz + (yz + new_yz) * d.yz);
}

/// Stiffness of the hourglass modes of the elements of a vector.
struct HourglassStiffness {
  Vec membrane;  ///< [N/m]
  Vec warp;      ///< [N/m]
  Vec bending;   ///< [N m]
};

/// Resists the hourglass modes. Stiffness form: Q(n) = Q(n-1) + K q; viscous form:
/// Q(n) = K (sqrt(A)/c) q/dt, the force that the stiffness form would build up while a wave crosses
/// the element. With BB the sum of all squared gradients and r the coefficient,
///   K_membrane = r E t A BB / 8,  K_bending = r E t^3 A BB / 192,  K_warp = r kappa G t^3 BB / 12
/// (on a square of side a: BB = 2/a^2, so K_membrane = r E t/4, a fraction of the membrane's own
/// stiffness; the factors are those customary for this element, with r from 0.01 to 0.05).
/// Returns the work [J] and leaves the stiffness for the stable step.
GANNET_INLINE Vec shell_hourglass(const ShellConstants& c, const ShellGeometry& g, double* state,
                                  const ShellIncrements& d, Vec t, double dt, ShellResultants& r,
                                  HourglassStiffness& K) {
  const Vec BB = Vec(2.0) * (g.B11 * g.B11 + g.B12 * g.B12 + g.B21 * g.B21 + g.B22 * g.B22);
  const Vec tA = t * g.area * BB;
  const Vec ttt = t * t * t * BB;
  K.membrane = Vec(c.hourglass_membrane) * tA;
  K.warp = Vec(c.hourglass_warp) * ttt;
  K.bending = Vec(c.hourglass_bending) * ttt * g.area;
  const Vec stiffness[5] = {K.membrane, K.membrane, K.warp, K.bending, K.bending};
  // Viscous: sqrt(A) = A rsqrt(A). The first step has dt = 0 and nothing to resist.
  const Vec per_step = c.viscous_hourglass
                           ? g.area * rsqrt(g.area) * Vec(dt > 0 ? c.inverse_wave_speed / dt : 0.0)
                           : Vec(1.0);
  Vec twice_work(0.0);
  for (int k = 0; k < 5; ++k) {
    const Vec old = Vec::load(state + 8 * k);
    const Vec change = stiffness[k] * per_step * d.q[k];
    r.Q[k] = c.viscous_hourglass ? change : old + change;
    r.Q[k].store(state + 8 * k);
    twice_work += (old + r.Q[k]) * d.q[k];
  }
  return Vec(0.5) * twice_work;
}

/// Internal forces [N] and moments [N m] on the corners, negative as they are added to f:
/// the transpose of shell_increments(), at the geometry of n.
GANNET_INLINE void shell_corner_forces(const ShellGeometry& g, const ShellResultants& r, VecX3 f[4],
                                       VecX3 m[4]) {
  const Vec A = -g.area;
  const Vec Q1 = -r.Q[0];
  const Vec Q2 = -r.Q[1];
  const Vec Q3 = -r.Q[2];
  const Vec Q4 = -r.Q[3];
  const Vec Q5 = -r.Q[4];
  // What multiplies each gradient: Lxx = B1.v_x gets nxx A - hx Q1, and so on.
  const Vec Sxx = A * r.nxx - g.hx * Q1;
  const Vec Sxy = A * r.nxy - g.hy * Q1;
  const Vec Syx = A * r.nxy - g.hx * Q2;
  const Vec Syy = A * r.nyy - g.hy * Q2;
  const Vec Szx = A * r.nxz - g.hx * Q3 + g.hz * Q1;
  const Vec Szy = A * r.nyz - g.hy * Q3 + g.hz * Q2;
  const Vec quarter_Q3 = Vec(0.25) * Q3;
  const Vec Mxx = A * r.mxx + quarter_Q3 * g.X;
  const Vec Mxy = A * r.mxy + quarter_Q3 * g.Y;
  const Vec Myy = A * r.myy + quarter_Q3 * g.Z;
  const Vec Tyx = Mxx - g.hx * Q5;   // B1.omega_y: k_xx
  const Vec Tyy = Mxy - g.hy * Q5;   // B2.omega_y: 2 k_xy
  const Vec Txx = -Mxy - g.hx * Q4;  // B1.omega_x: 2 k_xy
  const Vec Txy = -Myy - g.hy * Q4;  // B2.omega_x: k_yy
  const auto global3 = [&](Vec x, Vec y, Vec z) {
    return scaled(g.e1, x) + scaled(g.e2, y) + scaled(g.e3, z);
  };
  const auto global2 = [&](Vec x, Vec y) { return scaled(g.e1, x) + scaled(g.e2, y); };
  const VecX3 P1 =
      global3(g.B11 * Sxx + g.B21 * Sxy, g.B11 * Syx + g.B21 * Syy, g.B11 * Szx + g.B21 * Szy);
  const VecX3 P2 =
      global3(g.B12 * Sxx + g.B22 * Sxy, g.B12 * Syx + g.B22 * Syy, g.B12 * Szx + g.B22 * Szy);
  const VecX3 H = global3(Q1, Q2, Q3);
  f[0] = H + P1;
  f[1] = P2 - H;
  f[2] = H - P1;
  f[3] = VecX3{-P2.x, -P2.y, -P2.z} - H;
  const Vec quarter = Vec(0.25) * A;
  const VecX3 M1 = global2(g.B11 * Txx + g.B21 * Txy, g.B11 * Tyx + g.B21 * Tyy);
  const VecX3 M2 = global2(g.B12 * Txx + g.B22 * Txy, g.B12 * Tyx + g.B22 * Tyy);
  const VecX3 MH = global2(Q4, Q5);
  const VecX3 MS = global2(-quarter * r.nyz, quarter * r.nxz);
  const VecX3 even = MS + MH;
  const VecX3 odd = MS - MH;
  m[0] = even + M1;
  m[1] = odd + M2;
  m[2] = even - M1;
  m[3] = odd - M2;
}

/// The larger eigenvalue of the form |d + offset k|^2 + ratio alpha |k|^2 in d and k alpha^(1/2):
/// what stretching and bending at once come to where the middle of the shell is off its nodes, over
/// stretching alone. ratio: t^2/(12 alpha).
GANNET_INLINE Vec share_of_offset(double offset, Vec ratio, Vec inverse_alpha) {
  const Vec square = Vec(offset * offset) * inverse_alpha;
  const Vec half_gap = Vec(0.5) * (Vec(1.0) - square - ratio);
  return Vec(0.5) * (Vec(1.0) + square + ratio) + sqrt(half_gap * half_gap + square);
}

/// The bound where the element bends and shears through fibres (all terms times the mass of a
/// corner). With w = (1 + p^2)^(1/2), p the largest slope, turning of the nodes counts at most w
/// times as much; the spin of the element in its plane adds to the odd patterns of turning, which
/// bend, and to the even ones, which shear,
///   x_b^2 = alpha (sum |t|^2) tr(G)/4,  x_s^2 = |mean t|^2 tr(G)/4
/// (v and omega scaled by the roots of mass and inertia), so that the larger eigenvalue counts of
///   [membrane + bending x_b^2 + kappa G t A x_s^2, c; c, max(bending, shear) w^2],
///   c = (bending x_b + (shear kappa G t A)^(1/2) x_s) w.
GANNET_INLINE Vec bound_with_fibres(const ShellFibres& t, Vec membrane, Vec bending, Vec shear,
                                    Vec GtA, Vec trace, Vec inverse_alpha) {
  Vec squares(0.0);
  Vec most(0.0);
  Vec sum_x(0.0);
  Vec sum_y(0.0);
  for (int a = 0; a < 4; ++a) {
    const Vec slope = t.x[a] * t.x[a] + t.y[a] * t.y[a];
    squares += slope;
    most = max(most, slope);
    sum_x += t.x[a];
    sum_y += t.y[a];
  }
  const Vec x_b2 = Vec(0.25) * squares * trace / inverse_alpha;
  const Vec x_s2 = Vec(1.0 / 64.0) * (sum_x * sum_x + sum_y * sum_y) * trace;
  const Vec w2 = Vec(1.0) + most;
  const Vec a = membrane + bending * x_b2 + GtA * x_s2;
  const Vec b = max(bending, shear) * w2;
  const Vec c = bending * sqrt(x_b2) + sqrt(shear * GtA * x_s2);
  const Vec half_gap = Vec(0.5) * (a - b);
  return Vec(0.5) * (a + b) + sqrt(half_gap * half_gap + c * c * w2);
}

/// Bound of the largest squared frequency of each element [1/s^2], from its own lumped mass, so
/// that no assembly of such elements has a higher one. With m the mass and I = alpha m the rotary
/// inertia of a corner, alpha = max(t0^2/12, A0/8), lambda the larger eigenvalue of the Gram matrix
/// of B1 and B2, and c_max = E/(1 - |nu|) the largest eigenvalue of C (|d|^2 <= |grad v|^2):
///   membrane  (t A/m) c_max lambda
///   bending   (t^3 A/(12 I)) c_max lambda: below the membrane's, as alpha >= t^2/12
///   shear     kappa G t A (lambda/m + 1/(4 I))
/// These act on orthogonal patterns of the corners, so the largest counts; the hourglass modes
/// (K |gamma|^2/m and alike) may overlap with them and are added. What fibres change:
/// bound_with_fibres(). fibres: their state; nullptr where there are none.
GANNET_INLINE Vec shell_omega2(const ShellConstants& c, const ShellGeometry& g, Vec t,
                               Vec inverse_A0, const HourglassStiffness& K, const double* fibres) {
  const Vec two(2.0);
  const Vec g11 = two * (g.B11 * g.B11 + g.B12 * g.B12);
  const Vec g22 = two * (g.B21 * g.B21 + g.B22 * g.B22);
  const Vec g12 = two * (g.B11 * g.B21 + g.B12 * g.B22);
  const Vec half_sum = Vec(0.5) * (g11 + g22);
  const Vec half_gap = Vec(0.5) * (g11 - g22);
  const Vec lambda = half_sum + sqrt(half_gap * half_gap + g12 * g12);
  const Vec inverse_m = Vec(1.0 / c.nodal_mass_factor) * inverse_A0;
  const Vec inverse_alpha = min(Vec(1.0 / c.smallest_alpha), Vec(8.0) * inverse_A0);
  const Vec tA = t * g.area;
  const Vec thickness_ratio = t * t * inverse_alpha * Vec(1.0 / 12.0);
  const Vec gamma2 = Vec(4.0) + g.hx * g.hx * g11 + two * g.hx * g.hy * g12 + g.hy * g.hy * g22;
  const Vec bend2 = g.X * g.X + two * g.Y * g.Y + g.Z * g.Z;
  const Vec hourglass = gamma2 * (K.membrane + K.warp + K.bending * inverse_alpha) +
                        g.hz * g.hz * lambda * K.membrane +
                        Vec(1.0 / 16.0) * K.warp * bend2 * lambda * inverse_alpha;
  Vec membrane = tA * Vec(c.membrane_modulus) * lambda;
  Vec bending = membrane * thickness_ratio;
  if (c.offset != 0) {
    membrane = bending = membrane * share_of_offset(c.offset, thickness_ratio, inverse_alpha);
  }
  const Vec GtA = Vec(c.shear_factor * c.law.shear) * tA;
  const Vec shear = GtA * (lambda + Vec(0.25) * inverse_alpha);
  const Vec all = fibres == nullptr ? max(max(membrane, bending), shear)
                                    : bound_with_fibres(load_fibres(fibres), membrane, bending,
                                                        shear, GtA, g11 + g22, inverse_alpha);
  return inverse_m * (all + hourglass);
}

}  // namespace gannet::GANNET_ISA_NS
