// How much further than 2 h neighbour lists reach. A thick skin makes every pass dearer, for it
// looks at more pairs; a thin one makes lists old sooner. With a step of the pair passes that costs
// 1 + a s, s the mean skin, a build that costs b steps, and motion of u a step relative to what is
// near, so that lists last n steps where each skin is n u, the cost of a step is
//   1 + a n <u> + b/n,   least at   n = sqrt(b/(a <u>)),
// <u> the mean over particles, s and u over the spacing. Skins follow the motion at each place:
// those few particles that move fast relative to their neighbours make the passes over all others
// no dearer. b and a are those of this code on one machine: what is chosen follows from the motion,
// which is the same everywhere, never from a clock.
#pragma once

namespace gannet {

struct ListSkin {
  double width = 0;  ///< the largest of the lists that there are [m]
  double least = 0;  ///< bounds of what is chosen [m]; equal where the case says the skin
  double most = 0;
  double steps = 0;  ///< that these lists were used for
};

/// How many steps the next lists are to last: those at which a step costs least, fewer where the
/// largest skin would be too thick.
/// mean, largest: of the motion a step relative to what is near [m]; dx: spacing [m].
double steps_to_last(const ListSkin& skin, double mean, double largest, double dx);

/// The skin of a particle that moves by u a step relative to what is near, for lists of that many
/// steps [m].
double skin_for(const ListSkin& skin, double u, double steps);

}  // namespace gannet
