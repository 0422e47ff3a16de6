// A contact between parts as a plan has it: fields, measures, operations, ledger.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "contact/part_contact.hpp"
#include "contact/part_planes.hpp"
#include "contact/part_search.hpp"
#include "contact/track_contact.hpp"
#include "plan/effect.hpp"

namespace gannet {

namespace {
namespace part_contact_plan {

/// Nodes of shells have a side within this share of an element at least.
constexpr double near_of_shell = 0.3;
/// A node is inside a solid up to this share of the elements at its surface.
constexpr double inside_of_solid = 0.5;

void add_direction(PartContact& c, std::size_t points, bool friction) {
  PartDirection& d = c.directions.emplace_back();
  d.points = points;
  d.segments = 1 - points;
  const std::size_t n = c.sides[points].surface.node.size();
  d.side.assign(n, 0);
  d.offset.assign(n, 0);
  if (friction) d.tangential.resize(n);
  d.node_stiffness.resize(c.sides[d.segments].surface.node.size());
  d.node_path.resize(c.sides[d.segments].surface.node.size());
}

Vec3 force_on_second(const PartContact& c) {
  Vec3 sum = Vec3::Zero();
  for (const PartDirection& d : c.directions) {
    sum += (d.segments == 1 ? 1 : -1) * d.scattered.on_surface;
  }
  return sum;
}

std::size_t active_pairs(const PartContact& c) {
  std::size_t n = 0;
  for (const PartDirection& d : c.directions) n += static_cast<std::size_t>(d.scattered.active);
  return n;
}

void track(Scene& scene, PartContact& c) {
  const auto none = GhostRule::none;
  std::vector<Field> fields{plain_field("numbers", "", "", Over::scene, c.numbers, 1, none)};
  for (std::size_t k = 0; k < c.sides.size(); ++k) {
    fields.push_back(line_field(fmt::format("{}.x_search", k), "m", "", Over::scene,
                                c.sides[k].x_search, 0, 3, none));
  }
  for (PartDirection& d : c.directions) {
    const std::string of = fmt::format("{}.", d.points);
    fields.push_back(plain_field(of + "side", "1", "", Over::scene, d.side, 1, none));
    fields.push_back(plain_field(of + "offset", "m", "", Over::scene, d.offset, 1, none));
    if (d.tangential.empty()) continue;
    fields.push_back(line_field(of + "tangential", "N", "", Over::scene, d.tangential, 0, 3, none));
  }
  track_contact(scene, c.name, std::move(fields),
                {.force = [&c] { return force_on_second(c); },
                 .active = [&c] { return active_pairs(c); },
                 .numbers = &c.numbers,
                 .overlaps = 2});
}

void find_paths(const Scene& scene, const PartContact& c, PartDirection& d, const Step& step) {
  const Surface& surface = c.sides[d.segments].surface;
  for (std::size_t r = 0; r < d.gaps.size(); ++r) {
    const Gap& gap = d.gaps[r];
    if (gap.segment < 0 || !(gap.penetration > 0)) continue;
    const auto i = static_cast<std::size_t>(d.candidates.point[r]);
    d.point_path[r] = work_path(scene.nodes, c.sides[d.points].surface.node[i], step);
    for (const Index k : surface.segments[static_cast<std::size_t>(gap.segment)].corner) {
      const auto node = static_cast<std::size_t>(k);
      d.node_path[node] = work_path(scene.nodes, surface.node[node], step);
    }
  }
}

/// Adds the works of one contact at this level to its entries.
void add_work(const Scene& scene, PartContact& c, const Step& step) {
  Work of_normal = Work::Zero();
  Work of_friction = Work::Zero();
  Work of_damping = Work::Zero();
  for (PartDirection& d : c.directions) {
    if (d.scattered.active == 0) continue;
    find_paths(scene, c, d, step);
    ContactInput in;
    in.surface = &c.sides[d.segments].surface;
    in.candidates = &d.candidates;
    in.gaps = d.gaps;
    const auto work = [&](const std::vector<Vec3>& force) -> Work {
      return contact_work(in, force, d.point_path, d.node_path);
    };
    of_normal += work(d.forces.normal);
    if (c.friction_work != nullptr) of_friction += work(d.forces.friction);
    if (c.damping_work != nullptr) of_damping += work(d.forces.damping);
  }
  c.work->add_work(-of_normal);
  if (c.friction_work != nullptr) c.friction_work->add_work(-of_friction);
  if (c.damping_work != nullptr) c.damping_work->add_work(-of_damping);
}

/// Works of those that have pairs, and, for what belongs to the step after the last level, of those
/// that had.
void add_works(const Scene& scene, PartMeeting& meeting, const Step& step) {
  for (PartContact* c : meeting.near) add_work(scene, *c, step);
  for (PartContact* c : meeting.were_near) {
    const bool done = std::find(meeting.near.begin(), meeting.near.end(), c) != meeting.near.end();
    if (!done) add_work(scene, *c, step);
  }
  meeting.were_near = meeting.near;
  for (PartOnPlanes* c : meeting.on_planes) add_work_on_planes(scene, *c, step);
}

/// The smallest vote of all operations but the one of that name [s].
double smallest_of_others(const Plan& plan, const std::string& name) {
  double dt = std::numeric_limits<double>::infinity();
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : plan.at(static_cast<Stage>(s))) {
      if (op.stable_dt && op.name != name) dt = std::min(dt, op.stable_dt());
    }
  }
  return dt;
}

std::string who_limits(Scene& scene, const PartMeeting& meeting) {
  const ContactRate rate = rate_of(scene.nodes, scene.store.get<Followers>(), meeting);
  if (rate.node < 0) return "contact of parts";
  return fmt::format("contact of parts: node {}",
                     scene.nodes.id[static_cast<std::size_t>(rate.node)]);
}

std::string reason_of(const PartMeeting& meeting) {
  const std::string first =
      asked_for_at(meeting.contacts.empty() ? meeting.on_planes.front()->where
                                            : meeting.contacts.front()->where);
  const std::size_t n = meeting.contacts.size() + meeting.on_planes.size();
  return n == 1 ? first : fmt::format("{} contacts, the first {}", n, first);
}

}  // namespace part_contact_plan
}  // namespace

PartContact& make_part_contact(Scene& scene, const std::string& name, std::array<int, 2> parts,
                               std::array<ShellSurface, 2> data, bool both_ways, bool friction) {
  auto& all = scene.store.get<PartContacts>();
  PartContact& c = all.list.emplace_back();
  c.name = name;
  c.number = all.list.size() - 1;
  if (all.waits.empty()) {
    Field f = plain_field("contact.waits", "1", "", Over::scene, all.waits, 1, GhostRule::none);
    f.owner = "contacts of parts";
    scene.fields.push_back(std::move(f));
  }
  all.waits.push_back(0);
  c.followers = &scene.store.get<Followers>();
  for (std::size_t k = 0; k < 2; ++k) c.sides[k] = make_part_side(scene, parts[k], data[k]);
  if (!c.sides[1].line) part_contact_plan::add_direction(c, 0, friction);
  if (both_ways && !c.sides[0].line) part_contact_plan::add_direction(c, 1, friction);
  part_contact_plan::track(scene, c);
  scene.after_restart.push_back([&c] {
    if (c.numbers[0] >= 0) make_part_lists(c);
  });
  return c;
}

void set_distance(PartContact& c, double distance) {
  for (PartDirection& d : c.directions) {
    const PartSide& segments = c.sides[d.segments];
    const double size = std::min(c.sides[0].depth, c.sides[1].depth);
    d.range.contact = distance;
    d.range.near = segments.solid ? distance + part_contact_plan::inside_of_solid * segments.depth
                                  : std::max(GapRange::of(distance).near,
                                             distance + part_contact_plan::near_of_shell * size);
  }
}

void add_part_contact(Scene& scene, PartContact& c, Model& model, Ledger& ledger) {
  PartMeeting& meeting = scene.store.get<PartContacts>().meetings[&model];
  meeting.contacts.push_back(&c);
  meeting.numbers.push_back(c.number);
  meeting.were_near.push_back(&c);
  meeting.damping = std::max(meeting.damping, c.law.damping);
  c.work = &ledger.entry("contact", c.name);
  if (c.law.friction > 0) c.friction_work = &ledger.entry("friction", c.name);
  if (c.law.damping > 0) c.damping_work = &ledger.entry("contact_damping", c.name);
}

void add_part_contact_operations(Scene& scene, PartMeeting& meeting, Model& model) {
  Operation op;
  op.name = "contact: parts";
  op.reason = part_contact_plan::reason_of(meeting);
  op.stage = Stage::force;
  op.reads = {"x", "v"};
  op.writes = {"f"};
  if (!meeting.contacts.empty()) op.owns = {"contact.waits"};
  op.run = [&](const Step& step) { part_contacts_pass(scene, meeting, step); };
  op.stable_dt = [&, name = op.name] {
    const ContactRate rate = rate_of(scene.nodes, scene.store.get<Followers>(), meeting);
    if (!(rate.omega2 > 0)) return std::numeric_limits<double>::infinity();
    // The force of damping begins a step late too: its error in energy wants the shorter step.
    if (meeting.damping > 0) return contact_step(rate.omega2, meeting.damping);
    return std::max(contact_step(rate.omega2, meeting.damping),
                    step_beside(part_contact_plan::smallest_of_others(model.plan, name),
                                rate.omega2, meeting.damping));
  };
  op.limited_by = [&] { return part_contact_plan::who_limits(scene, meeting); };
  model.plan.add(std::move(op));
  Operation look;
  look.name = "contact: work of parts";
  look.reason = part_contact_plan::reason_of(meeting);
  look.stage = Stage::look;
  look.reads = {"v", "f"};
  look.run = [&](const Step& step) { part_contact_plan::add_works(scene, meeting, step); };
  model.plan.add(std::move(look));
}

}  // namespace gannet
