// What blocks of the shells of shell_assumed.hpp keep and have in common. For *.isa.cpp files only.
#pragma once

#include "fe/shell_damping.hpp"
#include "fe/shell_general.hpp"
#include "fe/shell_kernel.hpp"

namespace gannet::GANNET_ISA_NS {

/// Thickness and what else is kept of a block after the points.
struct BlockState {
  double* all;
  double* shear;
  double* fibres;
  double* thickness;
  Vec inverse_A0;
};

GANNET_INLINE BlockState block_state(const ShellPass& pass, std::int32_t number) {
  const ShellLayout& layout = pass.layout;
  double* all = pass.state + static_cast<std::int64_t>(number) * layout.n_values() * 8;
  return {all, all + 8 * layout.shear(), all + 8 * layout.fibres(), all + 8 * layout.thickness(),
          Vec::load(all + 8 * layout.inverse_area())};
}

/// The thickness over a point of the plane that still carries something [m].
template <PointLaw law>
GANNET_INLINE Vec carrying(Vec t, const ColumnStress& column) {
  if constexpr (law != PointLaw::general) return t;
  return select(less(column.least_damage, Vec(1.0)), t, Vec(0.0));
}

/// The thickness [m], 0 from now on where every point has failed.
GANNET_INLINE Vec left_of(Vec t, Vec least_damage, double* thickness) {
  const Vec left = select(less(least_damage, Vec(1.0)), t, Vec(0.0));
  left.store(thickness);
  return left;
}

}  // namespace gannet::GANNET_ISA_NS
