// What every part made of elements brings to a plan: one force operation with its vote, and the
// entries of the ledger.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "plan/effect.hpp"
#include "plan/plan.hpp"
#include "scene/draft.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Energies that a pass over elements added, and nothing else [J].
struct ElementWork {
  double internal = 0;
  double plastic = 0;  ///< part of internal
  double hourglass = 0;
  double viscous = 0;  ///< bulk viscosity
  double damping = 0;  ///< of the material
  double eroded = 0;   ///< left with elements that broke
};

/// An element and the step that it allows.
struct ElementStep {
  double dt = 0;  ///< [s]
  Index element = -1;
};

/// One part as the plan sees it. Whatever the functions refer to must outlive the plan.
struct ElementPart {
  std::string kind;    ///< "shell"; the operation is "<kind> <name of the part>"
  int part = -1;       ///< number in the scene
  std::string reason;  ///< of the operation; empty: parts.NAME.<kind> asks for it
  std::vector<std::string> reads{"x", "v"};
  std::vector<std::string> writes{"f"};
  bool plastic = false;    ///< has an entry for plastic work
  bool hourglass = false;  ///< for hourglass work
  bool viscous = false;    ///< for the work of bulk viscosity
  bool damping = false;    ///< for the work of damping
  bool eroded = false;     ///< for what leaves with elements that break
  std::function<ElementWork(const Step&)> pass;
  std::function<double()> stable_dt;
  std::function<Index()> limiting;                                  ///< element behind stable_dt
  std::function<std::vector<ElementStep>(std::size_t)> smallest{};  ///< optional, for `check`
};

/// Adds the force operation of a part of elements to the plan of its model; nothing for a part that
/// is rigid, whose elements are not computed: no force, no vote, no energy.
void add_element_operation(const Keys& root, Scene& scene, Models& models, ElementPart element);

/// "panel: element 1207 at (0.1, 0.2, 0)"; the name of the part alone where element < 0.
std::string text_of_element(const Scene& scene, int part, Index element);

/// The parts of a case that have the key `kind`, in file order.
std::vector<Keys> parts_with(const Keys& root, const char* kind);

/// The keys of a part of elements: those of solids under "materials.*", of its geometry, `map`, of
/// its start velocity, and parts.NAME.<kind> with `keys`.
Schema element_schema(const char* kind, const char* text, std::vector<Key> keys);

/// A part of a case as a draft without a mesh: name, place, material (where one is named) and kind.
/// The caller says what its cells are and passes on the mesh with set_mesh().
PartDraft element_draft(const Keys& part, const char* kind, Cell cell, bool rotations);

/// Gives the draft its points [m], moved by the part's `map`, and cells, and the start velocity of
/// the part there.
void set_mesh(const Keys& part, std::vector<Vec3> points, std::vector<Index> cells,
              PartDraft& draft);

/// Numbers first, first + 1, ... of elements in blocks of eight as a tracked field of a part:
/// number k of lane l of block b at state[(b n_values + k) 8 + l]. state must stay where it is.
Field element_field(const std::string& name, const std::string& unit, int part,
                    Array<double>& state, int n_values, int first, int components,
                    std::function<Index()> n_elements);

/// Adds a field of a part that is made for output when it is asked for: not in checkpoints.
void track_shown(Scene& scene, int part, Field field);

}  // namespace gannet
