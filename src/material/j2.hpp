// J2 plasticity at one point with hardening by a curve or a power, kinematic hardening (Prager
// 1956), a yield stress that depends on the rate (Cowper & Symonds 1957; Johnson & Cook 1983) and
// on the temperature, and failure. What metals with linear hardening need, and nothing else, stands
// in plane_stress.hpp and solid_stress.hpp; this is the law of all others.
//
//   |sigma - alpha|_vm = Y,   d eps_p = s dev(sigma - alpha),   d alpha = 2/3 H_k d eps_p
//   Y = (sigma_y + hardening(eps_p) + B eps_p^n) r(d eps_p/dt) (1 - T*^m)
//   r = 1 + (rate/D)^(1/p)  or  1 + C ln(max(rate/rate_0, 1))
//   T* = (T - T_room)/(T_melt - T_room),   rho c dT = beta sigma : d eps_p
//
// The step is backward Euler: eps_p and its rate are those of the end of the step; of the
// temperature, which changes by a fraction of a degree, that of the start. As in plane_stress.hpp
// xi = sigma - alpha shrinks in two parts, by 1/(1 + k s) each, with vm^2(s) = c_a shrink_a^2 + c_d
// shrink_d^2 and eps_p growing by x = 2/3 s vm; in three dimensions there is the deviator alone. s
// solves
//   F(s) = Y(x(s))/vm(s) - 1 = 0
// by Newton's method with Y replaced by its tangent Y_0 + Y' x, so that Y_0/vm + 2/3 Y' s - 1 is
// solved: exact at once in three dimensions for a piece of a curve. Laws with a power or a
// logarithm in them are nearly straight in ln s, so that there each step down is one of ln s.
//
// Damage grows by d eps_p/eps_f, with eps_f a constant or Johnson & Cook's (1985, Eng. Fract. Mech.
// 21, 31-48)
//   eps_f = (D1 + D2 exp(D3 p*)) (1 + D4 ln(max(rate/rate_0, 1))) (1 + D5 T*),  p* = mean/vm
// and a point with damage 1 carries nothing any more.
//
// For files compiled per instruction set: no Eigen, no standard containers.
#pragma once

#include "material/plane_stress.hpp"
#include "material/solid_stress.hpp"

namespace gannet {

inline constexpr int max_hardening_points = 16;

/// Which code answers at the points of an element.
enum class PointLaw { elastic, linear_hardening, general, hyperelastic };

enum class RateLaw { none, cowper_symonds, johnson_cook };

/// The constants of the law, ready for use.
struct J2Law {
  double shear = 0;      ///< G [Pa]
  double bulk = 0;       ///< K [Pa]
  double mean_rate = 0;  ///< E / (3 (1 - nu)) [Pa], see plane_stress.hpp
  double yield = 0;      ///< yield stress before any plastic strain [Pa], > 0
  int n_bends = 0;
  double knot[max_hardening_points] = {};  ///< plastic strains where the curve bends, rising [-]
  double bend[max_hardening_points] = {};  ///< change of its slope there [Pa]
  double power_factor = 0;                 ///< B [Pa]; 0: no power
  double power = 1;                        ///< n in (0, 1]
  double kinematic = 0;                    ///< H_k [Pa]
  RateLaw rate = RateLaw::none;
  double inverse_rate = 0;       ///< 1/D or 1/rate_0 [s]
  double rate_power = 0;         ///< 1/p or C [-]
  double heat = 0;               ///< beta/(rho c) [K m^3/J]; 0: no temperature
  double inverse_range = 0;      ///< 1/(T_melt - T_room) [1/K]
  double thermal_power = 1;      ///< m
  bool fails = false;            ///< has a damage
  bool fails_by_state = false;   ///< D2 ... D5 are not all 0
  double failure[5] = {};        ///< D1 ... D5 [-]
  double inverse_rate_fail = 0;  ///< 1/rate_0 of D4 [s]
  /// Neither a power nor a logarithm: Newton's method in s itself.
  [[nodiscard]] bool straight() const { return rate == RateLaw::none && power_factor == 0; }
};

/// Where the numbers of a point stand behind its stress: the plastic strain first, then what the
/// law needs of these; -1 where it does not.
struct J2History {
  int back_stress = -1;  ///< alpha, as many numbers as the stress [Pa]
  int temperature = -1;  ///< T - T_room [K]
  int damage = -1;       ///< [-], 1: failed
  int n = 1;             ///< numbers of a point behind its stress
};

inline J2History history_of(const J2Law& law, int stress_components) {
  J2History h;
  if (law.kinematic > 0) {
    h.back_stress = h.n;
    h.n += stress_components;
  }
  if (law.heat > 0) h.temperature = h.n++;
  if (law.fails) h.damage = h.n++;
  return h;
}

/// a^b; a > 0.
template <class T>
__attribute__((always_inline)) inline T power_of(T a, T b) {
  return exp_of(b * log_of(a));
}

/// A number and its derivative by the plastic strain.
template <class T>
struct WithSlope {
  T value, slope;
};

/// Yield stress at rest and at room temperature [Pa] as a function of the plastic strain.
template <class T>
__attribute__((always_inline)) inline WithSlope<T> hardened(const J2Law& law, T eps_p) {
  T Y = T(law.yield);
  T slope = T(0.0);
  for (int k = 0; k < law.n_bends; ++k) {
    const T beyond = eps_p - T(law.knot[k]);
    const auto reached = less(T(0.0), beyond);
    Y = Y + select(reached, T(law.bend[k]) * beyond, T(0.0));
    slope = slope + select(reached, T(law.bend[k]), T(0.0));
  }
  if (law.power_factor > 0) {
    const T safe = select(less(eps_p, T(1e-60)), T(1e-60), eps_p);
    const T part = T(law.power_factor) * power_of(safe, T(law.power));
    Y = Y + part;
    slope = slope + T(law.power) * part * reciprocal(safe);
  }
  return {Y, slope};
}

/// r of a step in which the plastic strain grows by x > 0, and its derivative by x.
template <class T>
__attribute__((always_inline)) inline WithSlope<T> rate_factor(const J2Law& law, T x,
                                                               T inverse_dt) {
  const T rate = x * inverse_dt * T(law.inverse_rate);
  if (law.rate == RateLaw::cowper_symonds) {
    const auto none = less(rate, T(1e-60));
    const T part = power_of(select(none, T(1e-60), rate), T(law.rate_power));
    const T slope = T(law.rate_power) * part * reciprocal(x);
    return {T(1.0) + select(none, T(0.0), part), select(none, T(0.0), slope)};
  }
  if (law.rate == RateLaw::johnson_cook) {
    const auto fast = less(T(1.0), rate);
    const T part = T(law.rate_power) * log_of(select(fast, rate, T(1.0)));
    return {T(1.0) + part, select(fast, T(law.rate_power) * reciprocal(x), T(0.0))};
  }
  return {T(1.0), T(0.0)};
}

/// T* of a rise of the temperature above that of the room [K], at most 1.
template <class T>
__attribute__((always_inline)) inline T homologous(const J2Law& law, T rise) {
  const T t = rise * T(law.inverse_range);
  return select(less(t, T(1.0)), t, T(1.0));
}

/// 1 - T*^m, above 0 also where the metal melts.
template <class T>
__attribute__((always_inline)) inline T thermal_factor(const J2Law& law, T rise) {
  const T t = homologous(law, rise);
  const auto warm = less(T(1e-30), t);
  const T part = power_of(select(warm, t, T(1e-30)), T(law.thermal_power));
  const T factor = T(1.0) - select(warm, part, T(0.0));
  return select(less(factor, T(1e-6)), T(1e-6), factor);
}

/// xi before the return: vm^2 of its two parts and the rates at which they shrink.
template <class T>
struct J2Trial {
  T c_a, c_d;       ///< [Pa^2]
  double k_a, k_d;  ///< [Pa]
  T at_rest;        ///< yield stress at rest, at its plastic strain and temperature [Pa]
  T eps_p;          ///< before the step
  T thermal;        ///< 1 - T*^m
  T guess;          ///< of the growth of eps_p, > 0: the equivalent of the whole strain increment
};

/// What the return comes to; zeros and ones where nothing flows.
template <class T>
struct J2Return {
  T s;                   ///< [1/Pa]
  T shrink_a, shrink_d;  ///< of the two parts of xi
  T d_eps;               ///< growth of eps_p
};

/// Iterations of general_return() at most; it ends where no s changes by more than 1e-8 of itself,
/// so that the last, quadratic, one leaves 1e-15. Steps of runs take two (curves) to four.
inline constexpr int max_return_iterations = 24;

/// Solves F(s) = 0, see the top. Lanes inside the yield surface get s = 0. Throws nothing.
template <class T>
__attribute__((always_inline)) inline J2Return<T> general_return(const J2Law& law,
                                                                 const J2Trial<T>& trial,
                                                                 T inverse_dt) {
  const T one = T(1.0);
  const T two_thirds = T(2.0 / 3.0);
  const T rest2 = trial.at_rest * trial.at_rest;
  const auto yields = less(rest2, trial.c_a + trial.c_d);
  // Points that do not yield solve a harmless problem whose answer is thrown away.
  const T c_a = select(yields, trial.c_a, T(0.0));
  const T c_d = select(yields, trial.c_d, T(2.0) * rest2);
  const T k_a = T(trial.k_a);
  const T k_d = T(trial.k_d);
  const T trial2 = c_a + c_d;
  const T trial_vm = trial2 * rsqrt(trial2);
  const T inverse_rest = reciprocal(trial.at_rest);
  // Above the root: vm falls at least as fast as with k_a, Y is at least that at rest.
  const T most = (trial_vm * inverse_rest - one) * T(1.0 / trial.k_a);
  T s = T(1.5) * trial.guess * inverse_rest;
  s = select(less(s, most), s, most);
  const bool straight = law.straight();
  const int most_iterations = any(yields) ? max_return_iterations : 0;
  for (int i = 0; i < most_iterations; ++i) {
    const T shrink_a = reciprocal(one + k_a * s);
    const T shrink_d = reciprocal(one + k_d * s);
    const T part_a = c_a * shrink_a * shrink_a;
    const T part_d = c_d * shrink_d * shrink_d;
    const T vm2 = part_a + part_d;
    const T inverse_vm = rsqrt(vm2);
    const T x = two_thirds * s * vm2 * inverse_vm;
    const WithSlope<T> hard = hardened(law, trial.eps_p + x);
    const WithSlope<T> rate = rate_factor(law, x, inverse_dt);
    const T Y = trial.thermal * hard.value * rate.value;
    const T slope = trial.thermal * (hard.slope * rate.value + hard.value * rate.slope);
    const T fall = (k_a * shrink_a * part_a + k_d * shrink_d * part_d) * inverse_vm * inverse_vm;
    const T F = Y * inverse_vm - one;
    const T F_s = (Y - slope * x) * inverse_vm * fall + two_thirds * slope;
    const T step = -F * reciprocal(F_s);
    T next = s + step;
    if (straight) {
      next = select(less(next, T(0.0)), T(0.0), next);
    } else {
      const T ratio = step * reciprocal(s);
      const T least = select(less(ratio, T(-8.0)), T(-8.0), ratio);
      next =
          select(less(ratio, T(0.0)), s * exp_of(select(less(ratio, T(0.0)), least, T(0.0))), next);
    }
    next = select(less(next, most), next, most);
    const T change = next - s;
    s = next;
    const T tolerance = T(1e-8) * s;
    const auto moves = less(tolerance * tolerance, select(yields, change * change, T(0.0)));
    if (!any(moves)) break;
  }
  J2Return<T> r;
  r.s = select(yields, s, T(0.0));
  r.shrink_a = reciprocal(one + k_a * r.s);
  r.shrink_d = reciprocal(one + k_d * r.s);
  const T vm2 = c_a * r.shrink_a * r.shrink_a + c_d * r.shrink_d * r.shrink_d;
  r.d_eps = two_thirds * r.s * vm2 * rsqrt(vm2);
  return r;
}

/// History of a point over a step: before in, after out.
template <class T>
struct J2State {
  T eps_p;
  T rise = T(0.0);    ///< of the temperature [K]
  T damage = T(0.0);  ///< [-]
};

/// Energies of a step per volume [J/m^3].
template <class T>
struct J2Work {
  T internal;  ///< (sigma(n-1) + sigma(n))/2 : e, less what leaves
  T plastic;   ///< part of it that plastic flow took
  T eroded;    ///< left with a point that failed: its elastic energy, and the work of the step
};

/// Damage that a growth of the plastic strain makes. mean, vm: of the stress [Pa].
template <class T>
__attribute__((always_inline)) inline T damage_of(const J2Law& law, T d_eps, T mean, T vm2, T rise,
                                                  T inverse_dt) {
  T strain = T(law.failure[0]);
  if (law.fails_by_state) {
    T triaxiality = mean * rsqrt(vm2 + T(1.0));
    triaxiality = select(less(triaxiality, T(-3.0)), T(-3.0), triaxiality);
    triaxiality = select(less(T(3.0), triaxiality), T(3.0), triaxiality);
    const T rate = d_eps * inverse_dt * T(law.inverse_rate_fail);
    const T log_rate = log_of(select(less(T(1.0), rate), rate, T(1.0)));
    strain = (strain + T(law.failure[1]) * exp_of(T(law.failure[2]) * triaxiality)) *
             (T(1.0) + T(law.failure[3]) * log_rate) *
             (T(1.0) + T(law.failure[4]) * homologous(law, rise));
    strain = select(less(strain, T(1e-6)), T(1e-6), strain);
  }
  return d_eps * reciprocal(strain);
}

/// Elastic energy per volume [J/m^3] of stresses whose s : s and trace are given.
template <class T>
__attribute__((always_inline)) inline T elastic_energy(const J2Law& law, T squared, T trace) {
  return T(0.25 / law.shear) * (squared - T(1.0 / 3.0) * trace * trace) +
         T(1.0 / (18 * law.bulk)) * trace * trace;
}

/// The yield stress at rest of a point, and the rest of a trial but for xi.
template <class T>
__attribute__((always_inline)) inline J2Trial<T> trial_of(const J2Law& law, const J2State<T>& state,
                                                          T guess) {
  J2Trial<T> trial;
  trial.eps_p = state.eps_p;
  trial.thermal = law.heat > 0 ? thermal_factor(law, state.rise) : T(1.0);
  trial.at_rest = trial.thermal * hardened(law, state.eps_p).value;
  trial.guess = select(less(guess, T(1e-30)), T(1e-30), guess);
  return trial;
}

/// Closes a step: temperature, damage; true where the point carries stress.
template <class T>
__attribute__((always_inline)) inline auto finish_state(const J2Law& law, T d_eps, T plastic,
                                                        T mean, T vm2, T inverse_dt,
                                                        J2State<T>& state) {
  state.eps_p = state.eps_p + d_eps;
  if (law.fails) {
    state.damage = state.damage + damage_of(law, d_eps, mean, vm2, state.rise, inverse_dt);
  }
  if (law.heat > 0) state.rise = state.rise + T(law.heat) * plastic;
  return less(state.damage, T(1.0));
}

/// Work of a step, split by whether the point still carries stress at its end and did before.
/// with, without: (sigma(n-1) + sigma(n))/2 : e with the stress of n, and without it; held: elastic
/// energy at n-1.
template <class T, class Mask>
__attribute__((always_inline)) inline J2Work<T> work_of(Mask carried, Mask carries, T with,
                                                        T without, T plastic, T held) {
  J2Work<T> w;
  w.internal = select(carries, with, select(carried, -held, T(0.0)));
  w.plastic = select(carries, plastic, T(0.0));
  w.eroded = select(carries, T(0.0), select(carried, without + held, T(0.0)));
  return w;
}

/// One point in three dimensions over a step.
/// old: stress of n-1; turned: that which the elastic answer to the strain increment e is added to
/// (old, where the material does not turn); alpha: back stress, turned with the material (zeros
/// without kinematic hardening); sigma: stress of n. Throws nothing.
template <class T>
__attribute__((always_inline)) inline J2Work<T> j2_step(const J2Law& law, const Symmetric<T>& old,
                                                        const Symmetric<T>& turned,
                                                        const Symmetric<T>& e, T inverse_dt,
                                                        Symmetric<T>& alpha, J2State<T>& state,
                                                        Symmetric<T>& sigma) {
  const SolidLaw elastic{law.bulk, law.shear, 0, 0};
  const auto carried = less(state.damage, T(1.0));
  Symmetric<T> trial = turned;
  add_elastic(elastic, e, trial);
  const T mean = T(1.0 / 3.0) * (trial.xx + trial.yy + trial.zz);
  const auto kept = [&](T a) { return select(carried, a, T(0.0)); };
  const Symmetric<T> xi{kept(trial.xx - mean - alpha.xx), kept(trial.yy - mean - alpha.yy),
                        kept(trial.zz - mean - alpha.zz), kept(trial.xy - alpha.xy),
                        kept(trial.yz - alpha.yz),        kept(trial.zx - alpha.zx)};
  const T trace_e = e.xx + e.yy + e.zz;
  const T e2 = T(2.0 / 3.0) * (contraction(e, e) - T(1.0 / 3.0) * trace_e * trace_e);
  J2Trial<T> t = trial_of(law, state, e2 * rsqrt(e2 + T(1e-60)));
  t.c_a = T(0.0);
  t.c_d = T(1.5) * contraction(xi, xi);
  t.k_d = 2 * law.shear + 2.0 / 3.0 * law.kinematic;
  t.k_a = t.k_d;
  const J2Return<T> r = general_return(law, t, inverse_dt);
  const T sf = r.s * r.shrink_d;  // d eps_p = sf xi of the trial
  const T fall = T(2.0 * law.shear) * sf;
  const T drag = T(2.0 / 3.0 * law.kinematic) * sf;
  const auto moved = [](Symmetric<T>& a, const Symmetric<T>& by, T factor) {
    a.xx = a.xx + factor * by.xx;
    a.yy = a.yy + factor * by.yy;
    a.zz = a.zz + factor * by.zz;
    a.xy = a.xy + factor * by.xy;
    a.yz = a.yz + factor * by.yz;
    a.zx = a.zx + factor * by.zx;
  };
  moved(trial, xi, -fall);
  if (law.kinematic > 0) moved(alpha, xi, drag);
  const T old_work = T(0.5) * contraction(old, e);
  const T new_work = T(0.5) * contraction(trial, e);
  const T plastic = T(0.5) * sf * (contraction(turned, xi) + contraction(trial, xi));
  const auto carries =
      finish_state(law, r.d_eps, plastic, mean, von_mises_squared(trial), inverse_dt, state);
  const auto left = [&](T a) { return select(carries, a, T(0.0)); };
  sigma = {left(trial.xx), left(trial.yy), left(trial.zz),
           left(trial.xy), left(trial.yz), left(trial.zx)};
  const T held = elastic_energy(law, contraction(old, old), old.xx + old.yy + old.zz);
  return work_of(carried, carries, old_work + new_work, old_work, plastic, held);
}

/// One point in plane stress over a step; gxy of e is the engineering shear strain. As j2_step().
template <class T>
__attribute__((always_inline)) inline J2Work<T> j2_step(const J2Law& law,
                                                        const PlaneStressLaw& elastic,
                                                        const PlaneStress<T>& old, T exx, T eyy,
                                                        T gxy, T inverse_dt, PlaneStress<T>& alpha,
                                                        J2State<T>& state, PlaneStress<T>& sigma) {
  const auto carried = less(state.damage, T(1.0));
  PlaneStress<T> trial = old;
  add_elastic(elastic, exx, eyy, gxy, trial);
  const auto kept = [&](T a) { return select(carried, a, T(0.0)); };
  const PlaneStress<T> xi{kept(trial.xx - alpha.xx), kept(trial.yy - alpha.yy),
                          kept(trial.xy - alpha.xy)};
  const T a = xi.xx + xi.yy;
  const T d = xi.xx - xi.yy;
  const T e2 = T(4.0 / 3.0) * (exx * exx + exx * eyy + eyy * eyy + T(0.25) * gxy * gxy);
  J2Trial<T> t = trial_of(law, state, e2 * rsqrt(e2 + T(1e-60)));
  t.c_a = T(0.25) * a * a;
  t.c_d = T(0.75) * d * d + T(3.0) * xi.xy * xi.xy;
  t.k_a = law.mean_rate + 2.0 / 3.0 * law.kinematic;
  t.k_d = 2 * law.shear + 2.0 / 3.0 * law.kinematic;
  const J2Return<T> r = general_return(law, t, inverse_dt);
  // xi of n, and d eps_p = s P xi with its shear as engineering shear.
  const T new_a = a * r.shrink_a;
  const T new_d = d * r.shrink_d;
  const PlaneStress<T> xi_n{T(0.5) * (new_a + new_d), T(0.5) * (new_a - new_d), xi.xy * r.shrink_d};
  const PlaneStress<T> flow{r.s * T(1.0 / 3.0) * (T(2.0) * xi_n.xx - xi_n.yy),
                            r.s * T(1.0 / 3.0) * (T(2.0) * xi_n.yy - xi_n.xx),
                            T(2.0) * r.s * xi_n.xy};
  const T fall_a = T(law.mean_rate) * r.s * new_a;
  const T fall_d = T(2.0 * law.shear) * r.s * new_d;
  trial.xx = trial.xx - T(0.5) * (fall_a + fall_d);
  trial.yy = trial.yy - T(0.5) * (fall_a - fall_d);
  trial.xy = trial.xy - T(2.0 * law.shear) * r.s * xi_n.xy;
  if (law.kinematic > 0) {
    const T drag = T(2.0 / 3.0 * law.kinematic) * r.s;
    alpha.xx = alpha.xx + drag * xi_n.xx;
    alpha.yy = alpha.yy + drag * xi_n.yy;
    alpha.xy = alpha.xy + drag * xi_n.xy;
  }
  const auto power = [](const PlaneStress<T>& s, T x, T y, T g) {
    return s.xx * x + s.yy * y + s.xy * g;
  };
  const T old_work = T(0.5) * power(old, exx, eyy, gxy);
  const T new_work = T(0.5) * power(trial, exx, eyy, gxy);
  const T plastic =
      T(0.5) * (power(old, flow.xx, flow.yy, flow.xy) + power(trial, flow.xx, flow.yy, flow.xy));
  const T mean = T(1.0 / 3.0) * (trial.xx + trial.yy);
  const auto carries =
      finish_state(law, r.d_eps, plastic, mean, von_mises_squared(trial), inverse_dt, state);
  const auto left = [&](T value) { return select(carries, value, T(0.0)); };
  sigma = {left(trial.xx), left(trial.yy), left(trial.xy)};
  const T squared = old.xx * old.xx + old.yy * old.yy + T(2.0) * old.xy * old.xy;
  const T held = elastic_energy(law, squared, old.xx + old.yy);
  return work_of(carried, carries, old_work + new_work, old_work, plastic, held);
}

}  // namespace gannet
