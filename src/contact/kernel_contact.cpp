#include "contact/kernel_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/parallel.hpp"
#include "contact/outer_faces.hpp"
#include "contact/particle_list.hpp"
#include "contact/track_contact.hpp"
#include "plan/effect.hpp"

namespace gannet {

namespace {
namespace kernel_contact {

constexpr Index row_chunk = 64;

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

double area_of(const Surface& surface, const Nodes& nodes, const Segment& g) {
  const auto x = [&](std::size_t k) { return xyz(nodes.x[at(surface.node[g.corner[k]])]); };
  if (g.n_corners == 2) return (x(1) - x(0)).norm();
  if (g.n_corners == 3) return 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
  return 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
}

/// Volumes of the nodes from those elements that are still there.
void add_up_volumes(KernelContact& c) {
  c.V_node.assign(c.surface.node.size(), 0);
  for (std::size_t s = 0; s < c.surface.segments.size(); ++s) {
    if (has_left(c.surface, static_cast<Index>(s))) continue;
    const Segment& g = c.surface.segments[s];
    for (int k = 0; k < g.n_corners; ++k) c.V_node[at(g.corner[at(k)])] += c.V_share[s];
  }
}

/// For each node its pairs, in their order.
void turn_round(KernelContact& c) {
  c.node_begin.assign(c.surface.node.size() + 1, 0);
  for (const Index j : c.candidates.segment) ++c.node_begin[at(j) + 1];
  for (std::size_t j = 0; j < c.surface.node.size(); ++j) c.node_begin[j + 1] += c.node_begin[j];
  c.pair_of_node.resize(c.candidates.segment.size());
  std::vector<Index> next(c.node_begin.begin(), c.node_begin.end() - 1);
  for (std::size_t pair = 0; pair < c.candidates.segment.size(); ++pair) {
    c.pair_of_node[at(next[at(c.candidates.segment[pair])]++)] = static_cast<Index>(pair);
  }
}

void finish_list(KernelContact& c) {
  turn_round(c);
  c.pair_force.resize(c.candidates.segment.size());
  c.pair_stiffness.resize(c.candidates.segment.size());
  c.particle_stiffness.resize(at(c.candidates.n_rows()));
}

/// Puts the places of particles and nodes where the list is made from.
void take_places(const Scene& scene, KernelContact& c) {
  const auto x = particle_lines(scene, scene.nodes.x);
  std::copy(x.begin(), x.end(), c.x_search.begin());
  std::copy(c.surface.x.begin(), c.surface.x.end(), c.node_x_search.begin());
}

/// The list from the positions in x_search and node_x_search.
void make_list(const Scene& scene, KernelContact& c) {
  SegmentSearch what{.points = owned_lines(scene, c.x_search),
                     .group = {scene.particle_part.data(), at(scene.particles.size())},
                     .wanted_group = c.particle_part,
                     .corner_points = c.node_x_search,
                     .segments = c.points,
                     .periods = *c.periods};
  what.reach = c.law.kernel.reach() + std::max(0.0, c.search_numbers[0]);
  find_candidates(what, c.candidates);
  finish_list(c);
}

/// The skin of a new list: a quarter of a spacing, up to a whole one.
double skin_of(const Scene& scene, const KernelContact& c, const Step& step) {
  const double dp = std::pow(c.V_particle, 1.0 / c.law.kernel.dimension);
  return list_skin(scene, c.surface, *c.periods, step.dt_old, {0.25 * dp, dp});
}

/// What one row, a particle, adds up over its nodes.
struct RowSum {
  Vec3 force = Vec3::Zero();
  Index active = 0;
  RowSum operator+(const RowSum& other) const {
    return {force + other.force, active + other.active};
  }
};

/// Forces of the pairs of a row; adds their sum to the particle.
RowSum push_particle(Scene& scene, KernelContact& c, Index row, const Vec3& moved) {
  const Index point = c.candidates.point[row];
  Line& f = scene.nodes.f[at(scene.particles.begin + point)];
  const Vec3 x = xyz(scene.nodes.x[at(scene.particles.begin + point)]);
  const bool repeats = !c.candidates.image.empty();
  const Vec3 place = repeats ? image_near(*c.periods, x, xyz(c.x_search[point]) + moved) : x;
  const double reach2 = std::pow(c.law.kernel.reach(), 2);
  RowSum sum;
  double stiffness = 0;
  for (Index e = c.candidates.begin[row]; e < c.candidates.begin[row + 1]; ++e) {
    const Index j = c.candidates.segment[e];
    const Vec3 here = repeats ? image_of(*c.periods, place, c.candidates.image[e]) : place;
    const Vec3 r = here - xyz(c.surface.x[j]);
    const double r2 = r.squaredNorm();
    c.pair_force[at(e)].setZero();
    c.pair_stiffness[at(e)] = 0;
    const double VV = c.V_particle * c.V_node[at(j)];
    if (!(r2 < reach2) || VV == 0) continue;
    const double distance = std::sqrt(r2);
    c.pair_force[at(e)] = VV * c.law.force_by_distance(distance) * r;
    c.pair_stiffness[at(e)] = VV * c.law.stiffness_at(distance);
    stiffness += c.pair_stiffness[at(e)];
    sum.force += c.pair_force[at(e)];
    sum.active = 1;
  }
  c.particle_stiffness[at(row)] = stiffness;
  add_xyz(f, sum.force);
  return sum;
}

/// The opposite forces, gathered by node.
void push_nodes(Scene& scene, KernelContact& c) {
  parallel_for(c.surface.n_nodes(), row_chunk, [&](Index begin, Index end) {
    for (Index j = begin; j < end; ++j) {
      Vec3 force = Vec3::Zero();
      double stiffness = 0;
      for (Index k = c.node_begin[at(j)]; k < c.node_begin[at(j) + 1]; ++k) {
        const auto pair = at(c.pair_of_node[at(k)]);
        force -= c.pair_force[pair];
        stiffness += c.pair_stiffness[pair];
      }
      add_xyz(scene.nodes.f[at(c.surface.node[j])], force);
      c.node_stiffness[at(j)] = stiffness;
    }
  });
}

/// Work of the forces of this level on particles and nodes along the paths that they count on [J].
Work work_of_pairs(const Scene& scene, KernelContact& c, const Step& step) {
  for (std::size_t j = 0; j < c.surface.node.size(); ++j) {
    c.node_path[j] = work_path(scene.nodes, c.surface.node[j], step);
  }
  return parallel_sum(
      c.candidates.n_rows(), row_chunk, Work(Work::Zero()), [&](Index begin, Index end) {
        Work work = Work::Zero();
        for (Index row = begin; row < end; ++row) {
          const WorkPath path =
              work_path(scene.nodes, scene.particles.begin + c.candidates.point[row], step);
          for (Index e = c.candidates.begin[row]; e < c.candidates.begin[row + 1]; ++e) {
            const WorkPath& of_node = c.node_path[at(c.candidates.segment[e])];
            work += work_along(path - of_node, c.pair_force[at(e)]);
          }
        }
        return work;
      });
}

ContactRate rate_of(const Scene& scene, const KernelContact& c) {
  ContactRate rate;
  const auto consider = [&](double omega2, Index node) {
    if (omega2 > rate.omega2) rate = {omega2, node};
  };
  for (Index row = 0; row < c.candidates.n_rows(); ++row) {
    const Index node = scene.particles.begin + c.candidates.point[row];
    consider(2 * c.particle_stiffness[at(row)] * scene.nodes.v[at(node)].w, node);
  }
  std::map<Index, double> of_bodies;
  for (std::size_t j = 0; j < c.node_stiffness.size(); ++j) {
    const Index node = c.surface.node[j];
    const Index leader = c.followers->leader_of(node);
    if (leader < 0) {
      consider(2 * c.node_stiffness[j] * scene.nodes.v[at(node)].w, node);
    } else {
      of_bodies[leader] += 2 * c.node_stiffness[j] * c.followers->inverse_mass[at(node)];
    }
  }
  for (const auto& [leader, omega2] : of_bodies) consider(omega2, leader);
  return rate;
}

/// Fields and measures.
void track(Scene& scene, KernelContact& c) {
  const auto none = GhostRule::none;
  c.x_search.resize(at(scene.particles.size()));
  c.node_x_search.resize(c.surface.node.size());
  c.search_numbers = {-1, 0, 0};
  track_contact(scene, c.name,
                {line_field("x_search", "m", "", Over::particles, c.x_search, 0, 3, none),
                 line_field("node_x_search", "m", "", Over::scene, c.node_x_search, 0, 3, none),
                 plain_field("search_numbers", "", "", Over::scene, c.search_numbers, 1, none)},
                {.force = [&c] { return c.on_surface; },
                 .active = [&c] { return at(c.active); },
                 .numbers = &c.search_numbers,
                 .overlaps = 1});
}

std::string who_limits(const Scene& scene, const KernelContact& c) {
  if (c.rate.node < 0) return "contact " + c.name;
  return fmt::format("contact {}: {} {}", c.name,
                     scene.particles.contains(c.rate.node) ? "particle" : "node",
                     scene.nodes.id[at(c.rate.node)]);
}

}  // namespace kernel_contact
}  // namespace

KernelContact& make_kernel_contact(Scene& scene, const std::string& name, int particle_part,
                                   int surface_part) {
  KernelContact& c = scene.store.get<KernelContacts>().list.emplace_back();
  c.name = name;
  c.particle_part = particle_part;
  c.surface_part = surface_part;
  c.followers = &scene.store.get<Followers>();
  c.periods = &scene.store.get<Periods>();
  const Part& part = scene.parts[kernel_contact::at(surface_part)];
  c.surface = make_surface(part.kind == "solid" ? outer_faces(part).faces : part);
  for (Index j = 0; j < c.surface.n_nodes(); ++j) c.points.push_back({j, j, j, j});
  c.node_stiffness.resize(c.surface.node.size());
  c.node_path.resize(c.surface.node.size());
  kernel_contact::track(scene, c);
  scene.index_lists.push_back({"contact." + name + ".candidates", &c.candidates.point});
  scene.after_restart.push_back([&scene, &c] {
    if (c.search_numbers[0] >= 0) kernel_contact::make_list(scene, c);
  });
  return c;
}

double longest_edge(const Nodes& nodes, const Surface& surface) {
  double longest = 0;
  for (const Segment& g : surface.segments) {
    for (int k = 0; k < g.n_corners; ++k) {
      const Index a = surface.node[g.corner[kernel_contact::at(k)]];
      const Index b = surface.node[g.corner[kernel_contact::at((k + 1) % g.n_corners)]];
      longest = std::max(
          longest,
          (xyz(nodes.x[kernel_contact::at(a)]) - xyz(nodes.x[kernel_contact::at(b)])).norm());
    }
  }
  return longest;
}

void take_volumes(KernelContact& c, const Nodes& nodes, double thickness) {
  c.thickness = thickness;
  c.V_share.clear();
  for (const Segment& g : c.surface.segments) {
    c.V_share.push_back(kernel_contact::area_of(c.surface, nodes, g) * thickness / g.n_corners);
  }
}

void list_pairs_of_now(Scene& scene, KernelContact& c) {
  update_surface(scene.nodes, c.surface);
  kernel_contact::add_up_volumes(c);
  kernel_contact::take_places(scene, c);
  kernel_contact::make_list(scene, c);
}

void search(Scene& scene, KernelContact& c, const Step& step) {
  update_surface(scene.nodes, c.surface);
  kernel_contact::add_up_volumes(c);
  const auto x = particle_lines(scene, scene.nodes.x);
  if (c.search_numbers[0] >= 0) {
    const Array<Index> before = c.candidates.point;
    order_rows(c.candidates);
    if (c.candidates.point != before) kernel_contact::finish_list(c);
    const double moved = relative_displacement(x, owned_lines(scene, c.x_search), c.surface.x,
                                               c.node_x_search, *c.periods);
    if (moved <= c.search_numbers[0]) return;
  }
  kernel_contact::take_places(scene, c);
  c.search_numbers[0] = kernel_contact::skin_of(scene, c, step);
  kernel_contact::make_list(scene, c);
}

void apply_kernel_contact(Scene& scene, KernelContact& c) {
  const Vec3 moved =
      c.periods->any() ? mean_displacement(c.surface.x, c.node_x_search) : Vec3(Vec3::Zero());
  const kernel_contact::RowSum sum =
      parallel_sum(c.candidates.n_rows(), kernel_contact::row_chunk, kernel_contact::RowSum{},
                   [&](Index begin, Index end) {
                     kernel_contact::RowSum part;
                     for (Index row = begin; row < end; ++row)
                       part = part + kernel_contact::push_particle(scene, c, row, moved);
                     return part;
                   });
  kernel_contact::push_nodes(scene, c);
  c.on_surface = -sum.force;
  c.active = sum.active;
  c.rate = kernel_contact::rate_of(scene, c);
}

void add_kernel_contact(Scene& scene, KernelContact& c, Model& model, Ledger& ledger) {
  model.plan.add({.name = "contact " + c.name,
                  .reason = asked_for_at(c.where),
                  .stage = Stage::force,
                  .reads = {"x", "v"},
                  .writes = {"f"},
                  .owns = {"contact." + c.name + ".x_search"},
                  .run =
                      [&scene, &c](const Step& step) {
                        search(scene, c, step);
                        apply_kernel_contact(scene, c);
                      },
                  .stable_dt =
                      [&scene, &c] {
                        c.limited_by = kernel_contact::who_limits(scene, c);
                        return contact_step(c.rate.omega2, 0);
                      },
                  .limited_by = [&c] { return c.limited_by; }});
  LedgerEntry& entry = ledger.entry("contact", c.name);
  model.plan.add({.name = "contact " + c.name + ": work",
                  .reason = asked_for_at(c.where),
                  .stage = Stage::look,
                  .reads = {"v", "f"},
                  .run = [&scene, &c, &entry](const Step& step) {
                    entry.add_work(-kernel_contact::work_of_pairs(scene, c, step));
                  }});
}

}  // namespace gannet
