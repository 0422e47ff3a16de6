#include "contact/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gannet {

namespace {

/// Sets point and distance from the weights, so that point = sum N_i x_i in the arithmetic used.
void finish(const Vec3& x, const Vec3* p, int n_corners, Closest& c) {
  c.point.setZero();
  for (int k = 0; k < n_corners; ++k) c.point += c.N[static_cast<std::size_t>(k)] * p[k];
  c.distance2 = (x - c.point).squaredNorm();
}

Closest closest_on_edges(const Vec3& x, const Vec3* p, int n_corners) {
  Closest best;
  for (int k = 0; k < n_corners; ++k) {
    const int next = (k + 1) % n_corners;
    const Closest c = closest_on_line(x, p[k], p[next]);
    if (k > 0 && !(c.distance2 < best.distance2)) continue;
    best = c;
    best.N = {};
    best.N[static_cast<std::size_t>(k)] = c.N[0];
    best.N[static_cast<std::size_t>(next)] = c.N[1];
    best.number = c.feature == Feature::corner && c.number == 1 ? next : k;
    if (c.feature == Feature::inside) best.feature = Feature::edge;
  }
  return best;
}

/// X = a0 + a1 xi + a2 eta + a3 xi eta.
struct Bilinear {
  Vec3 a0, a1, a2, a3;
  explicit Bilinear(const Vec3* p)
      : a0(0.25 * (p[0] + p[1] + p[2] + p[3])),
        a1(0.25 * (p[1] + p[2] - p[0] - p[3])),
        a2(0.25 * (p[2] + p[3] - p[0] - p[1])),
        a3(0.25 * (p[0] + p[2] - p[1] - p[3])) {}
};

/// Newton on the squared distance; steps fall back to Gauss-Newton where the Hessian is not
/// positive. True where it converged to a point inside.
bool solve_inside(const Vec3& x, const Bilinear& b, double& xi, double& eta) {
  constexpr double outside = 2;  // no solution inside will come back from there
  xi = eta = 0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Vec3 X_xi = b.a1 + b.a3 * eta;
    const Vec3 X_eta = b.a2 + b.a3 * xi;
    const Vec3 r = x - b.a0 - b.a1 * xi - X_eta * eta;
    const double h11 = X_xi.squaredNorm();
    const double h22 = X_eta.squaredNorm();
    const double gauss = X_xi.dot(X_eta);
    double h12 = gauss - r.dot(b.a3);
    double det = h11 * h22 - h12 * h12;
    if (!(det > 0.01 * h11 * h22)) {
      h12 = gauss;
      det = h11 * h22 - h12 * h12;
      if (!(det > 0)) return false;
    }
    const double g1 = X_xi.dot(r);
    const double g2 = X_eta.dot(r);
    const double d_xi = (h22 * g1 - h12 * g2) / det;
    const double d_eta = (h11 * g2 - h12 * g1) / det;
    xi = std::clamp(xi + d_xi, -outside, outside);
    eta = std::clamp(eta + d_eta, -outside, outside);
    // Quadratic convergence: the next step would be below rounding.
    if (std::abs(d_xi) < 1e-8 && std::abs(d_eta) < 1e-8) {
      return std::abs(xi) <= 1 && std::abs(eta) <= 1;
    }
    if (iteration > 0 && (std::abs(xi) == outside || std::abs(eta) == outside)) return false;
  }
  return false;
}

}  // namespace

Closest closest_on_line(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  const double length2 = e.squaredNorm();
  const double s = length2 > 0 ? (x - a).dot(e) / length2 : 0;
  Closest c;
  if (s <= 0 || s >= 1) {
    c.feature = Feature::corner;
    c.number = s <= 0 ? 0 : 1;
  }
  c.N[1] = std::clamp(s, 0.0, 1.0);
  c.N[0] = 1 - c.N[1];
  c.point = c.N[0] * a + c.N[1] * b;
  c.distance2 = (x - c.point).squaredNorm();
  return c;
}

Closest closest_on_triangle(const Vec3& x, const Vec3* p) {
  const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0)) return closest_on_edges(x, p, 3);
  Closest c;
  c.N[1] = normal.dot((x - p[0]).cross(p[2] - p[0])) / area2;
  c.N[2] = normal.dot((p[1] - p[0]).cross(x - p[0])) / area2;
  c.N[0] = 1 - c.N[1] - c.N[2];
  if (c.N[0] < 0 || c.N[1] < 0 || c.N[2] < 0) return closest_on_edges(x, p, 3);
  finish(x, p, 3, c);
  return c;
}

Closest closest_on_quad(const Vec3& x, const Vec3* p) {
  double xi = 0;
  double eta = 0;
  if (!solve_inside(x, Bilinear(p), xi, eta)) return closest_on_edges(x, p, 4);
  Closest c;
  c.N = {0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta), 0.25 * (1 + xi) * (1 + eta),
         0.25 * (1 - xi) * (1 + eta)};
  finish(x, p, 4, c);
  return c;
}

}  // namespace gannet
