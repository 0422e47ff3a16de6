#include "scene/node_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace gannet {

namespace {

constexpr std::array<const char*, 5> forms{"part", "edge_of", "nearest", "box", "plane"};

/// The part named under `key`, or nullptr after a complaint.
const Part* element_part(const Keys& nodes, const char* key, const Scene& scene) {
  const std::string name = nodes.word(key);
  const int p = scene.part_number(name);
  if (p < 0) {
    std::string known;
    for (const Part& part : scene.parts) {
      if (!part.is_particles()) known += (known.empty() ? "" : ", ") + part.name;
    }
    nodes.complain(key, fmt::format("there is no part '{}'; parts with elements: {}", name,
                                    known.empty() ? "none" : known));
    return nullptr;
  }
  const Part& part = scene.parts[static_cast<std::size_t>(p)];
  if (!part.is_particles()) return &part;
  nodes.complain(key, fmt::format("part '{}' is made of particles, which change their place in the "
                                  "node table; a set of nodes takes a part with elements",
                                  name));
  return nullptr;
}

std::vector<Index> nodes_where(const Part& part, const std::function<bool(Index)>& inside) {
  std::vector<Index> set;
  for (Index i = part.nodes.begin; i < part.nodes.end; ++i) {
    if (inside(i)) set.push_back(i);
  }
  return set;
}

std::vector<Index> nearest_node(const Part& part, const Nodes& nodes, const Vec3& point) {
  Index best = part.nodes.begin;
  double best_square = (xyz(nodes.x[static_cast<std::size_t>(best)]) - point).squaredNorm();
  for (Index i = part.nodes.begin + 1; i < part.nodes.end; ++i) {
    const double square = (xyz(nodes.x[static_cast<std::size_t>(i)]) - point).squaredNorm();
    if (square < best_square) {
      best = i;
      best_square = square;
    }
  }
  return {best};
}

/// Largest side of the bounding box of a part: the scale of what counts as "on" a face [m].
double extent_of(const Part& part, const Nodes& nodes) {
  Vec3 lowest = xyz(nodes.x[static_cast<std::size_t>(part.nodes.begin)]);
  Vec3 highest = lowest;
  for (Index i = part.nodes.begin; i < part.nodes.end; ++i) {
    lowest = lowest.cwiseMin(xyz(nodes.x[static_cast<std::size_t>(i)]));
    highest = highest.cwiseMax(xyz(nodes.x[static_cast<std::size_t>(i)]));
  }
  return (highest - lowest).maxCoeff();
}

std::vector<Index> nodes_in_box(const Part& part, const Nodes& nodes, const Keys& box) {
  // A node that is meant to lie on a face misses it by rounding.
  const double slack = 1e-9 * extent_of(part, nodes);
  const Vec3 from = box.vector("from").cwiseMin(box.vector("to")).array() - slack;
  const Vec3 to = box.vector("from").cwiseMax(box.vector("to")).array() + slack;
  return nodes_where(part, [&](Index i) {
    const Vec3 x = xyz(nodes.x[static_cast<std::size_t>(i)]);
    return (x.array() >= from.array()).all() && (x.array() <= to.array()).all();
  });
}

std::vector<Index> nodes_on_plane(const Part& part, const Nodes& nodes, const Keys& plane) {
  const Vec3 n = plane.vector("normal").normalized();
  const Vec3 point = plane.vector("point");
  const double within = std::max(plane.number_or("within", 0.0), 1e-9 * extent_of(part, nodes));
  return nodes_where(part, [&](Index i) {
    return std::abs(n.dot(xyz(nodes.x[static_cast<std::size_t>(i)]) - point)) <= within;
  });
}

/// Nodes on edges that belong to one cell only.
std::vector<Index> free_edge_nodes(const Part& part) {
  const auto n = static_cast<std::size_t>(nodes_per(part.cell));
  std::vector<std::pair<Index, Index>> edges;
  for (std::size_t first = 0; first < part.connectivity.size(); first += n) {
    for (std::size_t a = 0; a < n; ++a) {
      const Index i = part.connectivity[first + a];
      const Index j = part.connectivity[first + (a + 1) % n];
      // A triangle written as a quadrilateral repeats a node.
      if (i != j) edges.emplace_back(std::min(i, j), std::max(i, j));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Index> set;
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t next = k + 1;
    while (next < edges.size() && edges[next] == edges[k]) ++next;
    if (next == k + 1) {
      set.push_back(edges[k].first);
      set.push_back(edges[k].second);
    }
    k = next;
  }
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
  return set;
}

std::vector<Index> edge_nodes(const Keys& nodes, const Part& part) {
  if (part.cell != Cell::quad && part.cell != Cell::triangle) {
    nodes.complain("edge_of", fmt::format("part '{}' is no surface: it has no edge", part.name));
    return {};
  }
  std::vector<Index> set = free_edge_nodes(part);
  if (set.empty()) {
    nodes.complain("edge_of", fmt::format("part '{}' is closed: it has no free edge", part.name));
  }
  return set;
}

/// The nodes by a form that needs to be told the part by `of`.
std::vector<Index> nodes_by_place(const Keys& nodes, const std::string& form, const Scene& scene) {
  if (!nodes.has("of")) {
    nodes.complain(form, "say of which part: 'of: NAME'");
    return {};
  }
  const Part* part = element_part(nodes, "of", scene);
  if (part == nullptr || part->nodes.empty()) return {};
  if (form == "plane" && !(nodes.map(form).vector("normal").norm() > 0)) {
    nodes.map(form).complain("normal", "a normal needs a length above 0");
    return {};
  }
  std::vector<Index> set;
  if (form == "nearest") set = nearest_node(*part, scene.nodes, nodes.vector(form));
  if (form == "box") set = nodes_in_box(*part, scene.nodes, nodes.map(form));
  if (form == "plane") set = nodes_on_plane(*part, scene.nodes, nodes.map(form));
  if (set.empty()) nodes.complain(form, fmt::format("no node of '{}' lies there", part->name));
  return set;
}

}  // namespace

Key node_set_key(const std::string& name, bool required) {
  const auto point = [](const char* key, const char* text, bool needed) {
    return Key{
        .name = key, .kind = Kind::vector, .unit = dim::length, .text = text, .required = needed};
  };
  const auto part = [](const char* key, const char* text) {
    return Key{
        .name = key, .kind = Kind::reference, .text = text, .refers_to = "parts or moorings"};
  };
  Key box{.name = "box", .kind = Kind::map, .text = "nodes in a box, its faces included"};
  box.keys = {point("from", "one corner", true), point("to", "the corner opposite", true)};
  Key plane{.name = "plane", .kind = Kind::map, .text = "nodes on a plane"};
  plane.keys = {point("point", "a point of the plane", true),
                Key{.name = "normal",
                    .kind = Kind::vector,
                    .text = "its normal, of any length",
                    .required = true},
                Key{.name = "within",
                    .unit = dim::length,
                    .text = "largest distance from it",
                    .limits = at_least(0)}};
  Key key{.name = name, .kind = Kind::map, .text = "a set of nodes", .required = required};
  key.keys = {part("part", "every node of this part"),
              part("edge_of", "the nodes on the free edge of this part"),
              point("nearest", "the one node nearest to this point", false),
              box,
              plane,
              part("of", "the part that nearest, box and plane look at")};
  return key;
}

std::vector<Index> select_nodes(const Keys& nodes, const Scene& scene) {
  std::vector<std::string> given;
  for (const char* form : forms) {
    if (nodes.has(form)) given.emplace_back(form);
  }
  if (given.size() != 1) {
    nodes.complain(given.empty() ? "part" : given[1],
                   "a set of nodes is one of part, edge_of, nearest, box, plane");
    return {};
  }
  const std::string& form = given.front();
  if (form != "part" && form != "edge_of") return nodes_by_place(nodes, form, scene);
  if (nodes.has("of")) {
    nodes.complain("of", fmt::format("'{}' names its part already", form));
    return {};
  }
  const Part* part = element_part(nodes, form.c_str(), scene);
  if (part == nullptr) return {};
  if (form == "edge_of") return edge_nodes(nodes, *part);
  return nodes_where(*part, [](Index) { return true; });
}

}  // namespace gannet
