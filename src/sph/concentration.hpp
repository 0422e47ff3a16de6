// The gradient of the concentration of particles, and div r: what free-surface detection and
// shifting read. A term of the rates pass, there when one of them asks.
#pragma once

#include <string>

#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Makes sure that the rates pass stores sph.concentration, and tracks it: owned by the first
/// effect that asks. It is read after the pass that stores it, and shown before the next one, so a
/// checkpoint holds it.
void want_concentration(SphState& sph, Scene& scene, const std::string& owner);

}  // namespace gannet
