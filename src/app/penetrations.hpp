// What touches before the first step.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace gannet {

/// Penetrations of one contact at the start.
struct StartOverlap {
  std::string contact;  ///< "contact slam", "plane basin.z_min"
  long count = 0;       ///< particles or nodes nearer than the contact distance
  double depth = 0;     ///< of the deepest [m]
};

/// One entry a contact, those without penetration too: what the measures "contact.NAME.overlaps"
/// and ".overlap_depth" hold, and particles nearer to a plane than their contact distance.
/// Needs the force stage of the first level to have run.
std::vector<StartOverlap> start_overlaps(Scene& scene);

}  // namespace gannet
