#include "fe/stiffness_damping.hpp"

#include <cmath>

namespace gannet {

std::vector<Key> stiffness_damping_keys() {
  return {{.name = "damping_ratio",
           .text = "damping in proportion to stiffness, as the ratio of the highest mode of each "
                   "element",
           .limits = between(0, 2)},
          {.name = "damping_time",
           .unit = dim::time,
           .text = "damping over stiffness (beta), added to that",
           .limits = at_least(0)}};
}

StiffnessDamping read_stiffness_damping(const Keys& kind) {
  return {kind.number_or("damping_ratio", 0), kind.number_or("damping_time", 0)};
}

Array<double> damping_times(const StiffnessDamping& damping, const Array<double>& omega2) {
  Array<double> beta(omega2.size(), damping.time);
  for (std::size_t e = 0; e < omega2.size(); ++e) {
    if (omega2[e] > 0) beta[e] += 2 * damping.ratio / std::sqrt(omega2[e]);
  }
  return beta;
}

ElementVotes votes_of(const Array<double>& inverse_mass, const Array<double>& damping_time) {
  const auto of = [](const Array<double>& a) { return a.empty() ? nullptr : a.data(); };
  return {.inverse_mass = of(inverse_mass), .damping_time = of(damping_time)};
}

}  // namespace gannet
