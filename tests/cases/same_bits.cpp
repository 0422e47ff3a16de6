// The same bits for any number of threads, for a run that is cut and resumed, and for any output.
// CTest runs this once per instruction set (GANNET_ISA).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <set>
#include <thread>

#include "../support/same_bits.hpp"
#include "../support/temporary_folder.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "body/rigid_phase.hpp"
#include "output/checkpoint.hpp"
#include "output/folder.hpp"
#include "same_bits_cases.hpp"
#include "sph/sph_state.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// How many threads take part in loops whose chunks wait a little; tries until `wanted` do.
int n_threads_seen(int wanted) {
  std::set<std::thread::id> seen;
  std::mutex lock;
  for (int tries = 0; tries < 100 && static_cast<int>(seen.size()) < wanted; ++tries) {
    parallel_for(64, 1, [&](Index, Index) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const std::lock_guard<std::mutex> guard(lock);
      seen.insert(std::this_thread::get_id());
    });
  }
  return static_cast<int>(seen.size());
}

/// A case, and how many steps of it are compared.
struct Sample {
  std::function<std::unique_ptr<WatchedRun>()> make;
  std::int64_t n_steps = 0;
  bool contact = false;  ///< steps are counted from the first contact on
};

Sample panel_sample() {
  return {[] { return std::make_unique<WatchedRun>(panel_slam, small_panel); }, 220, true};
}

Sample dam_sample() {
  return {[] { return std::make_unique<WatchedRun>(dam_break, small_dam); }, 400, false};
}

Sample terms_sample(const std::string& precision) {
  std::vector<std::string> set = all_terms;
  set.push_back("parts.column.sph.precision=" + precision);
  return {[set] { return std::make_unique<WatchedRun>(dam_break, set); }, 150, false};
}

Sample periodic_sample() {
  return {[] { return std::make_unique<WatchedRun>(periodic_plane); }, 150, false};
}

Sample shaken_sample() {
  return {[] { return std::make_unique<WatchedRun>(shaken_tank); }, 150, false};
}

Sample walls_sample() {
  return {[] { return std::make_unique<WatchedRun>(channel); }, 150, false};
}

Sample resting_sample() {
  return {[] { return std::make_unique<WatchedRun>(resting); }, 240, false};
}

Sample sea_sample() {
  return {[] { return std::make_unique<WatchedRun>(sea); }, 150, false};
}

Sample bodies_sample() {
  return {[] { return std::make_unique<WatchedRun>(bodies); }, 150, false};
}

Sample tied_sample() {
  return {[] { return std::make_unique<WatchedRun>(tied_parts); }, 150, false};
}

Sample walled_bodies_sample() {
  return {[] { return std::make_unique<WatchedRun>(walled_bodies(bodies)); }, 150, false};
}

Sample border_sample() {
  return {[] { return std::make_unique<WatchedRun>(bodies_at_border(bodies)); }, 150, false};
}

Sample kernel_sample() {
  return {[] { return std::make_unique<WatchedRun>(kernel_bodies(bodies_at_border(bodies))); }, 150,
          false};
}

Sample rigid_and_back_sample() {
  return {[] { return std::make_unique<WatchedRun>(rigid_and_back); }, 150, false};
}

Sample moored_sample() {
  return {[] { return std::make_unique<WatchedRun>(moored); }, 150, false};
}

Sample held_sample() {
  return {[] { return std::make_unique<WatchedRun>(held(moored)); }, 150, false};
}

Sample linked_walls_sample(const std::string& text) {
  return {[text] { return std::make_unique<WatchedRun>(text); }, 150, false};
}

Sample solids_sample(const std::string& formulation) {
  std::vector<std::string> set = small_bar;
  set.push_back("parts.rod.solid.formulation=" + formulation);
  return {[set] { return std::make_unique<WatchedRun>(taylor_bar, set); }, 150, false};
}

Sample metals_sample() {
  return {[] { return std::make_unique<WatchedRun>(metals); }, 150, false};
}

Sample plane_sample() {
  return {[] { return std::make_unique<WatchedRun>(plane_block); }, 150, false};
}

Sample meeting_sample() {
  return {[] { return std::make_unique<WatchedRun>(blocks_that_meet); }, 150, false};
}

Sample shells_sample(const std::string& formulation) {
  return {[formulation] { return std::make_unique<WatchedRun>(shells(formulation)); }, 150, false};
}

/// A file with a mesh of 40 x 40 cells over 1 m x 1 m, every third of them two triangles.
std::string mixed_mesh() {
  const auto file = std::filesystem::temp_directory_path() / "gannet_same_bits_mixed.msh";
  constexpr int n = 40;
  std::string cells;
  int n_cells = 0;
  const auto add = [&](const std::vector<int>& nodes) {
    cells += fmt::format("{} {} 2 1 1 {}\n", ++n_cells, nodes.size() == 3 ? 2 : 3,
                         fmt::join(nodes, " "));
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i + 1;
      const std::vector<int> q{a, a + 1, a + n + 2, a + n + 1};
      if ((i + j) % 3 != 0) {
        add(q);
        continue;
      }
      add({q[0], q[1], q[2]});
      add({q[0], q[2], q[3]});
    }
  }
  std::ofstream out(file);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << (n + 1) * (n + 1) << "\n";
  for (int k = 0; k < (n + 1) * (n + 1); ++k) {
    out << k + 1 << ' ' << k % (n + 1) / double(n) << ' ' << k / (n + 1) / double(n) << " 0\n";
  }
  out << "$EndNodes\n$Elements\n" << n_cells << "\n" << cells << "$EndElements\n";
  return file.string();
}

Sample mixed_sample() {
  const std::string file = mixed_mesh();
  return {[file] { return std::make_unique<WatchedRun>(mixed_shells(file)); }, 150, false};
}

Sample torn_sample() {
  const std::vector<std::string> set{"dx=5mm", "output.checkpoint=never"};
  return {[set] { return std::make_unique<WatchedRun>("tests/hard/torn_panel.yaml", set); }, 260,
          false};
}

Sample lines_sample() {
  return {[] { return std::make_unique<WatchedRun>(rope_and_beam); }, 150, false};
}

Sample moorings_sample() {
  return {[] { return std::make_unique<WatchedRun>(moorings); }, 150, false};
}

/// Runs a sample from its start; returns it at its end.
std::unique_ptr<WatchedRun> run(const Sample& sample, int n_threads) {
  set_threads(n_threads);
  auto r = sample.make();
  if (sample.contact) r->until_above_zero("contact.slam.active");
  r->steps(sample.n_steps);
  return r;
}

void report(const WatchedRun& r) {
  WARN(fmt::format("{} steps, {} entries of {} bytes, {} x {} numbers of histories, {} lists made",
                   r.at().n, bits_of(*r.s).size(), n_bytes(bits_of(*r.s)), r.history.size(),
                   r.history.begin()->second.size(), r.s->scene.store.get<SphState>().n_builds));
}

void check_threads(const Sample& sample) {
  const auto one = run(sample, 1);
  const Bits bits = bits_of(*one->s);
  report(*one);
  // Lists must have been made anew, or the order of particles was never at stake.
  if (!one->s->scene.particles.empty()) {
    CHECK(one->s->scene.store.get<SphState>().n_builds >= 3);
  }
  for (const int n : {2, 3, 5}) {
    INFO(n << " threads");
    const auto other = run(sample, n);
    CHECK(other->history.size() == one->history.size());
    check_same(bits, bits_of(*other->s));
    check_same_history(*one, *other);
  }
}

/// Steps to level n, writes a checkpoint there, and reads it into a simulation made anew.
std::unique_ptr<WatchedRun> cut_at(const Sample& sample, std::unique_ptr<WatchedRun> r,
                                   std::int64_t n, const std::string& folder) {
  r->steps(n - r->at().n);
  const std::string path = fmt::format("{}/checkpoint_{:06}.h5", folder, n);
  write_checkpoint(path, r->s->scene, r->s->models, r->s->scene.store.get<RunRecord>());
  auto next = sample.make();
  Simulation& s = *next->s;
  read_checkpoint(path, s.scene, s.models, s.scene.store.get<RunRecord>());
  CHECK(next->at().n == n);
  return next;
}

void check_restart(const Sample& sample) {
  const auto whole = run(sample, 2);
  const std::int64_t end = whole->at().n;
  const TemporaryFolder folder;
  auto r = sample.make();
  // Cut soon after the start, in the middle, right after the next step, and close to the end.
  int n_threads = 1;
  for (const std::int64_t n : {std::int64_t{3}, end / 3, end - sample.n_steps / 2,
                               end - sample.n_steps / 2 + 1, end - 27}) {
    INFO("cut at step " << n << " of " << end);
    set_threads(n_threads);
    n_threads = n_threads % 3 + 1;
    r = cut_at(sample, std::move(r), n, folder.path());
  }
  r->steps(end - r->at().n);
  CHECK(r->history.size() == 27);
  check_same_history(*whole, *r);
  check_same(bits_of(*whole->s), bits_of(*r->s));
}

/// Names of the fields that change nothing within n steps where a restart goes without them.
std::set<std::string> needless_fields(const Sample& sample, std::int64_t n) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/checkpoint_1.h5";
  const auto whole = run(sample, 2);
  write_checkpoint(path, whole->s->scene, whole->s->models, whole->s->scene.store.get<RunRecord>());
  whole->steps(n);
  const Bits bits = bits_of(*whole->s);
  std::set<std::string> needless;
  for (std::size_t k = 0; k < whole->s->scene.fields.size(); ++k) {
    const auto r = sample.make();
    Scene& scene = r->s->scene;
    if (!scene.fields[k].checkpoint) continue;
    scene.fields[k].checkpoint = false;
    read_checkpoint(path, scene, r->s->models, scene.store.get<RunRecord>());
    try {
      r->steps(n);
      if (bits_of(*r->s) == bits) needless.insert(scene.fields[k].name);
    } catch (const RunError&) {
      // A guard that trips has noticed.
    }
  }
  return needless;
}

/// Runs as `gannet run` does, with these output keys, up to step `end`; returns the bits.
Bits run_with_output(const std::string& file, std::vector<std::string> set,
                     const std::vector<std::string>& output, const std::string& folder,
                     std::int64_t end) {
  set.insert(set.end(), output.begin(), output.end());
  const auto s = make_simulation(file, set);
  RunRecord& record = s->scene.store.get<RunRecord>();
  record.folder = folder;
  record.name = "bits";
  if (!folder.empty()) prepare_output_folder(folder, true, false);
  begin_run(record, s->models);
  while (!record.output.finished && s->models.list.front().step.n < end) {
    if (checkpoint_due(s->models, record)) write_next_checkpoint(s->scene, s->models, record);
    advance(s->models);
  }
  if (!folder.empty()) {
    CHECK(record.output.frames.size() > 10);
    CHECK(!newest_checkpoint(folder).empty());
  }
  return bits_of(*s);
}

void check_output(const std::string& file, const std::vector<std::string>& set,
                  const std::string& often, const std::string& until, std::int64_t end) {
  set_threads(2);
  const TemporaryFolder folder;
  const Bits silent = run_with_output(
      file, set, {"output.vtk=never", "output.history=never", "output.until=1000 s"}, "", end);
  const Bits talking =
      run_with_output(file, set,
                      {"output.vtk=every " + often, "output.history=every 1 ns",
                       "output.checkpoint=every " + often, "output.until=" + until},
                      folder.path() + "/out", end);
  check_same(silent, talking);
}

}  // namespace

TEST_CASE("same bits: parallel loops really use 1, 2, 3 and 5 threads", "[bits]") {
  for (const int n : {1, 2, 3, 5}) {
    set_threads(n);
    CHECK(threads() == n);
    CHECK(n_threads_seen(n) == n);
  }
}

TEST_CASE("same bits: panel on water, 1, 2, 3 and 5 threads, 220 steps past first contact",
          "[bits]") {
  check_threads(panel_sample());
}

TEST_CASE("same bits: dam break, 1, 2, 3 and 5 threads", "[bits]") { check_threads(dam_sample()); }

TEST_CASE("same bits: periodic shear layer with viscosity and XSPH, 1, 2, 3 and 5 threads",
          "[bits]") {
  check_threads(periodic_sample());
}

TEST_CASE("same bits: a tank of moving walls and formulas, 1, 2, 3 and 5 threads", "[bits]") {
  check_threads(shaken_sample());
}

TEST_CASE("same bits: a tank of moving walls and formulas, cut five times, as if never cut",
          "[bits]") {
  check_restart(shaken_sample());
}

TEST_CASE("same bits: every term of the pair passes, 1, 2, 3 and 5 threads", "[bits]") {
  check_threads(terms_sample(GENERATE("double", "single")));
}

TEST_CASE("same bits: every term of the pair passes, cut five times, as if never cut", "[bits]") {
  check_restart(terms_sample(GENERATE("double", "single")));
}

TEST_CASE("same bits: moving walls of dummy particles, 1, 2, 3 and 5 threads", "[bits]") {
  check_threads(walls_sample());
}

TEST_CASE("same bits: panel on water, cut five times and resumed, as if never cut", "[bits]") {
  check_restart(panel_sample());
}

TEST_CASE("same bits: dam break, cut five times and resumed, as if never cut", "[bits]") {
  check_restart(dam_sample());
}

TEST_CASE("same bits: periodic shear layer, cut five times and resumed, as if never cut",
          "[bits]") {
  check_restart(periodic_sample());
}

TEST_CASE("same bits: moving walls of dummy particles, cut five times and resumed", "[bits]") {
  check_restart(walls_sample());
}

TEST_CASE("same bits: a restart that lacks a field of the state is noticed", "[bits]") {
  Sample sample = panel_sample();
  sample.n_steps = 60;
  // The others are constant, or made anew before they are read.
  const std::set<std::string> needless = needless_fields(sample, 30);
  for (const char* name : {"x", "v", "omega", "rho", "p", "panel.state"}) {
    INFO(name);
    CHECK(!needless.contains(name));
  }
}

TEST_CASE("same bits: output, checkpoints and the end time change nothing in a panel on water",
          "[bits]") {
  check_output(panel_slam, small_panel, "0.07 ms", "1.8 ms", 300);
}

TEST_CASE("same bits: output, checkpoints and the end time change nothing in a dam break",
          "[bits]") {
  check_output(dam_break, small_dam, "1 ms", "60 ms", 400);
}

TEST_CASE("same bits: waves over a bed, sponge and relaxation, 1, 2, 3 and 5 threads", "[bits]") {
  check_threads(sea_sample());
}

TEST_CASE("same bits: models at steps of their own, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(moored_sample());
  check_restart(moored_sample());
}

TEST_CASE("same bits: forces held through substeps, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(held_sample());
  check_restart(held_sample());
}

TEST_CASE("same bits: walls on a body of a faster model, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  for (const std::string& text : {held(walled(moored)), walled(moored)}) {
    check_threads(linked_walls_sample(text));
    check_restart(linked_walls_sample(text));
  }
}

TEST_CASE("same bits: parts tied across models, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  check_threads(tied_sample());
  check_restart(tied_sample());
}

TEST_CASE("same bits: rigid bodies, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  check_threads(bodies_sample());
  check_restart(bodies_sample());
}

TEST_CASE("same bits: bodies with walls of particles, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(walled_bodies_sample());
  check_restart(walled_bodies_sample());
}

TEST_CASE("same bits: a body across a periodic border, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(border_sample());
  check_restart(border_sample());
}

TEST_CASE("same bits: kernel contact across a periodic border, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(kernel_sample());
  check_restart(kernel_sample());
}

TEST_CASE("same bits: a body that is rigid for a time, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(rigid_and_back_sample());
  check_restart(rigid_and_back_sample());
  const auto end = run(rigid_and_back_sample(), 1);
  CHECK(end->s->scene.store.get<RigidPhases>().list.front().phase[0] == 2);
}

TEST_CASE("same bits: solids that yield, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  const std::string formulation = GENERATE("one_point", "eight_points", "tetrahedra");
  check_threads(solids_sample(formulation));
  check_restart(solids_sample(formulation));
}

TEST_CASE("same bits: metals that warm, turn round and fail, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(metals_sample());
  check_restart(metals_sample());
  const auto end = run(metals_sample(), 1);
  for (const std::string name : {"solid.rod.eroded", "shell.sheet.eroded"}) {
    double n = 0;
    for (const Measure& m : end->s->scene.measures) {
      if (m.name == name) m.sample(&n);
    }
    INFO(name);
    CHECK(n > 0);
  }
}

TEST_CASE("same bits: plane solids that yield, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  check_threads(plane_sample());
  check_restart(plane_sample());
}

TEST_CASE("same bits: parts that meet, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  check_threads(meeting_sample());
  check_restart(meeting_sample());
}

TEST_CASE("same bits: shells that yield, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  const std::string formulation = GENERATE("belytschko_lin_tsay", "fully_integrated");
  check_threads(shells_sample(formulation));
  check_restart(shells_sample(formulation));
}

TEST_CASE(
    "same bits: quadrilaterals and triangles that settle, 1, 2, 3 and 5 threads, and restarts",
    "[bits]") {
  check_threads(mixed_sample());
  check_restart(mixed_sample());
}

TEST_CASE("same bits: water that tears a panel, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  check_threads(torn_sample());
  check_restart(torn_sample());
  const auto end = run(torn_sample(), 1);
  double n = 0;
  for (const Measure& m : end->s->scene.measures) {
    if (m.name == "shell.panel.eroded") m.sample(&n);
  }
  CHECK(n > 20);
}

TEST_CASE("same bits: a rope that breaks and a beam, 1, 2, 3 and 5 threads, and restarts",
          "[bits]") {
  check_threads(lines_sample());
  check_restart(lines_sample());
  const auto end = run(lines_sample(), 1);
  double n_broken = 0;
  for (const Measure& m : end->s->scene.measures) {
    if (m.name == "cable.rope.broken") m.sample(&n_broken);
  }
  CHECK(n_broken > 0);
  double n_left = 0;
  for (const Measure& m : end->s->scene.measures) {
    if (m.name == "beam.strut.eroded") m.sample(&n_left);
  }
  CHECK(n_left > 0);
}

TEST_CASE("same bits: mooring lines, 1, 2, 3 and 5 threads, and restarts", "[bits]") {
  check_threads(moorings_sample());
  check_restart(moorings_sample());
}

TEST_CASE("same bits: water that rests and wakes, 1, 2, 3 and 5 threads", "[bits]") {
  check_threads(resting_sample());
}

TEST_CASE("same bits: restarts of water that rests and wakes", "[bits]") {
  const auto r = run(resting_sample(), 2);
  const Resting& resting = r->s->scene.resting;
  WARN(fmt::format(
      "{} of {} particles at rest, {} of them unseen; {:.3g} of all particle steps saved",
      resting.n, r->s->scene.particles.size(), resting.n_unseen,
      resting.particle_steps / resting.all_particle_steps));
  CHECK(resting.n_unseen > 0);
  CHECK(resting.n < 0.9 * r->s->scene.particles.size());
  check_restart(resting_sample());
}

TEST_CASE("same bits: restarts of waves over a bed, sponge and relaxation", "[bits]") {
  check_restart(sea_sample());
}
