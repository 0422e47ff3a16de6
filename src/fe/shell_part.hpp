// A part of shells: its blocks, and what checkpoints and output have of it.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "fe/shell.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The blocks of a part, one for each kind of element it has, and what output shows of it, by cell.
struct ShellPart {
  std::string name;
  int part = -1;
  bool erodes = false;  ///< elements that have collapsed leave; else they stop the run
  std::vector<ShellBlock*> blocks;
  Array<double> thickness, stress, plastic, damage;
  std::vector<std::uint8_t> gone;  ///< per cell whether it has left; empty where none can
  Array<double> membrane_force, moment, shear_force;
};

/// Found by scene.store.
struct ShellParts {
  std::deque<ShellPart> list;
};

/// The whole states for checkpoints; for output, what is derived from them when it is asked for.
void track_shells(Scene& scene, ShellPart& part, bool section_forces);

}  // namespace gannet
