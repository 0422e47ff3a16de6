#include "fe/truss_kernel.hpp"

#include "fe/lane_extremes.hpp"
#include "fe/vec_x3.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// Sums of eight lanes.
struct LaneSums {
  Vec8 internal{0.0}, damping{0.0}, eroded{0.0}, broken{0.0};
  Vec8 rate{0.0};    ///< squared where nothing is damped
  Vec8 block{-1.0};  ///< of the largest rate
};

/// What all elements have in common, in all lanes.
struct Constants {
  Vec8 zeta_over_c;  ///< zeta/c, c^2 = EA/mu [s/m]
  Vec8 beta;         ///< [s]
  Vec8 inverse_dt;   ///< 0 before the first step [1/s]
  Vec8 four_over_EA_mu;
  Vec8 strength;

  GANNET_INLINE explicit Constants(const TrussPass& p)
      : zeta_over_c(sqrt(Vec8(p.mu / p.EA)) * Vec8(p.damping_ratio)),
        beta(p.damping_time),
        inverse_dt(p.dt > 0 ? 1 / p.dt : 0.0),
        four_over_EA_mu(4 / (p.EA * p.mu)),
        strength(p.strength) {}
};

/// Force and energy of a law of straight pieces: F = sum k_j (eps - eps_j)_+, W = l0 sum k_j (eps -
/// eps_j)_+^2/2. The first piece goes on below 0. K: EA/l0, 0 where the element is gone.
GANNET_INLINE void pieces(const TrussPass& pass, Vec8 K, Vec8 l0, Vec8 e, Vec8& F, Vec8& energy) {
  const Vec8 there = K * Vec8(1 / pass.EA);  // 1/l0 or 0
  const Vec8 strain = e * there;
  F = Vec8(pass.corners_of_law[0].slope) * strain;
  energy = Vec8(0.5) * F * strain;
  for (int j = 1; j < pass.n_corners; ++j) {
    const TrussCorner& corner = pass.corners_of_law[j];
    const Vec8 beyond = max(strain - Vec8(corner.strain), Vec8(0.0));
    const Vec8 more = Vec8(corner.slope) * beyond;
    F += more;
    energy += Vec8(0.5) * more * beyond;
  }
  energy *= l0;
}

GANNET_INLINE Vec8 size_of(Vec8 a) { return max(a, -a); }

/// Eight elements: state to level n, forces added. damped, breaks: whether the part asks for them.
template <bool damped, bool breaks>
GANNET_INLINE void truss_block(const TrussPass& pass, const Constants& k, std::int32_t block,
                               LaneSums& sums) {
  const std::int32_t* corners = pass.corners + 16 * static_cast<std::int64_t>(block);
  double* state = pass.state + 8 * truss_values * static_cast<std::int64_t>(block);
  const auto value = [state](TrussValue which) { return Vec8::load(state + 8 * which); };
  const auto put = [state](TrussValue which, Vec8 a) { a.store(state + 8 * which); };
  const Vec8 zero(0.0);
  const Vec8x3 r =
      gather_corner<Vec8>(pass.x, corners, 1) - gather_corner<Vec8>(pass.x, corners, 0);
  const Vec8 r2 = dot(r, r);
  // The smallest number keeps 1/l finite where both ends are at one place.
  const Vec8 inverse_l = rsqrt(r2 + Vec8(1e-300));
  const Vec8 l = r2 * inverse_l;
  const Vec8 l0 = value(truss_l0);
  Vec8 K = value(truss_stiffness);
  if constexpr (breaks) K = K * (Vec8(1.0) - value(truss_broken));
  Vec8 e = l - l0;
  if (pass.tension_only) e = max(e, zero);
  Vec8 F = K * e;
  Vec8 energy = Vec8(0.5) * F * e;
  if (pass.n_corners > 0) pieces(pass, K, l0, e, F, energy);
  const Vec8 old_energy = value(truss_energy);
  const Vec8 stretch = l - value(truss_length);
  Vec8 D(0.0);
  if constexpr (damped) {
    D = K * fma(k.zeta_over_c, l0, k.beta) * stretch * k.inverse_dt;
    if (pass.tension_only) D = select(less(l, l0), zero, max(D, -F));
    F = F + D;
  }
  if constexpr (breaks) {
    // 1 where an element breaks at this level, else 0.
    const auto holds = less(size_of(F), k.strength);
    const Vec8 breaking = select(holds, zero, Vec8(1.0)) * (Vec8(1.0) - value(truss_broken));
    sums.eroded += breaking * (old_energy + Vec8(0.5) * value(truss_force) * stretch);
    F = select(holds, F, zero);
    D = select(holds, D, zero);
    K = select(holds, K, zero);
    energy = select(holds, energy, zero);
    const Vec8 broken = value(truss_broken) + breaking;
    put(truss_broken, broken);
    sums.broken += broken;
  }
  sums.internal += energy - old_energy;
  put(truss_length, l);
  put(truss_energy, energy);
  if constexpr (damped) {
    Vec8 old_damping = value(truss_damping);
    if constexpr (breaks) old_damping = select(less(zero, K), old_damping, zero);
    sums.damping += Vec8(0.5) * (old_damping + D) * stretch;
    put(truss_damping, D);
  }
  put(truss_force, F);
  const Vec8 across = F * inverse_l;
  const Vec8x3 pull = scaled(r, across);
  scatter_corner(pass.f, corners, 0, pull);
  scatter_corner(pass.f, corners, 1, -pull);

  const std::int64_t first = 8 * static_cast<std::int64_t>(block);
  Vec8 omega2 = max(K, across) * K * k.four_over_EA_mu;
  if (pass.votes.inverse_mass != nullptr) omega2 *= Vec8::load(pass.votes.inverse_mass + first);
  Vec8 rate = omega2;
  if constexpr (damped) {
    const Vec8 b = Vec8(0.5) * omega2 * fma(k.zeta_over_c, l0, k.beta);
    rate = sqrt(fma(b, b, omega2)) + b;
  }
  if (pass.votes.omega2 != nullptr) (damped ? rate * rate : rate).store(pass.votes.omega2 + first);
  const auto larger = less(sums.rate, rate);
  sums.rate = select(larger, rate, sums.rate);
  sums.block = select(larger, Vec8(static_cast<double>(block)), sums.block);
}

template <bool damped, bool breaks>
GANNET_INLINE void run(const TrussPass& pass, std::int32_t begin, std::int32_t end,
                       TrussSums& sums) {
  const Constants k(pass);
  LaneSums lanes;
  for (std::int32_t block = begin; block < end; ++block) {
    truss_block<damped, breaks>(pass, k, block, lanes);
  }
  sums.internal = sum(lanes.internal);
  sums.damping = sum(lanes.damping);
  sums.eroded = sum(lanes.eroded);
  sums.broken = sum(lanes.broken);
  sums.rate = 0;
  sums.element = -1;
  take_largest(lanes.rate, lanes.block, 0, sums.rate, sums.element);
  if constexpr (!damped) sums.rate = __builtin_sqrt(sums.rate);
}

}  // namespace

__attribute__((flatten)) void truss_force_pass(const TrussPass& pass, std::int32_t begin,
                                               std::int32_t end, TrussSums& sums) {
  const bool damped = pass.damping_ratio > 0 || pass.damping_time > 0;
  if (pass.strength > 0) {
    damped ? run<true, true>(pass, begin, end, sums) : run<false, true>(pass, begin, end, sums);
  } else {
    damped ? run<true, false>(pass, begin, end, sums) : run<false, false>(pass, begin, end, sums);
  }
}

}  // namespace gannet::GANNET_ISA_NS
