// How much further than 2 h neighbour lists reach. A thick skin makes every pass dearer, for it
// looks at more pairs; a thin one makes lists old sooner. With a step of the pair passes that costs
// 1 + a s, a build that costs b steps, and motion of u a step relative to what is near, so that a
// list lasts s/u steps, the cost of a step is
//   1 + a s + b u/s,   least at   s = sqrt(b u/a),
// s and u over the spacing. b and a are those of this code on one machine: what is chosen follows
// from the motion, which is the same everywhere, never from a clock.
#pragma once

#include <algorithm>
#include <cmath>

namespace gannet {

struct ListSkin {
  double width = 0;  ///< of the lists that there are [m]
  double least = 0;  ///< bounds of what is chosen [m]; equal where the case says the skin
  double most = 0;
  double steps = 0;  ///< that these lists were used for
};

/// Chooses the width of the next lists from how long the last ones were right: u = width/steps [m].
/// dx: spacing [m].
inline void adapt(ListSkin& skin, double dx) {
  constexpr double b_over_a = 1.5;
  const double u = skin.width / std::max(1.0, skin.steps);
  skin.width = std::clamp(std::sqrt(b_over_a * u * dx), skin.least, skin.most);
}

}  // namespace gannet
