#include "sph/concentration.hpp"

namespace gannet {

void want_concentration(SphState& sph, Scene& scene, const std::string& owner) {
  if (!sph.concentration.empty()) return;
  sph.terms.concentration = true;
  // A full neighbourhood until the first pass.
  Line line;
  line.w = sph.kernel.dimension;
  sph.concentration.assign(static_cast<std::size_t>(scene.particles.size()), line);
  Field gradient = line_field("concentration", "1/m", "", Over::particles, sph.concentration, 0, 3,
                              GhostRule::none);
  Field div_r =
      line_field("div_r", "", "", Over::particles, sph.concentration, 3, 1, GhostRule::none);
  gradient.owner = div_r.owner = owner;
  scene.fields.push_back(std::move(gradient));
  scene.fields.push_back(std::move(div_r));
}

}  // namespace gannet
