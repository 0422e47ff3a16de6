// Shells with assumed transverse shear, eight at a time: the quadrilateral with 2 x 2 points in the
// plane (MITC4; Bathe & Dvorkin 1985, Int. J. Numer. Methods Eng. 21, 367-383) and the triangle
// (MITC3; Lee & Bathe 2004, Comput. Struct. 82, 945-962). No pattern of either is without stiffness
// but the spin of a node about its fibre.
//
// Frame: e3 is normal to both diagonals (the triangle), e1 and e2 lie so that the map from a square
// to the element has no rotation: g_xi.e2 = g_eta.e1 with g_xi, g_eta its sides' directions. x, y,
// z are places in it from the middle of the corners. With the gradients B1, B2 of the middle, spin
// of the element and motion without it,
//   (B2.v_z, -B1.v_z, s),  s = (B1.v_y - B2.v_x)/2
//   u_a = v_a - spin x x_a,  psi_a = (omega_a - spin) x p_a,  p_a = e3 + t_a,
// psi the velocity of the tip of a fibre in the plane (t_a as in shell_element.hpp: a node may spin
// about its fibre). Everything below is written in u and psi, so that a rigid rotation strains
// nothing whatever the shape; the forces take the same way back, and force and moment balance.
//   membrane  d_ab = sym(u_a,b),  curvature k_ab = sym(psi_a,b), strain at height z: d + z k
//   shear along the side from i to j: g_ij = r_ij.(psi_i + psi_j)/2 + (u_j - u_i).(p_i + p_j)/2
//
// Quadrilateral: with h = xi eta and gamma = (h - (h.x) B1 - (h.y) B2)/4, a field at a point is
// that of the middle and gamma.field times grad h. The membrane takes
//   d_xx += h,x q_x - nu h,y q_y,  d_yy += h,y q_y - nu h,x q_x,  d_xy of the middle, q = gamma.u:
// bending in the plane without parasitic shear (Belytschko & Bindeman 1991, Comput. Methods Appl.
// Mech. Eng. 88, 311-340: "ASQBI"); u without the rotation of warped elements cannot lock as the
// covariant strains of a paraboloid do. Curvature takes all of it. Shear: covariant components from
// opposite sides,
//   g_xi = ((1 - eta) g_12 + (1 + eta) g_43)/4,  g_eta = ((1 - xi) g_14 + (1 + xi) g_23)/4.
// Triangle: membrane and curvature are constant. Shear is the field whose components along the
// three sides are g/length there (sum of g_ij (N_i grad N_j - N_j grad N_i)), which is a mean,
//   sum g_ij (grad N_j - grad N_i)/3,
// and a turning of curl (g_12 + g_23 + g_31)/A about the centre.
//
// For *.isa.cpp files only.
#pragma once

#include "fe/shell_element.hpp"

namespace gannet::GANNET_ISA_NS {

/// Frame of the elements of a vector, with N corners, and the corners in it.
template <int N>
struct FlatGeometry {
  VecX3 e1, e2, e3;
  Vec area;
  Vec x[N], y[N], z[N];  ///< [m]
  Vec B1[N], B2[N];      ///< gradients at the middle [1/m]
  Vec g11, g22, g12;     ///< sums of B1 B1, B2 B2, B1 B2
};

/// The frame with e3 along n from directions of the sides; returns 1/|n|.
template <int N>
GANNET_INLINE Vec flat_frame(const VecX3& n, const VecX3& g_xi, const VecX3& g_eta,
                             FlatGeometry<N>& g) {
  const Vec n2 = dot(n, n);
  const Vec inverse = rsqrt(n2);
  g.area = Vec(0.5) * n2 * inverse;
  g.e3 = scaled(n, inverse);
  const VecX3 along = g_xi - scaled(g.e3, dot(g_xi, g.e3)) + cross(g_eta, g.e3);
  g.e1 = scaled(along, rsqrt(dot(along, along)));
  g.e2 = cross(g.e3, g.e1);
  return inverse;
}

template <int N>
GANNET_INLINE void place_corners(const VecX3 x[N], FlatGeometry<N>& g) {
  VecX3 middle = x[0];
  for (int a = 1; a < N; ++a) middle = middle + x[a];
  middle = scaled(middle, Vec(1.0 / N));
  for (int a = 0; a < N; ++a) {
    const VecX3 r = x[a] - middle;
    g.x[a] = dot(r, g.e1);
    g.y[a] = dot(r, g.e2);
    g.z[a] = dot(r, g.e3);
  }
}

template <int N>
GANNET_INLINE void add_gram(FlatGeometry<N>& g) {
  g.g11 = g.g22 = g.g12 = Vec(0.0);
  for (int a = 0; a < N; ++a) {
    g.g11 += g.B1[a] * g.B1[a];
    g.g22 += g.B2[a] * g.B2[a];
    g.g12 += g.B1[a] * g.B2[a];
  }
}

/// Larger eigenvalue of [a, c; c, b].
GANNET_INLINE Vec larger_eigenvalue(Vec a, Vec b, Vec c) {
  const Vec half_gap = Vec(0.5) * (a - b);
  return Vec(0.5) * (a + b) + sqrt(half_gap * half_gap + c * c);
}

/// Displacements of the corners and tips of fibres without the rotation of the element, over a
/// step; also what belongs to them in power: forces and couples.
template <int N>
struct Relative {
  Vec ux[N], uy[N], uz[N];  ///< [m], [N]
  Vec px[N], py[N];         ///< psi [-], [N m]
};

/// Components of t of the corners [-].
template <int N>
struct Leaning {
  Vec x[N], y[N];
};

template <int N>
GANNET_INLINE Leaning<N> load_leaning(const double* state) {
  Leaning<N> t;
  for (int a = 0; a < N; ++a) {
    t.x[a] = Vec::load(state + 16 * a);
    t.y[a] = Vec::load(state + 16 * a + 8);
  }
  return t;
}

/// u dt and psi dt from the velocities [m/s] and angular velocities [rad/s] of the corners.
template <int N>
GANNET_INLINE Relative<N> relative_motion(const FlatGeometry<N>& g, const Leaning<N>& t,
                                          const VecX3 v[N], const VecX3 w[N], Vec dt) {
  VecX3 L1 = scaled(v[0], g.B1[0]);
  VecX3 L2 = scaled(v[0], g.B2[0]);
  for (int a = 1; a < N; ++a) {
    L1 = L1 + scaled(v[a], g.B1[a]);
    L2 = L2 + scaled(v[a], g.B2[a]);
  }
  const Vec s = Vec(0.5) * dt * (dot(L1, g.e2) - dot(L2, g.e1));
  const Vec L1z = dt * dot(L1, g.e3);
  const Vec L2z = dt * dot(L2, g.e3);
  Relative<N> r;
  for (int a = 0; a < N; ++a) {
    const VecX3 d = scaled(v[a] - v[0], dt);
    r.ux[a] = dot(d, g.e1) + L1z * g.z[a] + s * g.y[a];
    r.uy[a] = dot(d, g.e2) + L2z * g.z[a] - s * g.x[a];
    r.uz[a] = dot(d, g.e3) - L1z * g.x[a] - L2z * g.y[a];
    const VecX3 turn = scaled(w[a], dt);
    const Vec left = s - dot(turn, g.e3);
    r.px[a] = dot(turn, g.e2) + t.y[a] * left + L1z;
    r.py[a] = L2z - dot(turn, g.e1) - t.x[a] * left;
  }
  return r;
}

/// The transpose of relative_motion(): forces [N] and moments [N m] on the nodes from what belongs
/// to u and psi.
template <int N>
GANNET_INLINE void nodal_forces(const FlatGeometry<N>& g, const Leaning<N>& t, const Relative<N>& r,
                                VecX3 f[N], VecX3 m[N]) {
  Vec X1(0.0);
  Vec X2(0.0);
  Vec X3(0.0);
  for (int a = 0; a < N; ++a) {
    const Vec S = r.px[a] * t.y[a] - r.py[a] * t.x[a];
    X1 += r.px[a] + r.ux[a] * g.z[a] - r.uz[a] * g.x[a];
    X2 += r.py[a] + r.uy[a] * g.z[a] - r.uz[a] * g.y[a];
    X3 += r.ux[a] * g.y[a] - r.uy[a] * g.x[a] + S;
    m[a] = scaled(g.e2, r.px[a]) - scaled(g.e1, r.py[a]) - scaled(g.e3, S);
  }
  X3 = Vec(0.5) * X3;
  for (int a = 0; a < N; ++a) {
    f[a] = scaled(g.e1, r.ux[a] - g.B2[a] * X3) + scaled(g.e2, r.uy[a] + g.B1[a] * X3) +
           scaled(g.e3, r.uz[a] + g.B1[a] * X1 + g.B2[a] * X2);
  }
}

/// g_ij of the top [m].
template <int N>
GANNET_INLINE Vec side_shear(const FlatGeometry<N>& g, const Leaning<N>& t, const Relative<N>& r,
                             int i, int j) {
  return Vec(0.5) *
             ((g.x[j] - g.x[i]) * (r.px[i] + r.px[j]) + (g.y[j] - g.y[i]) * (r.py[i] + r.py[j]) +
              (r.ux[j] - r.ux[i]) * (t.x[i] + t.x[j]) + (r.uy[j] - r.uy[i]) * (t.y[i] + t.y[j])) +
         r.uz[j] - r.uz[i];
}

/// The transpose: adds what the force G [N] that belongs to g_ij does to u and psi.
template <int N>
GANNET_INLINE void add_side_shear(const FlatGeometry<N>& g, const Leaning<N>& t, int i, int j,
                                  Vec G, Relative<N>& r) {
  const Vec half = Vec(0.5) * G;
  const Vec cx = half * (g.x[j] - g.x[i]);
  const Vec cy = half * (g.y[j] - g.y[i]);
  const Vec fx = half * (t.x[i] + t.x[j]);
  const Vec fy = half * (t.y[i] + t.y[j]);
  r.px[i] += cx;
  r.py[i] += cy;
  r.px[j] += cx;
  r.py[j] += cy;
  r.ux[j] += fx;
  r.ux[i] -= fx;
  r.uy[j] += fy;
  r.uy[i] -= fy;
  r.uz[j] += G;
  r.uz[i] -= G;
}

/// Sums over the in-plane points: what belongs to the fields of the middle.
struct MiddleForces {
  Vec nxx = Vec(0.0), nyy = Vec(0.0), nxy = Vec(0.0);  ///< [N m]
  Vec mxx = Vec(0.0), myy = Vec(0.0), mxy = Vec(0.0);  ///< [N m^2]
  GANNET_INLINE void add(const ShellResultants& r, Vec area) {
    nxx += area * r.nxx;
    nyy += area * r.nyy;
    nxy += area * r.nxy;
    mxx += area * r.mxx;
    myy += area * r.myy;
    mxy += area * r.mxy;
  }
};

/// Adds the forces of the fields of the middle to those of u and psi.
template <int N>
GANNET_INLINE void add_middle(const FlatGeometry<N>& g, const MiddleForces& s, Relative<N>& r) {
  for (int a = 0; a < N; ++a) {
    r.ux[a] += g.B1[a] * s.nxx + g.B2[a] * s.nxy;
    r.uy[a] += g.B1[a] * s.nxy + g.B2[a] * s.nyy;
    r.px[a] += g.B1[a] * s.mxx + g.B2[a] * s.mxy;
    r.py[a] += g.B1[a] * s.mxy + g.B2[a] * s.myy;
  }
}

/// Sum of b_a value_a.
template <int N>
GANNET_INLINE Vec weighted(const Vec b[N], const Vec value[N]) {
  Vec sum = b[0] * value[0];
  for (int a = 1; a < N; ++a) sum += b[a] * value[a];
  return sum;
}

/// Strain and curvature of the middle.
template <int N>
GANNET_INLINE ShellIncrements middle_increments(const FlatGeometry<N>& g, const Relative<N>& r) {
  ShellIncrements d;
  d.xx = weighted<N>(g.B1, r.ux);
  d.yy = weighted<N>(g.B2, r.uy);
  d.xy = weighted<N>(g.B2, r.ux) + weighted<N>(g.B1, r.uy);
  d.kxx = weighted<N>(g.B1, r.px);
  d.kyy = weighted<N>(g.B2, r.py);
  d.kxy = weighted<N>(g.B2, r.px) + weighted<N>(g.B1, r.py);
  return d;
}

/// Larger eigenvalue of the Gram matrix of the gradients [1/m^2].
template <int N>
GANNET_INLINE Vec largest_gradient(const FlatGeometry<N>& g) {
  return larger_eigenvalue(g.g11, g.g22, g.g12);
}

/// What fibres that lean make of the bounds of the membrane and of bending with shear (times the
/// mass of a corner): p the largest slope; turning counts (1 + p^2) times as much, and bending and
/// shear see motion in the plane with the share p.
template <int N>
GANNET_INLINE Vec bound_of_leaning(const Leaning<N>& t, Vec membrane, Vec bending) {
  Vec p2(0.0);
  for (int a = 0; a < N; ++a) p2 = max(p2, t.x[a] * t.x[a] + t.y[a] * t.y[a]);
  const Vec w2 = Vec(1.0) + p2;
  return larger_eigenvalue(membrane + bending * p2, bending * w2, bending * sqrt(p2 * w2));
}

/// Fibres halfway through the step, from those of n-1 and the motion that those see.
template <int N>
GANNET_INLINE Leaning<N> leaning_halfway(const Leaning<N>& t, const Relative<N>& r) {
  Leaning<N> middle;
  for (int a = 0; a < N; ++a) {
    middle.x[a] = t.x[a] + Vec(0.5) * r.px[a];
    middle.y[a] = t.y[a] + Vec(0.5) * r.py[a];
  }
  return middle;
}

/// Carries the fibres in `state` from n-1 to n.
template <int N>
GANNET_INLINE void follow_leaning(const Leaning<N>& old, const Relative<N>& r, double* state) {
  for (int a = 0; a < N; ++a) {
    (old.x[a] + r.px[a]).store(state + 16 * a);
    (old.y[a] + r.py[a]).store(state + 16 * a + 8);
  }
}

}  // namespace gannet::GANNET_ISA_NS
