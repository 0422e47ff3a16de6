#include "scene/field.hpp"

namespace gannet {

int size_of(Type type) {
  switch (type) {
    case Type::f64:
    case Type::i64:
      return 8;
    case Type::i32:
      return 4;
    case Type::u8:
      return 1;
  }
  return 0;
}

std::size_t bytes_of(const Field& field) {
  const Index n = field.count();
  const Index blocks = (n + field.layout.lanes - 1) / field.layout.lanes;
  return static_cast<std::size_t>(blocks) * static_cast<std::size_t>(field.layout.block_stride);
}

Field line_field(std::string name, std::string unit, std::string vtk, Over over, Array<Line>& array,
                 int first, int components, GhostRule ghosts) {
  Field f;
  f.name = std::move(name);
  f.unit = std::move(unit);
  f.vtk = std::move(vtk);
  f.over = over;
  f.components = components;
  f.ghosts = ghosts;
  f.layout = {sizeof(Line), sizeof(Line), sizeof(double), 1};
  f.base = [&array, first] {
    return reinterpret_cast<std::byte*>(array.data()) + first * static_cast<int>(sizeof(double));
  };
  f.count = [&array] { return static_cast<Index>(array.size()); };
  f.resize = [&array](Index n) { array.resize(static_cast<std::size_t>(n)); };
  return f;
}

}  // namespace gannet
