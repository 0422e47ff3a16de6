// bodies.NAME: parts of elements that move as one rigid body. What they are made of has its mass
// from `body_mass.hpp` or from the case; how it moves is `rigid_body.hpp`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <optional>

#include "body/body_mass_keys.hpp"
#include "body/effects.hpp"
#include "body/rigid_body.hpp"
#include "body/rigid_measures.hpp"
#include "plan/link.hpp"
#include "plan/model_of_part.hpp"

namespace gannet {

namespace {
namespace rigid_bodies {

/// What a case says of a body: its node, its parts, and the body once it is made.
struct NamedBody {
  std::string name;
  std::vector<int> parts;
  RigidBody* body = nullptr;
  WeighedBody mass;
};

/// Found by scene.store.
struct NamedBodies {
  std::deque<NamedBody> list;
};

/// Name of the part that is the centre of mass: no part of a case can be called so.
std::string part_name(const std::string& body) { return "body." + body; }

Schema schema() {
  Key motion{.name = "motion", .kind = Kind::map, .text = "what is given of its motion"};
  motion.keys = {{.name = "velocity",
                  .kind = Kind::vector_function,
                  .unit = dim::velocity,
                  .text = "of its centre, 'free' where forces decide: [free, 0, -1 m/s]",
                  .choices = {"free"},
                  .variables = {"t"}},
                 {.name = "angular_velocity",
                  .kind = Kind::vector_function,
                  .unit = dim::angular_velocity,
                  .text = "about the axes of space, 'free' where forces decide",
                  .choices = {"free"},
                  .variables = {"t"}}};
  const std::vector<Key> keys{{.name = "parts",
                               .kind = Kind::names,
                               .text = "parts of elements that move as one rigid body",
                               .required = true},
                              {.name = "velocity",
                               .kind = Kind::vector,
                               .unit = dim::velocity,
                               .text = "of the centre at the start"},
                              {.name = "angular_velocity",
                               .kind = Kind::vector,
                               .unit = dim::angular_velocity,
                               .text = "at the start"},
                              {.name = "held_until",
                               .unit = dim::time,
                               .text = "it stands still up to then, while water around it settles",
                               .limits = positive()},
                              motion};
  Schema table;
  std::vector<Key> all = body_mass_keys();
  all.insert(all.begin(), keys.front());
  all.insert(all.end(), keys.begin() + 1, keys.end());
  for (const Key& key : all) table.push_back({"bodies.*", key});
  table.push_back({"probes.*",
                   {.name = "body",
                    .kind = Kind::reference,
                    .text = "where this body is, how it moves and what acts on it",
                    .refers_to = "bodies"}});
  return table;
}

std::vector<Keys> bodies_of(const Keys& root) {
  std::vector<Keys> list;
  if (!root.has("bodies")) return list;
  for (const std::string& name : root.map("bodies").names()) {
    const Keys keys = root.map("bodies").map(name);
    if (!keys.given("rigid")) list.push_back(keys);  // else: body/rigid_phases_effect.cpp
  }
  return list;
}

/// Each body brings one node, which will be its centre of mass. It starts at the body's velocity.
void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& keys : bodies_of(root)) {
    PartDraft part;
    part.name = part_name(keys.name());
    part.kind = "body";
    part.where = keys.where();
    part.rotations = true;
    part.cell = Cell::point;
    part.points = {keys.has("centre") ? keys.vector("centre") : Vec3(Vec3::Zero())};
    part.connectivity = {0};
    if (keys.has("velocity")) part.velocity = keys.vector("velocity");
    draft.parts.push_back(std::move(part));
  }
}

/// Why a part cannot belong to a body; "" where it can.
std::string trouble_with(const Scene& scene, int number, const std::string& name) {
  if (number < 0) {
    std::string names;
    for (const Part& p : scene.parts) {
      if (p.kind != "body") names += (names.empty() ? "" : ", ") + p.name;
    }
    return fmt::format("there is no part '{}'; parts are: {}", name, names);
  }
  if (!scene.parts[static_cast<std::size_t>(number)].is_particles()) return "";
  return fmt::format("part '{}' is made of particles; a body is made of elements", name);
}

void take_parts(const Keys& root, const Keys& keys, Scene& scene, std::map<int, std::string>& taken,
                NamedBody& body) {
  for (const std::string& name : keys.words("parts")) {
    const int number = scene.part_number(name);
    const std::string trouble = trouble_with(scene, number, name);
    if (!trouble.empty()) {
      keys.complain("parts", trouble);
      continue;
    }
    const auto [at, is_new] = taken.emplace(number, keys.name());
    if (!is_new) {
      keys.complain("parts",
                    at->second == keys.name()
                        ? fmt::format("'{}' is named twice", name)
                        : fmt::format("part '{}' belongs to body '{}' already", name, at->second));
      continue;
    }
    const Keys part = root.map("parts").map(name);
    if (part.given("initial_velocity")) {
      part.complain(
          "initial_velocity",
          fmt::format("the part belongs to body '{}'; say its velocity there", keys.name()));
    }
    scene.parts[static_cast<std::size_t>(number)].rigid = true;
    body.parts.push_back(number);
  }
}

void state(const Keys& root, Scene& scene) {
  std::map<int, std::string> taken;
  for (const Keys& keys : bodies_of(root)) {
    NamedBody& body = scene.store.get<NamedBodies>().list.emplace_back();
    body.name = keys.name();
    if (keys.has("parts")) take_parts(root, keys, scene, taken, body);
    PartGroup& group = scene.groups.emplace_back(PartGroup{.name = body.name, .parts = body.parts});
    group.parts.push_back(scene.part_number(part_name(body.name)));
  }
}

constexpr std::array<const char*, 6> components{"x", "y", "z", "rx", "ry", "rz"};

/// In the plane a body moves along x and y and turns about z.
bool exists(int dimension, std::size_t d) { return dimension == 3 || d < 2 || d == 5; }

void read_rates(const Keys& keys, const char* key, std::size_t first, int dimension,
                BodyMotion& motion) {
  const Keys given = keys.map("motion");
  if (!given.has(key)) return;
  const VectorFunction rate = given.vector_function(key);
  for (std::size_t k = 0; k < 3; ++k) {
    if (given.words(key)[k] == "free") continue;
    const std::size_t d = first + k;
    if (!exists(dimension, d)) {
      if (rate.component[k] == Function(0.0)) continue;
      given.complain(key, fmt::format("a plane case has no motion in {}", components[d]));
      continue;
    }
    motion.mask |= 1u << d;
    motion.rate[d] = rate.component[k];
  }
}

/// What the case gives of the motion, and the start that goes with it.
BodyMotion read_motion(const Keys& keys, int dimension, Vec3& v, Vec3& omega) {
  BodyMotion motion;
  read_rates(keys, "velocity", 0, dimension, motion);
  read_rates(keys, "angular_velocity", 3, dimension, motion);
  motion.held_until = keys.number_or("held_until", 0);
  if (motion.held_until > 0 && !(v.isZero(0) && omega.isZero(0))) {
    keys.complain("held_until", "the body stands still at the start: no velocity goes with that");
  }
  for (std::size_t d = 0; d < 6; ++d) {
    const char* key = d < 3 ? "velocity" : "angular_velocity";
    double& start = (d < 3 ? v : omega)[static_cast<Eigen::Index>(d % 3)];
    if (!exists(dimension, d) && start != 0) {
      keys.complain(key, fmt::format("a plane case has no motion in {}", components[d]));
    }
    if ((motion.mask >> d & 1u) == 0) continue;
    const double given = value_at(motion.rate[d], 0);
    if (motion.held_until > 0) continue;
    if (keys.given(key) && start != given) {
      keys.complain(key, fmt::format("{} starts at {:g}, but 'motion' gives {:g}", components[d],
                                     start, given));
    }
    start = given;
  }
  return motion;
}

std::vector<Index> members_of(const Scene& scene, const NamedBody& body) {
  std::vector<Index> members;
  for (const int p : body.parts) {
    const Range& nodes = scene.parts[static_cast<std::size_t>(p)].nodes;
    for (Index i = nodes.begin; i < nodes.end; ++i) members.push_back(i);
  }
  std::sort(members.begin(), members.end());
  return members;
}

/// Puts the node of a body at its centre and makes the body.
void make_body(const Keys& keys, Scene& scene, NamedBody& body) {
  std::vector<Index> members = members_of(scene, body);
  if (members.empty()) return;
  const std::vector<Index>& tied = scene.group(body.name)->nodes;
  const std::optional<WeighedBody> weighed = weigh_body(keys, scene, body.parts, members, tied);
  if (!weighed) return;
  body.mass = *weighed;
  for (const Index i : tied) {
    scene.group(body.name)->masses.push_back(scene.nodes.x[static_cast<std::size_t>(i)].w);
  }
  members.insert(members.end(), tied.begin(), tied.end());
  std::ranges::sort(members);
  Vec3 v = keys.has("velocity") ? keys.vector("velocity") : Vec3(Vec3::Zero());
  Vec3 omega = keys.has("angular_velocity") ? keys.vector("angular_velocity") : Vec3(Vec3::Zero());
  const BodyMotion motion = read_motion(keys, scene.dimension, v, omega);
  const Index node =
      scene.parts[static_cast<std::size_t>(scene.part_number(part_name(body.name)))].nodes.begin;
  set_xyz(scene.nodes.x[static_cast<std::size_t>(node)], body.mass.of.centre);
  set_xyz(scene.nodes.v[static_cast<std::size_t>(node)], v);
  body.body = &make_rigid_body(scene, {.name = body.name,
                                       .where = keys.where(),
                                       .node = node,
                                       .members = members,
                                       .mass = body.mass.of.mass,
                                       .inertia = body.mass.of.inertia,
                                       .omega = omega,
                                       .motion = motion});
}

bool in_one_model(const Keys& keys, const Scene& scene, Models& models, const NamedBody& body) {
  const Model* model = &models.of_node(body.body->node);
  for (const int p : body.parts) {
    if (&model_of_part(scene, models, p) == model) continue;
    keys.complain("parts", fmt::format("part '{}' advances in another model than the body",
                                       scene.parts[static_cast<std::size_t>(p)].name));
    return false;
  }
  for (const Index node : scene.group(body.name)->nodes) {
    const Model& other = models.of_node(node);
    if (&other == model) continue;
    keys.complain("", fmt::format("a node that is tied to it advances in model '{}', the body in "
                                  "'{}'; name both in one model",
                                  other.name, model->name));
    return false;
  }
  return true;
}

void add_probes(const Keys& root, Scene& scene, Models& models, const NamedBody& body) {
  if (!root.has("probes")) return;
  for (const std::string& name : root.map("probes").names()) {
    const Keys probe = root.map("probes").map(name);
    if (!probe.has("body") || probe.word("body") != body.name) continue;
    add_body_probe(scene, models.of_node(body.body->node), *body.body, "probe." + name);
  }
}

/// Notes what acts on nodes that are tied to a body, weight and all, before the body gathers it.
void note_forces(Scene& scene, Model& model, PartGroup& group, const Keys& keys) {
  if (group.nodes.empty()) return;
  group.forces.assign(group.nodes.size(), Vec3::Zero());
  model.plan.add({.name = group.name + ": forces on tied nodes",
                  .reason = asked_for_at(keys.where()),
                  .stage = Stage::accelerate,
                  .reads = {"f"},
                  .run = [&scene, &group](const Step&) {
                    for (std::size_t k = 0; k < group.nodes.size(); ++k) {
                      const auto i = static_cast<std::size_t>(group.nodes[k]);
                      group.forces[k] = xyz(scene.nodes.f[i]) -
                                        excess_on_node(scene, group.nodes[k]) +
                                        group.masses[k] * scene.gravity;
                    }
                  }});
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!root.has("bodies")) return;
  for (NamedBody& body : scene.store.get<NamedBodies>().list) {
    const Keys keys = root.map("bodies").map(body.name);
    make_body(keys, scene, body);
    if (body.body == nullptr || !in_one_model(keys, scene, models, body)) continue;
    Model& model = models.of_node(body.body->node);
    note_forces(scene, model, *scene.group(body.name), keys);
    add_rigid_body_operations(scene, model, models.ledger, *body.body);
    add_body_measures(scene, model, *body.body);
    add_probes(root, scene, models, body);
  }
}

std::string text_of(const Vec3& x, const char* unit) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}] {}", x.x(), x.y(), x.z(), unit);
}

/// Mass, centre and inertia where the case leaves them open, and whose elements are not computed.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (!root.has("bodies")) return list;
  for (const NamedBody& body : scene.store.get<NamedBodies>().list) {
    if (body.body == nullptr) continue;
    const Keys keys = root.map("bodies").map(body.name);
    const BodyMass& m = body.mass.of;
    const auto open = [&](const char* key, const std::string& chosen) {
      if (!keys.has(key)) list.push_back({keys.path() + "." + key, chosen, body.mass.rule});
    };
    open("mass", fmt::format("{:.6g} kg", m.mass));
    open("centre", text_of(m.centre, "m"));
    const Mat3& I = m.inertia;
    open("inertia", scene.dimension == 2
                        ? fmt::format("{:.6g} kg m^2", I(2, 2))
                        : fmt::format("[{:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}] kg m^2",
                                      I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
    for (const int p : body.parts) {
      const Part& part = scene.parts[static_cast<std::size_t>(p)];
      list.push_back({"parts." + part.name + "." + part.kind, "rigid",
                      fmt::format("its elements are not computed: it belongs to body '{}' ({})",
                                  body.name, keys.where().text())});
    }
  }
  return list;
}

}  // namespace rigid_bodies
}  // namespace

Effect rigid_bodies_effect() {
  return {.name = "rigid bodies",
          .schema = rigid_bodies::schema,
          .parts = rigid_bodies::add_parts,
          .state = rigid_bodies::state,
          .operations = rigid_bodies::operations,
          .choices = rigid_bodies::choices};
}

}  // namespace gannet
