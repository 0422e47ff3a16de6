// Stop criteria: output.stop ends a run before its time, once something that it watches has
// happened. It looks at every level at which output may, and changes nothing else.
#pragma once

#include <functional>
#include <string>

#include "plan/effect.hpp"

namespace gannet {

/// The key `stop` of `output`.
Key stop_key();

/// Says why the run ends at the level of time t [s]: "slam_force z = 5012 N, above 5000 N"; ""
/// where it goes on.
using StopCheck = std::function<std::string(double t)>;

/// The check that output.stop asks for; empty where it asks for none, or after a mistake.
/// Measures must exist: to be made after all that make some.
StopCheck make_stop(const Keys& output, const Scene& scene);

}  // namespace gannet
