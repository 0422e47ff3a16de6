// ties.NAME between two parts that deform, each with its own mesh, in one model or in two. The
// nodes are moved onto the segments of the other part before anything takes its shape from them;
// from then on they stay where they are on it (part_tie.hpp). All nodes of a tie advance in the
// faster of the two models; what elements of the slower one put on them goes through a link.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "contact/effects.hpp"
#include "contact/tie_buffer.hpp"
#include "contact/tie_rows.hpp"
#include "plan/model_of_part.hpp"
#include "scene/node_set.hpp"
#include "scene/part_nodes.hpp"

namespace gannet {

namespace {
namespace part_ties {

constexpr double share_of_segment = 0.1;

std::vector<Keys> ties_of(const Keys& root) {
  std::vector<Keys> list;
  if (!root.has("ties")) return list;
  for (const std::string& name : root.map("ties").names()) {
    list.push_back(root.map("ties").map(name));
  }
  return list;
}

std::string place_text(const Scene& scene, Index node) {
  const Line& x = scene.nodes.x[static_cast<std::size_t>(node)];
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x, x.y, x.z);
}

/// What `to` names where it is no body: a part; -1 where the effect has complained.
int target_of(const Keys& keys, const Scene& scene) {
  const int number = scene.part_number(keys.word("to"));
  const auto p = static_cast<std::size_t>(number);
  if (number < 0 || scene.parts[p].cell == Cell::point) {
    keys.complain("to", fmt::format("there is no body or part '{}'", keys.word("to")));
    return -1;
  }
  if (scene.parts[p].is_particles()) {
    keys.complain("to", fmt::format("part '{}' is made of particles; nodes are tied to elements",
                                    scene.parts[p].name));
    return -1;
  }
  return number;
}

/// Why these nodes cannot be tied to the part; "" where they can.
std::string trouble_with(const Scene& scene, const std::vector<Index>& nodes, int to) {
  for (const Index node : nodes) {
    const int part = part_of(scene, node);
    if (part == to) {
      return fmt::format("part '{}' cannot be tied to itself",
                         scene.parts[static_cast<std::size_t>(to)].name);
    }
    if (part != part_of(scene, nodes.front())) return "are of two parts; tie each by itself";
  }
  return "";
}

bool near_enough(const Keys& keys, const Scene& scene, const TieRows& found) {
  const double within =
      keys.has("within") ? keys.number("within") : share_of_segment * found.size_there;
  if (found.farthest <= within) return true;
  keys.complain("nodes",
                fmt::format("a node at {} is {:.4g} m from '{}', more than {:.4g} m{}; nodes are "
                            "moved onto what they are tied to: say 'within' if that is meant",
                            place_text(scene, found.rows[found.row_there].node), found.farthest,
                            keys.word("to"), within,
                            keys.has("within") ? "" : " (a tenth of the segment there)"));
  return false;
}

/// Finds the rows of one tie and moves its nodes onto the segments.
void make_tie(const Keys& keys, Scene& scene) {
  const int to = target_of(keys, scene);
  const std::vector<Index> nodes = select_nodes(keys.map("nodes"), scene);
  if (to < 0 || nodes.empty()) return;
  const std::string trouble = trouble_with(scene, nodes, to);
  if (!trouble.empty()) return keys.complain("nodes", trouble);
  const std::vector<Corners> segments = tie_segments(scene.parts[static_cast<std::size_t>(to)]);
  if (segments.empty()) return keys.complain("to", "has no segments to tie to");
  TieRows found = find_tie_rows(scene, nodes, segments);
  if (!near_enough(keys, scene, found)) return;
  PartTie& tie = scene.store.get<PartTies>().list.emplace_back();
  tie.name = keys.name();
  tie.where = keys.where();
  tie.part = part_of(scene, nodes.front());
  tie.to = to;
  tie.rows = std::move(found.rows);
  tie.farthest = found.farthest;
  if (keys.has("breaks_at")) tie.breaks_at = keys.number("breaks_at");
  Bond& bond = scene.store.get<Bonds>().list.emplace_back(Bond{tie.name, {}});
  for (TiedNode& row : tie.rows) {
    const Range& turning = scene.nodes.rotating;
    row.turns = turning.contains(row.node) && turning.contains(row.corner[0]);
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(row.n); ++k) {
      x += row.N[k] * xyz(scene.nodes.x[static_cast<std::size_t>(row.corner[k])]);
      bond.nodes.push_back(row.corner[k]);
    }
    set_xyz(scene.nodes.x[static_cast<std::size_t>(row.node)], x);
    bond.nodes.push_back(row.node);
  }
}

/// A node hangs on one thing only, and nothing hangs on what hangs.
void check_chains(const Keys& ties, const Scene& scene, const PartTies& all) {
  std::map<Index, const PartTie*> tied;
  for (const PartTie& tie : all.list) {
    for (const TiedNode& row : tie.rows) {
      const auto [at, is_new] = tied.emplace(row.node, &tie);
      if (is_new) continue;
      return ties.map(tie.name).complain(
          "nodes", fmt::format("a node at {} is tied by '{}' already", place_text(scene, row.node),
                               at->second->name));
    }
  }
  for (const PartTie& tie : all.list) {
    for (const TiedNode& row : tie.rows) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(row.n); ++k) {
        const auto found = tied.find(row.corner[k]);
        if (found == tied.end()) continue;
        return ties.map(tie.name).complain(
            "to", fmt::format("the node of '{}' at {} is itself tied by '{}': tie the nodes of one "
                              "part to the other, not both ways",
                              ties.map(tie.name).word("to"), place_text(scene, row.corner[k]),
                              found->second->name));
      }
    }
  }
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : ties_of(root)) {
    const std::string to = keys.word("to");
    if (!root.has("bodies") || !root.map("bodies").has(to)) make_tie(keys, scene);
  }
  if (!scene.store.has<PartTies>()) return;
  auto& all = scene.store.get<PartTies>();
  check_chains(root.map("ties"), scene, all);
  for (PartTie& tie : all.list) {
    scene.measures.push_back(
        {"tie." + tie.name + ".force", "N", {"x", "y", "z"}, [&tie](double* out) {
           for (int d = 0; d < 3; ++d) out[d] = tie.force[d];
         }});
  }
}

/// Nodes of bonds and of those tied to bodies that do not advance with the elements of their part,
/// by pair of models.
std::map<std::pair<std::size_t, std::size_t>, std::vector<Index>> crossing(const Scene& scene,
                                                                           Models& models) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Index>> pairs;
  const auto look = [&](const std::vector<Index>& nodes) {
    for (const Index node : nodes) {
      const std::size_t slow = models.rank(model_of_part(scene, models, part_of(scene, node)));
      const std::size_t fast = models.rank(models.of_node(node));
      if (slow != fast) pairs[{slow, fast}].push_back(node);
    }
  };
  if (const Bonds* bonds = scene.store.find<Bonds>()) {
    for (const Bond& bond : bonds->list) look(bond.nodes);
  }
  for (const PartGroup& group : scene.groups) look(group.nodes);
  return pairs;
}

void open_links(Scene& scene, Models& models, PartTies& all) {
  for (auto& [pair, nodes] : crossing(scene, models)) {
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    Link& link = all.links.emplace_back();
    link.slow = &models.list[pair.first];
    link.fast = &models.list[pair.second];
    link.name = "ties of " + link.slow->name + " and " + link.fast->name;
    link.nodes.assign(nodes.begin(), nodes.end());
    link.of_elements = true;
    open_link(scene, link);
  }
}

/// What a tie across models cannot be.
void check_parts(const Keys& keys, const Keys& root, const Scene& scene, Models& models,
                 const PartTie& tie) {
  for (const int part : {tie.part, tie.to}) {
    const Part& p = scene.parts[static_cast<std::size_t>(part)];
    for (const PartGroup& group : scene.groups) {
      if (std::ranges::find(group.parts, part) == group.parts.end()) continue;
      keys.complain(part == tie.to ? "to" : "nodes",
                    fmt::format("part '{}' belongs to the rigid body '{}': tie to the body", p.name,
                                group.name));
    }
    const bool crosses =
        &model_of_part(scene, models, part) != &models.of_node(tie.rows.front().node);
    const bool line = !root.map("parts").has(p.name);
    if (crosses && line) {
      keys.complain(part == tie.to ? "to" : "nodes",
                    fmt::format("line '{}' advances in a slower model than what it is tied to; "
                                "name it in that model",
                                p.name));
    }
    if (crosses && !line && root.map("parts").map(p.name).has("damping")) {
      root.map("parts").map(p.name).complain(
          "damping", fmt::format("acts in the step of the part's model, and nodes that '{}' ties "
                                 "advance in a faster one; the damping of its elements acts there",
                                 tie.name));
    }
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (ties_of(root).empty()) return;
  auto& all = scene.store.get<PartTies>();
  open_links(scene, models, all);
  auto& followers = scene.store.get<Followers>();
  for (PartTie& tie : all.list) {
    check_parts(root.map("ties").map(tie.name), root, scene, models, tie);
    take_masses(tie, scene);
    Field broken = plain_field("tie." + tie.name + ".broken", "1", "", Over::scene, tie.broken, 1,
                               GhostRule::none);
    broken.owner = "tie " + tie.name;
    scene.fields.push_back(std::move(broken));
    scene.after_restart.push_back([&tie, &followers] {
      if (tie.holds()) return;
      for (const TiedNode& row : tie.rows) {
        followers.leader[static_cast<std::size_t>(row.node)] = -1;
      }
    });
  }
  for (const PartTie& tie : all.list) start_tied(tie, scene.nodes, followers);
}

/// Says once at the start which ties across models stand where the waves of a fine mesh are.
void warn_of_buffers(Scene& scene, Models& models, const PartTies& all) {
  std::string list;
  for (const PartTie& tie : all.list) {
    const std::string missing = missing_buffer(scene, models, tie);
    if (!missing.empty()) list += (list.empty() ? "" : "; ") + missing;
  }
  if (list.empty()) return;
  scene.warnings.push_back(fmt::format(
      "ties: {}: energy may grow at that border. Make three or four rows of the slow part's "
      "elements a part of their own that advances in the fast model, tie it to the rest by its own "
      "nodes, "
      "and tie the fine mesh to it",
      list));
}

void look_at_buffers(Scene& scene, Models& models, const PartTies& all) {
  if (all.links.empty() || all.list.empty()) return;  // links are for ties to bodies too
  models.list.back().plan.add({.name = "buffers of ties across models",
                               .reason = asked_for_at(all.list.front().where),
                               .stage = Stage::look,
                               .where_all_meet = true,
                               .run = [&](const Step&) {
                                 if (models.list.front().step.n == 0) {
                                   warn_of_buffers(scene, models, all);
                                 }
                               }});
}

/// When all forces are known, and nodes have the motion that boundaries give them.
void last_operations(const Keys&, Scene& scene, Models& models) {
  if (!scene.store.has<PartTies>()) return;
  auto& all = scene.store.get<PartTies>();
  for (Link& link : all.links) close_link(scene, link, models.ledger);
  for (PartTie& tie : all.list) {
    add_tie_operations(scene, models.of_node(tie.rows.front().node), models.ledger, tie);
  }
  look_at_buffers(scene, models, all);
}

/// How far nodes were moved onto what they are tied to.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (!scene.store.has<PartTies>()) return list;
  for (const PartTie& tie : scene.store.get<PartTies>().list) {
    list.push_back(
        {root.map("ties").map(tie.name).path() + ".nodes",
         fmt::format("{} nodes, moved by {:.3g} m at most", tie.rows.size(), tie.farthest),
         "tied nodes are moved onto the segments of the other part"});
  }
  return list;
}

}  // namespace part_ties
}  // namespace

Effect tie_places_effect() {
  return {.name = "ties of parts",
          .state = part_ties::state,
          .operations = part_ties::operations,
          .choices = part_ties::choices};
}

Effect tie_motion_effect() {
  return {.name = "motion of tied nodes", .operations = part_ties::last_operations};
}

}  // namespace gannet
