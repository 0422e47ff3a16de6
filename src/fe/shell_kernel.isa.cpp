#include "fe/shell_kernel.hpp"

#include "fe/shell_damping.hpp"
#include "fe/shell_element.hpp"
#include "fe/shell_general.hpp"
#include "fe/shell_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

struct OnePoint {
  static constexpr int n_corners = 4;
  template <PointLaw law>
  static GANNET_INLINE void block(const ShellPass& pass, std::int32_t block, ShellLaneSums& sums);
};

/// One block of eight elements.
template <PointLaw law>
GANNET_INLINE void OnePoint::block(const ShellPass& pass, std::int32_t block, ShellLaneSums& sums) {
  const ShellConstants& c = *pass.constants;
  const ShellLayout& layout = pass.layout;
  double* state = pass.state + static_cast<std::int64_t>(block) * layout.n_values() * 8;
  CornersOf<4> corners = gather_all<4>(pass, block);
  const VecX3* x = corners.x;
  const VecX3* v = corners.v;
  VecX3* w = corners.w;

  Vec t = Vec::load(state + 8 * layout.thickness());
  ShellGeometry half = shell_geometry(corners.middle);
  ShellGeometry now = shell_geometry(x);
  const auto goes_on =
      sums.shrunk_to(min(half.area, now.area) * Vec::load(state + 8 * layout.inverse_area()),
                     c.smallest_ratio, t, block);
  if (leaves_out(goes_on)) {
    make_harmless(corners, goes_on);
    t = select(goes_on, t, Vec(0.0));
    half = shell_geometry(corners.middle);
    now = shell_geometry(x);
  }
  double* fibres = layout.has_fibres ? state + 8 * layout.fibres() : nullptr;
  if (fibres != nullptr) follow_fibres(half, v, w, fibres, Vec(pass.dt));
  const ShellIncrements d = shell_increments(half, v, w, Vec(pass.dt));
  ShellResultants r;
  HourglassStiffness K;
  ColumnStress column;
  column_stress<law>(c, layout, pass.dt, state, d, t, r, column);
  Vec& work = column.work.internal;
  shell_shear(c, state + 8 * layout.shear(), d, t, r, work);
  Vec hourglass_work =
      shell_hourglass(c, half, state + 8 * layout.hourglass(), d, t, pass.dt, r, K);
  if constexpr (law == PointLaw::general) {
    t = take_out_failed(layout, state, d, column.least_damage, t, r, work, hourglass_work);
  }
  add_damping(pass, block, 0, state, d, t, half.area, r, sums);
  sums.hourglass += hourglass_work;
  sums.internal += work * half.area;
  if constexpr (law != PointLaw::elastic) sums.plastic += column.work.plastic * half.area;
  if constexpr (law == PointLaw::general) sums.eroded += column.work.eroded * half.area;
  if (c.thickness_changes) grown(t, column.growth).store(state + 8 * layout.thickness());

  VecX3 f[4];
  VecX3 m[4];
  shell_corner_forces(now, r, f, m);
  if (fibres != nullptr) give_back_spin(now, load_fibres(fibres), f, m);
  scatter_all<4>(pass, block, f, m);

  const Vec omega2 =
      shell_omega2(c, now, t, Vec::load(state + 8 * layout.inverse_area()), K, fibres);
  sums.vote(pass, omega2, block);
}

}  // namespace

__attribute__((flatten)) void shell_force(const ShellPass& pass, std::int32_t begin,
                                          std::int32_t end, ShellSums& sums) {
  with_law<OnePoint>(pass, begin, end, sums);
}

}  // namespace gannet::GANNET_ISA_NS
