// Water that meets a free box whose skin is backed by dummy particles.
#pragma once

#include <fmt/format.h>

#include <string>

namespace gannet::test {

/// A block of water of 0.3 m x 0.3 m that meets a free box of 0.2 m x 0.1 m off its middle,
/// without gravity and walls; models: a line of keys.
inline std::string water_meets_box(const char* slip, double density,
                                   const std::string& models = "") {
  return fmt::format(R"case(gannet: 1
dimension: 2
materials: {{water: {{density: 1000, c0: 40 m/s}}}}
parts:
  water:
    sph: {{material: water, spacing: 10 mm}}
    fill: {{box: {{from: [0, 0, 0], to: [0.3 m, 0.3 m, 0]}}}}
    initial_velocity: [0, 2 m/s, 0]
  box:
    rigid_surface: {{}}
    shape:
      polyline:
        points: [[0.12, 0.31, 0], [0.32, 0.33, 0], [0.31, 0.43, 0], [0.11, 0.41, 0], [0.12, 0.31, 0]]
        elements: [10, 5, 10, 5]
bodies: {{box: {{parts: box, density: {}, walls: dummy, slip: {}, angular_velocity: [0, 0, 1]}}}}
{}effects:
  viscosity: {{type: monaghan, alpha: 0.1}}
  xsph: {{epsilon: 0.3}}
output: {{until: 10 s, checkpoint: never}}
)case",
                     density, slip, models);
}

}  // namespace gannet::test
