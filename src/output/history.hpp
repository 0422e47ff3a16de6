// Histories: one table a file, one line an interval, times exact.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "output/files.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "time/energy_balance.hpp"

namespace gannet {

/// File of a measure: "keel_pressure" for "probe.keel_pressure", "contact_slam_force" for
/// "contact.slam.force"; empty for a measure that has no file.
std::string history_name(const Measure& measure);

/// Writes the tables of a run:
/// - history/energy.csv: time [s], held [J], external [J], error [-], then every entry of the
///   ledger, named "PART ENTRY [J]";
/// - history/NAME.csv for each measure with a history_name(): time [s], then its components. A
///   measure has one unit, or one for each component with commas between: "m^3/s,m^3".
/// Numbers are the shortest text that reads back to the same bits.
class History {
 public:
  History(const Scene& scene, const Ledger& ledger) : scene_(&scene), ledger_(&ledger) {}

  /// Appends one line at time t [s] to each table of an output folder; makes the files and their
  /// headers at first use. An existing file is continued. Throws InputError where its header is
  /// another one, and std::logic_error where the ledger got a new entry after the first line.
  void write(double t, const EnergyBalance& balance, const std::string& folder);

 private:
  struct Table {
    Table(const std::string& path, const Measure* m) : file(path), measure(m) {}
    GrowingFile file;
    const Measure* measure;  ///< none: the energies
    std::vector<double> values;
  };
  void open(const std::string& folder);

  const Scene* scene_;
  const Ledger* ledger_;
  std::deque<Table> tables_;
  std::size_t n_entries_ = 0;
  bool open_ = false;
  std::string line_;
};

/// Cuts every table in folder/history to the lines with time below t [s], and a partial last line:
/// what a run that stood at level t had written before it looked at that level.
void cut_histories(const std::string& folder, double t);

}  // namespace gannet
