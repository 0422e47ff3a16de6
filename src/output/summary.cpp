#include "output/summary.hpp"

#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/parallel.hpp"
#include "output/cfc_filter.hpp"
#include "output/files.hpp"
#include "output/report.hpp"
#include "time/guards.hpp"

namespace gannet {

namespace {

using Json = nlohmann::ordered_json;

/// Sum of m (x, y, z: m v; w: m) over the owned nodes.
Line mass_and_momentum(const Nodes& nodes) {
  return parallel_reduce(
      nodes.n_owned, node_chunk, Line{},
      [&](Index begin, Index end) {
        Line sum;
        for (Index i = begin; i < end; ++i) {
          const double m = nodes.x[static_cast<std::size_t>(i)].w;
          add_xyz(sum, m * xyz(nodes.v[static_cast<std::size_t>(i)]));
          sum.w += m;
        }
        return sum;
      },
      [](const Line& a, const Line& b) {
        return Line{a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
      });
}

long long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024LL * usage.ru_maxrss;
}

Json operations_json(const Models& models, double wall) {
  Json list = Json::array();
  for (const OperationCost& c : operation_costs(models, wall)) {
    list.push_back({{"name", c.name},
                    {"stage", c.stage},
                    {"model", c.model},
                    {"calls", c.calls},
                    {"seconds", c.seconds},
                    {"share", c.share}});
  }
  return list;
}

/// JSON has no infinity: null in its place.
Json number_json(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

/// The worst of all looks and of this moment.
void add_strays(Scene& scene, const RunRecord& record, Json& json) {
  if (scene.particles.size() == 0) return;
  StrayParticles strays = record.output.strays;
  look_for_strays(scene, strays);
  json["lost_particles"] = strays.lost;
  json["deepest_penetration"] = number_json(strays.deepest);
}

/// What rest saved; nothing where no particle may rest.
void add_rest(const Scene& scene, const Models& models, Json& json) {
  const Resting& resting = scene.resting;
  if (!(resting.all_particle_steps > 0)) return;
  const RestSaving saving = rest_saving(scene, models);
  json["rest"] = {
      {"mean_share", saving.share},
      {"share_at_end", static_cast<double>(resting.n) / scene.particles.size()},
      {"particle_steps_saved", resting.particle_steps},
      {"seconds_saved", saving.seconds},
      {"momentum_taken", {resting.momentum.x(), resting.momentum.y(), resting.momentum.z()}}};
}

/// What measures are told at the end, by name and component; nothing where there are none.
void add_measures_at_end(const Scene& scene, Json& json) {
  for (const Measure& m : scene.measures) {
    if (!m.at_end) continue;
    std::vector<double> values(m.components.size());
    m.sample(values.data());
    Json& entry = json["measures"][m.name];
    for (std::size_t c = 0; c < values.size(); ++c) {
      entry[m.components[c]] = number_json(values[c]);
    }
    entry["unit"] = m.unit;
  }
}

}  // namespace

std::string summary_text(Scene& scene, const Models& models, const RunRecord& record) {
  const double wall = wall_time(record);
  const StepsDone done = steps_done(scene, models, record);
  const Line sum = mass_and_momentum(scene.nodes);
  Json json = {{"status", record.status},
               {"exit_reason", record.exit_reason},
               {"case", record.case_file},
               {"version", full_version(record)},
               {"steps", models.list.back().step.n},
               {"time", models.list.front().step.t},
               {"wall_time", wall},
               {"wall_time_before", record.wall_before},
               {"cpu_time", cpu_time()},
               {"cpu_time_before", record.cpu_before},
               {"threads", record.threads},
               {"instruction_set", record.instruction_set},
               {"energy_error", scene.store.get<GuardState>().balance.error()},
               {"mass", sum.w},
               {"momentum", {sum.x, sum.y, sum.z}},
               {"peak_memory_bytes", peak_memory_bytes()},
               {"particle_steps_per_second", wall > 0 ? done.particle_steps / wall : 0},
               {"element_steps_per_second", wall > 0 ? done.element_steps / wall : 0}};
  add_strays(scene, record, json);
  add_rest(scene, models, json);
  add_measures_at_end(scene, json);
  json["operations"] = operations_json(models, wall);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(Scene& scene, const Models& models, const RunRecord& record) {
  write_filtered_histories(record);
  write_whole_file(record.folder + "/summary.json", summary_text(scene, models, record),
                   Durable::yes);
}

}  // namespace gannet
