#include "scene/tracked_values.hpp"

#include <utility>

namespace gannet {

void track_values(Scene& scene, const std::string& owner, const std::string& name,
                  const std::string& unit, int components, std::function<double*()> values) {
  constexpr auto size = static_cast<std::ptrdiff_t>(sizeof(double));
  Field f;
  f.name = name;
  f.unit = unit;
  f.over = Over::scene;
  f.components = components;
  f.layout = {components * size, components * size, size, 1};
  f.owner = owner;
  f.base = [values = std::move(values)] { return reinterpret_cast<std::byte*>(values()); };
  f.count = [] { return Index{1}; };
  scene.fields.push_back(std::move(f));
}

}  // namespace gannet
