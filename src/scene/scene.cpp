#include "scene/scene.hpp"

namespace gannet {

int nodes_per(Cell cell) {
  switch (cell) {
    case Cell::none:
      return 0;
    case Cell::point:
      return 1;
    case Cell::line:
      return 2;
    case Cell::triangle:
      return 3;
    case Cell::quad:
    case Cell::tetrahedron:
      return 4;
    case Cell::hexahedron:
      return 8;
  }
  return 0;
}

Index Part::n_cells() const {
  return cell == Cell::none ? 0 : static_cast<Index>(connectivity.size()) / nodes_per(cell);
}

int Scene::part_number(const std::string& name) const {
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].name == name) return static_cast<int>(k);
  }
  return -1;
}

PartGroup* Scene::group(const std::string& name) {
  const auto found = std::ranges::find(groups, name, &PartGroup::name);
  return found == groups.end() ? nullptr : &*found;
}

const PartGroup* Scene::group(const std::string& name) const {
  return const_cast<Scene*>(this)->group(name);
}

const Field* Scene::field(const std::string& name) const {
  for (const Field& f : fields) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

}  // namespace gannet
