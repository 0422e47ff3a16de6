#include "scene/draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "mesh/space_curve.hpp"

namespace gannet {

namespace {

/// Parts in node order: with rotations, other elements, particles; within a kind as in the case.
std::vector<std::size_t> node_order(const Draft& draft) {
  std::vector<std::size_t> order(draft.parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t k) {
    const PartDraft& p = draft.parts[k];
    return p.rotations ? 0 : (p.cell == Cell::none ? 2 : 1);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

std::vector<Vec3> cell_centres(const PartDraft& part) {
  const int n = nodes_per(part.cell);
  std::vector<Vec3> centres(part.connectivity.size() / static_cast<std::size_t>(n), Vec3::Zero());
  for (std::size_t k = 0; k < part.connectivity.size(); ++k) {
    centres[k / static_cast<std::size_t>(n)] +=
        part.points[static_cast<std::size_t>(part.connectivity[k])] / n;
  }
  return centres;
}

/// Copies the nodes of one part to [begin, ...) along the space-filling curve, and its cells.
void add_part(const PartDraft& draft, Index begin, std::int64_t& next_cell, Part& part,
              Nodes& nodes) {
  const std::vector<Index> order = curve_order(draft.points);
  std::vector<Index> node_of(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto from = static_cast<std::size_t>(order[k]);
    const std::size_t to = static_cast<std::size_t>(begin) + k;
    node_of[from] = static_cast<Index>(to);
    set_xyz(nodes.x[to], draft.points[from]);
    set_xyz(nodes.v[to], value_at(draft.velocity, 0, draft.points[from]));
    nodes.id[to] = static_cast<std::int64_t>(begin) + order[k] + 1;
  }
  part.name = draft.name;
  part.kind = draft.kind;
  part.material = draft.material;
  part.where = draft.where;
  part.cell = draft.cell;
  part.nodes = {begin, begin + static_cast<Index>(order.size())};
  if (draft.cell == Cell::none) return;
  const auto n = static_cast<std::size_t>(nodes_per(draft.cell));
  const std::vector<Index> cells = curve_order(cell_centres(draft));
  for (const Index c : cells) {
    for (std::size_t a = 0; a < n; ++a) {
      const Index corner = draft.connectivity[static_cast<std::size_t>(c) * n + a];
      part.connectivity.push_back(node_of[static_cast<std::size_t>(corner)]);
    }
    part.cell_id.push_back(next_cell + c);
  }
  next_cell += static_cast<std::int64_t>(cells.size());
}

void track_nodes(Scene& scene) {
  Nodes& n = scene.nodes;
  auto track = [&](Field f) {
    f.owner = "nodes";
    scene.fields.push_back(std::move(f));
  };
  track(line_field("x", "m", "", Over::nodes, n.x, 0, 3, GhostRule::copy_shifted));
  track(line_field("m", "kg", "", Over::nodes, n.x, 3, 1, GhostRule::copy));
  track(line_field("v", "m/s", "Velocity", Over::nodes, n.v, 0, 3, GhostRule::copy));
  track(line_field("1/m", "1/kg", "", Over::nodes, n.v, 3, 1, GhostRule::none));
  track(line_field("f", "N", "", Over::nodes, n.f, 0, 4, GhostRule::add_back));
  track(plain_field("id", "", "GlobalIds", Over::nodes, n.id, 1, GhostRule::copy));
  if (!n.rotating.empty()) {
    track(line_field("omega", "rad/s", "", Over::scene, n.omega, 0, 4, GhostRule::none));
    track(line_field("torque", "N m", "", Over::scene, n.torque, 0, 4, GhostRule::none));
  }
  if (!scene.particles.empty()) {
    track(
        plain_field("part", "", "Part", Over::particles, scene.particle_part, 1, GhostRule::copy));
  }
}

}  // namespace

Key initial_velocity_key() {
  return {.name = "initial_velocity",
          .kind = Kind::vector_function,
          .unit = dim::velocity,
          .text = "velocity at the start",
          .variables = {"x", "y", "z"}};
}

VectorFunction initial_velocity(const Keys& part, const std::vector<Vec3>& points) {
  if (!part.has("initial_velocity")) return Vec3(Vec3::Zero());
  VectorFunction v = part.vector_function("initial_velocity");
  if (v.constant()) return v;
  for (const Vec3& x : points) {
    if (value_at(v, 0, x).allFinite()) continue;
    part.complain("initial_velocity",
                  fmt::format("not finite at the point ({:g}, {:g}, {:g}) m of the part", x.x(),
                              x.y(), x.z()));
    break;
  }
  return v;
}

void assemble(const Draft& draft, Scene& scene) {
  scene.title = draft.title;
  scene.dimension = draft.dimension;
  Nodes& nodes = scene.nodes;
  std::size_t n_total = 0;
  std::size_t n_rotating = 0;
  for (const PartDraft& p : draft.parts) {
    n_total += p.points.size();
    if (p.rotations) n_rotating += p.points.size();
  }
  nodes.n_owned = static_cast<Index>(n_total);
  nodes.rotating = {0, static_cast<Index>(n_rotating)};
  nodes.x.assign(n_total, {});
  nodes.v.assign(n_total, {});
  nodes.f.assign(n_total, {});
  nodes.id.assign(n_total, 0);
  nodes.omega.assign(n_rotating, {});
  nodes.torque.assign(n_rotating, {});

  scene.parts.resize(draft.parts.size());
  Index begin = 0;
  std::int64_t next_cell = 1;
  scene.particles = {nodes.n_owned, nodes.n_owned};
  for (const std::size_t k : node_order(draft)) {
    Part& part = scene.parts[k];
    add_part(draft.parts[k], begin, next_cell, part, nodes);
    begin = part.nodes.end;
    if (!part.is_particles()) continue;
    scene.particles.begin = std::min(scene.particles.begin, part.nodes.begin);
    scene.particle_part.resize(scene.particle_part.size() + draft.parts[k].points.size(),
                               static_cast<Index>(k));
  }
  track_nodes(scene);
}

void finish_masses(Scene& scene) {
  Nodes& n = scene.nodes;
  for (std::size_t i = 0; i < n.x.size(); ++i) n.v[i].w = n.x[i].w > 0 ? 1 / n.x[i].w : 0;
  for (std::size_t i = 0; i < n.omega.size(); ++i) {
    n.omega[i].w = n.torque[i].w > 0 ? 1 / n.torque[i].w : 0;
  }
}

}  // namespace gannet
