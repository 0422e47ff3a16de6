// What is shown of shells: stress, section forces, plastic strain and damage from their state.
#pragma once

#include <span>

#include "fe/shell.hpp"

namespace gannet {

/// Fills stress_shown from the state: global xx, yy, zz, xy, yz, xz at the middle surface (the
/// point there, or the mean of the two nearest), mean over the points of the plane, in the frame at
/// positions x [m].
void show_stress(ShellBlock& block, std::span<const Line> x);

/// Fills forces_shown from the state, in the frame at positions x [m]: the membrane forces N and
/// the bending moments M about the middle of the shell as global tensors xx, yy, zz, xy, yz, xz
/// [N/m], [N], and the transverse shear force Q as a global vector [N/m], mean over the points of
/// the plane.
///   N = sum w t sigma,  M = sum w t z sigma,  Q = kappa t (sigma_xz e1 + sigma_yz e2)
void show_section_forces(ShellBlock& block, std::span<const Line> x);

/// Fills plastic_shown from the state. Needs a plastic material.
void show_plastic_strain(ShellBlock& block);

/// Fills damage_shown from the state. Needs a material that fails.
void show_damage(ShellBlock& block);

}  // namespace gannet
