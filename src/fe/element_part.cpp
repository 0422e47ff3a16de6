#include "fe/element_part.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/math.hpp"
#include "material/elastic_plastic.hpp"
#include "mesh/mesh_keys.hpp"
#include "plan/model_of_part.hpp"

namespace gannet {

std::string text_of_element(const Scene& scene, int part_number, Index element) {
  const Part& part = scene.parts[static_cast<std::size_t>(part_number)];
  if (element < 0) return part.name;
  const auto e = static_cast<std::size_t>(element);
  const auto n = static_cast<std::size_t>(nodes_per(part.cell));
  Vec3 centre = Vec3::Zero();
  for (std::size_t a = 0; a < n; ++a) {
    centre += xyz(scene.nodes.x[static_cast<std::size_t>(part.connectivity[n * e + a])]) /
              static_cast<double>(n);
  }
  return fmt::format("{}: element {} at ({:.4g}, {:.4g}, {:.4g})", part.name, part.cell_id[e],
                     centre.x(), centre.y(), centre.z());
}

std::vector<Keys> parts_with(const Keys& root, const char* kind) {
  std::vector<Keys> parts;
  if (!root.has("parts")) return parts;
  for (const std::string& name : root.map("parts").names()) {
    const Keys part = root.map("parts").map(name);
    if (part.has(kind)) parts.push_back(part);
  }
  return parts;
}

Schema element_schema(const char* kind, const char* text, std::vector<Key> keys) {
  Schema s = elastic_plastic_schema();
  for (const SchemaEntry& entry : mesh_schema()) s.push_back(entry);
  s.push_back(
      {"parts.*", {.name = kind, .kind = Kind::map, .text = text, .keys = std::move(keys)}});
  s.push_back({"parts.*", initial_velocity_key()});
  s.push_back({"parts.*",
               {.name = "map",
                .kind = Kind::vector_function,
                .unit = dim::length,
                .text = "where the points of the shape or mesh go: formulas of their x, y and z",
                .variables = {"x", "y", "z"}}});
  return s;
}

PartDraft element_draft(const Keys& part, const char* kind, Cell cell, bool rotations) {
  PartDraft draft;
  draft.name = part.name();
  draft.kind = kind;
  draft.material = part.map(kind).word("material");
  draft.where = part.where();
  draft.rotations = rotations;
  draft.cell = cell;
  return draft;
}

namespace {

/// Moves the points where `map` says. Complains where one of them goes nowhere.
void move_points(const Keys& part, std::vector<Vec3>& points) {
  if (!part.has("map")) return;
  const VectorFunction place = part.vector_function("map");
  for (Vec3& x : points) {
    const Vec3 moved = value_at(place, 0, x);
    if (!moved.allFinite()) {
      part.complain(
          "map", fmt::format("is not finite at ({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z()));
      return;
    }
    x = moved;
  }
}

}  // namespace

void set_mesh(const Keys& part, std::vector<Vec3> points, std::vector<Index> cells,
              PartDraft& draft) {
  move_points(part, points);
  draft.points = std::move(points);
  draft.connectivity = std::move(cells);
  draft.velocity = initial_velocity(part, draft.points);
}

Field element_field(const std::string& name, const std::string& unit, int part,
                    Array<double>& state, int n_values, int first, int components,
                    std::function<Index()> n_elements) {
  const std::ptrdiff_t lane = sizeof(double);
  return {.name = name,
          .unit = unit,
          .over = Over::cells,
          .part = part,
          .components = components,
          .layout = {.block_stride = n_values * 8 * lane,
                     .entry_stride = lane,
                     .component_stride = 8 * lane,
                     .lanes = 8},
          .base = [&state, first,
                   lane] { return reinterpret_cast<std::byte*>(state.data()) + first * 8 * lane; },
          .count = std::move(n_elements)};
}

void track_shown(Scene& scene, int part, Field field) {
  field.part = part;
  field.checkpoint = false;
  field.resize = nullptr;
  scene.fields.push_back(std::move(field));
}

namespace {

/// The entries of the ledger that a part has; nullptr where it has none.
struct Entries {
  LedgerEntry* internal = nullptr;
  LedgerEntry* plastic = nullptr;
  LedgerEntry* hourglass = nullptr;
  LedgerEntry* viscous = nullptr;
  LedgerEntry* damping = nullptr;
  LedgerEntry* eroded = nullptr;
};

Entries entries_of(Ledger& ledger, const ElementPart& element, const std::string& part) {
  Entries e;
  e.internal = &ledger.entry("internal", part);
  if (element.hourglass) e.hourglass = &ledger.entry("hourglass", part);
  if (element.viscous) e.viscous = &ledger.entry("bulk_viscosity", part);
  if (element.damping) e.damping = &ledger.entry("damping", part);
  if (element.eroded) e.eroded = &ledger.entry("eroded", part);
  if (element.plastic) {
    e.plastic = &ledger.entry("plastic", part);
    e.plastic->within_other = true;
  }
  return e;
}

void add(const ElementWork& work, const Entries& to) {
  to.internal->value += work.internal;
  if (to.plastic != nullptr) to.plastic->value += work.plastic;
  if (to.hourglass != nullptr) to.hourglass->value += work.hourglass;
  if (to.viscous != nullptr) to.viscous->value += work.viscous;
  if (to.damping != nullptr) to.damping->value += work.damping;
  if (to.eroded != nullptr) to.eroded->value += work.eroded;
}

}  // namespace

void add_element_operation(const Keys& root, Scene& scene, Models& models, ElementPart element) {
  const int number = element.part;
  if (scene.parts[static_cast<std::size_t>(number)].rigid) return;
  const std::string name = scene.parts[static_cast<std::size_t>(number)].name;
  const Entries entries = entries_of(models.ledger, element, name);
  Operation operation{.name = element.kind + " " + name,
                      .reason = element.reason.empty()
                                    ? asked_for_at(root.map("parts").map(name).where(element.kind))
                                    : element.reason,
                      .stage = Stage::force,
                      .reads = std::move(element.reads),
                      .writes = std::move(element.writes),
                      .owns = {name + ".state"},
                      .run = [pass = std::move(element.pass),
                              entries](const Step& step) { add(pass(step), entries); },
                      .stable_dt = std::move(element.stable_dt),
                      .limited_by =
                          [&scene, number, limiting = std::move(element.limiting)] {
                            return text_of_element(scene, number, limiting());
                          }};
  if (element.smallest) {
    operation.smallest = [&scene, number, steps = std::move(element.smallest)](std::size_t n) {
      std::vector<Vote> votes;
      for (const ElementStep& s : steps(n)) {
        votes.push_back({s.dt, text_of_element(scene, number, s.element)});
      }
      return votes;
    };
  }
  model_of_part(scene, models, number).plan.add(std::move(operation));
}

}  // namespace gannet
