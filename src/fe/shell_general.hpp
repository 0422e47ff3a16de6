// Shells of the law of j2.hpp: stress at the points through the thickness, and what happens where
// all of them have failed. For *.isa.cpp files only.
#pragma once

#include "base/simd_math.hpp"
#include "fe/shell_element.hpp"

namespace gannet::GANNET_ISA_NS {

/// What the points through the thickness come to.
struct ColumnStress {
  J2Work<Vec8> work;  ///< per area [J/m^2]
  Vec8 growth;        ///< mean strain increment through the thickness
  Vec8 least_damage;  ///< smallest over the points
};

/// As shell_stress(), of the law of j2.hpp. dt: of the step [s].
/// Not inlined: it is long, and called where a step costs more anyway.
__attribute__((noinline)) inline void general_shell_stress(const ShellConstants& c,
                                                           const ShellLayout& layout, double dt,
                                                           double* state, const ShellIncrements& d,
                                                           const Vec8& t, ShellResultants& r,
                                                           ColumnStress& out) {
  const Vec8 zero(0.0);
  r.nxx = r.nyy = r.nxy = r.mxx = r.myy = r.mxy = zero;
  out = {{zero, zero, zero}, zero, Vec8(1.0)};
  const J2History& h = c.history;
  const Vec8 inverse_dt(dt > 0 ? 1 / dt : 0.0);
  double* p = state;
  for (int k = 0; k < layout.n_points; ++k, p += 8 * layout.per_point) {
    const Vec8 z = Vec8(0.5 * c.point[k]) * t;
    const Vec8 exx = d.xx + z * d.kxx;
    const Vec8 eyy = d.yy + z * d.kyy;
    const Vec8 gxy = d.xy + z * d.kxy;
    double* history = p + 24;
    const auto optional = [&](int j) { return j < 0 ? zero : Vec8::load(history + 8 * j); };
    J2State<Vec8> point{Vec8::load(history), optional(h.temperature), optional(h.damage)};
    PlaneStress<Vec8> alpha{zero, zero, zero};
    double* back = history + 8 * h.back_stress;
    if (h.back_stress >= 0) alpha = {Vec8::load(back), Vec8::load(back + 8), Vec8::load(back + 16)};
    const PlaneStress<Vec8> old{Vec8::load(p), Vec8::load(p + 8), Vec8::load(p + 16)};
    PlaneStress<Vec8> sigma;
    const J2Work<Vec8> w =
        j2_step(c.j2, c.law, old, exx, eyy, gxy, inverse_dt, alpha, point, sigma);
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
    const Vec8 W = Vec8(c.weight[k]) * t;
    out.work.internal += W * w.internal;
    out.work.plastic += W * w.plastic;
    out.work.eroded += W * w.eroded;
    // A point that fails hands its stress to nothing: no strain through the thickness for it.
    const Vec8 strain =
        through_thickness_strain(c.law, exx, eyy, sigma.xx - old.xx, sigma.yy - old.yy);
    out.growth += Vec8(c.weight[k]) * select(less(point.damage, Vec8(1.0)), strain, zero);
    const Vec8 Wz = W * z;
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
                                 double* state, const ShellIncrements& d, Vec8 t,
                                 ShellResultants& r, ColumnStress& out) {
  const Vec8 offset(c.offset);
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
GANNET_INLINE void drop_failed_shear(double* shear, const ShellIncrements& d, Vec8 least_damage,
                                     ShellResultants& r, Vec8& work) {
  const auto carries = less(least_damage, Vec8(1.0));
  const Vec8 zero(0.0);
  const auto lost = [&](Vec8 a) { return select(carries, zero, a); };
  const auto left = [&](Vec8 a) { return select(carries, a, zero); };
  work -= Vec8(0.5) * (lost(r.nxz) * d.xz + lost(r.nyz) * d.yz);
  r.nxz = left(r.nxz);
  r.nyz = left(r.nyz);
  left(Vec8::load(shear)).store(shear);
  left(Vec8::load(shear + 8)).store(shear + 8);
}

/// Takes elements out whose points have all failed: transverse shear and hourglass forces of this
/// step fall to zero with the rest, the thickness is 0 from now on. Takes back the half of their
/// work that their forces of this level would have done. Returns the thickness [m].
GANNET_INLINE Vec8 take_out_failed(const ShellLayout& layout, double* state,
                                   const ShellIncrements& d, Vec8 least_damage, Vec8 t,
                                   ShellResultants& r, Vec8& shear_work, Vec8& hourglass_work) {
  const auto carries = less(least_damage, Vec8(1.0));
  const Vec8 zero(0.0);
  if (!any(less(zero, select(carries, zero, t)))) return t;
  const auto lost = [&](Vec8 a) { return select(carries, zero, a); };
  const auto left = [&](Vec8 a) { return select(carries, a, zero); };
  shear_work -= Vec8(0.5) * (lost(r.nxz) * d.xz + lost(r.nyz) * d.yz);
  r.nxz = left(r.nxz);
  r.nyz = left(r.nyz);
  for (int k = 0; k < 5; ++k) {
    hourglass_work -= Vec8(0.5) * lost(r.Q[k]) * d.q[k];
    r.Q[k] = left(r.Q[k]);
  }
  for (int k = layout.shear(); k < layout.thickness(); ++k) {
    left(Vec8::load(state + 8 * k)).store(state + 8 * k);
  }
  left(Vec8::load(state + 8 * layout.thickness())).store(state + 8 * layout.thickness());
  return left(t);
}

}  // namespace gannet::GANNET_ISA_NS
