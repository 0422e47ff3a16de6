// The scene: the state of everything that moves, as plain arrays. A particle is a node that also
// has a density; position, velocity, force and mass live once, in one node table.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <vector>

#include "base/array.hpp"
#include "base/error.hpp"
#include "base/math.hpp"
#include "scene/field.hpp"

namespace gannet {

/// The node table. Order: nodes with rotations, nodes without, particles, then ghosts.
/// Time levels at entry to a step: x at n, v at n-1/2, f whatever the last step left.
struct Nodes {
  Index n_owned = 0;
  Index n_ghosts = 0;
  Range rotating;          ///< nodes that have rotational lines; begins at 0
  Array<Line> x;           ///< position [m]; w: mass m [kg]
  Array<Line> v;           ///< velocity [m/s]; w: 1/m [1/kg], 0 where f does not move the node
  Array<Line> f;           ///< force [N]; w unused
  Array<Line> omega;       ///< angular velocity [rad/s]; w: 1/I [1/(kg m^2)]; rotating nodes only
  Array<Line> torque;      ///< moment [N m]; w: rotary inertia I [kg m^2]; rotating nodes only
  Array<std::int64_t> id;  ///< stable number of a node, from 1, the same for the whole run
  [[nodiscard]] Index size() const { return n_owned + n_ghosts; }
};

enum class Cell { none, point, line, triangle, quad, tetrahedron, hexahedron };
int nodes_per(Cell cell);

/// What the user called a part: a range of nodes, and cells over them (none for particles, whose
/// order changes: a particle knows its part by the field "part").
struct Part {
  std::string name;
  std::string kind;      ///< the key that made it: "sph", "shell"
  std::string material;  ///< name under `materials`
  Location where;
  Range nodes;  ///< at the start, for particles
  Cell cell = Cell::none;
  bool rigid =
      false;  ///< its elements are not computed: something else moves its nodes, or nothing
  Array<Index> connectivity;    ///< node indices, nodes_per(cell) a cell
  Array<std::int64_t> cell_id;  ///< stable numbers, from 1
  [[nodiscard]] Index n_cells() const;
  [[nodiscard]] bool is_particles() const { return cell == Cell::none; }
};

/// What stands behind a plane for the water in front of it, besides the penalty of contact.
enum class Behind { mirror, dummy, nothing };

/// A rigid plane; the material is on the side that the normal points to.
struct Plane {
  std::string name;
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  Location where;
  Behind behind = Behind::mirror;
  bool slips = true;  ///< water slides along it; else it sticks
  // Of one that moves, kept by what moves it; point and normal are those of the stage.
  bool moves = false;
  bool turns = false;
  Vec3 velocity = Vec3::Zero();      ///< of its point, mean over the step from this level [m/s]
  Vec3 spin = Vec3::Zero();          ///< angular velocity, likewise [rad/s]
  Vec3 velocity_old = Vec3::Zero();  ///< of the step that led to this level
  Vec3 spin_old = Vec3::Zero();
};

/// Parts that move as one, and so advance in one model; a case may name them by one name.
struct PartGroup {
  std::string name;
  std::vector<int> parts;        ///< numbers in scene.parts
  std::vector<Index> nodes;      ///< of other parts, which move along
  std::vector<double> masses{};  ///< theirs, noted by what took them over [kg]
  std::vector<Vec3> forces{};    ///< on them at this level, noted likewise [N]
};

/// A list of particle indices that someone keeps; permuted whenever particles are sorted.
struct IndexList {
  std::string name;
  Array<Index>* list = nullptr;
};

/// A number that the scene can be asked for at level n: the force of a contact, the mass of a part.
struct Measure {
  std::string name;  ///< "contact.slam.force"
  std::string unit;
  std::vector<std::string> components;  ///< {"x", "y", "z"}, {"value"}
  std::function<void(double*)> sample;  ///< writes one double a component
  bool at_end = false;                  ///< told in the report and the summary of a run
};

/// Particles that are not computed for a while, because nothing happens where they are
/// (sph/rest.hpp): they keep their place and density, v = f = 0. They are the last of the
/// particles, and the very last are those that no other particle sees. Without any, all are
/// computed.
struct Resting {
  Index n = 0;                    ///< particles at rest
  Index n_unseen = 0;             ///< of them, those that no particle in motion has near
  double particle_steps = 0;      ///< that were not computed since the start
  double all_particle_steps = 0;  ///< with those that were; 0: nothing may rest
  Vec3 momentum = Vec3::Zero();   ///< that was taken from particles that came to rest [kg m/s]
};

/// State that effects own and others may look up by its type: scene.store.get<SphState>().
class Store {
 public:
  /// The state of type T, made (default constructed) at first use. Its address never changes.
  template <class T>
  T& get() {
    auto& slot = slots_[std::type_index(typeid(T))];
    if (!slot) slot = std::make_shared<T>();
    return *static_cast<T*>(slot.get());
  }
  /// The state of type T; null where nobody made it.
  template <class T>
  [[nodiscard]] const T* find() const {
    const auto slot = slots_.find(std::type_index(typeid(T)));
    return slot == slots_.end() ? nullptr : static_cast<const T*>(slot->second.get());
  }
  template <class T>
  [[nodiscard]] bool has() const {
    return slots_.contains(std::type_index(typeid(T)));
  }

 private:
  std::map<std::type_index, std::shared_ptr<void>> slots_;
};

struct Scene {
  std::string title;
  int dimension = 3;
  Vec3 gravity = Vec3::Zero();  ///< at the level of the last force stage, or the start [m/s^2]
  Nodes nodes;
  Range particles;             ///< the one range of nodes that are particles, sorted in space
  Resting resting;             ///< those of them that rest
  Array<Index> particle_part;  ///< part number of each particle (tracked field "part")
  std::vector<Part> parts;
  std::vector<PartGroup> groups;
  std::vector<Plane> planes;
  std::vector<Field> fields;
  std::vector<IndexList> index_lists;
  std::vector<Measure> measures;
  /// Called after a checkpoint was read into the fields, to rebuild what is derived from them
  /// (neighbour lists from the positions that they were built at, ...).
  std::vector<std::function<void()>> after_restart;
  /// Sentences for the user that do not stop a run; each is added once, and shown by who reports.
  std::vector<std::string> warnings;
  Store store;

  /// The particles that are computed: the first ones.
  [[nodiscard]] Range awake() const { return {particles.begin, particles.end - resting.n}; }
  /// These and the particles at rest that they may have near.
  [[nodiscard]] Range seen() const { return {particles.begin, particles.end - resting.n_unseen}; }
  /// The nodes of a range that are computed. Particles are the last of all owned nodes.
  [[nodiscard]] Range computed(const Range& r) const {
    return resting.n == 0 ? r : Range{r.begin, std::max(r.begin, std::min(r.end, awake().end))};
  }
  [[nodiscard]] int part_number(const std::string& name) const;  ///< -1 where there is none
  [[nodiscard]] PartGroup* group(const std::string& name);       ///< null where there is none
  [[nodiscard]] const PartGroup* group(const std::string& name) const;
  [[nodiscard]] const Field* field(const std::string& name) const;
};

}  // namespace gannet
