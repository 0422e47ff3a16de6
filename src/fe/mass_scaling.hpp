// parts.NAME.mass_scaling: mass for the elements whose stable step is below a wanted one, added
// once before the run, so that momenta and energy are those of a somewhat heavier part.
#pragma once

#include <functional>
#include <span>

#include "base/array.hpp"
#include "base/keys.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Own mass [kg] and rotary inertia [kg m^2] that an element gives to each of its corners.
struct CornerMass {
  double m = 0;
  double I = 0;
};

/// The elements of one block as mass scaling sees them.
struct ScalableElements {
  Index n_elements = 0;
  int n_corners = 0;
  double dt_factor = 1;  ///< the part votes for this share of the stable step
  Array<double> bounds;  ///< squares of the frequencies of each element [1/s^2]
  std::function<CornerMass(Index e)> mass;
  std::function<Index(Index e, int a)> corner;  ///< node that corner a of element e is
  std::function<Index(Index e)> cell;           ///< of the part that the element is
  Array<double>* inverse_mass = nullptr;        ///< gets own over whole mass, eight a block
};

/// Factor of the mass of an element with the bound omega2 [1/s^2] that allows the step dt [s] at
/// dt_factor: all its frequencies fall with the root of its mass,
///   s = max(1, omega^2 (dt/dt_factor)^2/4)
double mass_factor(double omega2, double dt, double dt_factor);

/// Where the part asks for it: adds (s - 1) times its own to the mass and the rotary inertia of
/// each corner of each element, and notes what was added. Notes a mistake that says by how much and
/// what to do where the mass of the part would grow by more than the ceiling; then nothing is
/// added. blocks: all elements of the part, number: its number in the scene.
void scale_masses(const Keys& part, int number, Scene& scene, std::span<ScalableElements> blocks);

}  // namespace gannet
