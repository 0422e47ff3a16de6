// Rigid walls: planes whose normals point to the side of the material. What touches them is the
// business of contact.
#include "body/effects.hpp"
#include "scene/plane_keys.hpp"

namespace gannet {

namespace {
namespace planes {

void state(const Keys& root, Scene& scene) {
  for (const Plane& plane : read_planes(root)) scene.planes.push_back(plane);
}

}  // namespace planes
}  // namespace

Effect planes_effect() {
  return {.name = "planes", .schema = plane_schema, .state = planes::state};
}

}  // namespace gannet
