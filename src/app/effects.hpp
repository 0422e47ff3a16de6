// The table of effects: the one file (effects.cpp) that names them all.
#pragma once

#include <span>

#include "plan/effect.hpp"

namespace gannet {

/// All effects that the program knows. Their order is the order of their operations in a stage.
std::span<const Effect> effects();

/// Keys that belong to the case itself (title, dimension) and those of all effects.
Schema whole_schema();

}  // namespace gannet
