// Shells of the law of j2.hpp: stress at the points through the thickness, and what happens where
// all of them have failed. For *.isa.cpp files only.
#pragma once

#include "base/simd_vec.hpp"
#include "fe/shell_element.hpp"

namespace gannet::GANNET_ISA_NS {

/// What the points through the thickness come to.
struct ColumnStress {
  J2Work<Vec> work;  ///< per area [J/m^2]
  Vec growth;        ///< mean strain increment through the thickness
  Vec least_damage;  ///< smallest over the points
};

/// As shell_stress(), of the law of j2.hpp. dt: of the step [s].
/// Not inlined: it is long, and called where a step costs more anyway.
__attribute__((noinline)) inline void general_shell_stress(const ShellConstants& c,
                                                           const ShellLayout& layout, double dt,
                                                           double* state, const ShellIncrements& d,
                                                           const Vec& t, ShellResultants& r,
                                                           ColumnStress& out) {
  const Vec zero(0.0);
  r.nxx = r.nyy = r.nxy = r.mxx = r.myy = r.mxy = zero;
  out = {{zero, zero, zero}, zero, Vec(1.0)};
  const J2History& h = c.history;
  const Vec inverse_dt(dt > 0 ? 1 / dt : 0.0);
  double* p = state;
  for (int k = 0; k < layout.n_points; ++k, p += 8 * layout.per_point) {
    const Vec z = Vec(0.5 * c.point[k]) * t;
    const Vec exx = d.xx + z * d.kxx;
    const Vec eyy = d.yy + z * d.kyy;
    const Vec gxy = d.xy + z * d.kxy;
    double* history = p + 24;
    const auto optional = [&](int j) { return j < 0 ? zero : Vec::load(history + 8 * j); };
    J2State<Vec> point{Vec::load(history), optional(h.temperature), optional(h.damage)};
    PlaneStress<Vec> alpha{zero, zero, zero};
    double* back = history + 8 * h.back_stress;
    if (h.back_stress >= 0) alpha = {Vec::load(back), Vec::load(back + 8), Vec::load(back + 16)};
    const PlaneStress<Vec> old{Vec::load(p), Vec::load(p + 8), Vec::load(p + 16)};
    PlaneStress<Vec> sigma;
    const J2Work<Vec> w = j2_step(c.j2, c.law, old, exx, eyy, gxy, inverse_dt, alpha, point, sigma);
    sigma.xx.store(p);
    sigma.yy.store(p + 8);
    sigma.xy.store(p + 16);
    point.eps_p.store(history);
    if (h.back_stress >= 0) {
      alpha.xx.store(back);
      alpha.yy.store(back + 8);
      alpha.xy.store(back + 16);
    }
    if (h.temperature >= 0) point.rise.store(history + 8 * h.temperature);
    if (h.damage >= 0) point.damage.store(history + 8 * h.damage);
    out.least_damage = min(out.least_damage, point.damage);
    const Vec W = Vec(c.weight[k]) * t;
    out.work.internal += W * w.internal;
    out.work.plastic += W * w.plastic;
    out.work.eroded += W * w.eroded;
    // A point that fails hands its stress to nothing: no strain through the thickness for it.
    const Vec strain =
        through_thickness_strain(c.law, exx, eyy, sigma.xx - old.xx, sigma.yy - old.yy);
    out.growth += Vec(c.weight[k]) * select(less(point.damage, Vec(1.0)), strain, zero);
    const Vec Wz = W * z;
    r.nxx += W * sigma.xx;
    r.nyy += W * sigma.yy;
    r.nxy += W * sigma.xy;
    r.mxx += Wz * sigma.xx;
    r.myy += Wz * sigma.yy;
    r.mxy += Wz * sigma.xy;
  }
}

/// Stress from n-1 to n at the points through the thickness over one point of the plane, of
/// whatever law: see shell_stress() and general_shell_stress(). The middle of the shell lies
/// c.offset over the nodes, whose strain and moments are those of d and r.
template <PointLaw law>
GANNET_INLINE void column_stress(const ShellConstants& c, const ShellLayout& layout, double dt,
                                 double* state, const ShellIncrements& d, Vec t, ShellResultants& r,
                                 ColumnStress& out) {
  const Vec offset(c.offset);
  ShellIncrements middle = d;
  middle.xx += offset * d.kxx;
  middle.yy += offset * d.kyy;
  middle.xy += offset * d.kxy;
  if constexpr (law == PointLaw::general) {
    general_shell_stress(c, layout, dt, state, middle, t, r, out);
  } else {
    out.growth = shell_stress<law == PointLaw::linear_hardening>(
        c, layout, state, middle, t, r, out.work.internal, out.work.plastic);
  }
  r.mxx += offset * r.nxx;
  r.myy += offset * r.nyy;
  r.mxy += offset * r.nxy;
}

/// Where all points over one of the plane have failed, the transverse shear there falls to zero
/// with the rest. shear: its state. Takes back the half of the work that its forces of this level
/// would have done.
GANNET_INLINE void drop_failed_shear(double* shear, const ShellIncrements& d, Vec least_damage,
                                     ShellResultants& r, Vec& work) {
  const auto carries = less(least_damage, Vec(1.0));
  const Vec zero(0.0);
  const auto lost = [&](Vec a) { return select(carries, zero, a); };
  const auto left = [&](Vec a) { return select(carries, a, zero); };
  work -= Vec(0.5) * (lost(r.nxz) * d.xz + lost(r.nyz) * d.yz);
  r.nxz = left(r.nxz);
  r.nyz = left(r.nyz);
  left(Vec::load(shear)).store(shear);
  left(Vec::load(shear + 8)).store(shear + 8);
}

/// Takes elements out whose points have all failed: transverse shear and hourglass forces of this
/// step fall to zero with the rest, the thickness is 0 from now on. Takes back the half of their
/// work that their forces of this level would have done. Returns the thickness [m].
GANNET_INLINE Vec take_out_failed(const ShellLayout& layout, double* state,
                                  const ShellIncrements& d, Vec least_damage, Vec t,
                                  ShellResultants& r, Vec& shear_work, Vec& hourglass_work) {
  const auto carries = less(least_damage, Vec(1.0));
  const Vec zero(0.0);
  if (!any(less(zero, select(carries, zero, t)))) return t;
  const auto lost = [&](Vec a) { return select(carries, zero, a); };
  const auto left = [&](Vec a) { return select(carries, a, zero); };
  shear_work -= Vec(0.5) * (lost(r.nxz) * d.xz + lost(r.nyz) * d.yz);
  r.nxz = left(r.nxz);
  r.nyz = left(r.nyz);
  for (int k = 0; k < 5; ++k) {
    hourglass_work -= Vec(0.5) * lost(r.Q[k]) * d.q[k];
    r.Q[k] = left(r.Q[k]);
  }
  for (int k = layout.shear(); k < layout.thickness(); ++k) {
    left(Vec::load(state + 8 * k)).store(state + 8 * k);
  }
  left(Vec::load(state + 8 * layout.thickness())).store(state + 8 * layout.thickness());
  return left(t);
}

}  // namespace gannet::GANNET_ISA_NS
