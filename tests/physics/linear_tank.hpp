// A half-submerged circular cylinder of half the density of water that heaves in a tank, by linear
// potential theory: what a run in that very tank should do. In deep and wide water it is the
// problem of Maskell and Ursell 1970 (J. Fluid Mech. 44, 303).
#pragma once

#include <Eigen/Dense>
#include <numbers>

#include "running.hpp"

namespace gannet::test {

/// Straight pieces of the boundary of the right half of the water, lengths over R: a to b, the
/// water on the right hand, so that the normal points out of it.
struct BoundaryPieces {
  std::vector<Eigen::Vector2d> a, b;
  void add(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    a.push_back(from);
    b.push_back(to);
  }
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(a.size()); }
};

/// Adds the integrals of ln r (to G) and of its derivative along the normal (to H) over the images
/// of the pieces, seen from the middles of the pieces. flip: signs of x - 0 and y - bottom.
inline void add_influence(const BoundaryPieces& pieces, const Eigen::Vector2d& flip, double bottom,
                          Eigen::MatrixXd& G, Eigen::MatrixXd& H) {
  const auto image = [&](const Eigen::Vector2d& x) {
    return Eigen::Vector2d(flip.x() * x.x(), flip.y() > 0 ? x.y() : 2 * bottom - x.y());
  };
  for (Eigen::Index j = 0; j < pieces.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const Eigen::Vector2d a = image(pieces.a[k]);
    const Eigen::Vector2d along = image(pieces.b[k]) - a;
    const double length = along.norm();
    const Eigen::Vector2d t = along / length;
    const Eigen::Vector2d n = flip.prod() * Eigen::Vector2d(-t.y(), t.x());
    for (Eigen::Index i = 0; i < pieces.size(); ++i) {
      const auto m = static_cast<std::size_t>(i);
      const Eigen::Vector2d d = 0.5 * (pieces.a[m] + pieces.b[m]) - a;
      const double x1 = -d.dot(t);
      const double x2 = length - d.dot(t);
      const double y = d.dot(n);
      const double angle = std::abs(y) < 1e-13 ? 0 : std::atan(x2 / y) - std::atan(x1 / y);
      G(i, j) +=
          x2 * std::log(std::hypot(x2, y)) - x1 * std::log(std::hypot(x1, y)) - length + y * angle;
      H(i, j) -= angle;
    }
  }
}

/// What potential flow does in the right half of a tank, all over R, g and the density of water:
///   pi phi = int (phi d ln r/dn - ln r dphi/dn) ds, pieces of constant phi, images across x = 0
///   and the bottom
struct LinearTank {
  static constexpr int n_body = 40;
  int n_surface = 0;
  Eigen::MatrixXd of_surface;  ///< phi on body and side, dphi/dy on the surface, for phi there
  Eigen::VectorXd of_body;     ///< the same, for the cylinder that moves up with 1
  Eigen::VectorXd weight;      ///< 2 n_y ds of the pieces of the cylinder
  double added_mass = 0;       ///< at once
};

inline LinearTank make_linear_tank(double depth, double width) {
  LinearTank tank;
  tank.n_surface = static_cast<int>(std::ceil((0.5 * width - 1) / 0.12));
  const auto n_side = static_cast<int>(std::ceil(depth / 0.3));
  BoundaryPieces pieces;
  const auto on_body = [](double k) {
    const double angle = 0.5 * std::numbers::pi * (k / LinearTank::n_body - 1);
    return Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  for (int k = 0; k < LinearTank::n_body; ++k) pieces.add(on_body(k), on_body(k + 1));
  const double ds = (0.5 * width - 1) / tank.n_surface;
  for (int k = 0; k < tank.n_surface; ++k) pieces.add({1 + ds * k, 0}, {1 + ds * (k + 1), 0});
  const double dy = depth / n_side;
  for (int k = 0; k < n_side; ++k) {
    pieces.add({0.5 * width, -dy * k}, {0.5 * width, -dy * (k + 1)});
  }
  const Eigen::Index n = pieces.size();
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd H = G;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) add_influence(pieces, {x, y}, -depth, G, H);
  }
  const Eigen::MatrixXd A = std::numbers::pi * Eigen::MatrixXd::Identity(n, n) - H;
  Eigen::MatrixXd unknown = A;  // of phi on cylinder and side, of dphi/dn on the surface
  unknown.middleCols(LinearTank::n_body, tank.n_surface) =
      G.middleCols(LinearTank::n_body, tank.n_surface);
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(unknown);
  Eigen::VectorXd n_y(LinearTank::n_body);
  tank.weight.resize(LinearTank::n_body);
  for (int k = 0; k < LinearTank::n_body; ++k) {
    const Eigen::Vector2d along = on_body(k + 1) - on_body(k);
    n_y[k] = along.x() / along.norm();
    tank.weight[k] = 2 * along.x();
  }
  tank.of_surface = solver.solve(-A.middleCols(LinearTank::n_body, tank.n_surface));
  tank.of_body = solver.solve(-(G.leftCols(LinearTank::n_body) * n_y));
  tank.added_mass = tank.weight.dot(tank.of_body.head(LinearTank::n_body));
  return tank;
}

/// Rates of (x, v, eta, phi), x the lift of the cylinder, eta and phi those of the surface:
///   deta/dt = dphi/dy,  dphi/dt = -eta,  pi/2 dv/dt = -2 x - 2 int phi_t n_y ds on the cylinder,
/// where phi_t is the flow with -eta at the surface and dv/dt n_y on the cylinder.
inline Eigen::VectorXd rates_of(const LinearTank& tank, const Eigen::VectorXd& y) {
  const int n = tank.n_surface;
  const int n_body = LinearTank::n_body;
  const Eigen::VectorXd eta = y.segment(2, n);
  const Eigen::VectorXd phi = y.tail(n);
  Eigen::VectorXd rates(y.size());
  const Eigen::VectorXd phi_t = tank.of_surface.topRows(n_body) * -eta;
  rates[0] = y[1];
  rates[1] = (-2 * y[0] - tank.weight.dot(phi_t)) / (0.5 * std::numbers::pi + tank.added_mass);
  rates.segment(2, n) =
      tank.of_surface.middleRows(n_body, n) * phi + y[1] * tank.of_body.segment(n_body, n);
  rates.tail(n) = -eta;
  return rates;
}

/// Free decay of the heave, x over x0 against tau = t sqrt(g/R), in a tank of the given depth and
/// width over R with the cylinder in its middle, from rest to `until`; by Runge and Kutta's fourth
/// order.
inline Curve linear_heave(double depth, double width, double until) {
  const LinearTank tank = make_linear_tank(depth, width);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 + 2 * tank.n_surface);
  y[0] = 1;
  Curve curve;
  curve.add(0, 1);
  const double dt = 0.05;
  for (int step = 1; step * dt < until + dt; ++step) {
    const Eigen::VectorXd k1 = rates_of(tank, y);
    const Eigen::VectorXd k2 = rates_of(tank, y + 0.5 * dt * k1);
    const Eigen::VectorXd k3 = rates_of(tank, y + 0.5 * dt * k2);
    const Eigen::VectorXd k4 = rates_of(tank, y + dt * k3);
    y += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    curve.add(step * dt, y[0]);
  }
  return curve;
}

/// The extremes of a curve after its start that exceed 0.02 in size, the time and the value of
/// each.
inline std::vector<std::pair<double, double>> extremes_of(const Curve& curve) {
  std::vector<std::pair<double, double>> found;
  for (std::size_t k = 1; k + 1 < curve.t.size(); ++k) {
    const double before = curve.y[k] - curve.y[k - 1];
    const double after = curve.y[k + 1] - curve.y[k];
    if (before * after > 0 || std::abs(curve.y[k]) < 0.02 || curve.t[k] < 1) continue;
    if (!found.empty() && curve.t[k] - found.back().first < 1) {
      if (std::abs(curve.y[k]) > std::abs(found.back().second)) {
        found.back() = {curve.t[k], curve.y[k]};
      }
      continue;
    }
    found.emplace_back(curve.t[k], curve.y[k]);
  }
  return found;
}

}  // namespace gannet::test
