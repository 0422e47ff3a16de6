// Tracked fields: one list that says what every array of the state is called, what it is measured
// in, where it lies in memory and how it behaves. Sorting, ghosts, checkpoints and VTK each loop
// over this list and know nothing else about the effects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>

#include "base/array.hpp"

namespace gannet {

/// What the entries of a field belong to. Entry i of a particle field is node
/// scene.particles.begin + i; entry i of a cell field is cell i of its part.
enum class Over { nodes, particles, cells, scene };

enum class Type : std::uint8_t { f64, i32, i64, u8 };

/// What a ghost holds: nothing, a copy of its source, a copy shifted by the period (positions);
/// or what it collects is added back to the source (forces).
enum class GhostRule { none, copy, copy_shifted, add_back };

/// Where component c of entry e lies: base + (e / lanes) block_stride + (e % lanes) entry_stride +
/// c component_stride, in bytes. Plain arrays have lanes = 1.
struct Layout {
  std::ptrdiff_t block_stride = 0;
  std::ptrdiff_t entry_stride = 0;
  std::ptrdiff_t component_stride = 0;
  int lanes = 1;
};

/// One tracked field.
struct Field {
  std::string name;  ///< unique among fields of its part: "x", "rho", "panel.stress"
  std::string unit;  ///< SI, for headers: "m/s"
  std::string vtk;   ///< array name in VTK output ("Velocity"); empty: not shown
  Over over = Over::nodes;
  int part = -1;  ///< for cells: the part; -1 otherwise
  Type type = Type::f64;
  int components = 1;
  Layout layout;
  GhostRule ghosts = GhostRule::none;
  bool checkpoint = true;             ///< false where it is recomputed before it is read
  std::string owner;                  ///< the effect that owns it, or one thing that it made
  std::string effect{};               ///< the effect that tracks it, noted when the scene is built
  std::function<std::byte*()> base;   ///< address of entry 0, asked for anew after every growth
  std::function<Index()> count;       ///< number of entries
  std::function<void(Index)> resize;  ///< for particle and node fields: makes room for n entries
  std::function<void()> prepare;      ///< optional: called before output reads the field

  [[nodiscard]] std::byte* at(Index entry, int component = 0) const {
    return base() + (entry / layout.lanes) * layout.block_stride +
           (entry % layout.lanes) * layout.entry_stride + component * layout.component_stride;
  }
};

/// Bytes of one component.
int size_of(Type type);

/// Bytes of all entries, with the padding of a blocked layout.
std::size_t bytes_of(const Field& field);

/// A plain array of T with `components` values an entry, as a tracked field. The array must stay
/// where it is (owned by something that is not moved) for as long as the scene lives.
template <class T>
Field plain_field(std::string name, std::string unit, std::string vtk, Over over, Array<T>& array,
                  int components, GhostRule ghosts) {
  static_assert(sizeof(T) == 8 || std::is_same_v<T, std::int32_t> || sizeof(T) == 1);
  Field f;
  f.name = std::move(name);
  f.unit = std::move(unit);
  f.vtk = std::move(vtk);
  f.over = over;
  f.components = components;
  f.ghosts = ghosts;
  if constexpr (std::is_same_v<T, double>) f.type = Type::f64;
  if constexpr (std::is_same_v<T, std::int32_t>) f.type = Type::i32;
  if constexpr (std::is_same_v<T, std::int64_t>) f.type = Type::i64;
  if constexpr (sizeof(T) == 1) f.type = Type::u8;
  const auto size = static_cast<std::ptrdiff_t>(sizeof(T));
  f.layout = {size * components, size * components, size, 1};
  f.base = [&array] { return reinterpret_cast<std::byte*>(array.data()); };
  f.count = [&array, components] { return static_cast<Index>(array.size()) / components; };
  f.resize = [&array, components](Index n) {
    array.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(components));
  };
  return f;
}

/// Three components (or one, `first` 0..3) of an array of lines as a tracked field.
Field line_field(std::string name, std::string unit, std::string vtk, Over over, Array<Line>& array,
                 int first, int components, GhostRule ghosts);

}  // namespace gannet
