// Planes as each model sees them. Those of the scene stand where the model that moves them does;
// parts that advance at another step meet them where they are at their own levels.
#pragma once

#include <map>
#include <vector>

#include "plan/plan.hpp"

namespace gannet {

/// scene.store.get<ModelPlanes>().
struct ModelPlanes {
  std::vector<int> parts;  ///< numbers of those that meet planes, known before operations are made
  /// Planes at the levels of a model, where it has such parts and another model moves planes.
  std::map<const Model*, std::vector<Plane>> own;
};

/// The planes that a model sees at its levels, numbered as scene.planes. Asked after what moves
/// planes has made its operations; the address never changes.
inline const std::vector<Plane>& planes_seen_by(const Scene& scene, const Model& model) {
  const ModelPlanes* planes = scene.store.find<ModelPlanes>();
  if (planes == nullptr) return scene.planes;
  const auto found = planes->own.find(&model);
  return found == planes->own.end() ? scene.planes : found->second;
}

}  // namespace gannet
