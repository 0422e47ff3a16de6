// A study: one case, run with several settings, to show what accuracy costs.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/schema.hpp"

namespace gannet {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// One key of the case and the values that it takes, as written: "let.dx", {"8mm", "4mm"}.
/// "on" and "off" keep or remove a map of the case ("effects.xsph").
struct StudyAxis {
  std::string key;
  std::vector<std::string> values;
  /// Of variants, which `key` and `values` only name: what each sets, as "key=value". Empty where
  /// the axis is a key of the case.
  std::vector<std::vector<std::string>> sets{};
};

/// What errors are measured against.
struct StudyReference {
  enum class Kind { finest, number, csv, formula, richardson };
  Kind kind = Kind::finest;
  double value = 0;    ///< of Kind::number [SI]
  std::string file;    ///< of Kind::csv: the time in its first column
  std::string column;  ///< of Kind::csv; empty: the only one
  std::string text;    ///< of Kind::formula, as written
  /// of Kind::formula: value [SI] of the history at a time [s], &t
  std::function<double(const double*)> formula;
};

/// One number that is taken from a history of a run.
struct StudyMeasure {
  std::string name;     ///< "peak_force"
  std::string kind;     ///< one of measure_kinds()
  std::string history;  ///< "slam_force": history/slam_force.csv of the run
  std::string column;   ///< "z"; empty: the only one, or the length of a vector
  double percent = 99;  ///< of percentile, 0 to 100
  double from = -std::numeric_limits<double>::infinity();  ///< window in time [s]
  double until = std::numeric_limits<double>::infinity();
  double max_shift = 0;  ///< distance: the best shift in time within this is taken out [s]
  double width = 0;      ///< of the windows of largest_mean [s]
  double period = 0;     ///< of the sine that amplitude, phase and midline are of [s]
  double level = 0;      ///< that arrival waits for [SI]
  /// error = difference / scale; 0: the size of the reference, of a distance the range of it [SI]
  double scale = 0;
  std::optional<StudyReference> reference;  ///< where it is not that of the study
};

/// All that a user asks for.
struct StudySpec {
  std::string case_file;
  std::string title;  ///< of the case
  std::vector<StudyAxis> axes;
  std::vector<std::string> set;  ///< "key=value" in all runs
  std::vector<StudyMeasure> measures;
  StudyReference reference;
  std::string refine;  ///< key of the axis along which results converge; empty: found by itself
  bool refine_counts = false;  ///< its values are numbers of elements; sizes are 1/number
  double budget = std::numeric_limits<double>::infinity();  ///< wall time [s]
  int repeats = 1;
  std::string jitter_part;  ///< part whose particles are moved at random, another way each repeat
  double jitter = 0;        ///< largest move, in spacings
  int parallel = 1;         ///< runs side by side
  int threads = 0;          ///< of each run; 0: cores / parallel
  std::string out;          ///< folder of the results
  bool collect = false;     ///< make no run
};

/// How big a run is before it is made.
struct StudyRunSize {
  double particles = 0;
  double elements = 0;
  double dt = 0;     ///< [s] at the start
  double until = 0;  ///< [s]
  /// Particle steps and element steps together.
  [[nodiscard]] double work() const { return dt > 0 ? (particles + elements) * until / dt : 0; }
};

/// What a study needs from the program that it is part of.
struct StudyProgram {
  std::string path = "/proc/self/exe";  ///< what runs a case
  std::string version;                  ///< goes into the hash of each run
  std::string short_version;            ///< what `gannet --version` says behind its name
  Schema schema;                        ///< the case language
  /// Builds the case and looks; throws InputError.
  std::function<StudyRunSize(const std::string& file, const std::vector<std::string>& set)> size;
};

enum class StudyState { waiting, done, failed, not_run };

/// One run of the study: what it is, and what became of it.
struct StudyRun {
  std::vector<std::string> choices;  ///< a value for each axis
  int repeat = 0;
  std::vector<std::string> set;  ///< overrides of the case
  std::string hash;              ///< of the resolved case and the version
  std::string folder;            ///< output folder
  double h = unknown;            ///< size of the refined axis [SI, or 1/number of elements]
  StudyRunSize size;

  StudyState state = StudyState::waiting;
  bool was_there = false;      ///< done by an earlier study
  std::string reason;          ///< why it failed or was not run
  double predicted = unknown;  ///< wall time [s]
  double wall = unknown;       ///< [s], all attempts together
  double cpu = unknown;        ///< [s]
  double steps = unknown;
  double particle_rate = unknown;  ///< particle steps per second
  double element_rate = unknown;
  double memory = unknown;  ///< peak [B]
  double energy_error = unknown;
  double lost_particles = unknown;       ///< most at one look
  double deepest_penetration = unknown;  ///< [m]
  std::string version;
};

/// A key in few words: "dx" for let.dx, "xsph" for effects.xsph, "plate.elements"; the whole key
/// where another axis has the same words.
std::string short_key(const std::vector<StudyAxis>& axes, const std::string& key);

/// "dx = 4 mm, xsph = off"
std::string setting_text(const std::vector<StudyAxis>& axes,
                         const std::vector<std::string>& choices);

/// A size along the refined axis as a person writes it: "3.1 mm", "57" (elements).
std::string size_text(const StudySpec& spec, double h);

/// "41 s", "3.2 min", "1.5 h"
std::string wall_text(double seconds);

}  // namespace gannet
