#include "fe/shell_kernel.hpp"

#include "fe/shell_element.hpp"
#include "fe/shell_general.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// Gathers the corners of a block: lines at base as three components.
GANNET_INLINE void gather_corners(const double* base, const std::int32_t* corners, Vec8x3 out[4]) {
  for (int a = 0; a < 4; ++a) out[a] = gather_corner(base, corners, a);
}

GANNET_INLINE void scatter_corners(double* base, const std::int32_t* corners, const Vec8x3 in[4]) {
  for (int a = 0; a < 4; ++a) scatter_corner(base, corners, a, in[a]);
}

/// Blocks between the one at work and the one whose data is called for: long enough for memory to
/// answer (50 to 70 % more elements a second out of cache).
constexpr std::int32_t blocks_ahead = 2;

/// Calls for the state and the nodes of a later block. Two opposite corners are enough: with its
/// neighbours they name nearly every node.
GANNET_INLINE void call_for(const ShellPass& pass, std::int32_t block) {
  const int n_values = pass.layout.n_values();
  const double* state = pass.state + static_cast<std::int64_t>(block) * n_values * 8;
  for (int k = 0; k < n_values; ++k) __builtin_prefetch(state + 8 * k, 1);
  const std::int32_t* corners = pass.corners + 32 * static_cast<std::int64_t>(block);
  for (int k = 0; k < 16; ++k) {
    const std::int64_t line = 4 * static_cast<std::int64_t>(corners[k < 8 ? k : k + 8]);
    __builtin_prefetch(pass.x + line);
    __builtin_prefetch(pass.v + line);
    __builtin_prefetch(pass.omega + line);
    __builtin_prefetch(pass.f + line, 1);
    __builtin_prefetch(pass.torque + line, 1);
  }
}

/// The thickness follows the strain increment: t (1 + e/2)/(1 - e/2), t exp(e) to second order.
GANNET_INLINE Vec8 grown(Vec8 t, Vec8 strain) {
  return t * (Vec8(1.0) + Vec8(0.5) * strain) / (Vec8(1.0) - Vec8(0.5) * strain);
}

/// One block of eight elements.
template <PointLaw law>
GANNET_INLINE void shell_block(const ShellPass& pass, std::int32_t block, ShellLaneSums& sums) {
  const ShellConstants& c = *pass.constants;
  const ShellLayout& layout = pass.layout;
  const std::int32_t* corners = pass.corners + 32 * static_cast<std::int64_t>(block);
  double* state = pass.state + static_cast<std::int64_t>(block) * layout.n_values() * 8;
  Vec8x3 x[4];
  Vec8x3 v[4];
  Vec8x3 w[4];
  gather_corners(pass.x, corners, x);
  gather_corners(pass.v, corners, v);
  gather_corners(pass.omega, corners, w);

  Vec8x3 middle[4];
  for (int a = 0; a < 4; ++a) middle[a] = x[a] - scaled(v[a], Vec8(0.5 * pass.dt));
  const ShellGeometry half = shell_geometry(middle);
  double* fibres = layout.has_fibres ? state + 8 * layout.fibres() : nullptr;
  if (fibres != nullptr) follow_fibres(half, v, w, fibres, Vec8(pass.dt));
  const ShellIncrements d = shell_increments(half, v, w, Vec8(pass.dt));
  Vec8 t = Vec8::load(state + 8 * layout.thickness());
  ShellResultants r;
  HourglassStiffness K;
  Vec8 work;
  Vec8 plastic_work;
  Vec8 growth;
  GeneralStress general;
  if constexpr (law == PointLaw::general) {
    general_shell_stress(c, layout, pass.dt, state, d, t, r, general);
    work = general.work.internal;
    plastic_work = general.work.plastic;
    growth = general.growth;
    sums.eroded += general.work.eroded * half.area;
  } else {
    growth = shell_stress<law == PointLaw::linear_hardening>(c, layout, state, d, t, r, work,
                                                             plastic_work);
  }
  shell_shear(c, state + 8 * layout.shear(), d, t, r, work);
  Vec8 hourglass_work =
      shell_hourglass(c, half, state + 8 * layout.hourglass(), d, t, pass.dt, r, K);
  if constexpr (law == PointLaw::general) {
    t = take_out_failed(layout, state, d, general.least_damage, t, r, work, hourglass_work);
  }
  sums.hourglass += hourglass_work;
  sums.internal += work * half.area;
  if constexpr (law != PointLaw::elastic) sums.plastic += plastic_work * half.area;
  if (c.thickness_changes) grown(t, growth).store(state + 8 * layout.thickness());

  const ShellGeometry now = shell_geometry(x);
  Vec8x3 f[4];
  Vec8x3 m[4];
  shell_corner_forces(now, r, f, m);
  if (fibres != nullptr) give_back_spin(now, load_fibres(fibres), f, m);
  scatter_corners(pass.f, corners, f);
  scatter_corners(pass.torque, corners, m);

  const Vec8 omega2 =
      shell_omega2(c, now, t, Vec8::load(state + 8 * layout.inverse_area()), K, fibres);
  const auto larger = less(sums.omega2, omega2);
  sums.omega2 = select(larger, omega2, sums.omega2);
  sums.block = select(larger, Vec8(static_cast<double>(block)), sums.block);
}

template <PointLaw law>
GANNET_INLINE void shell_blocks(const ShellPass& pass, std::int32_t begin, std::int32_t end,
                                ShellSums& out) {
  ShellLaneSums sums;
  for (std::int32_t block = begin; block < end; ++block) {
    if (block + blocks_ahead < end) call_for(pass, block + blocks_ahead);
    shell_block<law>(pass, block, sums);
  }
  out.internal = sum(sums.internal);
  out.plastic = sum(sums.plastic);
  out.hourglass = sum(sums.hourglass);
  out.eroded = sum(sums.eroded);
  alignas(64) double omega2[8];
  alignas(64) double index[8];
  sums.omega2.store(omega2);
  sums.block.store(index);
  out.omega2 = 0;
  out.element = -1;
  for (int lane = 0; lane < 8; ++lane) {
    if (omega2[lane] <= out.omega2) continue;
    out.omega2 = omega2[lane];
    out.element = 8 * static_cast<std::int32_t>(index[lane]) + lane;
  }
}

}  // namespace

__attribute__((flatten)) void shell_force(const ShellPass& pass, std::int32_t begin,
                                          std::int32_t end, ShellSums& sums) {
  const PointLaw law = pass.constants->point_law;
  if (law == PointLaw::linear_hardening) {
    shell_blocks<PointLaw::linear_hardening>(pass, begin, end, sums);
  } else if (law == PointLaw::general) {
    shell_blocks<PointLaw::general>(pass, begin, end, sums);
  } else {
    shell_blocks<PointLaw::elastic>(pass, begin, end, sums);
  }
}

}  // namespace gannet::GANNET_ISA_NS
