// Which bodies of a case are rigid for a time only (body/rigid_phases_effect.cpp).
#pragma once

#include <vector>

#include "base/keys.hpp"

namespace gannet {

/// The maps of all bodies with the key `rigid`, in file order.
std::vector<Keys> bodies_rigid_for_a_time(const Keys& root);

}  // namespace gannet
