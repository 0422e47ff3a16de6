// The key `sea`: waves and current.
#pragma once

#include "base/keys.hpp"
#include "scene/wave_field.hpp"

namespace gannet {

/// sea: {level, depth, current, wave: {type, height, length, phase, direction, components,
/// spectrum}}
Schema sea_schema();

/// What it says, with gravity from loads.gravity along the last axis of the space. Notes mistakes;
/// the depth is then 0.
WaveField read_wave_field(const Keys& root, int dimension);

}  // namespace gannet
