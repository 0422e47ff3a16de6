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

const Field* Scene::field(const std::string& name) const {
  for (const Field& f : fields) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

}  // namespace gannet
