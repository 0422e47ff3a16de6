// The effect `sea`: water that starts inside a field of waves. Particles that fill a box of water
// at rest are carried to where the waves have that water, with its velocity and pressure
// (scene/wave_field.hpp). Walls of particles may follow the same paths for ever: `motion: waves` in
// sph/walls.cpp.
#include <algorithm>
#include <string>
#include <vector>

#include "scene/wave_keys.hpp"
#include "sph/effects.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace sea {

bool in_waves(const Keys& part) {
  if (part.has("sph")) return part.has("start") && part.word("start") == "waves";
  return part.has("wall") && part.map("wall").has("motion");
}

/// The parts of particles that the waves carry, in file order.
std::vector<Keys> carried_parts(const Keys& root) {
  std::vector<Keys> parts;
  if (!root.has("parts")) return parts;
  for (const std::string& name : root.map("parts").names()) {
    const Keys part = root.map("parts").map(name);
    if (in_waves(part)) parts.push_back(part);
  }
  return parts;
}

void carry(const Keys& root, Draft& draft) {
  const std::vector<Keys> parts = carried_parts(root);
  if (parts.empty()) {
    if (root.given("sea")) {
      root.map("sea").complain("", "no part starts in it: parts: {water: {start: waves, ...}}");
    }
    return;
  }
  if (!root.has("sea")) {
    const Keys& part = parts.front();
    const bool water = part.has("sph");
    (water ? part : part.map("wall"))
        .complain(water ? "start" : "motion",
                  "waves of what? sea: {depth: 1 m, wave: {height: 10 mm, length: 2 m}}");
    return;
  }
  const WaveField field = read_wave_field(root, draft.dimension);
  if (!(field.depth > 0)) return;
  for (const Keys& part : parts) {
    for (PartDraft& p : draft.parts) {
      if (p.name != part.name()) continue;
      for (Vec3& x : p.points) {
        // The lattice stands for the water at rest; what rises over the still level is its top.
        x += displacement_at(field, x, 0);
      }
    }
  }
}

void set_start(const WaveField& field, const Keys& part, SphState& sph, Scene& scene) {
  const int number = scene.part_number(part.name());
  for (Index k = 0; k < scene.particles.size(); ++k) {
    if (scene.particle_part[k] != number) continue;
    const Index i = scene.particles.begin + k;
    const Vec3 X = rest_place_of(field, xyz(scene.nodes.x[i]), 0);
    add_xyz(scene.nodes.v[i], velocity_of(field, X, 0));
    const Murnaghan& eos = eos_of(sph, scene, k);
    const double p = sph.p[k] + eos.rho0 * std::max(pressure_of(field, X, 0), 0.0);
    sph.rho[k] = density(eos, p);
    sph.p[k] = pressure(eos, sph.rho[k]);
  }
}

void make_state(const Keys& root, Scene& scene) {
  if (!root.has("sea") || scene.particles.empty()) return;
  const WaveField field = read_wave_field(root, scene.dimension);
  auto& sph = scene.store.get<SphState>();
  for (const Keys& part : carried_parts(root)) {
    if (part.has("sph") && field.depth > 0) set_start(field, part, sph, scene);
  }
}

}  // namespace sea
}  // namespace

Effect sea_effect() {
  return {.name = "sea", .schema = sea_schema, .parts = sea::carry, .state = sea::make_state};
}

}  // namespace gannet
