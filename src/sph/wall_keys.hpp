// What a case may say of walls of dummy particles.
#pragma once

#include "base/schema.hpp"

namespace gannet {

/// Keys `parts.*.wall` and `boundaries.*.extent`.
Schema wall_schema();

}  // namespace gannet
