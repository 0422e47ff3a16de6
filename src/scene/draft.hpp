// What the parts of a case bring together before there is a node table, and how they become one.
#pragma once

#include <string>
#include <vector>

#include "base/function.hpp"
#include "base/keys.hpp"
#include "base/math.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// One part as its effect made it: points, cells over them, start velocity.
struct PartDraft {
  std::string name;
  std::string kind;
  std::string material;
  Location where;
  bool rotations = false;  ///< its nodes have rotational lines
  Cell cell = Cell::none;  ///< none: the points are particles
  std::vector<Vec3> points;
  std::vector<Index> connectivity;        ///< indices into points
  VectorFunction velocity{Vec3::Zero()};  ///< initial velocity by place [m/s]
};

struct Draft {
  std::string title;
  int dimension = 3;
  std::vector<PartDraft> parts;
};

/// The key initial_velocity of a part, for a schema.
Key initial_velocity_key();

/// What it says: at rest where it is absent. Complains where it is not finite at a point.
VectorFunction initial_velocity(const Keys& part, const std::vector<Vec3>& points);

/// Numbers the nodes (rotating, other, particles), orders nodes and cells of each mesh along a
/// space-filling curve, and tracks the fields of the node table. Masses are 0 until the effects
/// add theirs.
void assemble(const Draft& draft, Scene& scene);

/// After all masses are known: fills the inverse masses and inertias. Nodes without mass get 0.
void finish_masses(Scene& scene);

}  // namespace gannet
