// What every contact keeps over a restart and tells of itself.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace gannet {

/// What a contact tells of itself at level n.
struct ContactTold {
  std::function<Vec3()> force;               ///< on its second side [N]
  std::function<Vec3()> viscous_force = {};  ///< the share of friction in it [N]; empty: not told
  std::function<std::size_t()> active;       ///< how many pairs push
  const Array<double>* numbers = nullptr;    ///< where it counts overlaps at the start; or not told
  std::size_t overlaps = 0;                  ///< place of their count; the largest [m] comes next
};

/// Tracks the fields of a contact, in this order, as "contact.NAME." and their own names, and
/// registers its measures: force, viscous_force, active, overlaps, overlap_depth. What `told` looks
/// at must stay where it is. Throws nothing.
void track_contact(Scene& scene, const std::string& name, std::vector<Field> fields,
                   const ContactTold& told);

}  // namespace gannet
