// A case inside another program: read it, advance it step by step, look at it. Link the library
// gannet_app; this header needs nothing else of Gannet.
//
//     gannet::EmbeddedRun run("case.yaml");
//     while (run.time() < 0.02) run.advance();
//     std::vector<double> force = run.measure("contact.slam.force");
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gannet {

struct Simulation;

/// A running case. Nothing is written to disk. Not to be copied; one thread at a time calls it.
class EmbeddedRun {
 public:
  /// Reads and checks a case. set: "key.path=value", as `gannet run --set`.
  /// Throws gannet::InputError (a std::runtime_error) with every mistake found.
  explicit EmbeddedRun(const std::string& case_file, const std::vector<std::string>& set = {});
  ~EmbeddedRun();
  EmbeddedRun(EmbeddedRun&&) noexcept;
  EmbeddedRun& operator=(EmbeddedRun&&) noexcept;

  /// One step of the slowest model, and of the others until they have caught up.
  /// Throws gannet::RunError (a std::runtime_error) where a guard stops the run.
  void advance();

  [[nodiscard]] double time() const;         ///< of the present level [s]
  [[nodiscard]] std::int64_t steps() const;  ///< made so far
  [[nodiscard]] double last_step() const;    ///< size of the last step [s]; 0 before it

  [[nodiscard]] std::vector<std::string> parts() const;
  /// Stable numbers of a part's nodes or particles, in the order of positions() right now.
  [[nodiscard]] std::vector<std::int64_t> ids(const std::string& part) const;
  /// x, y, z of a part's nodes or particles at the present level [m], three numbers each.
  [[nodiscard]] std::vector<double> positions(const std::string& part) const;
  /// Names that measure() takes: "contact.slam.force", "probe.deflection", ...
  [[nodiscard]] std::vector<std::string> measures() const;
  /// The components of a measure at the last level that was looked at, SI.
  /// Throws std::invalid_argument for an unknown name, here and for an unknown part above.
  [[nodiscard]] std::vector<double> measure(const std::string& name) const;

 private:
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace gannet
