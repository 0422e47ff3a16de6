// Sets of nodes as a user asks for them: a whole part, the edge of a shell, the node nearest to a
// point, what lies in a box or on a plane. Boundaries, loads and probes all use these keys.
#pragma once

#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The key `name` that holds a set of nodes, for the schema of whoever takes one. The map holds
/// exactly one of
///   part: NAME                                 every node of the part
///   edge_of: NAME                              nodes on edges that only one cell uses
///   nearest: [x, y, z], of: NAME               one node; of equally near ones the first
///   box: {from: [..], to: [..]}, of: NAME      nodes in the box, its faces included
///   plane: {point, normal, within}, of: NAME   nodes at most `within` from the plane
Key node_set_key(const std::string& name, bool required);

/// The nodes of a set at their present positions (so: ask before the first step), in rising order,
/// each once.
/// nodes: the map of node_set_key(). Notes a mistake at its place and returns an empty list where
/// the set is not described by one form, finds no node, or asks for particles: they change their
/// order in the node table and cannot be held by their index. Throws nothing.
std::vector<Index> select_nodes(const Keys& nodes, const Scene& scene);

}  // namespace gannet
