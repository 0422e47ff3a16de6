// Line files of MoorDyn, versions 1 and 2, as mooring lines.
#pragma once

#include <string>
#include <vector>

#include "fe/mooring.hpp"

namespace gannet {

/// What a line file of MoorDyn says.
struct MoorDynFile {
  std::vector<MooringLine> lines;     ///< named line_ID
  double g = 9.80665;                 ///< [m/s^2]
  std::vector<std::string> mistakes;  ///< "lines.txt:14: ...": then there are no lines
};

/// Reads a line file of MoorDyn (FloatingArrayDesign/MoorDyn, docs/inputs.rst): LINE TYPES with the
/// columns of version 1 or 2, POINTS (or CONNECTIONS, NODES) that are fixed, coupled or vessel,
/// LINES, and the OPTIONS g, rhoW (WtrDens), WtrDpth, kBot, cBot, FrictionCoefficient. The upper
/// end of a line is the coupled one. Points that are free or on bodies, bending stiffness, bodies,
/// rods and stiffness from a file are mistakes; other options and outputs say nothing about a line.
/// text: of the file; name: for messages; held: whether ends at coupled points are. Throws nothing.
MoorDynFile read_moordyn(const std::string& text, const std::string& name, bool held);

}  // namespace gannet
