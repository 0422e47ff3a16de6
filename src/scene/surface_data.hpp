// What contact needs to know of the parts that have a surface: one small struct a part, filled by
// the effect that makes the elements.
#pragma once

#include <cstdint>
#include <vector>

namespace gannet {

/// The surface of one part; zeros where a part has none.
struct ShellSurface {
  double thickness = 0;  ///< of the shell at the start, diameter of a cable or beam [m]
  double young = 0;      ///< Young's modulus [Pa]
  double offset = 0;     ///< of the middle of the shell from its nodes, along their normals [m]
  /// For each cell of the part whether it has left; nullptr where none can. Up to date in the force
  /// stage once the elements have been passed over.
  const std::vector<std::uint8_t>* gone = nullptr;
  double modulus = 0;  ///< K + 4/3 G of a part of solids, its stiffness with sides held [Pa]
  double axial = 0;    ///< axial stiffness EA of a part of cables or beams [N]
};

/// scene.store.get<SurfaceData>().of_part[p] belongs to scene.parts[p]; may be shorter than the
/// list of parts.
struct SurfaceData {
  std::vector<ShellSurface> of_part;
};

}  // namespace gannet
