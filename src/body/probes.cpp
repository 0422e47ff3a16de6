// Probes: what a user watches, as measures "probe.NAME" that output writes one file each.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "body/effects.hpp"
#include "scene/node_set.hpp"

namespace gannet {

namespace {
namespace probes {

const std::vector<std::string> components{"x", "y", "z"};

void write(const Vec3& value, double* to) {
  for (int d = 0; d < 3; ++d) to[d] = value[d];
}

Schema schema() {
  const auto of_nodes = [](const char* name, const char* text) {
    Key key{.name = name, .kind = Kind::map, .text = text};
    key.keys = {node_set_key("node", true)};
    return key;
  };
  Schema table;
  table.push_back({"probes.*", of_nodes("displacement", "mean displacement of nodes")});
  table.push_back({"probes.*", of_nodes("velocity", "mean velocity of nodes")});
  table.push_back({"probes.*", Key{.name = "contact_force",
                                   .kind = Kind::reference,
                                   .text = "force of this contact on its second side",
                                   .refers_to = "contacts"}});
  table.push_back({"probes.*", Key{.name = "boundary_force",
                                   .kind = Kind::reference,
                                   .text = "force that this boundary puts on its nodes",
                                   .refers_to = "boundaries"}});
  return table;
}

Vec3 mean_position(const std::vector<Index>& set, const Nodes& nodes) {
  Vec3 sum = Vec3::Zero();
  for (const Index i : set) sum += xyz(nodes.x[static_cast<std::size_t>(i)]);
  return sum / static_cast<double>(set.size());
}

/// The nodes of one probe, chosen in the first configuration: a restart finds the same ones.
struct NodeProbe {
  std::vector<Index> nodes;
  Vec3 start = Vec3::Zero();  ///< their mean position at the start [m]
};

/// By name of the probe.
struct NodeProbes {
  std::map<std::string, NodeProbe> of;
};

void add_displacement(const NodeProbe& probe, const std::string& name, Scene& scene) {
  scene.measures.push_back({name, "m", components, [&nodes = scene.nodes, &probe](double* to) {
                              write(mean_position(probe.nodes, nodes) - probe.start, to);
                            }});
}

void add_velocity(const NodeProbe& probe, const std::string& name, Scene& scene, Models& models) {
  std::vector<const Model*> model_of;
  for (const Index i : probe.nodes) model_of.push_back(&models.of_node(i));
  scene.measures.push_back(
      {name, "m/s", components, [&nodes = scene.nodes, &probe, model_of](double* to) {
         Vec3 sum = Vec3::Zero();
         for (std::size_t k = 0; k < probe.nodes.size(); ++k) {
           sum += velocity_at_level(nodes, probe.nodes[k], model_of[k]->step.dt);
         }
         write(sum / static_cast<double>(probe.nodes.size()), to);
       }});
}

/// Passes on another measure, which may be made later than the probe. Not a number where nobody
/// makes it.
void add_force_of(const std::string& source, const std::string& name, Scene& scene) {
  scene.measures.push_back({name, "N", components, [&scene, source](double* to) {
                              write(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), to);
                              for (const Measure& m : scene.measures) {
                                if (m.name == source) m.sample(to);
                              }
                            }});
}

void add_contact_force(const Keys& root, const Keys& probe, const std::string& name, Scene& scene) {
  const std::string contact = probe.word("contact_force");
  if (!root.has("contacts") || !root.map("contacts").has(contact)) {
    probe.complain("contact_force", fmt::format("there is no contact '{}'", contact));
    return;
  }
  add_force_of("contact." + contact + ".force", name, scene);
}

void add_boundary_force(const Keys& root, const Keys& probe, const std::string& name,
                        Scene& scene) {
  const std::string boundary = probe.word("boundary_force");
  if (!root.has("boundaries") || !root.map("boundaries").has(boundary)) {
    probe.complain("boundary_force", fmt::format("there is no boundary '{}'", boundary));
    return;
  }
  if (!root.map("boundaries").map(boundary).has("nodes")) {
    probe.complain("boundary_force",
                   fmt::format("boundary '{}' has no nodes; the force on a wall is that of the "
                               "contact with it",
                               boundary));
    return;
  }
  add_force_of("boundary." + boundary + ".force", name, scene);
}

constexpr std::array<const char*, 4> kinds{"displacement", "velocity", "contact_force",
                                           "boundary_force"};

void state(const Keys& root, Scene& scene) {
  if (!root.has("probes")) return;
  const Keys probes = root.map("probes");
  for (const std::string& name : probes.names()) {
    const Keys probe = probes.map(name);
    const auto n_given = std::count_if(kinds.begin(), kinds.end(),
                                       [&](const char* kind) { return probe.has(kind); });
    if (n_given > 1) {
      probe.complain(probe.names()[1], "a probe watches one thing; give each its own name");
    }
    for (const char* kind : {"displacement", "velocity"}) {
      if (!probe.has(kind)) continue;
      NodeProbe of{select_nodes(probe.map(kind).map("node"), scene), Vec3::Zero()};
      if (of.nodes.empty()) continue;
      of.start = mean_position(of.nodes, scene.nodes);
      scene.store.get<NodeProbes>().of[name] = std::move(of);
    }
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!root.has("probes")) return;
  const Keys probes = root.map("probes");
  const auto& of_nodes = scene.store.get<NodeProbes>().of;
  for (const std::string& name : probes.names()) {
    const Keys probe = probes.map(name);
    const std::string measure = "probe." + name;
    const auto found = of_nodes.find(name);
    if (found != of_nodes.end() && probe.has("displacement")) {
      add_displacement(found->second, measure, scene);
    } else if (found != of_nodes.end() && probe.has("velocity")) {
      add_velocity(found->second, measure, scene, models);
    }
    if (probe.has("contact_force")) add_contact_force(root, probe, measure, scene);
    if (probe.has("boundary_force")) add_boundary_force(root, probe, measure, scene);
  }
}

}  // namespace probes
}  // namespace

Effect probes_effect() {
  return {.name = "probes",
          .schema = probes::schema,
          .state = probes::state,
          .operations = probes::operations};
}

}  // namespace gannet
