#include "contact/force.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr Index force_chunk = 512;

/// Sum of N_i a_i over the corners of a gap's segment, a: one vector a surface node.
template <class T, class F>
T at_foot(const Surface& surface, const Gap& gap, F&& of_node) {
  const Segment& g = surface.segments[static_cast<std::size_t>(gap.segment)];
  T sum = T::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(g.n_corners); ++k) {
    sum += gap.N[k] * of_node(static_cast<std::size_t>(g.corner[k]));
  }
  return sum;
}

std::size_t node_of_row(const ContactInput& in, std::size_t row) {
  const Index point = in.candidates->point[row];
  return static_cast<std::size_t>(in.point_node.empty()
                                      ? in.points.begin + point
                                      : in.point_node[static_cast<std::size_t>(point)]);
}

double stiffness_of_row(const ContactInput& in, const ContactLaw& law, std::size_t row) {
  return in.stiffness.empty() ? law.stiffness(in.nodes->x[node_of_row(in, row)].w)
                              : in.stiffness[row];
}

Vec3 relative_velocity(const ContactInput& in, std::size_t row) {
  const Surface& surface = *in.surface;
  const Vec3 foot = at_foot<Vec3>(surface, in.gaps[row], [&](std::size_t i) {
    return xyz(in.nodes->v[static_cast<std::size_t>(surface.node[i])]);
  });
  return xyz(in.nodes->v[node_of_row(in, row)]) - foot;
}

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Sum of k b b^T over the rows on a rigid body (largest_rate()).
struct BodyStiffness {
  Vec3 centre;
  double mass_root;   ///< M^(-1/2) [kg^(-1/2)]
  Mat3 inertia_root;  ///< R [(kg m^2)^(-1/2)]
  Mat6 sum = Mat6::Zero();

  BodyStiffness(const Carrier& body, const Vec3& at)
      : centre(at), mass_root(std::sqrt(body.inverse_mass)) {
    const Mat3 A = body.q.toRotationMatrix();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(body.inverse_inertia);
    inertia_root = A * axes.operatorSqrt() * A.transpose();
  }
  void add(double k, const Vec3& foot, const Vec3& d) {
    Eigen::Matrix<double, 6, 1> b;
    b << mass_root * d, inertia_root * (foot - centre).cross(d);
    sum += k * b * b.transpose();
  }
  [[nodiscard]] double omega2() const {
    return 2 * Eigen::SelfAdjointEigenSolver<Mat6>(sum, Eigen::EigenvaluesOnly).eigenvalues()[5];
  }
};

using BodyStiffnesses = std::map<Index, BodyStiffness>;  // by leader

BodyStiffnesses stiffness_of_bodies(const ContactInput& in) {
  BodyStiffnesses bodies;
  if (in.carriers == nullptr) return bodies;
  for (const Carrier& body : in.carriers->list) {
    if (body.node < 0) continue;
    bodies.try_emplace(body.node, body, xyz(in.nodes->x[static_cast<std::size_t>(body.node)]));
  }
  return bodies;
}

/// Adds row r to a body by the share of the corners that belong to it: sum N_c b_c over them is
/// N_B b at their own foot.
void add_share(const ContactInput& in, const ContactLaw& law, std::size_t r, Index leader,
               BodyStiffness& body) {
  const auto of_corner = [&](std::size_t i) -> Eigen::Vector4d {
    if (in.followers->leader_of(in.surface->node[i]) != leader) return Eigen::Vector4d::Zero();
    return xyz(in.surface->x[i]).homogeneous();
  };
  const Gap& gap = in.gaps[r];
  const auto sum = at_foot<Eigen::Vector4d>(*in.surface, gap, of_corner);
  const double share = sum[3];
  if (!(share > 0)) return;
  const double k = share * stiffness_of_row(in, law, r);
  const Vec3 foot = sum.head<3>() / share;
  if (law.friction > 0) {
    for (Eigen::Index d = 0; d < 3; ++d) body.add(k, foot, Vec3::Unit(d));
  } else {
    body.add(k, foot, gap.normal);
  }
}

/// Raises the rate to that of the rigid bodies that segments belong to, wholly or in part.
void consider_bodies(const ContactInput& in, const ContactLaw& law, BodyStiffnesses& bodies,
                     ContactRate& rate) {
  for (std::size_t r = 0; r < static_cast<std::size_t>(in.candidates->n_rows()); ++r) {
    if (in.gaps[r].segment < 0) continue;
    const Segment& g = in.surface->segments[static_cast<std::size_t>(in.gaps[r].segment)];
    std::array<Index, 4> seen{-1, -1, -1, -1};
    for (std::size_t c = 0; c < static_cast<std::size_t>(g.n_corners); ++c) {
      const auto corner = static_cast<std::size_t>(g.corner[c]);
      const Index leader = in.followers->leader_of(in.surface->node[corner]);
      if (leader < 0 || std::ranges::find(seen, leader) != seen.end()) continue;
      seen[c] = leader;
      const auto body = bodies.find(leader);
      if (body != bodies.end()) add_share(in, law, r, leader, body->second);
    }
  }
  for (const auto& [leader, body] : bodies) {
    const double omega2 = body.omega2();
    if (omega2 > rate.omega2) rate = {omega2, leader};
  }
}

/// The same of other leaders, of which only the inverse masses of their followers are known.
void consider_leaders(const ContactInput& in, std::span<const double> stiffness,
                      const BodyStiffnesses& bodies, ContactRate& rate) {
  std::map<Index, double> omega2;  // by leader
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    const Index node = in.surface->node[i];
    const Index leader = in.followers->leader_of(node);
    if (leader < 0 || bodies.contains(leader)) continue;
    omega2[leader] += 2 * stiffness[i] * in.followers->inverse_mass[static_cast<std::size_t>(node)];
  }
  for (const auto& [leader, value] : omega2) {
    if (value > rate.omega2) rate = {value, leader};
  }
}

}  // namespace

Vec3 penalty_force(double k, const Gap& gap) { return gap.normal * (k * gap.penetration); }

Vec3 damping_force(double zeta, double k, double m, double v_n, const Gap& gap) {
  const double spring = k * gap.penetration;
  const double c = 2 * zeta * std::sqrt(k * m);
  return gap.normal * std::clamp(-c * v_n, -spring, spring);
}

Vec3 friction_force(const Vec3& t, const Vec3& slip, double k, double limit, const Gap& gap) {
  Vec3 trial = t - k * slip;
  trial -= gap.normal * gap.normal.dot(trial);
  const double size = trial.norm();
  return size > limit ? Vec3(trial * (limit / size)) : trial;
}

void contact_forces(const ContactInput& in, const ContactLaw& law, std::span<Line> t,
                    ContactForces& forces) {
  parallel_for(in.candidates->n_rows(), force_chunk, [&](Index begin, Index end) {
    for (auto r = static_cast<std::size_t>(begin); r < static_cast<std::size_t>(end); ++r) {
      const Gap& gap = in.gaps[r];
      const bool active = gap.segment >= 0 && gap.penetration > 0;
      const double m = in.nodes->x[node_of_row(in, r)].w;
      const double k = stiffness_of_row(in, law, r);
      forces.normal[r] = active ? penalty_force(k, gap) : Vec3(Vec3::Zero());
      Vec3 total = forces.normal[r];
      if (law.damping > 0) {
        forces.damping[r].setZero();
        if (active) {
          const double v_n = gap.normal.dot(relative_velocity(in, r));
          forces.damping[r] = damping_force(law.damping, k, m, v_n, gap);
        }
        total += forces.damping[r];
      }
      if (law.friction > 0) {
        Line& memory = t[static_cast<std::size_t>(in.candidates->point[r])];
        forces.friction[r].setZero();
        if (active) {
          const Vec3 slip = relative_velocity(in, r) * in.dt_old;
          const double limit = law.friction * gap.normal.dot(total);
          forces.friction[r] = friction_force(xyz(memory), slip, k, limit, gap);
        }
        set_xyz(memory, forces.friction[r]);
        total += forces.friction[r];
      }
      forces.total[r] = total;
    }
  });
}

Scattered scatter_forces(const ContactInput& in, const ContactLaw& law, const ContactForces& forces,
                         Nodes& nodes, std::span<double> stiffness) {
  Scattered result;
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  const auto n_rows = static_cast<std::size_t>(in.candidates->n_rows());
  for (std::size_t r = 0; r < n_rows; ++r) {
    const Gap& gap = in.gaps[r];
    if (gap.segment < 0) continue;
    const std::size_t p = node_of_row(in, r);
    const double k = stiffness_of_row(in, law, r);
    const Segment& g = in.surface->segments[static_cast<std::size_t>(gap.segment)];
    const auto n_corners = static_cast<std::size_t>(g.n_corners);
    for (std::size_t c = 0; c < n_corners; ++c) {
      stiffness[static_cast<std::size_t>(g.corner[c])] += k * gap.N[c];
    }
    if (!(gap.penetration > 0)) continue;
    const Vec3& f = forces.total[r];
    add_xyz(nodes.f[p], f);
    for (std::size_t c = 0; c < n_corners; ++c) {
      const auto node = in.surface->node[static_cast<std::size_t>(g.corner[c])];
      add_xyz(nodes.f[static_cast<std::size_t>(node)], -gap.N[c] * f);
    }
    result.on_surface -= f;
    ++result.active;
  }
  return result;
}

ContactRate largest_rate(const ContactInput& in, const ContactLaw& law,
                         std::span<const double> stiffness) {
  ContactRate rate;
  const auto consider = [&](double sum, std::size_t node) {
    const double omega2 = 2 * sum * in.nodes->v[node].w;
    if (omega2 > rate.omega2) rate = {omega2, static_cast<Index>(node)};
  };
  const auto n_rows = static_cast<std::size_t>(in.candidates->n_rows());
  for (std::size_t r = 0; r < n_rows; ++r) {
    if (in.gaps[r].segment < 0) continue;
    const std::size_t p = node_of_row(in, r);
    consider(stiffness_of_row(in, law, r), p);
  }
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    consider(stiffness[i], static_cast<std::size_t>(in.surface->node[i]));
  }
  if (in.followers == nullptr || in.followers->leader.empty()) return rate;
  BodyStiffnesses bodies = stiffness_of_bodies(in);
  consider_bodies(in, law, bodies, rate);
  consider_leaders(in, stiffness, bodies, rate);
  return rate;
}

double contact_step(double omega2, double zeta) {
  if (!(omega2 > 0)) return std::numeric_limits<double>::infinity();
  return 0.4 * 2 / std::sqrt(omega2) * (std::sqrt(1 + zeta * zeta) - zeta);
}

double step_beside(double d, double omega2, double zeta) {
  if (!(omega2 > 0)) return d;
  constexpr double a2 = 0.672078;  // (1.04^(1/2) - 0.2)^2
  const double omega = std::sqrt(omega2);
  const double w = omega / 1.9;
  const double b = 0.9 * (1 - a2) / d + 2 * zeta * w;
  const double a = 0.81 * a2 / (d * d) + w * w;
  return std::min({d, 1.25 / omega, 2 / (b + std::sqrt(b * b + 4 * a))});
}

Work contact_work(const ContactInput& in, std::span<const Vec3> force,
                  std::span<const WorkPath> point_path_of_row,
                  std::span<const WorkPath> node_path) {
  const auto rows = [&](Index begin, Index end) {
    Work work = Work::Zero();
    for (auto r = static_cast<std::size_t>(begin); r < static_cast<std::size_t>(end); ++r) {
      const Gap& gap = in.gaps[r];
      if (gap.segment < 0 || !(gap.penetration > 0)) continue;
      const WorkPath foot = at_foot<WorkPath>(
          *in.surface, gap, [&](std::size_t i) -> const WorkPath& { return node_path[i]; });
      work += work_along(point_path_of_row[r] - foot, force[r]);
    }
    return work;
  };
  return parallel_sum(in.candidates->n_rows(), force_chunk, Work(Work::Zero()), rows);
}

}  // namespace gannet
