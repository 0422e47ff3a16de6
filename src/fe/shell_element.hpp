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
#include "fe/vec8x3.hpp"

namespace gannet::GANNET_ISA_NS {

/// Frame, gradients and hourglass geometry of eight elements.
struct ShellGeometry {
  Vec8x3 e1, e2, e3;
  Vec8 area;
  Vec8 B11, B12, B21, B22;  ///< B1 and B2 at nodes 1 and 2; nodes 3 and 4 have minus these
  Vec8 hx, hy, hz;          ///< h.x, h.y, h.z
  Vec8 X, Y, Z;             ///< see the top
};

/// Geometry of eight elements from their corners [m]. Needs diagonals that cross.
GANNET_INLINE ShellGeometry shell_geometry(const Vec8x3 x[4]) {
  ShellGeometry g;
  const Vec8x3 r31 = x[2] - x[0];
  const Vec8x3 r42 = x[3] - x[1];
  const Vec8x3 r21 = x[1] - x[0];
  const Vec8x3 n = cross(r31, r42);
  const Vec8 n2 = dot(n, n);
  const Vec8 inverse_2A = rsqrt(n2);
  g.area = Vec8(0.5) * n2 * inverse_2A;
  g.e3 = scaled(n, inverse_2A);
  const Vec8x3 side = r21 - scaled(g.e3, dot(r21, g.e3));
  g.e1 = scaled(side, rsqrt(dot(side, side)));
  g.e2 = cross(g.e3, g.e1);
  const Vec8 x31 = dot(r31, g.e1);
  const Vec8 y31 = dot(r31, g.e2);
  const Vec8 x42 = dot(r42, g.e1);
  const Vec8 y42 = dot(r42, g.e2);
  g.B11 = -y42 * inverse_2A;
  g.B12 = y31 * inverse_2A;
  g.B21 = x42 * inverse_2A;
  g.B22 = -x31 * inverse_2A;
  const Vec8x3 h = r31 - r21 - (r42 + r21);
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
  Vec8 x[4], y[4];
};

GANNET_INLINE ShellFibres load_fibres(const double* state) {
  ShellFibres t;
  for (int a = 0; a < 4; ++a) {
    t.x[a] = Vec8::load(state + 16 * a);
    t.y[a] = Vec8::load(state + 16 * a + 8);
  }
  return t;
}

GANNET_INLINE Vec8x3 in_plane(const ShellGeometry& g, Vec8 x, Vec8 y) {
  return scaled(g.e1, x) + scaled(g.e2, y);
}

/// Takes what nodes spin about their fibres out of the angular velocities w [rad/s], and carries
/// the fibres in `state` from n-1 to n. What is taken out belongs to the fibres halfway, half a
/// step on from those of n-1, as everything else does. v: [m/s]; dt: [s].
GANNET_INLINE void follow_fibres(const ShellGeometry& g, const Vec8x3 v[4], Vec8x3 w[4],
                                 double* state, Vec8 dt) {
  const Vec8x3 v13 = v[0] - v[2];
  const Vec8x3 v24 = v[1] - v[3];
  const Vec8x3 L1 = scaled(v13, g.B11) + scaled(v24, g.B12);
  const Vec8x3 L2 = scaled(v13, g.B21) + scaled(v24, g.B22);
  const Vec8 spin = Vec8(0.5) * (dot(L1, g.e2) - dot(L2, g.e1));
  const Vec8 half_dt = Vec8(0.5) * dt;
  const ShellFibres t = load_fibres(state);
  for (int a = 0; a < 4; ++a) {
    const Vec8 s = spin - dot(w[a], g.e3);
    const Vec8 x_rate = dot(w[a], g.e2) + dot(L1, g.e3);
    const Vec8 y_rate = dot(L2, g.e3) - dot(w[a], g.e1);
    const Vec8 x = t.x[a] + half_dt * (x_rate + t.y[a] * s);
    const Vec8 y = t.y[a] + half_dt * (y_rate - t.x[a] * s);
    w[a] = w[a] + in_plane(g, x * s, y * s);
    (t.x[a] + dt * (x_rate + y * s)).store(state + 16 * a);
    (t.y[a] + dt * (y_rate - x * s)).store(state + 16 * a + 8);
  }
}

/// The transpose of taking the spin out: turns moments [N m] on what is left of the angular
/// velocities into moments and forces [N] on the nodes.
GANNET_INLINE void give_back_spin(const ShellGeometry& g, const ShellFibres& t, Vec8x3 f[4],
                                  Vec8x3 m[4]) {
  Vec8 sum(0.0);
  for (int a = 0; a < 4; ++a) {
    const Vec8 s = dot(m[a], in_plane(g, t.x[a], t.y[a]));
    m[a] = m[a] - scaled(g.e3, s);
    sum += s;
  }
  const Vec8 half = Vec8(0.5) * sum;
  const Vec8x3 f1 = in_plane(g, -half * g.B21, half * g.B11);
  const Vec8x3 f2 = in_plane(g, -half * g.B22, half * g.B12);
  f[0] = f[0] + f1;
  f[1] = f[1] + f2;
  f[2] = f[2] - f1;
  f[3] = f[3] - f2;
}

/// Increments over a step, in the frame of the element.
struct ShellIncrements {
  Vec8 xx, yy, xy, xz, yz;  ///< strain of the middle surface, shear as engineering shear [-]
  Vec8 kxx, kyy, kxy;       ///< curvature, kxy as 2 k_xy [1/m]
  Vec8 q[5];                ///< hourglass: displacement x, y, z [m], rotation x, y [rad]
};

/// Increments from the velocities [m/s] and angular velocities [rad/s] of the corners over dt [s].
GANNET_INLINE ShellIncrements shell_increments(const ShellGeometry& g, const Vec8x3 v[4],
                                               const Vec8x3 w[4], Vec8 dt) {
  const Vec8x3 v13 = v[0] - v[2];
  const Vec8x3 v24 = v[1] - v[3];
  const Vec8x3 vh = (v[0] + v[2]) - (v[1] + v[3]);
  const Vec8x3 w13 = w[0] - w[2];
  const Vec8x3 w24 = w[1] - w[3];
  const Vec8x3 wh = (w[0] + w[2]) - (w[1] + w[3]);
  const Vec8x3 ws = (w[0] + w[2]) + (w[1] + w[3]);
  const Vec8 B11 = g.B11 * dt;
  const Vec8 B12 = g.B12 * dt;
  const Vec8 B21 = g.B21 * dt;
  const Vec8 B22 = g.B22 * dt;
  const auto d1 = [&](const Vec8x3& e, const Vec8x3& a, const Vec8x3& b) {
    return B11 * dot(a, e) + B12 * dot(b, e);
  };
  const auto d2 = [&](const Vec8x3& e, const Vec8x3& a, const Vec8x3& b) {
    return B21 * dot(a, e) + B22 * dot(b, e);
  };
  const Vec8 Lxx = d1(g.e1, v13, v24);
  const Vec8 Lxy = d2(g.e1, v13, v24);
  const Vec8 Lyx = d1(g.e2, v13, v24);
  const Vec8 Lyy = d2(g.e2, v13, v24);
  const Vec8 Lzx = d1(g.e3, v13, v24);
  const Vec8 Lzy = d2(g.e3, v13, v24);
  const Vec8 Pxx = d1(g.e1, w13, w24);
  const Vec8 Pxy = d2(g.e1, w13, w24);
  const Vec8 Pyx = d1(g.e2, w13, w24);
  const Vec8 Pyy = d2(g.e2, w13, w24);
  const Vec8 quarter = Vec8(0.25) * dt;
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
           Vec8(0.25) * (g.X * d.kxx + g.Y * d.kxy + g.Z * d.kyy);
  d.q[3] = dt * dot(wh, g.e1) - g.hx * Pxx - g.hy * Pxy;
  d.q[4] = dt * dot(wh, g.e2) - g.hx * Pyx - g.hy * Pyy;
  return d;
}

/// Stress resultants: forces per length [N/m], moments per length [N], hourglass forces.
struct ShellResultants {
  Vec8 nxx, nyy, nxy, nxz, nyz;
  Vec8 mxx, myy, mxy;
  Vec8 Q[5];
};

/// Stress from n-1 to n at every point through the thickness; fills the resultants of the section
/// and adds the work per area: w = sum (sigma(n-1) + sigma(n))/2 . d eps.
/// state: first value of the block. t: thickness [m]. work, plastic_work: [J/m^2].
/// Returns the mean strain increment through the thickness.
template <bool plastic>
GANNET_INLINE Vec8 shell_stress(const ShellConstants& c, const ShellLayout& layout, double* state,
                                const ShellIncrements& d, Vec8 t, ShellResultants& r, Vec8& work,
                                Vec8& plastic_work) {
  const Vec8 zero(0.0);
  r.nxx = r.nyy = r.nxy = r.mxx = r.myy = r.mxy = zero;
  Vec8 twice_work = zero;
  Vec8 dissipated = zero;
  Vec8 growth = zero;
  const Vec8 half_t = Vec8(0.5) * t;
  constexpr int per_point = plastic ? 4 : 3;
  double* p = state;
  for (int k = 0; k < layout.n_points; ++k, p += per_point * 8) {
    const Vec8 z = Vec8(c.point[k]) * half_t;
    const Vec8 exx = d.xx + z * d.kxx;
    const Vec8 eyy = d.yy + z * d.kyy;
    const Vec8 gxy = d.xy + z * d.kxy;
    const PlaneStress<Vec8> old{Vec8::load(p), Vec8::load(p + 8), Vec8::load(p + 16)};
    PlaneStress<Vec8> sigma = old;
    add_elastic(c.law, exx, eyy, gxy, sigma);
    const Vec8 W = Vec8(c.weight[k]) * t;
    if constexpr (plastic) {
      const Vec8 eps_p = Vec8::load(p + 24);
      const Vec8 yield = Vec8(c.law.yield) + Vec8(c.law.hardening) * eps_p;
      if (any(less(yield * yield, von_mises_squared(sigma)))) {
        const Vec8 flow = return_to_yield(c.law, yield, sigma);
        dissipated += W * flow * (yield + Vec8(0.5 * c.law.hardening) * flow);
        (eps_p + flow).store(p + 24);
      }
    }
    sigma.xx.store(p);
    sigma.yy.store(p + 8);
    sigma.xy.store(p + 16);
    twice_work +=
        W * ((old.xx + sigma.xx) * exx + (old.yy + sigma.yy) * eyy + (old.xy + sigma.xy) * gxy);
    if (c.thickness_changes) {
      growth += Vec8(c.weight[k]) *
                through_thickness_strain(c.law, exx, eyy, sigma.xx - old.xx, sigma.yy - old.yy);
    }
    const Vec8 Wz = W * z;
    r.nxx += W * sigma.xx;
    r.nyy += W * sigma.yy;
    r.nxy += W * sigma.xy;
    r.mxx += Wz * sigma.xx;
    r.myy += Wz * sigma.yy;
    r.mxy += Wz * sigma.xy;
  }
  work = Vec8(0.5) * twice_work;
  plastic_work = dissipated;
  return growth;
}

/// Elastic transverse shear, the same at all heights: the resultant is kappa G t gamma. Adds its
/// work per area [J/m^2].
GANNET_INLINE void shell_shear(const ShellConstants& c, double* q, const ShellIncrements& d, Vec8 t,
                               ShellResultants& r, Vec8& work) {
  const Vec8 xz = Vec8::load(q);
  const Vec8 yz = Vec8::load(q + 8);
  const Vec8 new_xz = xz + Vec8(c.law.shear) * d.xz;
  const Vec8 new_yz = yz + Vec8(c.law.shear) * d.yz;
  new_xz.store(q);
  new_yz.store(q + 8);
  const Vec8 W = Vec8(c.shear_factor) * t;
  r.nxz = W * new_xz;
  r.nyz = W * new_yz;
  work += Vec8(0.5) * W * ((xz + new_xz) * d.xz + (yz + new_yz) * d.yz);
}

/// Stiffness of the hourglass modes of eight elements.
struct HourglassStiffness {
  Vec8 membrane;  ///< [N/m]
  Vec8 warp;      ///< [N/m]
  Vec8 bending;   ///< [N m]
};

/// Resists the hourglass modes. Stiffness form: Q(n) = Q(n-1) + K q; viscous form:
/// Q(n) = K (sqrt(A)/c) q/dt, the force that the stiffness form would build up while a wave crosses
/// the element. With BB the sum of all squared gradients and r the coefficient,
///   K_membrane = r E t A BB / 8,  K_bending = r E t^3 A BB / 192,  K_warp = r kappa G t^3 BB / 12
/// (on a square of side a: BB = 2/a^2, so K_membrane = r E t/4, a fraction of the membrane's own
/// stiffness; the factors are those customary for this element, with r from 0.01 to 0.05).
/// Returns the work [J] and leaves the stiffness for the stable step.
GANNET_INLINE Vec8 shell_hourglass(const ShellConstants& c, const ShellGeometry& g, double* state,
                                   const ShellIncrements& d, Vec8 t, double dt, ShellResultants& r,
                                   HourglassStiffness& K) {
  const Vec8 BB = Vec8(2.0) * (g.B11 * g.B11 + g.B12 * g.B12 + g.B21 * g.B21 + g.B22 * g.B22);
  const Vec8 tA = t * g.area * BB;
  const Vec8 ttt = t * t * t * BB;
  K.membrane = Vec8(c.hourglass_membrane) * tA;
  K.warp = Vec8(c.hourglass_warp) * ttt;
  K.bending = Vec8(c.hourglass_bending) * ttt * g.area;
  const Vec8 stiffness[5] = {K.membrane, K.membrane, K.warp, K.bending, K.bending};
  // Viscous: sqrt(A) = A rsqrt(A). The first step has dt = 0 and nothing to resist.
  const Vec8 per_step =
      c.viscous_hourglass ? g.area * rsqrt(g.area) * Vec8(dt > 0 ? c.inverse_wave_speed / dt : 0.0)
                          : Vec8(1.0);
  Vec8 twice_work(0.0);
  for (int k = 0; k < 5; ++k) {
    const Vec8 old = Vec8::load(state + 8 * k);
    const Vec8 change = stiffness[k] * per_step * d.q[k];
    r.Q[k] = c.viscous_hourglass ? change : old + change;
    r.Q[k].store(state + 8 * k);
    twice_work += (old + r.Q[k]) * d.q[k];
  }
  return Vec8(0.5) * twice_work;
}

/// Internal forces [N] and moments [N m] on the corners, negative as they are added to f:
/// the transpose of shell_increments(), at the geometry of n.
GANNET_INLINE void shell_corner_forces(const ShellGeometry& g, const ShellResultants& r,
                                       Vec8x3 f[4], Vec8x3 m[4]) {
  const Vec8 A = -g.area;
  const Vec8 Q1 = -r.Q[0];
  const Vec8 Q2 = -r.Q[1];
  const Vec8 Q3 = -r.Q[2];
  const Vec8 Q4 = -r.Q[3];
  const Vec8 Q5 = -r.Q[4];
  // What multiplies each gradient: Lxx = B1.v_x gets nxx A - hx Q1, and so on.
  const Vec8 Sxx = A * r.nxx - g.hx * Q1;
  const Vec8 Sxy = A * r.nxy - g.hy * Q1;
  const Vec8 Syx = A * r.nxy - g.hx * Q2;
  const Vec8 Syy = A * r.nyy - g.hy * Q2;
  const Vec8 Szx = A * r.nxz - g.hx * Q3 + g.hz * Q1;
  const Vec8 Szy = A * r.nyz - g.hy * Q3 + g.hz * Q2;
  const Vec8 quarter_Q3 = Vec8(0.25) * Q3;
  const Vec8 Mxx = A * r.mxx + quarter_Q3 * g.X;
  const Vec8 Mxy = A * r.mxy + quarter_Q3 * g.Y;
  const Vec8 Myy = A * r.myy + quarter_Q3 * g.Z;
  const Vec8 Tyx = Mxx - g.hx * Q5;   // B1.omega_y: k_xx
  const Vec8 Tyy = Mxy - g.hy * Q5;   // B2.omega_y: 2 k_xy
  const Vec8 Txx = -Mxy - g.hx * Q4;  // B1.omega_x: 2 k_xy
  const Vec8 Txy = -Myy - g.hy * Q4;  // B2.omega_x: k_yy
  const auto global3 = [&](Vec8 x, Vec8 y, Vec8 z) {
    return scaled(g.e1, x) + scaled(g.e2, y) + scaled(g.e3, z);
  };
  const auto global2 = [&](Vec8 x, Vec8 y) { return scaled(g.e1, x) + scaled(g.e2, y); };
  const Vec8x3 P1 =
      global3(g.B11 * Sxx + g.B21 * Sxy, g.B11 * Syx + g.B21 * Syy, g.B11 * Szx + g.B21 * Szy);
  const Vec8x3 P2 =
      global3(g.B12 * Sxx + g.B22 * Sxy, g.B12 * Syx + g.B22 * Syy, g.B12 * Szx + g.B22 * Szy);
  const Vec8x3 H = global3(Q1, Q2, Q3);
  f[0] = H + P1;
  f[1] = P2 - H;
  f[2] = H - P1;
  f[3] = Vec8x3{-P2.x, -P2.y, -P2.z} - H;
  const Vec8 quarter = Vec8(0.25) * A;
  const Vec8x3 M1 = global2(g.B11 * Txx + g.B21 * Txy, g.B11 * Tyx + g.B21 * Tyy);
  const Vec8x3 M2 = global2(g.B12 * Txx + g.B22 * Txy, g.B12 * Tyx + g.B22 * Tyy);
  const Vec8x3 MH = global2(Q4, Q5);
  const Vec8x3 MS = global2(-quarter * r.nyz, quarter * r.nxz);
  const Vec8x3 even = MS + MH;
  const Vec8x3 odd = MS - MH;
  m[0] = even + M1;
  m[1] = odd + M2;
  m[2] = even - M1;
  m[3] = odd - M2;
}

/// The larger eigenvalue of the form |d + offset k|^2 + ratio alpha |k|^2 in d and k alpha^(1/2):
/// what stretching and bending at once come to where the middle of the shell is off its nodes, over
/// stretching alone. ratio: t^2/(12 alpha).
GANNET_INLINE Vec8 share_of_offset(double offset, Vec8 ratio, Vec8 inverse_alpha) {
  const Vec8 square = Vec8(offset * offset) * inverse_alpha;
  const Vec8 half_gap = Vec8(0.5) * (Vec8(1.0) - square - ratio);
  return Vec8(0.5) * (Vec8(1.0) + square + ratio) + sqrt(half_gap * half_gap + square);
}

/// The bound where the element bends and shears through fibres (all terms times the mass of a
/// corner). With w = (1 + p^2)^(1/2), p the largest slope, turning of the nodes counts at most w
/// times as much; the spin of the element in its plane adds to the odd patterns of turning, which
/// bend, and to the even ones, which shear,
///   x_b^2 = alpha (sum |t|^2) tr(G)/4,  x_s^2 = |mean t|^2 tr(G)/4
/// (v and omega scaled by the roots of mass and inertia), so that the larger eigenvalue counts of
///   [membrane + bending x_b^2 + kappa G t A x_s^2, c; c, max(bending, shear) w^2],
///   c = (bending x_b + (shear kappa G t A)^(1/2) x_s) w.
GANNET_INLINE Vec8 bound_with_fibres(const ShellFibres& t, Vec8 membrane, Vec8 bending, Vec8 shear,
                                     Vec8 GtA, Vec8 trace, Vec8 inverse_alpha) {
  Vec8 squares(0.0);
  Vec8 most(0.0);
  Vec8 sum_x(0.0);
  Vec8 sum_y(0.0);
  for (int a = 0; a < 4; ++a) {
    const Vec8 slope = t.x[a] * t.x[a] + t.y[a] * t.y[a];
    squares += slope;
    most = max(most, slope);
    sum_x += t.x[a];
    sum_y += t.y[a];
  }
  const Vec8 x_b2 = Vec8(0.25) * squares * trace / inverse_alpha;
  const Vec8 x_s2 = Vec8(1.0 / 64.0) * (sum_x * sum_x + sum_y * sum_y) * trace;
  const Vec8 w2 = Vec8(1.0) + most;
  const Vec8 a = membrane + bending * x_b2 + GtA * x_s2;
  const Vec8 b = max(bending, shear) * w2;
  const Vec8 c = bending * sqrt(x_b2) + sqrt(shear * GtA * x_s2);
  const Vec8 half_gap = Vec8(0.5) * (a - b);
  return Vec8(0.5) * (a + b) + sqrt(half_gap * half_gap + c * c * w2);
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
GANNET_INLINE Vec8 shell_omega2(const ShellConstants& c, const ShellGeometry& g, Vec8 t,
                                Vec8 inverse_A0, const HourglassStiffness& K,
                                const double* fibres) {
  const Vec8 two(2.0);
  const Vec8 g11 = two * (g.B11 * g.B11 + g.B12 * g.B12);
  const Vec8 g22 = two * (g.B21 * g.B21 + g.B22 * g.B22);
  const Vec8 g12 = two * (g.B11 * g.B21 + g.B12 * g.B22);
  const Vec8 half_sum = Vec8(0.5) * (g11 + g22);
  const Vec8 half_gap = Vec8(0.5) * (g11 - g22);
  const Vec8 lambda = half_sum + sqrt(half_gap * half_gap + g12 * g12);
  const Vec8 inverse_m = Vec8(1.0 / c.nodal_mass_factor) * inverse_A0;
  const Vec8 inverse_alpha = min(Vec8(1.0 / c.smallest_alpha), Vec8(8.0) * inverse_A0);
  const Vec8 tA = t * g.area;
  const Vec8 thickness_ratio = t * t * inverse_alpha * Vec8(1.0 / 12.0);
  const Vec8 gamma2 = Vec8(4.0) + g.hx * g.hx * g11 + two * g.hx * g.hy * g12 + g.hy * g.hy * g22;
  const Vec8 bend2 = g.X * g.X + two * g.Y * g.Y + g.Z * g.Z;
  const Vec8 hourglass = gamma2 * (K.membrane + K.warp + K.bending * inverse_alpha) +
                         g.hz * g.hz * lambda * K.membrane +
                         Vec8(1.0 / 16.0) * K.warp * bend2 * lambda * inverse_alpha;
  Vec8 membrane = tA * Vec8(c.membrane_modulus) * lambda;
  Vec8 bending = membrane * thickness_ratio;
  if (c.offset != 0) {
    membrane = bending = membrane * share_of_offset(c.offset, thickness_ratio, inverse_alpha);
  }
  const Vec8 GtA = Vec8(c.shear_factor * c.law.shear) * tA;
  const Vec8 shear = GtA * (lambda + Vec8(0.25) * inverse_alpha);
  const Vec8 all = fibres == nullptr ? max(max(membrane, bending), shear)
                                     : bound_with_fibres(load_fibres(fibres), membrane, bending,
                                                         shear, GtA, g11 + g22, inverse_alpha);
  return inverse_m * (all + hourglass);
}

}  // namespace gannet::GANNET_ISA_NS
