#include "sph/wall_keys.hpp"

namespace gannet {

Schema wall_schema() {
  Key wall{.name = "wall",
           .kind = Kind::map,
           .text = "the part is a rigid wall of particles, which fluids do not pass"};
  wall.keys = {
      {.name = "like",
       .kind = Kind::reference,
       .text = "part of fluid whose spacing and equation of state it has; the only one unless said",
       .refers_to = "parts"},
      {.name = "slip",
       .kind = Kind::choice,
       .text = "whether viscous fluid slides along it: free, or none",
       .fallback = "free",
       .choices = {"free", "none"}},
      {.name = "velocity",
       .kind = Kind::vector,
       .unit = dim::velocity,
       .text = "velocity of the wall; at rest unless said"},
      {.name = "angular_velocity",
       .kind = Kind::vector,
       .unit = dim::angular_velocity,
       .text = "angular velocity of the wall about its centre"},
      {.name = "centre",
       .kind = Kind::vector,
       .unit = dim::length,
       .text = "centre of the rotation at the start; moves with the wall (the origin unless said)"},
      {.name = "factor",
       .kind = Kind::function,
       .unit = dim::none,
       .text = "multiplies both velocities in time, a table: [[0 s, 0], [1 ms, 1]]",
       .variables = {"t"}},
      {.name = "motion",
       .kind = Kind::choice,
       .text = "waves: each particle moves as the water of `sea` would at its place",
       .choices = {"waves"}}};
  Key extent{.name = "extent",
             .kind = Kind::map,
             .text =
                 "box that dummy walls end at where no plane does; the fluid's own, widened by "
                 "half unless said"};
  for (const char* end : {"from", "to"}) {
    extent.keys.push_back({.name = end,
                           .kind = Kind::vector,
                           .unit = dim::length,
                           .text = "a corner of the box",
                           .required = true});
  }
  return {{"parts.*", wall}, {"boundaries.*", extent}};
}

}  // namespace gannet
