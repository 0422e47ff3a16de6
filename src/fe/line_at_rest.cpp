#include "fe/line_at_rest.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace gannet {

namespace {

/// Energy, forces and stiffness of a chain in one position.
struct Balance {
  double energy = 0;
  double scale = 0;           ///< largest force of an element or on a node [N]
  std::vector<Vec3> force;    ///< on each node
  std::vector<Mat3> element;  ///< stiffness of element k against the difference of its ends
  std::vector<double> bed;    ///< stiffness of the bed at each node
  [[nodiscard]] double largest() const {
    double f = 0;
    for (std::size_t k = 1; k + 1 < force.size(); ++k) f = std::max(f, force[k].norm());
    return f;
  }
};

void add_element(const ChainAtRest& chain, const std::vector<Vec3>& x, std::size_t k, Balance& b) {
  const Vec3 r = x[k + 1] - x[k];
  const double l = r.norm();
  const Vec3 n = l > 0 ? Vec3(r / l) : Vec3(Vec3::Zero());
  const AxialAnswer a = chain.law(l / chain.l0 - 1);
  const Mat3 along = n * n.transpose();
  b.energy += chain.l0 * a.energy;
  b.scale = std::max(b.scale, a.force);
  b.force[k] += a.force * n;
  b.force[k + 1] -= a.force * n;
  b.element[k] = a.slope / chain.l0 * along;
  if (l > 0) b.element[k] += a.force / l * (Mat3::Identity() - along);
}

Balance balance_of(const ChainAtRest& chain, const std::vector<Vec3>& x) {
  Balance b;
  b.force = chain.load;
  b.element.resize(x.size() - 1);
  b.bed.assign(x.size(), 0);
  for (std::size_t k = 0; k < x.size(); ++k) {
    b.energy -= chain.load[k].dot(x[k]);
    b.scale = std::max(b.scale, chain.load[k].norm());
    const double push = bed_push(chain, k, x[k]);
    if (!(push > 0)) continue;
    b.force[k].z() += push;
    b.bed[k] = chain.bed_stiffness[k];
    b.energy += 0.5 * push * push / chain.bed_stiffness[k];
  }
  for (std::size_t k = 0; k + 1 < x.size(); ++k) add_element(chain, x, k, b);
  return b;
}

/// The step of the inner nodes that takes all forces to 0 at the stiffness at hand: a system of
/// three by three blocks on three diagonals, eliminated from one end to the other.
std::vector<Vec3> newton_step(const Balance& b, double trace) {
  const std::size_t n = b.force.size();
  std::vector<Vec3> step(n, Vec3::Zero());
  std::vector<Mat3> upper(n, Mat3::Zero());  // what is left of the block beside the diagonal
  for (std::size_t k = 1; k + 1 < n; ++k) {
    Mat3 diagonal = b.element[k - 1] + b.element[k] + trace * Mat3::Identity();
    diagonal(2, 2) += b.bed[k];
    const Mat3& before = b.element[k - 1];
    if (k > 1) diagonal -= before * upper[k - 1];
    const Vec3 right = b.force[k] + (k > 1 ? Vec3(before * step[k - 1]) : Vec3(Vec3::Zero()));
    const Eigen::PartialPivLU<Mat3> lu(diagonal);
    step[k] = lu.solve(right);
    upper[k] = lu.solve(b.element[k]);
  }
  for (std::size_t k = n - 2; k > 1; --k) step[k - 1] += upper[k - 1] * step[k];
  return step;
}

std::vector<Vec3> moved(const std::vector<Vec3>& x, const std::vector<Vec3>& step, double share) {
  std::vector<Vec3> to = x;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) to[k] += share * step[k];
  return to;
}

double slope_along(const Balance& b, const std::vector<Vec3>& step) {
  double slope = 0;
  for (std::size_t k = 1; k + 1 < step.size(); ++k) slope += b.force[k].dot(step[k]);
  return slope;
}

}  // namespace

double bed_push(const ChainAtRest& chain, std::size_t k, const Vec3& x) {
  if (!chain.bed) return 0;
  return chain.bed_stiffness[k] * std::max(0.0, chain.bed_level - x.z());
}

RestResult bring_to_rest(const ChainAtRest& chain, std::vector<Vec3>& x) {
  const double trace = 1e-8 * chain.law(1e-6).slope / chain.l0;
  Balance now = balance_of(chain, x);
  RestResult result;
  for (result.iterations = 0; result.iterations < 500; ++result.iterations) {
    result.largest = now.largest();
    if (result.largest < 1e-11 * now.scale) break;
    const std::vector<Vec3> step = newton_step(now, trace);
    const double slope = slope_along(now, step);
    double share = 1;
    bool better = false;
    for (int half = 0; half < 40 && !better; ++half, share *= 0.5) {
      std::vector<Vec3> there = moved(x, step, share);
      Balance next = balance_of(chain, there);
      // Near the end the energy no longer tells by its digits; the forces do.
      better = next.energy < now.energy - 1e-4 * share * slope || next.largest() < now.largest();
      if (!better) continue;
      x = std::move(there);
      now = std::move(next);
    }
    if (!better) break;
  }
  result.largest = now.largest();
  result.found = result.largest < 1e-7 * now.scale;
  return result;
}

}  // namespace gannet
