// What a part may want of the bounds that its elements vote with. Plain data, for kernels too.
#pragma once

namespace gannet {

/// Numbers of each element, eight a block; null where the part does not ask for them.
struct ElementVotes {
  const double* inverse_mass = nullptr;  ///< own mass over that with what mass scaling adds, (0, 1]
  const double* damping_time = nullptr;  ///< beta of damping in proportion to stiffness [s]
  double* omega2 = nullptr;              ///< gets the bounds of the pass [1/s^2]
};

}  // namespace gannet
