// How a case asks for prescribed motion: boundaries.NAME: {nodes, fix, velocity, angular_velocity}.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "body/effects.hpp"
#include "body/prescribed_motion.hpp"
#include "scene/followers.hpp"
#include "scene/given_rotations.hpp"
#include "scene/given_velocities.hpp"
#include "scene/node_set.hpp"

namespace gannet {

namespace {
namespace prescribed_motion {

constexpr std::array<const char*, 6> components{"x", "y", "z", "rx", "ry", "rz"};

Schema schema() {
  Schema table;
  const auto key = [&](Key k) { table.push_back({"boundaries.*", std::move(k)}); };
  key(node_set_key("nodes", false));
  key({.name = "fix",
       .kind = Kind::names,
       .text = "components that stay at rest, of x, y, z and the rotations rx, ry, rz",
       .choices = {components.begin(), components.end()}});
  key({.name = "velocity",
       .kind = Kind::vector_function,
       .unit = dim::velocity,
       .text = "velocity of the nodes, 'free' where forces decide: [free, free, -6 m/s]",
       .choices = {"free"},
       .variables = {"t"}});
  key({.name = "angular_velocity",
       .kind = Kind::vector_function,
       .unit = dim::angular_velocity,
       .text = "angular velocity of the nodes, 'free' where forces decide",
       .choices = {"free"},
       .variables = {"t"}});
  key({.name = "factor",
       .kind = Kind::function,
       .text = "multiplies both in time: [[0 s, 0], [1 ms, 1]]",
       .variables = {"t"}});
  return table;
}

/// Which key prescribes component d of a boundary; nullptr: none.
using Sources = std::array<const char*, 6>;

void prescribe(const Keys& boundary, const char* key, std::size_t d, const Function& rate,
               PrescribedMotion& motion, Sources& sources) {
  if (sources[d] != nullptr) {
    boundary.complain(key,
                      fmt::format("{} is prescribed by '{}' already", components[d], sources[d]));
    return;
  }
  sources[d] = key;
  motion.rate[d] = rate;
}

/// velocity and angular_velocity: three items, each a function of time or 'free'.
void read_rates(const Keys& boundary, const char* key, std::size_t first, PrescribedMotion& motion,
                Sources& sources) {
  if (!boundary.has(key)) return;
  const VectorFunction rate = boundary.vector_function(key);
  const Function factor = boundary.has("factor") ? boundary.function("factor") : Function(1.0);
  for (std::size_t d = 0; d < 3; ++d) {
    if (boundary.words(key)[d] == "free") continue;
    prescribe(boundary, key, first + d, product(rate.component[d], factor), motion, sources);
  }
}

/// Which motion prescribes component d of a node.
using Owners = std::map<Index, std::array<const PrescribedMotion*, 6>>;

/// Hands the components of `sources` to the nodes. What an earlier boundary prescribes alike stays
/// with that one, so that a reaction is counted once; what it prescribes otherwise is a mistake.
void claim(const Keys& boundary, const Sources& sources, const Scene& scene, Owners& owners,
           PrescribedMotion& motion) {
  for (const Index i : motion.nodes) {
    auto& owner = owners[i];
    unsigned mask = 0;
    for (std::size_t d = 0; d < 6; ++d) {
      if (sources[d] == nullptr) continue;
      if (owner[d] != nullptr && !(owner[d]->rate[d] == motion.rate[d])) {
        const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(i)]);
        boundary.complain(
            sources[d],
            fmt::format("{} of the node at ({:.6g}, {:.6g}, {:.6g}) m is prescribed otherwise by "
                        "boundary '{}' ({})",
                        components[d], x.x(), x.y(), x.z(), owner[d]->name,
                        owner[d]->where.text()));
        return;
      }
      if (owner[d] != nullptr) continue;
      owner[d] = &motion;
      mask |= 1u << d;
    }
    motion.mask.push_back(static_cast<std::uint8_t>(mask));
  }
}

/// Rotations can be prescribed only where nodes have them.
bool rotations_exist(const Keys& boundary, const Sources& sources, const Scene& scene,
                     const PrescribedMotion& motion) {
  for (std::size_t d = 3; d < 6; ++d) {
    if (sources[d] == nullptr) continue;
    for (const Index i : motion.nodes) {
      if (scene.nodes.rotating.contains(i)) continue;
      boundary.complain(
          sources[d], fmt::format("the nodes have no rotations to prescribe ({})", components[d]));
      return false;
    }
  }
  return true;
}

void read_motion(const Keys& boundary, Scene& scene, Owners& owners) {
  PrescribedMotion motion;
  motion.name = boundary.name();
  motion.where = boundary.where();
  Sources sources{};
  if (boundary.has("fix")) {
    for (const std::string& word : boundary.words("fix")) {
      for (std::size_t d = 0; d < 6; ++d) {
        if (word == components[d]) prescribe(boundary, "fix", d, Function(0.0), motion, sources);
      }
    }
  }
  read_rates(boundary, "velocity", 0, motion, sources);
  read_rates(boundary, "angular_velocity", 3, motion, sources);
  if (sources == Sources{}) {
    boundary.complain("nodes", "say what the nodes do: fix, velocity or angular_velocity");
    return;
  }
  motion.nodes = select_nodes(boundary.map("nodes"), scene);
  if (motion.nodes.empty() || !rotations_exist(boundary, sources, scene, motion)) return;
  if (std::any_of(sources.begin() + 3, sources.end(), [](const char* s) { return s != nullptr; })) {
    auto& given = scene.store.get<GivenRotations>().nodes;
    given.insert(given.end(), motion.nodes.begin(), motion.nodes.end());
  }
  PrescribedMotion& kept =
      scene.store.get<PrescribedMotions>().list.emplace_back(std::move(motion));
  claim(boundary, sources, scene, owners, kept);
  auto& given = scene.store.get<GivenVelocities>().masks;
  for (std::size_t k = 0; k < kept.mask.size(); ++k) {
    if ((kept.mask[k] & 7u) != 0) given[kept.nodes[k]] |= kept.mask[k] & 7u;
  }
  // After a complaint the masks are short and nothing will run.
  if (kept.mask.size() == kept.nodes.size()) set_velocities(kept, scene.nodes, 0);
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("boundaries")) return;
  Owners owners;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    const Keys boundary = boundaries.map(name);
    if (boundary.has("nodes")) {
      read_motion(boundary, scene, owners);
      continue;
    }
    for (const char* key : {"fix", "velocity", "angular_velocity", "factor"}) {
      if (boundary.given(key)) boundary.complain(key, "say of which nodes: 'nodes: {...}'");
    }
  }
}

/// A node that no force can move cannot be held by one.
void check_masses(const Keys& root, const PrescribedMotion& motion, const Nodes& nodes,
                  const Followers& followers) {
  for (std::size_t k = 0; k < motion.nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(motion.nodes[k]);
    const bool moved = (motion.mask[k] & 0b111) == 0 || nodes.v[i].w > 0;
    const bool turned = (motion.mask[k] & 0b111000) == 0 || nodes.omega[i].w > 0;
    if (moved && turned) continue;
    root.map("boundaries")
        .map(motion.name)
        .complain(
            "nodes",
            followers.leader_of(motion.nodes[k]) >= 0
                ? "a node of the set follows a rigid body or what it is tied to, and cannot be "
                  "moved by itself; say how that moves"
                : "a node of the set has no mass of its own and cannot be moved by itself");
    return;
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<PrescribedMotions>()) return;
  for (PrescribedMotion& motion : scene.store.get<PrescribedMotions>().list) {
    if (motion.mask.size() != motion.nodes.size()) continue;
    check_masses(root, motion, scene.nodes, scene.store.get<Followers>());
    add_prescribed_motion(motion, scene, models);
  }
}

}  // namespace prescribed_motion
}  // namespace

Effect prescribed_motion_effect() {
  return {.name = "prescribed motion",
          .schema = prescribed_motion::schema,
          .state = prescribed_motion::state,
          .operations = prescribed_motion::operations};
}

}  // namespace gannet
