// Numbers of the whole scene that a checkpoint keeps.
#pragma once

#include <functional>
#include <string>

#include "scene/scene.hpp"

namespace gannet {

/// Tracks `components` doubles that stand one after the other where values() says, asked anew each
/// time: name and unit as for a field, owner: the effect that keeps them.
void track_values(Scene& scene, const std::string& owner, const std::string& name,
                  const std::string& unit, int components, std::function<double*()> values);

}  // namespace gannet
