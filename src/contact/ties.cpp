// ties.NAME: nodes of one part that hang on a rigid body. A tied node becomes one of the body's
// own: its mass moves with the body, and what pulls at it pulls at the body, so that momentum is
// kept to rounding and there is no spring whose stiffness would limit the step. The force of the
// tie is what the rest of the tied part, and the weight of the node, put on the body.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "contact/effects.hpp"
#include "plan/effect.hpp"
#include "scene/node_set.hpp"
#include "scene/part_nodes.hpp"

namespace gannet {

namespace {
namespace ties {

Schema schema() {
  return {{"ties.*", node_set_key("nodes", true)},
          {"ties.*",
           {.name = "to",
            .kind = Kind::reference,
            .text = "the rigid body that they hang on, or the part of elements",
            .required = true,
            .refers_to = "bodies or parts or moorings"}},
          {"ties.*",
           {.name = "within",
            .unit = dim::length,
            .text = "how far from a part nodes may be, onto which they are moved; by default a "
                    "tenth of the segment there",
            .limits = positive()}},
          {"ties.*",
           {.name = "breaks_at",
            .unit = dim::force,
            .text = "size of the force at which the tie lets go",
            .limits = positive()}}};
}

/// Why a node cannot be tied to a group; "" where it can.
std::string trouble_with(const Scene& scene, const PartGroup& group, Index node) {
  const int number = part_of(scene, node);
  const Part& part = scene.parts[static_cast<std::size_t>(number)];
  const auto is_mine = [&](const PartGroup& g) {
    return std::ranges::find(g.parts, number) != g.parts.end();
  };
  if (is_mine(group)) {
    return fmt::format("part '{}' belongs to body '{}'; a part of something else is tied to it",
                       part.name, group.name);
  }
  for (const PartGroup& other : scene.groups) {
    if (is_mine(other)) {
      return fmt::format(
          "part '{}' belongs to the rigid body '{}'; two bodies are merged by naming "
          "the parts of both in one",
          part.name, other.name);
    }
    if (std::ranges::find(other.nodes, node) != other.nodes.end()) {
      return fmt::format("a node of '{}' at ({:.6g}, {:.6g}, {:.6g}) m is tied to '{}' already",
                         part.name, scene.nodes.x[static_cast<std::size_t>(node)].x,
                         scene.nodes.x[static_cast<std::size_t>(node)].y,
                         scene.nodes.x[static_cast<std::size_t>(node)].z, other.name);
    }
  }
  return "";
}

/// Sum over these of the nodes of a group, as what moves the group noted it [N].
Vec3 force_on(const std::vector<Index>& nodes, const PartGroup& group) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < group.forces.size(); ++k) {
    if (std::ranges::find(nodes, group.nodes[k]) != nodes.end()) sum += group.forces[k];
  }
  return sum;
}

void make_tie(const Keys& keys, Scene& scene) {
  PartGroup* group = scene.group(keys.word("to"));
  const std::vector<Index> nodes = select_nodes(keys.map("nodes"), scene);
  if (group == nullptr || nodes.empty()) return;
  for (const char* key : {"within", "breaks_at"}) {
    if (!keys.has(key)) continue;
    return keys.complain(key,
                         "has no meaning where nodes are tied to a rigid body, which takes "
                         "them over for good");
  }
  for (const Index node : nodes) {
    const std::string trouble = trouble_with(scene, *group, node);
    if (!trouble.empty()) return keys.complain("nodes", trouble);
  }
  group->nodes.insert(group->nodes.end(), nodes.begin(), nodes.end());
  scene.measures.push_back({"tie." + keys.name() + ".force",
                            "N",
                            {"x", "y", "z"},
                            [&scene, nodes, to = group->name](double* out) {
                              const Vec3 sum = force_on(nodes, *scene.group(to));
                              for (int d = 0; d < 3; ++d) out[d] = sum[d];
                            }});
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("ties")) return;
  const Keys ties = root.map("ties");
  for (const std::string& name : ties.names()) {
    if (scene.group(ties.map(name).word("to")) != nullptr) make_tie(ties.map(name), scene);
  }
}

}  // namespace ties
}  // namespace

Effect ties_effect() { return {.name = "ties", .schema = ties::schema, .state = ties::state}; }

}  // namespace gannet
