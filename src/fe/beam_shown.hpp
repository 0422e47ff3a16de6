// What is shown of the fibres of beams.
#pragma once

#include "fe/beam.hpp"

namespace gannet {

/// Fills damage_shown. Needs a law that fails.
void show_damage(BeamBlock& block);

/// Fills plastic_shown. Needs a law that yields.
void show_plastic_strain(BeamBlock& block);

}  // namespace gannet
