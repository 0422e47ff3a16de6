// The plan: the operations of one step, grouped in a short closed list of stages, decided from the
// scene before the first step. What a scene does not ask for is not in its plan.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The stages of a step, in order (see time/step.hpp for what each time level is).
enum class Stage { force, accelerate, kick, look, half_drift, rates, drift };
inline constexpr int n_stages = 7;
const char* name_of(Stage stage);

/// Where a model stands: the level n it is at and the steps on both sides of it.
struct Step {
  std::int64_t n = 0;     ///< number of the step
  double t = 0;           ///< time of level n [s]
  double dt_old = 0;      ///< t(n) - t(n-1); 0 before the first step
  double dt = 0;          ///< t(n+1) - t(n), known after the force stage
  bool coincides = true;  ///< all models stand at the same time: output may look
};

/// Adds up wall time.
struct Stopwatch {
  double seconds = 0;
  std::int64_t calls = 0;
};

struct Operation;

/// A limit on the time step.
struct Vote {
  double dt = std::numeric_limits<double>::infinity();  ///< [s]
  std::string who;                                      ///< "panel: element 1207"
  /// Who casts it, where `who` was not yet asked for. Operations stay where they are, once in a
  /// plan: its stages are deques, and nothing is taken out of them.
  const Operation* by = nullptr;
  /// Who limits the step. Asked for only where it is read: words cost more than a short step.
  [[nodiscard]] std::string limited_by() const;
};

/// One thing that happens in a step.
struct Operation {
  std::string name;
  std::string reason;  ///< "asked for at case.yaml:41", or the rule with its numbers
  Stage stage = Stage::force;
  bool where_all_meet = false;  ///< runs only where all models stand at the same time
  std::vector<std::string> reads;
  std::vector<std::string> writes;
  std::vector<std::string> owns;
  std::function<void(const Step&)> run;
  std::function<double()> stable_dt;        ///< optional vote, asked after the force stage [s]
  std::function<std::string()> limited_by;  ///< who casts that vote: part, element, position
  /// Optional, for `gannet check`: the n smallest of the steps that the vote is the least of, the
  /// smallest first.
  std::function<std::vector<Vote>(std::size_t n)> smallest{};
  std::string effect{};  ///< whose it is, noted when the plan is made
  Stopwatch watch{};
};

/// Work of a force at level n [J]: of the half step before the level, and of the half step after.
using Work = Eigen::Vector2d;

/// One entry of the energy ledger. Stored and dissipated energies are positive; what comes in from
/// outside (external work) is positive in `external` entries.
struct LedgerEntry {
  std::string name;  ///< "kinetic", "internal", "plastic", "hourglass", "artificial_viscosity", ...
  std::string part;  ///< the part, contact or load that it belongs to
  bool external = false;  ///< work put in from outside, not energy held
  /// Part of another entry (plastic within internal): shown, not added to the total.
  bool within_other = false;
  double value = 0;    ///< up to level n [J]
  double pending = 0;  ///< of the work measured at level n, what belongs to the step after it [J]

  /// Adds work that was measured along work_path() at level n: what belongs to the step before the
  /// level counts now, what belongs to the step after it at the next level.
  void add_work(const Work& work) {
    value += pending + work[0];
    pending = work[1];
  }
};

/// The energy ledger: an open list. Every entry is a sum of work or a state function that an
/// operation measured; none is computed as a remainder.
class Ledger {
 public:
  /// The entry of that name and part, made at first use; the address never changes.
  LedgerEntry& entry(const std::string& name, const std::string& part);
  [[nodiscard]] const std::deque<LedgerEntry>& entries() const { return entries_; }
  std::deque<LedgerEntry>& entries() { return entries_; }
  [[nodiscard]] double held() const;      ///< kinetic, stored and dissipated [J]
  [[nodiscard]] double external() const;  ///< work put in since the start [J]

 private:
  std::deque<LedgerEntry> entries_;
};

/// The operations of one model.
class Plan {
 public:
  /// Appends to its stage; within a stage the order is the order of adding.
  Operation& add(Operation operation);
  /// Puts it before all that its stage holds so far.
  Operation& add_first(Operation operation);
  std::deque<Operation>& at(Stage stage) { return stages_[static_cast<std::size_t>(stage)]; }
  [[nodiscard]] const std::deque<Operation>& at(Stage stage) const {
    return stages_[static_cast<std::size_t>(stage)];
  }

 private:
  std::array<std::deque<Operation>, n_stages> stages_;
};

/// A set of ranges of the one node table that advances at its own step.
struct Model {
  std::string name = "main";
  std::vector<Range> ranges;
  Plan plan;
  Step step;
  Vote vote;              ///< who limited the last step
  double dt_scale = 1;    ///< taken of the smallest vote
  double target = 0;      ///< time of the next slower model's next level [s]
  int substeps_left = 0;  ///< to the target, this step included
};

/// All models, slowest first, and the ledger that they share.
struct Models {
  std::deque<Model> list;
  Ledger ledger;
  /// The model that holds a node.
  Model& of_node(Index node);
  /// The place of a model in the list: the smaller, the slower.
  [[nodiscard]] std::size_t rank(const Model& model) const;
};

/// v(n) of node i after the kick: v(n+1/2) - (f/m) dt/2. Holds for prescribed and tied nodes too,
/// because the kick leaves in f the force that the constraint really applied.
inline Vec3 velocity_at_level(const Nodes& nodes, Index i, double dt) {
  const double s = 0.5 * dt * nodes.v[i].w;
  return {nodes.v[i].x - s * nodes.f[i].x, nodes.v[i].y - s * nodes.f[i].y,
          nodes.v[i].z - s * nodes.f[i].z};
}

/// What work at level n is measured along [m]: column 0 is v(n-1/2) dt_old/2, the half step before
/// the level, column 1 is v(n+1/2) dt/2, the half step after it.
using WorkPath = Eigen::Matrix<double, 3, 2>;

/// Path of node i at level n, after the kick. With it the work of a force over a step is the
/// trapezoid (f(n) + f(n+1))/2 . (x(n+1) - x(n)).
inline WorkPath work_path(const Nodes& nodes, Index i, const Step& step) {
  const Vec3 v_new = xyz(nodes.v[i]);
  const Vec3 a = xyz(nodes.f[i]) * nodes.v[i].w;
  WorkPath path;
  path.col(0) = (v_new - a * (0.5 * (step.dt_old + step.dt))) * (0.5 * step.dt_old);
  path.col(1) = v_new * (0.5 * step.dt);
  return path;
}

/// Work of a force [N] along a path, before and after the level [J].
inline Work work_along(const WorkPath& path, const Vec3& force) { return path.transpose() * force; }

}  // namespace gannet
