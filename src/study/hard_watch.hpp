// Watching a run against the limits of a hard case.
#pragma once

#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "study/hard_case.hpp"

namespace gannet {

/// How near a run came to one limit.
struct LimitState {
  std::string name;  ///< "energy_growth", "exact.force_on_floor"
  double worst = 0;  ///< worst value so far, in the sense of the limit
  double limit = 0;
  bool at_least = false;  ///< a lower limit; otherwise an upper one
  std::int64_t step = 0;  ///< at which the worst was seen
  [[nodiscard]] bool kept() const;
  /// How many times better than needed: limit/worst, for lower limits worst/limit; infinite where
  /// an upper limit was not even approached (worst <= 0).
  [[nodiscard]] double margin() const;
};

/// Names that a limit can have, "finite" and "guard" among them.
std::vector<std::string> limit_names();

/// Total momentum sum m v of all nodes and sum m |v|, at entry to a step [kg m/s].
struct TotalMomentum {
  Vec3 sum = Vec3::Zero();
  double scale = 0;
};
TotalMomentum total_momentum(const Nodes& nodes);

/// The least distance between two particles of the scene, or `reach` where none are that near [m].
/// Periodic images are not looked at.
double smallest_particle_spacing(const Scene& scene, double reach);

/// True where all positions and velocities are finite.
bool all_finite(const Nodes& nodes);

/// Follows a run: make it before the first step, call look() after each.
class HardWatch {
 public:
  /// Throws InputError where the case names a measure that the scene does not have.
  HardWatch(const HardCase& hard, Scene& scene, Models& models);

  /// Looks at energies and the step always, at the rest every few steps or where `closely`.
  void look(bool closely = false);
  /// What is judged at the end only: final values and means.
  void finish();
  [[nodiscard]] const std::vector<LimitState>& limits() const { return limits_; }
  /// The first limit that is broken; nullptr where all are kept.
  [[nodiscard]] const LimitState* broken() const;

 private:
  struct Probe {
    Exact exact;
    const Measure* measure = nullptr;
    std::size_t component = 0;
    std::size_t limit = 0;  ///< its place in limits_
    double sum = 0;         ///< of deviation times time
    double time = 0;
  };

  std::size_t add(const std::string& name, double limit, bool at_least = false);
  void note(std::size_t which, double value);
  void add_probe(const Exact& exact);
  void look_at_energy();
  void look_at_particles();
  [[nodiscard]] double deviation(const Probe& probe) const;

  HardCase hard_;
  Scene* scene_;
  Models* models_;
  std::vector<LimitState> limits_;
  std::vector<Probe> probes_;
  Vec3 start_momentum_ = Vec3::Zero();
  double largest_momentum_ = 0;
  double largest_supply_ = 0;  ///< largest of start energy + work put in so far [J]
  double first_dt_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace gannet
