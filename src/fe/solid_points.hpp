// Points of integration of solids with eight of them: gradients there, and forces from their
// stress. The equations stand in solid_element.hpp. For *.isa.cpp files only.
#pragma once

#include "fe/solid_element.hpp"

namespace gannet::GANNET_ISA_NS {

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

/// Eight times d/d xi, d/d eta, d/d zeta of the field m.
GANNET_INLINE void derivatives(const SolidModes& m, const SolidPlace& at, VecX3 d[3]) {
  const Vec xi(at.xi);
  const Vec eta(at.eta);
  const Vec zeta(at.zeta);
  d[0] = m.a[0] + scaled(m.g[1] + scaled(m.g[3], eta), zeta) + scaled(m.g[2], eta);
  d[1] = m.a[1] + scaled(m.g[0] + scaled(m.g[3], xi), zeta) + scaled(m.g[2], xi);
  d[2] = m.a[2] + scaled(m.g[0] + scaled(m.g[3], xi), eta) + scaled(m.g[1], xi);
}

/// Cofactors of the Jacobian of the map at a point, and its determinant.
struct PointGradient {
  VecX3 c[3];  ///< 64 times [m^2]
  Vec det;     ///< [m^3]
};

GANNET_INLINE PointGradient point_gradient(const SolidModes& x, const SolidPlace& at) {
  VecX3 d[3];
  derivatives(x, at, d);
  PointGradient g;
  g.c[0] = cross(d[1], d[2]);
  g.c[1] = cross(d[2], d[0]);
  g.c[2] = cross(d[0], d[1]);
  g.det = Vec(1.0 / 512.0) * dot(d[0], g.c[0]);
  return g;
}

/// Gradient at a point of the field v, times `scale`.
GANNET_INLINE Tensor gradient_at(const PointGradient& g, const SolidModes& v, const SolidPlace& at,
                                 Vec scale) {
  VecX3 d[3];
  derivatives(v, at, d);
  const Vec s = scale * Vec(1.0 / 512.0) * reciprocal(g.det);
  const auto row = [&](Vec a, Vec b, Vec c) {
    return scaled(scaled(g.c[0], a) + scaled(g.c[1], b) + scaled(g.c[2], c), s);
  };
  return {{row(d[0].x, d[1].x, d[2].x), row(d[0].y, d[1].y, d[2].y), row(d[0].z, d[1].z, d[2].z)}};
}

/// Adds the forces of the deviator of sigma at a point, p its mean [Pa].
GANNET_INLINE void add_point_forces(const PointGradient& g, const SolidPlace& at,
                                    const Symmetric<Vec>& s, Vec p, SolidModes& F) {
  const Vec k(-1.0 / 512.0);
  const Vec xy = k * s.xy;
  const Vec yz = k * s.yz;
  const Vec zx = k * s.zx;
  const Tensor T{{{k * (s.xx - p), xy, zx}, {xy, k * (s.yy - p), yz}, {zx, yz, k * (s.zz - p)}}};
  const VecX3 xi = times(T, g.c[0]);
  const VecX3 eta = times(T, g.c[1]);
  const VecX3 zeta = times(T, g.c[2]);
  F.a[0] = F.a[0] + xi;
  F.a[1] = F.a[1] + eta;
  F.a[2] = F.a[2] + zeta;
  F.g[0] = F.g[0] + scaled(eta, Vec(at.zeta)) + scaled(zeta, Vec(at.eta));
  F.g[1] = F.g[1] + scaled(xi, Vec(at.zeta)) + scaled(zeta, Vec(at.xi));
  F.g[2] = F.g[2] + scaled(xi, Vec(at.eta)) + scaled(eta, Vec(at.xi));
  F.g[3] = F.g[3] + scaled(xi, Vec(at.eta * at.zeta)) + scaled(eta, Vec(at.zeta * at.xi)) +
           scaled(zeta, Vec(at.xi * at.eta));
}

/// Adds the forces of a mean stress [Pa] over the whole element.
GANNET_INLINE void add_mean_stress(const SolidGeometry& G, Vec mean, SolidModes& F) {
  const Vec p = Vec(1.0 / 192.0) * mean;
  for (int k = 0; k < 3; ++k) F.a[k] = F.a[k] - scaled(G.a[k], p);
  for (int k = 0; k < 3; ++k) F.g[k] = F.g[k] - scaled(G.g[k], p);
}

/// Bound of the largest eigenvalue of sum_I B_I B_I^T at a Gauss point, B_I the gradients of the
/// shape functions there [1/m^2]: sum_I (dN_I/dxi_k)^2 = 2/9, and xi_k xi_l/6 for k != l. In a
/// plane case the two corners above each other move alike: three quarters of that, in the plane.
GANNET_INLINE Vec largest_gram(const PointGradient& g, const SolidPlace& at, bool plane) {
  constexpr double scale = 1.0 / 4096.0;
  const Vec two_ninths(2.0 / 9.0 * scale);
  const Vec xy(at.xi * at.eta / 6 * scale);
  const Vec yz(at.eta * at.zeta / 6 * scale);
  const Vec zx(at.zeta * at.xi / 6 * scale);
  const VecX3 w[3] = {scaled(g.c[0], two_ninths) + scaled(g.c[1], xy) + scaled(g.c[2], zx),
                      scaled(g.c[1], two_ninths) + scaled(g.c[0], xy) + scaled(g.c[2], yz),
                      scaled(g.c[2], two_ninths) + scaled(g.c[0], zx) + scaled(g.c[1], yz)};
  Symmetric<Vec> G{Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0), Vec(0.0)};
  for (int k = 0; k < 3; ++k) {
    G.xx += g.c[k].x * w[k].x;
    G.yy += g.c[k].y * w[k].y;
    G.zz += g.c[k].z * w[k].z;
    G.xy += g.c[k].x * w[k].y;
    G.yz += g.c[k].y * w[k].z;
    G.zx += g.c[k].z * w[k].x;
  }
  const Vec inverse_det = reciprocal(g.det);
  const Vec largest = plane ? Vec(0.75) * largest_in_plane(G) : largest_eigenvalue_bound(G);
  return largest * inverse_det * inverse_det;
}

}  // namespace gannet::GANNET_ISA_NS
