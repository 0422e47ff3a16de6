#include "contact/node_to_segment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/parallel.hpp"
#include "contact/particle_list.hpp"
#include "contact/track_contact.hpp"
#include "plan/effect.hpp"
#include "plan/linked_weight.hpp"
#include "plan/model_of_part.hpp"

namespace gannet {

namespace {
namespace node_to_segment {

ContactInput input_of(const Scene& scene, const NodeToSegment& c, const Step& step) {
  return {&scene.nodes, scene.particles, &c.surface,  &c.candidates,
          c.gaps,       step.dt_old,     c.followers, c.carriers};
}

/// Arrays over rows; they grow only when a list is made.
void size_rows(NodeToSegment& c) {
  const auto n = static_cast<std::size_t>(c.candidates.n_rows());
  c.gaps.resize(n);
  c.point_path.resize(n);
  c.forces.normal.resize(n);
  c.forces.total.resize(n);
  if (c.law.friction > 0) c.forces.friction.resize(n);
  if (c.law.damping > 0) c.forces.damping.resize(n);
}

/// The list from the positions in x_search and node_x_search.
void make_list(const Scene& scene, NodeToSegment& c) {
  const SegmentSearch what{owned_lines(scene, c.x_search),
                           scene.particle_part,
                           c.particle_part,
                           c.node_x_search,
                           c.surface.corners,
                           0,
                           *c.periods};
  SegmentSearch with_reach = what;
  with_reach.group = {scene.particle_part.data(), what.points.size()};
  with_reach.reach = c.range.near + c.search_numbers[0];
  find_candidates(with_reach, c.candidates);
  size_rows(c);
}

/// The skin of a new list: a third of the contact distance, up to three.
double skin_of(const Scene& scene, const NodeToSegment& c, const Step& step) {
  const double d = c.range.contact;
  return list_skin(scene, c.surface, *c.periods, step.dt_old, {0.35 * d, 3 * d});
}

/// What particles remember when they are not near any segment: nothing.
void forget_far(const Scene& scene, NodeToSegment& c) {
  std::size_t row = 0;
  const auto n_rows = static_cast<std::size_t>(c.candidates.n_rows());
  for (Index i = 0; i < scene.particles.size(); ++i) {
    if (row < n_rows && c.candidates.point[row] == i) {
      ++row;
      continue;
    }
    const auto p = static_cast<std::size_t>(i);
    c.side[p] = 0;
    c.offset[p] = 0;
    if (!c.tangential.empty()) c.tangential[p] = {};
  }
}

void size_memory(const Scene& scene, NodeToSegment& c, bool friction) {
  const auto n = static_cast<std::size_t>(scene.particles.size());
  c.x_search.resize(n);
  c.side.assign(n, 0);
  c.offset.assign(n, 0);
  if (friction) c.tangential.resize(n);
  c.node_x_search.resize(c.surface.node.size());
  c.search_numbers = {-1, 0, 0};
}

Vec3 friction_on_surface(const NodeToSegment& c) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : c.forces.friction) sum -= f;
  return sum;
}

/// Friction acts along the surface, as viscosity does, and counts as such in probes.
void track(Scene& scene, NodeToSegment& c) {
  const auto none = GhostRule::none;
  std::vector<Field> fields{
      line_field("x_search", "m", "", Over::particles, c.x_search, 0, 3, none),
      plain_field("side", "1", "", Over::particles, c.side, 1, none),
      plain_field("offset", "m", "", Over::particles, c.offset, 1, none)};
  ContactTold told{.force = [&c] { return c.scattered.on_surface; },
                   .active = [&c] { return c.scattered.active; },
                   .numbers = &c.search_numbers,
                   .overlaps = 1};
  if (!c.tangential.empty()) {
    fields.push_back(line_field("tangential", "N", "", Over::particles, c.tangential, 0, 3, none));
    told.viscous_force = [&c] { return friction_on_surface(c); };
  }
  fields.push_back(line_field("node_x_search", "m", "", Over::scene, c.node_x_search, 0, 3, none));
  fields.push_back(plain_field("search_numbers", "", "", Over::scene, c.search_numbers, 1, none));
  track_contact(scene, c.name, std::move(fields), told);
}

bool is_linked(const NodeToSegment& c) { return !c.link.nodes.empty(); }

/// Paths of rows and nodes; those of nodes of another model are not known here and stay 0.
void find_paths(const Scene& scene, NodeToSegment& c, const Step& step) {
  for (std::size_t i = 0; i < c.surface.node.size(); ++i) {
    c.node_path[i] =
        is_linked(c) ? WorkPath(WorkPath::Zero()) : work_path(scene.nodes, c.surface.node[i], step);
  }
  for (std::size_t r = 0; r < c.gaps.size(); ++r) {
    if (c.gaps[r].segment < 0 || !(c.gaps[r].penetration > 0)) continue;
    c.point_path[r] = work_path(scene.nodes, scene.particles.begin + c.candidates.point[r], step);
  }
}

void add_linked_force(Scene& scene, NodeToSegment& c, const char* kind, LedgerEntry* entry,
                      const std::vector<Vec3>& of_rows) {
  if (entry == nullptr) return;
  const std::size_t n = c.surface.node.size();
  LinkedForce& force = c.linked.emplace_back();
  force.entry = entry;
  force.of_rows = &of_rows;
  force.f_level.assign(n, {});
  force.f.assign(n, {});
  Field f = line_field("contact." + c.name + ".linked_" + kind, "N", "", Over::scene, force.f_level,
                       0, 3, GhostRule::none);
  f.owner = "contact " + c.name;
  scene.fields.push_back(std::move(f));
}

/// The operation that adds up the works, and its ledger entries.
void add_work(Scene& scene, NodeToSegment& c, Model& model, Ledger& ledger) {
  LedgerEntry* normal = &ledger.entry("contact", c.name);
  LedgerEntry* friction = c.law.friction > 0 ? &ledger.entry("friction", c.name) : nullptr;
  LedgerEntry* damping = c.law.damping > 0 ? &ledger.entry("contact_damping", c.name) : nullptr;
  Operation op;
  op.name = "contact " + c.name + ": work";
  op.reason = asked_for_at(c.where);
  op.stage = Stage::look;
  op.reads = {"v", "f"};
  op.run = [&scene, &c, normal, friction, damping](const Step& step) {
    find_paths(scene, c, step);
    const ContactInput in = input_of(scene, c, step);
    const auto work = [&](const std::vector<Vec3>& force) -> Work {
      return contact_work(in, force, c.point_path, c.node_path);
    };
    normal->add_work(-work(c.forces.normal));
    if (friction != nullptr) friction->add_work(-work(c.forces.friction));
    if (damping != nullptr) damping->add_work(-work(c.forces.damping));
    for (LinkedForce& force : c.linked) add_linked_work(in, c.link, force);
  };
  model.plan.add(std::move(op));
  if (!is_linked(c)) return;
  add_linked_force(scene, c, "normal", normal, c.forces.normal);
  add_linked_force(scene, c, "friction", friction, c.forces.friction);
  add_linked_force(scene, c, "damping", damping, c.forces.damping);
}

std::string who_limits(const Scene& scene, const NodeToSegment& c) {
  if (c.rate.node < 0) return "contact " + c.name;
  const auto node = static_cast<std::size_t>(c.rate.node);
  return fmt::format("contact {}: {} {}", c.name,
                     scene.particles.contains(c.rate.node) ? "particle" : "node",
                     scene.nodes.id[node]);
}

}  // namespace node_to_segment
}  // namespace

NodeToSegment& make_node_to_segment(Scene& scene, const std::string& name, int particle_part,
                                    int surface_part, bool friction) {
  NodeToSegment& c = scene.store.get<NodeToSegments>().list.emplace_back();
  c.name = name;
  c.particle_part = particle_part;
  c.surface_part = surface_part;
  c.followers = &scene.store.get<Followers>();
  c.carriers = &scene.store.get<Carriers>();
  c.periods = &scene.store.get<Periods>();
  c.surface = make_surface(scene.parts[static_cast<std::size_t>(surface_part)]);
  c.node_stiffness.resize(c.surface.node.size());
  c.node_path.resize(c.surface.node.size());
  node_to_segment::size_memory(scene, c, friction);
  node_to_segment::track(scene, c);
  scene.index_lists.push_back({"contact." + name + ".candidates", &c.candidates.point});
  scene.after_restart.push_back([&scene, &c] {
    if (c.search_numbers[0] >= 0) node_to_segment::make_list(scene, c);
  });
  return c;
}

bool search(Scene& scene, NodeToSegment& c, const Step& step) {
  update_surface(scene.nodes, c.surface);
  const bool first = c.search_numbers[0] < 0;
  const auto x = particle_lines(scene, scene.nodes.x);
  if (!first) {
    order_rows(c.candidates);
    const double moved = relative_displacement(x, owned_lines(scene, c.x_search), c.surface.x,
                                               c.node_x_search, *c.periods);
    if (moved <= c.search_numbers[0]) return false;
  }
  std::copy(x.begin(), x.end(), c.x_search.begin());
  std::copy(c.surface.x.begin(), c.surface.x.end(), c.node_x_search.begin());
  c.search_numbers[0] = node_to_segment::skin_of(scene, c, step);
  node_to_segment::make_list(scene, c);
  node_to_segment::forget_far(scene, c);
  return first;
}

void apply_contact(Scene& scene, NodeToSegment& c, const Step& step, bool first) {
  const GapMemory memory{c.side, c.offset};
  PointImages images{*c.periods, owned_lines(scene, c.x_search)};
  if (c.periods->any()) images.moved = mean_displacement(c.surface.x, c.node_x_search);
  const Overlaps overlaps = find_gaps(c.surface, c.candidates, particle_lines(scene, scene.nodes.x),
                                      c.range, first, memory, c.gaps, images);
  if (first) {
    c.search_numbers[1] = overlaps.count;
    c.search_numbers[2] = overlaps.largest;
  }
  const ContactInput in = node_to_segment::input_of(scene, c, step);
  contact_forces(in, c.law, c.tangential, c.forces);
  c.scattered = scatter_forces(in, c.law, c.forces, scene.nodes, c.node_stiffness);
  c.rate = largest_rate(in, c.law, c.node_stiffness);
}

void add_node_to_segment(Scene& scene, NodeToSegment& c, Models& models) {
  Model& model = models.of_node(scene.particles.begin);
  Model& of_surface = model_of_part(scene, models, c.surface_part);
  if (&of_surface != &model) {
    c.link.name = "contact " + c.name;
    c.link.slow = &model;
    c.link.fast = &of_surface;
    c.link.nodes.assign(c.surface.node.begin(), c.surface.node.end());
    const std::vector<Index> bodies = bodies_of(scene, c.link, *c.followers);
    c.link.nodes.insert(c.link.nodes.end(), bodies.begin(), bodies.end());
    open_link(scene, c.link);
    move_weights(scene, c.link, bodies);
  }
  Operation op;
  op.name = "contact " + c.name;
  op.reason = asked_for_at(c.where);
  op.stage = Stage::force;
  op.reads = {"x", "v"};
  op.writes = {"f"};
  op.owns = {"contact." + c.name + ".side", "contact." + c.name + ".offset"};
  op.run = [&scene, &c](const Step& step) {
    const bool first = search(scene, c, step);
    apply_contact(scene, c, step, first);
  };
  op.stable_dt = [&scene, &c] {
    c.limited_by = node_to_segment::who_limits(scene, c);
    return contact_step(c.rate.omega2, c.law.damping);
  };
  op.limited_by = [&c] { return c.limited_by; };
  model.plan.add(std::move(op));
  if (node_to_segment::is_linked(c)) close_link(scene, c.link, models.ledger);
  node_to_segment::add_work(scene, c, model, models.ledger);
}

}  // namespace gannet
