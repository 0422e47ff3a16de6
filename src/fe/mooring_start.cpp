#include "fe/mooring_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fe/catenary.hpp"
#include "fe/line_at_rest.hpp"

namespace gannet {

namespace {

constexpr double longest_strain = 0.2;  // beyond it a line is a mistake

double lump(const MooringLine& line, std::size_t k) {
  const double l0 = line.length / line.n;
  return k == 0 || k == static_cast<std::size_t>(line.n) ? 0.5 * l0 : l0;
}

double first_slope(const TrussBlock& block) {
  return block.law.empty() ? block.EA : std::max(block.law.front().slope, 1e-6 * block.EA);
}

/// Points along corners at equal distances, n + 1 of them.
std::vector<Vec3> along(const std::vector<Vec3>& corners, int n) {
  double length = 0;
  for (std::size_t c = 1; c < corners.size(); ++c) length += (corners[c] - corners[c - 1]).norm();
  std::vector<Vec3> x;
  std::size_t leg = 1;
  double before = 0;  // length of the legs before this one
  for (int k = 0; k <= n; ++k) {
    const double s = length * k / n;
    double l = (corners[leg] - corners[leg - 1]).norm();
    while (leg + 1 < corners.size() && s > before + l) {
      before += l;
      ++leg;
      l = (corners[leg] - corners[leg - 1]).norm();
    }
    const double share = l > 0 ? std::min(1.0, (s - before) / l) : 0;
    x.emplace_back(corners[leg - 1] + share * (corners[leg] - corners[leg - 1]));
  }
  return x;
}

/// Where no catenary is: straight where it is taut, else down from the upper end and along the bed,
/// or to a low point between the ends.
std::vector<Vec3> slack_guess(const MooringLine& line) {
  const Vec3& a = line.ends[0].at;
  const Vec3& b = line.ends[1].at;
  const double spare = line.length - (b - a).norm();
  if (spare <= 0) return along({a, b}, line.n);
  if (line.bed.there) return along({a, Vec3(b.x(), b.y(), line.bed.level), b}, line.n);
  const Vec3 middle = 0.5 * (a + b);
  return along({a, Vec3(middle.x(), middle.y(), std::min(a.z(), b.z()) - 0.5 * spare), b}, line.n);
}

std::vector<Vec3> guess(const MooringLine& line, double weight) {
  const Vec3& a = line.ends[0].at;
  const Vec3 r = line.ends[1].at - a;
  const double X = std::hypot(r.x(), r.y());
  CatenaryLine uniform{line.length, weight, first_slope(line.block), line.bed.friction, false};
  uniform.bed = line.bed.there && std::abs(a.z() - line.bed.level) < 1e-6 * line.length;
  const auto c = catenary_between(uniform, X, r.z());
  if (!c) return slack_guess(line);
  std::vector<Vec3> x;
  for (int k = 0; k <= line.n; ++k) {
    const CatenaryPoint p = point_at(*c, line.length * k / line.n);
    Vec3 at = a + Vec3(r.x() / X * p.x, r.y() / X * p.x, p.z);
    if (line.bed.there) at.z() = std::max(at.z(), line.bed.level);
    x.push_back(at);
  }
  x.back() = line.ends[1].at;
  return x;
}

/// The share of node k that is under water: see wet_share() in mooring_kernel.isa.cpp.
double wet_share(const MooringLine& line, const std::vector<Vec3>& x, std::size_t k) {
  const std::size_t n = x.size() - 1;
  const double before = x[k > 0 ? k - 1 : 0].z();
  const double after = x[std::min(k + 1, n)].z();
  const double weight = k == 0 || k == n ? 0.25 : 0.125;
  const double middle = x[k].z() + weight * (before - 2 * x[k].z() + after);
  const double height = 0.5 * std::abs(after - before) + line.diameter;
  return std::clamp(0.5 + (line.water.level - middle) / height, 0.0, 1.0);
}

/// Weight, buoyancy and the drag of the current at the start on node k at rest.
Vec3 load_on(const MooringLine& line, const Vec3& gravity, const std::vector<Vec3>& x,
             std::size_t k) {
  const double l = lump(line, k);
  Vec3 load = line.block.mu * l * gravity;
  const LineWater& w = line.water;
  if (!(w.density > 0)) return load;
  const double wet = wet_share(line, x, k) * l;
  load -= line.displaced() * wet * gravity;
  if (!w.flows) return load;
  const Vec3 t = (x[std::min(k + 1, x.size() - 1)] - x[k > 0 ? k - 1 : 0]).normalized();
  const Vec3 u = value_at(w.current, 0, x[k]);
  const Vec3 ut = u.dot(t) * t;
  const Vec3 un = u - ut;
  const double rho_d = 0.5 * w.density * line.diameter * wet;
  return load + rho_d * (w.Cdn * un.norm() * un + std::numbers::pi * w.Cdt * ut.norm() * ut);
}

/// Friction that holds back what the upper end pulls, node by node towards the anchor.
std::vector<Vec3> friction_of(const MooringLine& line, const ChainAtRest& chain,
                              const std::vector<Vec3>& x) {
  std::vector<Vec3> friction(x.size(), Vec3::Zero());
  if (!(line.bed.friction > 0)) return friction;
  const auto end = static_cast<std::size_t>(line.n);
  double left = 0;  // the pull along the bed
  for (std::size_t k = end; k-- > 1;) {
    const double push = bed_push(chain, k, x[k]);
    if (!(push > 0)) continue;
    const Vec3 r = x[k + 1] - x[k];
    const Vec3 flat(r.x(), r.y(), 0);
    if (left == 0) {
      left = answer_of(line.block, r.norm() / chain.l0 - 1).force * flat.norm() / r.norm();
    }
    const double f = std::min(line.bed.friction * push, left);
    if (!(f > 0) || !(flat.norm() > 0)) break;
    friction[k] = -f * flat.normalized();
    left -= f;
  }
  return friction;
}

ChainAtRest chain_of(const MooringLine& line, double g) {
  ChainAtRest chain;
  chain.l0 = line.length / line.n;
  chain.law = [&block = line.block](double strain) { return answer_of(block, strain); };
  chain.bed = line.bed.there;
  chain.bed_level = pushing_level(line, g);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(line.n); ++k) {
    chain.bed_stiffness.push_back(line.bed.stiffness * line.diameter * lump(line, k));
  }
  return chain;
}

std::string trouble_of(const MooringLine& line) {
  const double chord = (line.ends[1].at - line.ends[0].at).norm();
  if (chord > (1 + longest_strain) * line.length) {
    return fmt::format(
        "too short: its ends are {:.6g} m apart, {:.3g} % more than {:.6g} m; a line may start "
        "stretched by {} %, so at least {:.6g} m are wanted",
        chord, 100 * (chord / line.length - 1), line.length, 100 * longest_strain,
        chord / (1 + longest_strain));
  }
  for (const LineEnd& end : line.ends) {
    if (!line.bed.there || end.at.z() >= line.bed.level - 1e-6 * line.length) continue;
    return fmt::format("one end is {:.6g} m below the bed at {:.6g} m", line.bed.level - end.at.z(),
                       line.bed.level);
  }
  return "";
}

double largest_tension(const MooringLine& line, const std::vector<Vec3>& x) {
  double largest = 0;
  for (std::size_t k = 1; k < x.size(); ++k) {
    const double strain = (x[k] - x[k - 1]).norm() * line.n / line.length - 1;
    largest = std::max(largest, answer_of(line.block, strain).force);
  }
  return largest;
}

}  // namespace

AxialAnswer answer_of(const TrussBlock& block, double strain) {
  if (strain < 0) return {};
  if (block.law.empty()) {
    return {block.EA * strain, block.EA, 0.5 * block.EA * strain * strain};
  }
  AxialAnswer a;
  for (const TrussCorner& corner : block.law) {
    const double beyond = strain - corner.strain;
    if (beyond < 0) continue;
    a.force += corner.slope * beyond;
    a.slope += corner.slope;
    a.energy += 0.5 * corner.slope * beyond * beyond;
  }
  return a;
}

LineStart start_of(const MooringLine& line, const Vec3& gravity) {
  LineStart start;
  start.trouble = trouble_of(line);
  if (!start.trouble.empty()) return start;
  ChainAtRest chain = chain_of(line, -gravity.z());
  start.x = guess(line, (line.block.mu - line.displaced()) * -gravity.z());
  start.friction.assign(start.x.size(), Vec3::Zero());
  RestResult rest;
  double change = 1;
  double scale = 0;
  for (int round = 0; round < 100; ++round) {
    std::vector<Vec3> load = start.friction;
    for (std::size_t k = 0; k < load.size(); ++k) load[k] += load_on(line, gravity, start.x, k);
    change = 0;
    for (std::size_t k = 0; k < load.size(); ++k) {
      scale = std::max(scale, load[k].norm());
      if (round > 0) change = std::max(change, (load[k] - chain.load[k]).norm());
    }
    if (round > 0 && change <= 1e-12 * scale) break;
    chain.load = std::move(load);
    rest = bring_to_rest(chain, start.x);
    if (!rest.found) break;
    start.friction = friction_of(line, chain, start.x);
  }
  start.largest = largest_tension(line, start.x);
  if (!rest.found || change > 1e-6 * scale) {
    start.trouble = fmt::format(
        "no place to rest was found: after {} rounds {:.3g} N are not in balance, of {:.3g} N in "
        "the line",
        rest.iterations, std::max(rest.largest, change), start.largest);
  } else if (line.block.strength > 0 && start.largest >= line.block.strength) {
    start.trouble = fmt::format(
        "breaks at the start: its tension at rest is {:.6g} N, its strength {:.6g} N; it is {:.6g} "
        "m long, its ends are {:.6g} m apart",
        start.largest, line.block.strength, line.length,
        (line.ends[1].at - line.ends[0].at).norm());
  }
  return start;
}

}  // namespace gannet
