// Damping of shells in proportion to stiffness. For *.isa.cpp files only.
#pragma once

#include "fe/shell_element.hpp"
#include "fe/shell_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

/// Damping forces of the section over one point of the plane, added to the resultants r about the
/// nodes; z0 the height of the middle, C the elastic matrix of plane stress:
///   N = (beta/dt) t C (d + z0 k),  M = (beta/dt) t^3/12 C k + z0 N,  Q = (beta/dt) kappa G t gamma
/// factor: beta/dt [-]; kept: those of the step before, which these replace; t: thickness [m], 0 of
/// what carries nothing. Returns the work per area by trapezoids, (F(n-1) + F(n))/2 . d [J/m^2].
/// Not inlined: parts without damping do not carry it along.
__attribute__((noinline)) inline void shell_damping(const ShellConstants& c, const Vec& factor,
                                                    double* kept, const ShellIncrements& d,
                                                    const Vec& t, ShellResultants& r, Vec& work) {
  const Vec zero(0.0);
  const Vec z0(c.offset);
  PlaneStress<Vec> n{zero, zero, zero};
  PlaneStress<Vec> m{zero, zero, zero};
  add_elastic(c.law, d.xx + z0 * d.kxx, d.yy + z0 * d.kyy, d.xy + z0 * d.kxy, n);
  add_elastic(c.law, d.kxx, d.kyy, d.kxy, m);
  const Vec stretch = factor * t;
  const Vec bend = stretch * t * t * Vec(1.0 / 12.0);
  const Vec shear = stretch * Vec(c.shear_factor * c.law.shear);
  const Vec N[3] = {stretch * n.xx, stretch * n.yy, stretch * n.xy};
  const Vec F[8] = {N[0],
                    N[1],
                    N[2],
                    bend * m.xx + z0 * N[0],
                    bend * m.yy + z0 * N[1],
                    bend * m.xy + z0 * N[2],
                    shear * d.xz,
                    shear * d.yz};
  const Vec path[8] = {d.xx, d.yy, d.xy, d.kxx, d.kyy, d.kxy, d.xz, d.yz};
  Vec* const to[8] = {&r.nxx, &r.nyy, &r.nxy, &r.mxx, &r.myy, &r.mxy, &r.nxz, &r.nyz};
  work = zero;
  for (int k = 0; k < 8; ++k) {
    work += Vec(0.5) * (Vec::load(kept + 8 * k) + F[k]) * path[k];
    F[k].store(kept + 8 * k);
    *to[k] += F[k];
  }
}

/// Where the part asks for it: damping over point g of the plane, its work added to the sums.
/// state: of the block; area: that the point stands for [m^2].
GANNET_INLINE void add_damping(const ShellPass& pass, std::int32_t block, int g, double* state,
                               const ShellIncrements& d, Vec t, Vec area, ShellResultants& r,
                               ShellLaneSums& sums) {
  if (pass.votes.damping_time == nullptr) [[likely]]
    return;
  // Copies: what a function gets by reference is kept in memory wherever it is used.
  const ShellIncrements increments = d;
  ShellResultants with_damping = r;
  Vec work;
  shell_damping(*pass.constants, damping_per_step(pass.votes, block, pass.dt),
                state + 8 * pass.layout.damping(g), increments, t, with_damping, work);
  r = with_damping;
  sums.damping += work * area;
}

}  // namespace gannet::GANNET_ISA_NS
