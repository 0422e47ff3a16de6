// The effect `models`: parts at steps of their own.
#pragma once

#include "plan/effect.hpp"

namespace gannet {

/// models.NAME: divides the parts of a case among models, slowest first.
Effect models_effect();

}  // namespace gannet
