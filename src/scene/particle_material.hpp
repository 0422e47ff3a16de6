// What passes outside the SPH room may need to know of the material of particles: one small
// struct a part, filled by the effect that makes the particles.
#pragma once

#include <vector>

#include "kernel/smoothing_kernel.hpp"

namespace gannet {

/// The material of the particles of one part; zeros where a part is not made of particles.
struct ParticleMaterial {
  double spacing = 0;  ///< initial distance of neighbouring particles [m]
  double rho0 = 0;     ///< reference density [kg/m^3]
  double c0 = 0;       ///< speed of sound at rho0 [m/s]
  SmoothingKernel kernel{};
};

/// scene.store.get<ParticleMaterials>().of_part[p] belongs to scene.parts[p]; may be shorter than
/// the list of parts.
struct ParticleMaterials {
  std::vector<ParticleMaterial> of_part;
};

}  // namespace gannet
