#include "output/output.hpp"

#include <fmt/format.h>

#include <memory>
#include <set>
#include <stdexcept>

#include "output/history.hpp"
#include "output/report.hpp"
#include "output/stop.hpp"
#include "output/stray_particles.hpp"
#include "output/vtk_series.hpp"
#include "sph/sph_state.hpp"
#include "time/guards.hpp"

namespace gannet {

namespace {

constexpr double default_frames = 50;
constexpr double default_lines = 1000;

Schema output_schema() {
  Key output{.name = "output",
             .kind = Kind::map,
             .text = "how long the run is and what it writes when",
             .required = true};
  output.keys = {
      {.name = "until",
       .unit = dim::time,
       .text = "end of the run",
       .required = true,
       .limits = positive()},
      {.name = "vtk",
       .kind = Kind::text,
       .text = "VTK frames: 'every 0.25 ms' or 'never'; absent: 50 frames over the run"},
      {.name = "history",
       .kind = Kind::text,
       .text = "lines of the histories: 'every 10 us' or 'never'; absent: 1000 over the run"},
      {.name = "checkpoint",
       .kind = Kind::text,
       .text = "'every 5 min of wall time', 'every 2 ms' (of the run) or 'never'",
       .fallback = "every 5 min of wall time"},
      stop_key()};
  Key filter{.name = "filter",
             .kind = Kind::choice,
             .text = "low-pass filter of SAE J211: NAME_filtered.csv beside NAME.csv",
             .choices = {"CFC 60", "CFC 180", "CFC 600", "CFC 1000"}};
  return {{"", output}, {"probes.*", filter}};
}

/// What `read` makes of the text of a key; its complaint where it cannot.
template <class T>
T parsed(const Keys& keys, const char* key, T otherwise, T (*read)(const std::string&)) {
  if (!keys.has(key)) return otherwise;
  try {
    return read(keys.word(key));
  } catch (const std::invalid_argument& error) {
    keys.complain(key, error.what());
    return otherwise;
  }
}

OutputPlan read_plan(const Keys& keys) {
  OutputPlan plan;
  plan.until = keys.number("until");
  plan.vtk = parsed(keys, "vtk", Every{plan.until / default_frames}, parse_every);
  plan.history = parsed(keys, "history", Every{plan.until / default_lines}, parse_every);
  plan.checkpoint = parsed(keys, "checkpoint", CheckpointEvery{}, parse_checkpoint_every);
  return plan;
}

/// Filters that probes ask for. A class of F needs ten values in 1/F (SAE J211-1).
void read_filters(const Keys& root, RunRecord& record) {
  if (!root.has("probes")) return;
  for (const std::string& name : root.map("probes").names()) {
    const Keys probe = root.map("probes").map(name);
    if (!probe.has("filter")) continue;
    const double cfc = std::stod(probe.word("filter").substr(4));
    const double interval = record.plan.history.interval;
    if (!(interval > 0) || interval > 1.0001 / (10 * cfc)) {
      probe.complain("filter",
                     fmt::format("needs a line every {} or more often (ten times the class of {} "
                                 "Hz); output.history is {}",
                                 time_text(1 / (10 * cfc)), cfc,
                                 interval > 0 ? "every " + time_text(interval) : "'never'"));
      continue;
    }
    record.filters.push_back({file_name_of(name), cfc});
  }
}

void check_names(const Keys& keys, const Scene& scene, const RunRecord& record) {
  std::set<std::string> taken{"energy"};
  for (const HistoryFilter& f : record.filters) taken.insert(f.history + "_filtered");
  for (const Measure& m : scene.measures) {
    const std::string name = history_name(m);
    if (!name.empty() && !taken.insert(name).second) {
      keys.complain("history",
                    "two histories would be called '" + name + ".csv'; rename '" + m.name + "'");
    }
  }
}

/// True at the levels at which `every` is due, and at the last level of the run.
bool acts(const Every& every, const RunRecord& record, const Step& s) {
  if (record.folder.empty() || !(every.interval > 0)) return false;
  const OutputProgress& o = record.output;
  const bool ends = s.t >= record.plan.until || !record.stop_reason.empty();
  const bool last = ends && o.last_look < record.plan.until;
  return last || due(every, o.last_look, s.t);
}

std::string reason(const Keys& keys, const char* key, const Every& every) {
  const std::string often = "every " + time_text(every.interval);
  return keys.given(key) ? often + ", " + asked_for_at(keys.where(key)) : often + ", by default";
}

std::vector<std::string> shown_fields(const Scene& scene) {
  std::vector<std::string> names;
  for (const Field& f : scene.fields) {
    if (!f.vtk.empty()) names.push_back(f.name);
  }
  return names;
}

void add_histories(const Keys& keys, Scene& scene, Models& models, RunRecord& record) {
  if (!(record.plan.history.interval > 0)) return;
  auto history = std::make_shared<History>(scene, models.ledger);
  const GuardState& guards = scene.store.get<GuardState>();
  models.list.back().plan.add({.name = "histories",
                               .reason = reason(keys, "history", record.plan.history),
                               .stage = Stage::look,
                               .where_all_meet = true,
                               .reads = {"ledger", "measures"},
                               .run = [history, &guards, &record](const Step& s) {
                                 if (!acts(record.plan.history, record, s)) return;
                                 history->write(s.t, guards.balance, record.folder);
                               }});
}

/// Where histories are written; all runs look once more at their end.
void add_stray_looks(const Keys& keys, Scene& scene, Models& models, RunRecord& record) {
  if (scene.particles.size() == 0) return;
  scene.store.get<StrayLimits>().lost = lost_limits(scene, scene.store.get<SphState>().dx);
  if (!(record.plan.history.interval > 0)) return;
  models.list.back().plan.add({.name = "stray particles",
                               .reason = "for summary.json, with the histories: " +
                                         reason(keys, "history", record.plan.history),
                               .stage = Stage::look,
                               .where_all_meet = true,
                               .reads = {"x"},
                               .run = [&scene, &record](const Step& s) {
                                 if (!acts(record.plan.history, record, s)) return;
                                 look_for_strays(scene, record.output.strays);
                               }});
}

void add_frames(const Keys& keys, Scene& scene, Models& models, RunRecord& record) {
  if (!(record.plan.vtk.interval > 0)) return;
  models.list.back().plan.add({.name = "VTK frames",
                               .reason = reason(keys, "vtk", record.plan.vtk),
                               .stage = Stage::look,
                               .where_all_meet = true,
                               .reads = shown_fields(scene),
                               .run = [&scene, &models, &record](const Step& s) {
                                 if (!acts(record.plan.vtk, record, s)) return;
                                 write_frame(scene, models, record);
                               }});
}

/// Before what writes, so that the level at which a run stops is written.
void add_stop(const Keys& keys, const Scene& scene, Models& models, RunRecord& record) {
  const StopCheck check = make_stop(keys, scene);
  if (!check) return;
  models.list.back().plan.add({.name = "stop criterion",
                               .reason = asked_for_at(keys.where("stop")),
                               .stage = Stage::look,
                               .where_all_meet = true,
                               .reads = {"measures"},
                               .run = [check, &record](const Step& s) {
                                 if (record.output.finished) return;
                                 record.stop_reason = check(s.t);
                               }});
}

void output_operations(const Keys& root, Scene& scene, Models& models) {
  RunRecord& record = scene.store.get<RunRecord>();
  const Keys keys = root.map("output");
  record.plan = read_plan(keys);
  read_filters(root, record);
  check_names(keys, scene, record);
  add_stop(keys, scene, models, record);
  add_histories(keys, scene, models, record);
  add_stray_looks(keys, scene, models, record);
  add_frames(keys, scene, models, record);
  models.list.back().plan.add(
      {.name = "end of run",
       .reason = "until " + time_text(record.plan.until) + ", " + asked_for_at(keys.where("until")),
       .stage = Stage::look,
       .where_all_meet = true,
       .run = [&record](const Step& s) {
         record.output.last_look = s.t;
         const bool stops = !record.stop_reason.empty();
         if (stops) record.stop_reason += " at " + time_text(s.t);
         if (stops || s.t >= record.plan.until) record.output.finished = true;
       }});
}

/// Intervals of frames and histories, where the case leaves them open.
std::vector<Choice> output_choices(const Keys& root, Scene& scene) {
  const OutputPlan& plan = scene.store.get<RunRecord>().plan;
  const Keys keys = root.map("output");
  std::vector<Choice> list;
  if (!keys.given("vtk")) {
    list.push_back({"output.vtk", "every " + time_text(plan.vtk.interval),
                    fmt::format("{} frames over the run", default_frames)});
  }
  if (!keys.given("history")) {
    list.push_back({"output.history", "every " + time_text(plan.history.interval),
                    fmt::format("{} lines over the run", default_lines)});
  }
  return list;
}

}  // namespace

Effect output_effect() {
  return {.name = "output",
          .schema = output_schema,
          .operations = output_operations,
          .choices = output_choices};
}

std::string last_output(const RunRecord& record) {
  if (record.output.frames.empty()) return "no frame was written";
  const Frame& last = record.output.frames.back();
  return fmt::format("frame {} at {} in {}", last.number, time_text(last.t), pvd_path(record));
}

}  // namespace gannet
