// The parts that are walls of dummy particles, as drafts: their points.
#pragma once

#include <string>
#include <vector>

#include "scene/draft.hpp"

namespace gannet {

/// Names of the parts under a key ("sph", "wall"), in file order.
std::vector<std::string> names_of_parts_with(const Keys& root, const char* key);

/// The fluid that a wall names, else the first of the case; "" where there is none. A name is not
/// looked up.
std::string named_fluid(const Keys& root, const Keys& wall);

/// The fluid that a wall goes with; "" after a complaint.
std::string fluid_of(const Keys& root, const Keys& wall);

/// How many layers of dummy particles the kernel reaches over. sph: the keys of the fluid.
int n_wall_layers(const Keys& sph, int dimension);

/// Adds a part for each that a case calls a wall, and for each plane that is backed by dummy
/// particles.
void add_wall_parts(const Keys& root, Draft& draft);

}  // namespace gannet
