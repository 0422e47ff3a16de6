// The eight-node solid with one point of integration, eight elements at a time (Flanagan &
// Belytschko 1981, Int. J. Numer. Methods Eng. 17, 679-706), written in the modes of the trilinear
// map.
//
// A field f over the element is, but for its mean, a combination of the seven patterns xi, eta,
// zeta, eta zeta, zeta xi, xi eta, xi eta zeta of the corners (each +-1), with the coefficients
//   a1, a2, a3 (linear), g1, g2, g3, g4 (hourglass):  f_mode = 1/8 sum_I pattern_I f_I.
// With a_k and g_k the coefficients of the positions, the volume is exactly
//   V = 8 ([a1 a2 a3] + ([a1 g3 g2] + [g3 a2 g1] + [g2 g1 a3])/3),   [a b c] = a . (b x c)
// and its derivative by each coefficient, D_mode, is a sum of cross products (D of g4 is 0). The
// mean of a gradient over the element, exact for any shape, and the forces that are its transpose:
//   L = 1/V sum_mode v_mode D_mode^T,   F_mode = -sigma D_mode,   f_I = 1/8 sum_mode pattern_I
//   F_mode
//
// Hourglass patterns are what a linear field leaves of g1 ... g4:
//   q_k = v_gk - L g_k,   Q_k(n) = R Q_k(n-1) + k_h q_k dt,   k_h = 8 kappa (lambda + 2 mu) tr G/V
// with the Gram matrix G = 1/8 sum_mode D_mode D_mode^T (equal to sum_I B_I B_I^T): kappa is the
// stiffness over the largest that the element has, Flanagan & Belytschko's coefficient. A field
// that is linear in space, a rotation above all, is not resisted, in any shape.
//
// Stress and Q turn with the element by Hughes and Winget's rotation of the midpoint spin, which is
// exact for a rotation about an axis that keeps its direction (1980, Int. J. Numer. Methods Eng.
// 15, 1862-1867).
//
// The accurate element has eight points at +-1/sqrt(3), each with its own gradient, stress and
// rotation, but for the dilatation, which is the mean over the element (Nagtegaal, Parks & Rice
// 1974, Comput. Methods Appl. Mech. Eng. 4, 153-177; Hughes 1980): it has no hourglass patterns and
// does not lock where the material is nearly incompressible or flows. With c_k = d x_l x d x_m the
// cofactors of the Jacobian at a point, J its determinant,
//   L = 1/J sum_k (d v/d xi_k) c_k^T,   e = sym L + (tr L_mean - tr L)/3 I,
//   F of d x/d xi_k = -sum_points dev(sigma) c_k,   F_mode -= p_mean D_mode.
//
// A quadrilateral in plane strain is the solid one unit thick whose two faces move alike: its
// corners 4-7 are its corners 0-3, the patterns that are odd in zeta vanish but for a3 = (0, 0,
// 1/2) of the positions, and bounds of frequencies leave out what only acts across the plane.
//
// A tetrahedron is the image of a brick without hourglass patterns: a_k = s (x_k - x_0) with
// 48 s^3 = 1 gives V = 8 [a1 a2 a3] = [x1-x0 x2-x0 x3-x0]/6. One such element is too stiff where
// the volume hardly changes, so its dilatation is the mean of that of its nodes (Bonet & Burton
// 1998, Commun. Numer. Methods Eng. 14, 437-449): with V_a = sum_e V_e/4 over the elements around
// node a,
//   ln J_e = 1/4 sum_a ln(V_a/V0_a),   e = dev(sym L) + (ln J_e(n) - ln J_e(n-1))/3 I,
// whose adjoint, a pressure that is the mean of those of the nodes, the rate of ln J_e gives by
// itself.
//
// For *.isa.cpp files only.
#pragma once

#include "fe/solid_kernel.hpp"
#include "fe/vec8x3.hpp"

namespace gannet::GANNET_ISA_NS {

/// Coefficients of the seven patterns of a vector field over eight elements.
struct SolidModes {
  Vec8x3 a[3];
  Vec8x3 g[4];
};

/// Coefficients from the values at the corners. Corners as VTK counts them: 0-3 around the face
/// zeta = -1 (counter-clockwise seen from above), 4-7 above them.
GANNET_INLINE SolidModes modes_of(const Vec8x3 f[8]) {
  Vec8x3 p[4];
  Vec8x3 m[4];
  for (int k = 0; k < 4; ++k) {
    p[k] = f[k] + f[k + 4];
    m[k] = f[k + 4] - f[k];
  }
  const Vec8 eighth(0.125);
  const auto pattern_xi = [&](const Vec8x3* s) {
    return scaled((s[1] - s[0]) + (s[2] - s[3]), eighth);
  };
  const auto pattern_eta = [&](const Vec8x3* s) {
    return scaled((s[3] - s[0]) + (s[2] - s[1]), eighth);
  };
  const auto pattern_xi_eta = [&](const Vec8x3* s) {
    return scaled((s[0] - s[1]) + (s[2] - s[3]), eighth);
  };
  SolidModes c;
  c.a[0] = pattern_xi(p);
  c.a[1] = pattern_eta(p);
  c.a[2] = scaled((m[0] + m[1]) + (m[2] + m[3]), eighth);
  c.g[0] = pattern_eta(m);
  c.g[1] = pattern_xi(m);
  c.g[2] = pattern_xi_eta(p);
  c.g[3] = pattern_xi_eta(m);
  return c;
}

/// The same of a field that is alike on both faces, from corners 0-3. across: a3.
GANNET_INLINE SolidModes plane_modes_of(const Vec8x3 f[4], const Vec8x3& across) {
  const Vec8 quarter(0.25);
  const Vec8x3 zero{Vec8(0.0), Vec8(0.0), Vec8(0.0)};
  SolidModes c;
  c.a[0] = scaled((f[1] - f[0]) + (f[2] - f[3]), quarter);
  c.a[1] = scaled((f[3] - f[0]) + (f[2] - f[1]), quarter);
  c.a[2] = across;
  c.g[0] = zero;
  c.g[1] = zero;
  c.g[2] = scaled((f[0] - f[1]) + (f[2] - f[3]), quarter);
  c.g[3] = zero;
  return c;
}

/// s with 48 s^3 = 1.
constexpr double tetrahedron_scale = 0.27516060407455223;

/// The same of a tetrahedron.
GANNET_INLINE SolidModes tetrahedron_modes_of(const Vec8x3 f[4]) {
  const Vec8x3 zero{Vec8(0.0), Vec8(0.0), Vec8(0.0)};
  SolidModes c{{zero, zero, zero}, {zero, zero, zero, zero}};
  for (int k = 0; k < 3; ++k) c.a[k] = scaled(f[k + 1] - f[0], Vec8(tetrahedron_scale));
  return c;
}

/// What forces on the coefficients of a tetrahedron are at its corners.
GANNET_INLINE void tetrahedron_corners_of(const SolidModes& F, Vec8x3 f[4]) {
  for (int k = 0; k < 3; ++k) f[k + 1] = scaled(F.a[k], Vec8(tetrahedron_scale));
  f[0] = -(f[1] + f[2] + f[3]);
}

/// What forces on the coefficients are at corners 0-3 where both faces hang on them.
GANNET_INLINE void plane_corners_of(const SolidModes& F, Vec8x3 f[4]) {
  const Vec8 quarter(0.25);
  const Vec8x3 sum = scaled(F.a[0] + F.a[1], quarter);
  const Vec8x3 gap = scaled(F.a[0] - F.a[1], quarter);
  const Vec8x3 g = scaled(F.g[2], quarter);
  f[0] = g - sum;
  f[1] = gap - g;
  f[2] = g + sum;
  f[3] = -(gap + g);
}

/// The transpose of modes_of(): what forces on the coefficients are at the corners.
GANNET_INLINE void corners_of(const SolidModes& F, Vec8x3 f[8]) {
  const Vec8 eighth(0.125);
  SolidModes s;
  for (int k = 0; k < 3; ++k) s.a[k] = scaled(F.a[k], eighth);
  for (int k = 0; k < 4; ++k) s.g[k] = scaled(F.g[k], eighth);
  // p: even in zeta, m: odd in it; both at the corners (-, -), (+, -), (+, +), (-, +).
  const Vec8x3 sum = s.a[0] + s.a[1];
  const Vec8x3 gap = s.a[0] - s.a[1];
  const Vec8x3 p[4] = {s.g[2] - sum, gap - s.g[2], s.g[2] + sum, -(gap + s.g[2])};
  const Vec8x3 odd_sum = s.g[1] + s.g[0];
  const Vec8x3 odd_gap = s.g[1] - s.g[0];
  const Vec8x3 even = s.a[2] + s.g[3];
  const Vec8x3 odd = s.a[2] - s.g[3];
  const Vec8x3 m[4] = {even - odd_sum, odd + odd_gap, even + odd_sum, odd - odd_gap};
  for (int k = 0; k < 4; ++k) {
    f[k] = p[k] - m[k];
    f[k + 4] = p[k] + m[k];
  }
}

/// Volume of eight elements and its derivatives by the coefficients of the positions.
struct SolidGeometry {
  Vec8 volume;
  Vec8x3 a[3];  ///< dV/da [m^2]
  Vec8x3 g[3];  ///< dV/dg1 ... dV/dg3 [m^2]
};

GANNET_INLINE SolidGeometry solid_geometry(const SolidModes& x) {
  const Vec8 eight(8.0);
  const Vec8 third(8.0 / 3.0);
  SolidGeometry G;
  const Vec8x3 a23 = scaled(cross(x.a[1], x.a[2]), eight);
  G.a[0] = a23 + scaled(cross(x.g[2], x.g[1]), third);
  G.a[1] = scaled(cross(x.a[2], x.a[0]), eight) + scaled(cross(x.g[0], x.g[2]), third);
  G.a[2] = scaled(cross(x.a[0], x.a[1]), eight) + scaled(cross(x.g[1], x.g[0]), third);
  G.g[0] = scaled(cross(x.g[2], x.a[1]) + cross(x.a[2], x.g[1]), third);
  G.g[1] = scaled(cross(x.a[0], x.g[2]) + cross(x.g[0], x.a[2]), third);
  G.g[2] = scaled(cross(x.g[1], x.a[0]) + cross(x.a[1], x.g[0]), third);
  // [g3 a2 g1] and [g2 g1 a3] are each linear in g1, so V = a1 . D_a1 + the two that hold no a1.
  G.volume = dot(x.a[0], G.a[0]) + dot(x.g[0], G.g[0]);
  return G;
}

/// A tensor of nine components; row i, column j is d v_i/d x_j.
struct Tensor {
  Vec8x3 row[3];
};

/// Mean gradient of the field with coefficients v, times `scale`.
GANNET_INLINE Tensor mean_gradient(const SolidGeometry& G, const SolidModes& v, Vec8 scale) {
  const auto row = [&](auto component) {
    Vec8x3 sum = scaled(G.a[0], component(v.a[0]));
    for (int k = 1; k < 3; ++k) sum = sum + scaled(G.a[k], component(v.a[k]));
    for (int k = 0; k < 3; ++k) sum = sum + scaled(G.g[k], component(v.g[k]));
    return scaled(sum, scale);
  };
  return {{row([](const Vec8x3& a) { return a.x; }), row([](const Vec8x3& a) { return a.y; }),
           row([](const Vec8x3& a) { return a.z; })}};
}

GANNET_INLINE Vec8x3 times(const Tensor& t, const Vec8x3& a) {
  return {dot(t.row[0], a), dot(t.row[1], a), dot(t.row[2], a)};
}

GANNET_INLINE Symmetric<Vec8> symmetric_part(const Tensor& t) {
  const Vec8 half(0.5);
  return {t.row[0].x,
          t.row[1].y,
          t.row[2].z,
          half * (t.row[0].y + t.row[1].x),
          half * (t.row[1].z + t.row[2].y),
          half * (t.row[2].x + t.row[0].z)};
}

/// Rotation of a step from the gradient of its displacement at the midpoint,
///   R = (I - W/2)^-1 (I + W/2),  W = (L - L^T)/2
/// (Hughes & Winget 1980), by Cayley's formula: with w the axial vector of W, s = 1/(1 + w.w/4),
///   R = I + s (W + W^2/2).
GANNET_INLINE Tensor rotation_of(const Tensor& L) {
  const Vec8 half(0.5);
  const Vec8x3 w{half * (L.row[2].y - L.row[1].z), half * (L.row[0].z - L.row[2].x),
                 half * (L.row[1].x - L.row[0].y)};
  const Vec8 w2 = dot(w, w);
  const Vec8 s = reciprocal(Vec8(1.0) + Vec8(0.25) * w2);
  const Vec8 h = half * s;
  // W^2 = w w^T - w.w I
  const Vec8x3 hw = scaled(w, h);
  const Vec8x3 sw = scaled(w, s);
  const Vec8 one = Vec8(1.0) - h * w2;
  const Vec8 xy = hw.x * w.y;
  const Vec8 yz = hw.y * w.z;
  const Vec8 zx = hw.z * w.x;
  return {{{one + hw.x * w.x, xy - sw.z, zx + sw.y},
           {xy + sw.z, one + hw.y * w.y, yz - sw.x},
           {zx - sw.y, yz + sw.x, one + hw.z * w.z}}};
}

/// R s R^T.
GANNET_INLINE Symmetric<Vec8> rotated(const Tensor& R, const Symmetric<Vec8>& s) {
  const Vec8x3 columns[3] = {times(R, {s.xx, s.xy, s.zx}), times(R, {s.xy, s.yy, s.yz}),
                             times(R, {s.zx, s.yz, s.zz})};
  // Row i of R s, its product with row j of R.
  const Vec8x3 x{columns[0].x, columns[1].x, columns[2].x};
  const Vec8x3 y{columns[0].y, columns[1].y, columns[2].y};
  const Vec8x3 z{columns[0].z, columns[1].z, columns[2].z};
  return {dot(x, R.row[0]), dot(y, R.row[1]), dot(z, R.row[2]),
          dot(x, R.row[1]), dot(y, R.row[2]), dot(z, R.row[0])};
}

/// Bound of the largest eigenvalue of a symmetric tensor that is not negative: mean + sqrt(2/3)
/// |deviator|, sharp where two are equal and below the third, and where all are.
GANNET_INLINE Vec8 largest_eigenvalue_bound(const Symmetric<Vec8>& G) {
  const Vec8 trace = G.xx + G.yy + G.zz;
  const Vec8 d2 = contraction(G, G) - Vec8(1.0 / 3.0) * trace * trace;
  return Vec8(1.0 / 3.0) * trace + Vec8(0.81649658092772603) * sqrt(max(d2, Vec8(0.0)));
}

/// The largest eigenvalue of the part of a symmetric tensor in the plane, exactly.
GANNET_INLINE Vec8 largest_in_plane(const Symmetric<Vec8>& G) {
  const Vec8 half(0.5);
  const Vec8 gap = half * (G.xx - G.yy);
  return half * (G.xx + G.yy) + sqrt(gap * gap + G.xy * G.xy);
}

/// The trace of the Gram matrix sum_I B_I B_I^T of the mean gradients, and the bound of its largest
/// eigenvalue: sharp for a cube and for a flat element. Both times V^2.
struct GramBound {
  Vec8 trace;
  Vec8 largest;
};

/// Of a tetrahedron, whose four gradients are known.
GANNET_INLINE GramBound tetrahedron_gram_bound(const SolidGeometry& G) {
  const Vec8x3 D[4] = {G.a[0], G.a[1], G.a[2], G.a[0] + G.a[1] + G.a[2]};
  Symmetric<Vec8> sum{Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0)};
  for (const Vec8x3& d : D) {
    sum.xx += d.x * d.x;
    sum.yy += d.y * d.y;
    sum.zz += d.z * d.z;
    sum.xy += d.x * d.y;
    sum.yz += d.y * d.z;
    sum.zx += d.z * d.x;
  }
  const Vec8 s2(tetrahedron_scale * tetrahedron_scale);
  return {s2 * (sum.xx + sum.yy + sum.zz), s2 * largest_eigenvalue_bound(sum)};
}

GANNET_INLINE GramBound gram_bound(const SolidGeometry& G, SolidShape shape) {
  if (shape == SolidShape::tetrahedron) return tetrahedron_gram_bound(G);
  Symmetric<Vec8> sum{Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0)};
  for (int k = 0; k < 6; ++k) {
    const Vec8x3& D = k < 3 ? G.a[k] : G.g[k - 3];
    sum.xx += D.x * D.x;
    sum.yy += D.y * D.y;
    sum.zz += D.z * D.z;
    sum.xy += D.x * D.y;
    sum.yz += D.y * D.z;
    sum.zx += D.z * D.x;
  }
  const Vec8 eighth(0.125);
  if (shape == SolidShape::quadrilateral)
    return {eighth * (sum.xx + sum.yy), eighth * largest_in_plane(sum)};
  return {eighth * (sum.xx + sum.yy + sum.zz), eighth * largest_eigenvalue_bound(sum)};
}

/// A place in the element: xi, eta, zeta.
struct SolidPlace {
  double xi, eta, zeta;
};

/// Gauss point 0 ... 7, in the order of the corners.
GANNET_INLINE SolidPlace gauss_place(int point) {
  constexpr double a = 0.57735026918962576;
  const int k = point & 3;
  return {k == 1 || k == 2 ? a : -a, k > 1 ? a : -a, point > 3 ? a : -a};
}

/// d/d xi, d/d eta, d/d zeta of the field with coefficients m.
GANNET_INLINE void derivatives(const SolidModes& m, const SolidPlace& at, Vec8x3 d[3]) {
  const Vec8 xi(at.xi);
  const Vec8 eta(at.eta);
  const Vec8 zeta(at.zeta);
  d[0] = m.a[0] + scaled(m.g[1] + scaled(m.g[3], eta), zeta) + scaled(m.g[2], eta);
  d[1] = m.a[1] + scaled(m.g[0] + scaled(m.g[3], xi), zeta) + scaled(m.g[2], xi);
  d[2] = m.a[2] + scaled(m.g[0] + scaled(m.g[3], xi), eta) + scaled(m.g[1], xi);
}

/// Cofactors of the Jacobian of the map at a point, and its determinant.
struct PointGradient {
  Vec8x3 c[3];  ///< [m^2]
  Vec8 det;     ///< [m^3]
};

GANNET_INLINE PointGradient point_gradient(const SolidModes& x, const SolidPlace& at) {
  Vec8x3 d[3];
  derivatives(x, at, d);
  PointGradient g;
  g.c[0] = cross(d[1], d[2]);
  g.c[1] = cross(d[2], d[0]);
  g.c[2] = cross(d[0], d[1]);
  g.det = dot(d[0], g.c[0]);
  return g;
}

/// Gradient at a point of the field with coefficients v, times `scale`.
GANNET_INLINE Tensor gradient_at(const PointGradient& g, const SolidModes& v, const SolidPlace& at,
                                 Vec8 scale) {
  Vec8x3 d[3];
  derivatives(v, at, d);
  const Vec8 s = scale * reciprocal(g.det);
  const auto row = [&](Vec8 a, Vec8 b, Vec8 c) {
    return scaled(scaled(g.c[0], a) + scaled(g.c[1], b) + scaled(g.c[2], c), s);
  };
  return {{row(d[0].x, d[1].x, d[2].x), row(d[0].y, d[1].y, d[2].y), row(d[0].z, d[1].z, d[2].z)}};
}

/// Adds the forces of the deviator of sigma at a point, p its mean [Pa], to those on the
/// coefficients.
GANNET_INLINE void add_point_forces(const PointGradient& g, const SolidPlace& at,
                                    const Symmetric<Vec8>& s, Vec8 p, SolidModes& F) {
  const Tensor T{{{p - s.xx, -s.xy, -s.zx}, {-s.xy, p - s.yy, -s.yz}, {-s.zx, -s.yz, p - s.zz}}};
  const Vec8x3 xi = times(T, g.c[0]);
  const Vec8x3 eta = times(T, g.c[1]);
  const Vec8x3 zeta = times(T, g.c[2]);
  F.a[0] = F.a[0] + xi;
  F.a[1] = F.a[1] + eta;
  F.a[2] = F.a[2] + zeta;
  F.g[0] = F.g[0] + scaled(eta, Vec8(at.zeta)) + scaled(zeta, Vec8(at.eta));
  F.g[1] = F.g[1] + scaled(xi, Vec8(at.zeta)) + scaled(zeta, Vec8(at.xi));
  F.g[2] = F.g[2] + scaled(xi, Vec8(at.eta)) + scaled(eta, Vec8(at.xi));
  F.g[3] = F.g[3] + scaled(xi, Vec8(at.eta * at.zeta)) + scaled(eta, Vec8(at.zeta * at.xi)) +
           scaled(zeta, Vec8(at.xi * at.eta));
}

/// Adds the forces of a mean stress [Pa] over the whole element.
GANNET_INLINE void add_mean_stress(const SolidGeometry& G, Vec8 mean, SolidModes& F) {
  for (int k = 0; k < 3; ++k) F.a[k] = F.a[k] - scaled(G.a[k], mean);
  for (int k = 0; k < 3; ++k) F.g[k] = F.g[k] - scaled(G.g[k], mean);
}

/// Bound of the largest eigenvalue of sum_I B_I B_I^T at a Gauss point, B_I the gradients of the
/// shape functions there [1/m^2]: sum_I (dN_I/dxi_k)^2 = 2/9, and xi_k xi_l/6 for k != l. In a
/// plane case the two corners above each other move alike: three quarters of that, in the plane.
GANNET_INLINE Vec8 largest_gram(const PointGradient& g, const SolidPlace& at, bool plane) {
  const Vec8 two_ninths(2.0 / 9.0);
  const Vec8 xy(at.xi * at.eta / 6);
  const Vec8 yz(at.eta * at.zeta / 6);
  const Vec8 zx(at.zeta * at.xi / 6);
  const Vec8x3 w[3] = {scaled(g.c[0], two_ninths) + scaled(g.c[1], xy) + scaled(g.c[2], zx),
                       scaled(g.c[1], two_ninths) + scaled(g.c[0], xy) + scaled(g.c[2], yz),
                       scaled(g.c[2], two_ninths) + scaled(g.c[0], zx) + scaled(g.c[1], yz)};
  Symmetric<Vec8> G{Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0), Vec8(0.0)};
  for (int k = 0; k < 3; ++k) {
    G.xx += g.c[k].x * w[k].x;
    G.yy += g.c[k].y * w[k].y;
    G.zz += g.c[k].z * w[k].z;
    G.xy += g.c[k].x * w[k].y;
    G.yz += g.c[k].y * w[k].z;
    G.zx += g.c[k].z * w[k].x;
  }
  const Vec8 inverse_det = reciprocal(g.det);
  const Vec8 largest = plane ? Vec8(0.75) * largest_in_plane(G) : largest_eigenvalue_bound(G);
  return largest * inverse_det * inverse_det;
}

}  // namespace gannet::GANNET_ISA_NS
