// The work of a contact on surface nodes of a faster model. They move in substeps, so that it is
// measured from level to level of the slow model, along what they really moved by:
//   W = sum_i (f_i(n-1) + f_i(n))/2 . (x_i(n) - x_i(n-1))
#pragma once

#include <string>
#include <vector>

#include "contact/force.hpp"
#include "plan/link.hpp"

namespace gannet {

/// One kind of force of a contact: normal, friction or damping.
struct LinkedForce {
  LedgerEntry* entry = nullptr;
  const std::vector<Vec3>* of_rows = nullptr;  ///< on the points of all rows at this level [N]
  Array<Line> f_level;                         ///< on the surface nodes at the last level [N]
  Array<Line> f;                               ///< at this level
};

/// Takes the work on the surface nodes of a contact out of the entry: what it holds grows by what
/// the nodes give. After collect of the link, at the level.
void add_linked_work(const ContactInput& in, const Link& link, LinkedForce& force);

}  // namespace gannet
