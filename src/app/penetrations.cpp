#include "app/penetrations.hpp"

#include <algorithm>

#include "contact/planes.hpp"

namespace gannet {

namespace {

double sample(const Measure& m) {
  double value = 0;
  m.sample(&value);
  return value;
}

void add_contacts(const Scene& scene, std::vector<StartOverlap>& list) {
  const std::string begin = "contact.";
  const std::string end = ".overlaps";
  for (const Measure& m : scene.measures) {
    if (!m.name.starts_with(begin) || !m.name.ends_with(end)) continue;
    const std::string name = m.name.substr(0, m.name.size() - end.size());
    StartOverlap o{"contact " + name.substr(begin.size()), static_cast<long>(sample(m))};
    for (const Measure& depth : scene.measures) {
      if (depth.name == name + ".overlap_depth") o.depth = sample(depth);
    }
    list.push_back(o);
  }
}

/// Particles at rest half a spacing before a plane touch it within rounding: not counted.
void add_planes(Scene& scene, std::vector<StartOverlap>& list) {
  if (!scene.store.has<ParticlesOnPlanes>()) return;
  const auto& state = scene.store.get<ParticlesOnPlanes>();
  const auto& law = state.law;
  for (std::size_t p = 0; p < scene.planes.size(); ++p) {
    if (state.pushes[p] == 0) continue;
    const Plane& plane = scene.planes[p];
    StartOverlap o{"plane " + plane.name};
    for (Index k = 0; k < scene.particles.size(); ++k) {
      const auto part = static_cast<std::size_t>(scene.particle_part[static_cast<std::size_t>(k)]);
      const Line& x = scene.nodes.x[static_cast<std::size_t>(scene.particles.begin + k)];
      const double d = law[part].distance;
      if (!(d > 0)) continue;  // the particles of a wall
      const double depth = d - plane.normal.dot(xyz(x) - plane.point);
      if (!(depth > 1e-9 * d)) continue;
      ++o.count;
      o.depth = std::max(o.depth, depth);
    }
    list.push_back(o);
  }
}

}  // namespace

std::vector<StartOverlap> start_overlaps(Scene& scene) {
  std::vector<StartOverlap> list;
  add_contacts(scene, list);
  add_planes(scene, list);
  return list;
}

}  // namespace gannet
