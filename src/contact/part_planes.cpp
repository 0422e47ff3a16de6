#include "contact/part_planes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/part_contact.hpp"
#include "contact/planes.hpp"
#include "contact/track_contact.hpp"
#include "plan/model_planes.hpp"

namespace gannet {

namespace {
namespace part_planes {

/// Penetrations at the start below this share of the distance, or of the size of the elements, are
/// rounding.
constexpr double touching = 1e-9;

/// What a node faces least, as a share of the areas around it.
constexpr double least_facing = 0.1;

const Plane& plane_of(const PartOnPlanes& c, std::size_t k) { return (*c.seen)[c.planes[k]]; }

Vec3 velocity_of_plane(const Plane& plane, const Vec3& x) {
  return plane.velocity + plane.spin.cross(x - plane.point);
}

/// Area by which a node meets a plane [m^2].
double area_of(const PartSide& side, std::size_t i, const Vec3& n) {
  if (side.line) return side.area[i];
  const double facing = side.facing[i].dot(n);
  return std::max(least_facing * side.area[i], side.solid ? -facing : std::abs(facing));
}

/// Nodes within the distance, with their penetrations less what they started with.
void find_touches(const Scene& scene, PartOnPlanes& c) {
  const Surface& surface = c.side.surface;
  const bool first = c.numbers[0] == 0;
  const double rounding = touching * std::max(c.distance, std::min(c.side.depth, 1.0));
  c.numbers[0] = 1;
  c.touches.clear();
  std::size_t entry = 0;
  for (std::size_t k = 0; k < c.planes.size(); ++k) {
    const Plane& plane = plane_of(c, k);
    for (std::size_t i = 0; i < surface.node.size(); ++i, ++entry) {
      const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(surface.node[i])]);
      const double inside = c.distance - plane.normal.dot(x - plane.point);
      double& offset = c.offset[entry];
      if (first && inside > rounding) {
        offset = inside;
        c.numbers[1] += 1;
        c.numbers[2] = std::max(c.numbers[2], inside);
      }
      offset = std::min(offset, std::max(0.0, inside));
      if (!(inside > offset)) {
        if (!c.tangential.empty()) c.tangential[entry] = {};
        continue;
      }
      PlaneTouch& t = c.touches.emplace_back();
      t.plane = k;
      t.point = i;
      t.gap.penetration = inside - offset;
      t.gap.normal = plane.normal;
    }
  }
}

double stiffness_of(const PartOnPlanes& c, std::size_t i, double A) {
  return c.kappa > 0 ? c.kappa * A : 2 * c.factor * c.side.kappa[i] * A;
}

/// Stiffnesses, and the masses that damping goes by.
void find_stiffness(const Scene& scene, PartOnPlanes& c) {
  double all = 0;
  for (PlaneTouch& t : c.touches) {
    const double A = area_of(c.side, t.point, t.gap.normal);
    t.stiffness = stiffness_of(c, t.point, A);
    t.mass = A;
    all += A;
  }
  for (PlaneTouch& t : c.touches) {
    const Index node = c.side.surface.node[t.point];
    const auto i = static_cast<std::size_t>(node);
    const bool follows = c.followers->leader_of(node) >= 0;
    t.mass = follows ? t.mass / (all * c.followers->inverse_mass[i]) : scene.nodes.x[i].w;
  }
}

void find_forces(const Scene& scene, PartOnPlanes& c, const Step& step) {
  for (PlaneTouch& t : c.touches) {
    const auto i = static_cast<std::size_t>(c.side.surface.node[t.point]);
    const Vec3 v =
        xyz(scene.nodes.v[i]) - velocity_of_plane(plane_of(c, t.plane), xyz(scene.nodes.x[i]));
    t.normal = penalty_force(t.stiffness, t.gap);
    if (c.law.damping > 0) {
      t.damping = damping_force(c.law.damping, t.stiffness, t.mass, t.gap.normal.dot(v), t.gap);
    }
    if (c.law.friction <= 0) continue;
    Line& memory = c.tangential[t.plane * c.side.surface.node.size() + t.point];
    const double limit = c.law.friction * t.gap.normal.dot(t.normal + t.damping);
    t.friction = friction_force(xyz(memory), v * step.dt_old, t.stiffness, limit, t.gap);
    set_xyz(memory, t.friction);
  }
}

void scatter(Scene& scene, PartOnPlanes& c, PartMeeting& meeting) {
  c.on_planes.setZero();
  for (const PlaneTouch& t : c.touches) {
    const Index node = c.side.surface.node[t.point];
    const Vec3 f = t.normal + t.damping + t.friction;
    add_xyz(scene.nodes.f[static_cast<std::size_t>(node)], f);
    c.on_planes -= f;
    add_stiffness(meeting, node, t.stiffness);
  }
}

void track(Scene& scene, PartOnPlanes& c) {
  const auto none = GhostRule::none;
  std::vector<Field> fields{plain_field("numbers", "", "", Over::scene, c.numbers, 1, none),
                            plain_field("offset", "m", "", Over::scene, c.offset, 1, none)};
  if (!c.tangential.empty()) {
    fields.push_back(line_field("tangential", "N", "", Over::scene, c.tangential, 0, 3, none));
  }
  track_contact(scene, c.name, std::move(fields),
                {.force = [&c] { return Vec3(-c.on_planes); },
                 .active = [&c] { return c.touches.size(); },
                 .numbers = &c.numbers,
                 .overlaps = 1});
}

}  // namespace part_planes
}  // namespace

PartOnPlanes& make_part_on_planes(Scene& scene, const std::string& name, int number,
                                  const ShellSurface& data, std::vector<std::size_t> planes,
                                  bool friction) {
  PartOnPlanes& c = scene.store.get<PartsOnPlanes>().list.emplace_back();
  c.name = name;
  c.side = make_part_side(scene, number, data, true);
  c.planes = std::move(planes);
  c.seen = &scene.planes;
  scene.store.get<ModelPlanes>().parts.push_back(number);
  c.area = c.side.area;
  c.followers = &scene.store.get<Followers>();
  const std::size_t n = c.planes.size() * c.side.surface.node.size();
  c.offset.assign(n, 0);
  if (friction) c.tangential.resize(n);
  part_planes::track(scene, c);
  return c;
}

double rate_of_all_nodes(const PartOnPlanes& c) {
  double rate2 = 0;
  for (std::size_t i = 0; i < c.area.size(); ++i) {
    const Index node = c.side.surface.node[i];
    if (c.followers->leader_of(node) < 0) continue;
    const double w = c.followers->inverse_mass[static_cast<std::size_t>(node)];
    rate2 += part_planes::stiffness_of(c, i, c.area[i]) * w;
  }
  return rate2;
}

void part_on_planes_pass(Scene& scene, PartOnPlanes& c, const Step& step, PartMeeting& meeting) {
  if (c.rate2 < 0) c.rate2 = rate_of_all_nodes(c);
  meeting.rate2 = std::max(meeting.rate2, c.rate2);
  part_planes::find_touches(scene, c);
  if (!c.touches.empty()) update_side(scene.nodes, c.side);
  part_planes::find_stiffness(scene, c);
  part_planes::find_forces(scene, c, step);
  part_planes::scatter(scene, c, meeting);
}

void add_work_on_planes(const Scene& scene, PartOnPlanes& c, const Step& step) {
  Work of_normal = Work::Zero();
  Work of_friction = Work::Zero();
  Work of_damping = Work::Zero();
  Work put_in = Work::Zero();
  for (const PlaneTouch& t : c.touches) {
    const Index node = c.side.surface.node[t.point];
    const Plane& plane = part_planes::plane_of(c, t.plane);
    WorkPath path = work_path(scene.nodes, node, step);
    if (plane.moves) {
      const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(node)]);
      const WorkPath of_plane = path_of_plane(plane, x, step);
      put_in += work_along(of_plane, t.normal + t.damping + t.friction);
      path -= of_plane;
    }
    of_normal += work_along(path, t.normal);
    of_friction += work_along(path, t.friction);
    of_damping += work_along(path, t.damping);
  }
  c.work->add_work(-of_normal);
  if (c.friction_work != nullptr) c.friction_work->add_work(-of_friction);
  if (c.damping_work != nullptr) c.damping_work->add_work(-of_damping);
  if (c.put_in != nullptr) c.put_in->add_work(put_in);
}

void add_part_on_planes(Scene& scene, PartOnPlanes& c, PartMeeting& meeting, Ledger& ledger) {
  meeting.on_planes.push_back(&c);
  meeting.damping = std::max(meeting.damping, c.law.damping);
  c.work = &ledger.entry("contact", c.name);
  if (c.law.friction > 0) c.friction_work = &ledger.entry("friction", c.name);
  if (c.law.damping > 0) c.damping_work = &ledger.entry("contact_damping", c.name);
  const bool moves = std::any_of(c.planes.begin(), c.planes.end(),
                                 [&](std::size_t k) { return scene.planes[k].moves; });
  if (!moves) return;
  c.put_in = &ledger.entry("moving plane", c.name);
  c.put_in->external = true;
}

}  // namespace gannet
