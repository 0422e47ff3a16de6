#include "sph/list_skin.hpp"

#include <algorithm>
#include <cmath>

namespace gannet {

namespace {

/// b/a of the header.
constexpr double build_over_skin = 1.5;
/// How much thicker skins are than the motion that is known asks for: that to come is another.
constexpr double reserve = 1.3;
/// Of steps, where nothing moves.
constexpr double many = 1000;

}  // namespace

double steps_to_last(const ListSkin& skin, double mean, double largest, double dx) {
  const double best = mean > 0 ? std::sqrt(build_over_skin * dx / (reserve * mean)) : many;
  const double possible = largest > 0 ? skin.most / (reserve * largest) : many;
  return std::clamp(std::min(best, possible), 1.0, many);
}

double skin_for(const ListSkin& skin, double u, double steps) {
  return std::clamp(reserve * u * steps, skin.least, skin.most);
}

}  // namespace gannet
