// The eight-node solid with one point of integration, a vector of elements at a time (Flanagan &
// Belytschko 1981, Int. J. Numer. Methods Eng. 17, 679-706), written in the modes of the trilinear
// map.
//
// A field f over the element is, but for its mean, a combination of the seven patterns xi, eta,
// zeta, eta zeta, zeta xi, xi eta, xi eta zeta of the corners (each +-1), with the coefficients
//   a1, a2, a3 (linear), g1, g2, g3, g4 (hourglass):  f_mode = 1/8 sum_I pattern_I f_I.
// Kept are the sums, eight times the coefficients, and what follows from them without factors that
// cancel anyway (SolidModes, SolidGeometry).
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
#include "fe/vec_x3.hpp"

namespace gannet::GANNET_ISA_NS {

/// Eight times the coefficients of the seven patterns of a vector field: as the sums over the
/// corners give them. Of forces: an eighth of those on the coefficients, whose sum over the
/// patterns is the force on a corner.
struct SolidModes {
  VecX3 a[3];
  VecX3 g[4];
};

/// The seven sums over corners with the signs of the patterns: a1, a2, a3, g1, g2, g3, g4. Corners
/// as VTK counts them: 0-3 around the face zeta = -1 (counter-clockwise seen from above), 4-7 above
/// them.
GANNET_INLINE void pattern_sums(const Vec f[8], Vec m[7]) {
  // Within a face s: differences along xi, sums along xi, of the edges eta = -1 and eta = +1.
  const auto face = [](const Vec* s, Vec& xi, Vec& eta, Vec& xi_eta, Vec& all) {
    const Vec low = s[1] - s[0];
    const Vec high = s[2] - s[3];
    const Vec low_sum = s[0] + s[1];
    const Vec high_sum = s[2] + s[3];
    xi = low + high;
    xi_eta = high - low;
    eta = high_sum - low_sum;
    all = high_sum + low_sum;
  };
  Vec even[4];
  Vec odd[4];
  for (int k = 0; k < 4; ++k) {
    even[k] = f[k] + f[k + 4];
    odd[k] = f[k + 4] - f[k];
  }
  Vec mean;
  face(even, m[0], m[1], m[5], mean);
  face(odd, m[4], m[3], m[6], m[2]);
}

/// The transpose of pattern_sums().
GANNET_INLINE void pattern_values(const Vec m[7], Vec f[8]) {
  const Vec sum = m[0] + m[1];
  const Vec gap = m[0] - m[1];
  const Vec even[4] = {m[5] - sum, gap - m[5], m[5] + sum, -(gap + m[5])};
  const Vec odd_sum = m[4] + m[3];
  const Vec odd_gap = m[4] - m[3];
  const Vec with = m[2] + m[6];
  const Vec without = m[2] - m[6];
  const Vec odd[4] = {with - odd_sum, without + odd_gap, with + odd_sum, without - odd_gap};
  for (int k = 0; k < 4; ++k) {
    f[k] = even[k] - odd[k];
    f[k + 4] = even[k] + odd[k];
  }
}

/// The patterns of four vectors of lines each, transposed.
GANNET_INLINE SolidModes modes_of_lines(const Vec line[7][line_vecs]) {
  SolidModes modes;
  for (int p = 0; p < 7; ++p) {
    Vec c[3];
    components_of(line[p], c);
    (p < 3 ? modes.a[p] : modes.g[p - 3]) = {c[0], c[1], c[2]};
  }
  return modes;
}

/// Gathers positions and velocities of bricks from lines: pattern by pattern while a line is an
/// element's. corners: 8 a corner, as SolidPass::corners.
GANNET_INLINE void gather_bricks(const double* x, const double* v, const std::int32_t* corners,
                                 SolidModes& of_x, SolidModes& of_v) {
  Vec x_lines[7][line_vecs];
  Vec v_lines[7][line_vecs];
  for (int k = 0; k < line_vecs; ++k) {
    LinePlace at[8];
    Vec f[8];
    Vec m[7];
    for (int a = 0; a < 8; ++a) at[a] = place_of_lines(corners + 8 * a + k);
    for (int a = 0; a < 8; ++a) f[a] = load_lines(x, at[a]);
    pattern_sums(f, m);
    for (int p = 0; p < 7; ++p) x_lines[p][k] = m[p];
    for (int a = 0; a < 8; ++a) f[a] = load_lines(v, at[a]);
    pattern_sums(f, m);
    for (int p = 0; p < 7; ++p) v_lines[p][k] = m[p];
  }
  of_x = modes_of_lines(x_lines);
  of_v = modes_of_lines(v_lines);
}

/// Adds forces to the corners of bricks, element by element in order.
GANNET_INLINE void scatter_brick(double* base, const std::int32_t* corners, const SolidModes& F) {
  Vec line[7][line_vecs];
  for (int p = 0; p < 7; ++p) {
    const VecX3& mode = p < 3 ? F.a[p] : F.g[p - 3];
    const Vec c[3] = {mode.x, mode.y, mode.z};
    lines_of(c, line[p]);
  }
  for (int k = 0; k < line_vecs; ++k) {
    Vec m[7];
    for (int p = 0; p < 7; ++p) m[p] = line[p][k];
    Vec f[8];
    pattern_values(m, f);
    for (int a = 0; a < 8; ++a) add_lines(base, place_of_lines(corners + 8 * a + k), f[a]);
  }
}

/// Of a field that is alike on both faces, from corners 0-3. across: eight times a3.
GANNET_INLINE SolidModes plane_modes_of(const VecX3 f[4], const VecX3& across) {
  const Vec two(2.0);
  const VecX3 zero{Vec(0.0), Vec(0.0), Vec(0.0)};
  SolidModes c;
  c.a[0] = scaled((f[1] - f[0]) + (f[2] - f[3]), two);
  c.a[1] = scaled((f[3] - f[0]) + (f[2] - f[1]), two);
  c.a[2] = across;
  c.g[0] = zero;
  c.g[1] = zero;
  c.g[2] = scaled((f[0] - f[1]) + (f[2] - f[3]), two);
  c.g[3] = zero;
  return c;
}

/// 8 s with 48 s^3 = 1.
constexpr double tetrahedron_scale = 8 * 0.27516060407455223;

/// Of a tetrahedron.
GANNET_INLINE SolidModes tetrahedron_modes_of(const VecX3 f[4]) {
  const VecX3 zero{Vec(0.0), Vec(0.0), Vec(0.0)};
  SolidModes c{{zero, zero, zero}, {zero, zero, zero, zero}};
  for (int k = 0; k < 3; ++k) c.a[k] = scaled(f[k + 1] - f[0], Vec(tetrahedron_scale));
  return c;
}

/// What forces are at the corners of a tetrahedron.
GANNET_INLINE void tetrahedron_corners_of(const SolidModes& F, VecX3 f[4]) {
  for (int k = 0; k < 3; ++k) f[k + 1] = scaled(F.a[k], Vec(tetrahedron_scale));
  f[0] = -(f[1] + f[2] + f[3]);
}

/// What forces are at corners 0-3 where both faces hang on them.
GANNET_INLINE void plane_corners_of(const SolidModes& F, VecX3 f[4]) {
  const Vec two(2.0);
  const VecX3 sum = scaled(F.a[0] + F.a[1], two);
  const VecX3 gap = scaled(F.a[0] - F.a[1], two);
  const VecX3 g = scaled(F.g[2], two);
  f[0] = g - sum;
  f[1] = gap - g;
  f[2] = g + sum;
  f[3] = -(gap + g);
}

/// Volume of elements and its derivatives by the coefficients of the positions, without the factors
/// that would have to be multiplied in: 192 V and 24 dV/da.
struct SolidGeometry {
  Vec volume_192;  ///< [m^3]
  VecX3 a[3];      ///< 24 dV/da1 ... [m^2]
  VecX3 g[3];      ///< 24 dV/dg1 ... [m^2]
  [[nodiscard]] GANNET_INLINE Vec volume() const { return Vec(1.0 / 192.0) * volume_192; }
};

/// p x q + r x s.
GANNET_INLINE VecX3 two_crosses(const VecX3& p, const VecX3& q, const VecX3& r, const VecX3& s) {
  return {fma(p.y, q.z, fnma(p.z, q.y, fma(r.y, s.z, -(r.z * s.y)))),
          fma(p.z, q.x, fnma(p.x, q.z, fma(r.z, s.x, -(r.x * s.z)))),
          fma(p.x, q.y, fnma(p.y, q.x, fma(r.x, s.y, -(r.y * s.x))))};
}

GANNET_INLINE SolidGeometry solid_geometry(const SolidModes& x) {
  const Vec three(3.0);
  SolidGeometry G;
  const VecX3 a1 = scaled(x.a[0], three);
  const VecX3 a2 = scaled(x.a[1], three);
  const VecX3 a3 = scaled(x.a[2], three);
  G.a[0] = two_crosses(a2, x.a[2], x.g[2], x.g[1]);
  G.a[1] = two_crosses(a3, x.a[0], x.g[0], x.g[2]);
  G.a[2] = two_crosses(a1, x.a[1], x.g[1], x.g[0]);
  G.g[0] = two_crosses(x.g[2], x.a[1], x.a[2], x.g[1]);
  G.g[1] = two_crosses(x.a[0], x.g[2], x.g[0], x.a[2]);
  G.g[2] = two_crosses(x.g[1], x.a[0], x.a[1], x.g[0]);
  // [g3 a2 g1] and [g2 g1 a3] are each linear in g1, so V = a1 . D_a1 + the two that hold no a1.
  G.volume_192 = dot(x.a[0], G.a[0]) + dot(x.g[0], G.g[0]);
  return G;
}

/// A tensor of nine components; row i, column j is d v_i/d x_j.
struct Tensor {
  VecX3 row[3];
};

/// Mean gradient of the field v, times `scale` 192 V.
GANNET_INLINE Tensor mean_gradient(const SolidGeometry& G, const SolidModes& v, Vec scale) {
  const auto row = [&](auto component) {
    VecX3 sum = scaled(G.a[0], component(v.a[0]));
    for (int k = 1; k < 3; ++k) sum = sum + scaled(G.a[k], component(v.a[k]));
    for (int k = 0; k < 3; ++k) sum = sum + scaled(G.g[k], component(v.g[k]));
    return scaled(sum, scale);
  };
  return {{row([](const VecX3& a) { return a.x; }), row([](const VecX3& a) { return a.y; }),
           row([](const VecX3& a) { return a.z; })}};
}

GANNET_INLINE VecX3 times(const Tensor& t, const VecX3& a) {
  return {dot(t.row[0], a), dot(t.row[1], a), dot(t.row[2], a)};
}

GANNET_INLINE Symmetric<Vec> symmetric_part(const Tensor& t) {
  const Vec half(0.5);
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
  const Vec half(0.5);
  const VecX3 w{half * (L.row[2].y - L.row[1].z), half * (L.row[0].z - L.row[2].x),
                half * (L.row[1].x - L.row[0].y)};
  const Vec w2 = dot(w, w);
  const Vec s = reciprocal(Vec(1.0) + Vec(0.25) * w2);
  const Vec h = half * s;
  // W^2 = w w^T - w.w I
  const VecX3 hw = scaled(w, h);
  const VecX3 sw = scaled(w, s);
  const Vec one = Vec(1.0) - h * w2;
  const Vec xy = hw.x * w.y;
  const Vec yz = hw.y * w.z;
  const Vec zx = hw.z * w.x;
  return {{{one + hw.x * w.x, xy - sw.z, zx + sw.y},
           {xy + sw.z, one + hw.y * w.y, yz - sw.x},
           {zx - sw.y, yz + sw.x, one + hw.z * w.z}}};
}

/// R s R^T.
GANNET_INLINE Symmetric<Vec> rotated(const Tensor& R, const Symmetric<Vec>& s) {
  const VecX3 columns[3] = {times(R, {s.xx, s.xy, s.zx}), times(R, {s.xy, s.yy, s.yz}),
                            times(R, {s.zx, s.yz, s.zz})};
  // Row i of R s, its product with row j of R.
  const VecX3 x{columns[0].x, columns[1].x, columns[2].x};
  const VecX3 y{columns[0].y, columns[1].y, columns[2].y};
  const VecX3 z{columns[0].z, columns[1].z, columns[2].z};
  return {dot(x, R.row[0]), dot(y, R.row[1]), dot(z, R.row[2]),
          dot(x, R.row[1]), dot(y, R.row[2]), dot(z, R.row[0])};
}

/// Bound of the largest eigenvalue of a symmetric tensor that is not negative: mean + sqrt(2/3)
/// |deviator|, sharp where two are equal and below the third, and where all are.
GANNET_INLINE Vec largest_eigenvalue_bound(const Symmetric<Vec>& G) {
  const Vec trace = G.xx + G.yy + G.zz;
  const Vec d2 = contraction(G, G) - Vec(1.0 / 3.0) * trace * trace;
  return Vec(1.0 / 3.0) * trace + Vec(0.81649658092772603) * sqrt(max(d2, Vec(0.0)));
}

/// The largest eigenvalue of the part of a symmetric tensor in the plane, exactly.
GANNET_INLINE Vec largest_in_plane(const Symmetric<Vec>& G) {
  const Vec half(0.5);
  const Vec gap = half * (G.xx - G.yy);
  return half * (G.xx + G.yy) + sqrt(gap * gap + G.xy * G.xy);
}

/// The trace of the Gram matrix sum_I B_I B_I^T of the mean gradients, and the bound of its largest
/// eigenvalue: sharp for a cube and for a flat element. Both times V^2.
struct GramBound {
  Vec trace;
  Vec largest;
};

/// Of a tetrahedron, whose four gradients are known.
GANNET_INLINE GramBound tetrahedron_gram_bound(const SolidGeometry& G) {
  const VecX3 D[4] = {G.a[0], G.a[1], G.a[2], G.a[0] + G.a[1] + G.a[2]};
  Symmetric<Vec> sum{Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0)};
  for (const VecX3& d : D) {
    sum.xx += d.x * d.x;
    sum.yy += d.y * d.y;
    sum.zz += d.z * d.z;
    sum.xy += d.x * d.y;
    sum.yz += d.y * d.z;
    sum.zx += d.z * d.x;
  }
  const Vec s2(tetrahedron_scale * tetrahedron_scale / (64.0 * 576.0));
  return {s2 * (sum.xx + sum.yy + sum.zz), s2 * largest_eigenvalue_bound(sum)};
}

GANNET_INLINE GramBound gram_bound(const SolidGeometry& G, SolidShape shape) {
  if (shape == SolidShape::tetrahedron) return tetrahedron_gram_bound(G);
  Symmetric<Vec> sum{Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0)};
  for (int k = 0; k < 6; ++k) {
    const VecX3& D = k < 3 ? G.a[k] : G.g[k - 3];
    sum.xx += D.x * D.x;
    sum.yy += D.y * D.y;
    sum.zz += D.z * D.z;
    sum.xy += D.x * D.y;
    sum.yz += D.y * D.z;
    sum.zx += D.z * D.x;
  }
  const Vec scale(1.0 / (8.0 * 576.0));
  if (shape == SolidShape::quadrilateral)
    return {scale * (sum.xx + sum.yy), scale * largest_in_plane(sum)};
  return {scale * (sum.xx + sum.yy + sum.zz), scale * largest_eigenvalue_bound(sum)};
}

}  // namespace gannet::GANNET_ISA_NS
