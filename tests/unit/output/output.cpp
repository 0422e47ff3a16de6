#include <catch2/catch.hpp>

#include "output/checkpoint.hpp"
#include "output/folder.hpp"
#include "output/history.hpp"
#include "output/output.hpp"
#include "output/vtk_series.hpp"
#include "small_run.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

std::vector<double> frame_times(Run& run) {
  std::vector<double> times;
  for (const Frame& f : run.record().output.frames) times.push_back(f.t);
  return times;
}

}  // namespace

TEST_CASE("output: first frame at 0, one for each interval, a last one at the end", "[output]") {
  const EmptyFolder folder("effect");
  Run run(folder.path, 0.0105, {{"vtk", "every 2 ms"}, {"history", "every 1 ms"}});
  run.go();
  REQUIRE(run.mistakes.empty());
  const std::vector<double> times = frame_times(run);
  REQUIRE(times.size() == 7);  // 0, 2, 4, 6, 8, 10 ms and the end
  const double largest_step = 1.3e-4 * 2.2;
  CHECK(times[0] == 0);
  for (int k = 1; k < 6; ++k) {
    CHECK(times[static_cast<std::size_t>(k)] >= k * 2e-3);
    CHECK(times[static_cast<std::size_t>(k)] < k * 2e-3 + largest_step);
  }
  CHECK(times[6] >= 0.0105);
  CHECK(times[6] < 0.0105 + largest_step);
  const std::string tip = read_file(folder.path + "/history/tip.csv");
  CHECK(std::count(tip.begin(), tip.end(), '\n') == 1 + 11 + 1);
  CHECK(last_output(run.record()).starts_with("frame 6 at 10."));
}

TEST_CASE("output: it changes neither the steps nor the state", "[output]") {
  const EmptyFolder folder("bystander");
  Run silent("", 0.01, {{"vtk", "never"}, {"history", "never"}});
  Run busy(folder.path, 0.01,
           {{"vtk", "every 1.5 ms"}, {"history", "1 us"}, {"checkpoint", "every 4 ms"}});
  silent.go();
  busy.go();
  const Step& a = silent.small.models.list.front().step;
  const Step& b = busy.small.models.list.front().step;
  CHECK(a.n == b.n);
  CHECK(a.t == b.t);
  const auto& x = silent.small.scene.nodes.x;
  const auto& y = busy.small.scene.nodes.x;
  CHECK(std::memcmp(x.data(), y.data(), x.size() * sizeof(Line)) == 0);
  CHECK(checkpoints_in(folder.path).size() == 2);
}

TEST_CASE("output: without words, 50 frames and 1000 lines over the run", "[output]") {
  const EmptyFolder folder("defaults");
  Run run(folder.path, 0.5, {}, 1e-4);
  run.go();
  CHECK(run.record().output.frames.size() == 51);
  const std::string tip = read_file(folder.path + "/history/tip.csv");
  CHECK(std::count(tip.begin(), tip.end(), '\n') == 1 + 1001);
}

TEST_CASE("output: an interrupted and resumed run leaves the same bytes as an unbroken one",
          "[output]") {
  const Texts texts{
      {"vtk", "every 0.9 ms"}, {"history", "every 0.2 ms"}, {"checkpoint", "every 6 ms"}};
  const EmptyFolder whole("unbroken");
  Run unbroken(whole.path, 0.02, texts);
  unbroken.go();

  const EmptyFolder cut("interrupted");
  // Stops far behind the last checkpoint, with frames and lines that the resumed run must undo.
  Run(cut.path, 0.02, texts).go(60);
  write_file(cut.path + "/history/tip.csv", read_file(cut.path + "/history/tip.csv") + "0.01,2");
  write_file(cut.path + "/vtk/.unfinished.tmp", "half a frame");
  Run resumed(cut.path, 0.02, texts);
  prepare_output_folder(cut.path, false, true);
  const auto warnings = read_checkpoint(newest_checkpoint(cut.path), resumed.small.scene,
                                        resumed.small.models, resumed.record());
  CHECK(warnings.empty());
  rewind_output(resumed.small.models, resumed.record());
  CHECK(resumed.small.models.list.front().step.n > 0);
  resumed.go();

  const auto a = all_files(whole.path, "checkpoint");
  const auto b = all_files(cut.path, "checkpoint");
  CHECK(a.size() == b.size());
  CHECK(a.size() > 20);
  for (const auto& [name, bytes] : a) {
    INFO(name);
    REQUIRE(b.contains(name));
    CHECK(b.at(name) == bytes);
  }
}

TEST_CASE("output: a checkpoint of a finished run knows that it is done", "[output]") {
  const EmptyFolder folder("finished");
  Run run(folder.path, 0.005, {{"vtk", "every 5 ms"}});
  run.go();
  const std::string path = write_next_checkpoint(run.small.scene, run.small.models, run.record());
  Run same(folder.path, 0.005, {});
  read_checkpoint(path, same.small.scene, same.small.models, same.record());
  CHECK(same.record().output.finished);
  Run longer(folder.path, 0.01, {});
  read_checkpoint(path, longer.small.scene, longer.small.models, longer.record());
  CHECK_FALSE(longer.record().output.finished);
}

TEST_CASE("output: in another folder a resumed run starts its own frames", "[output]") {
  const EmptyFolder first("first");
  const EmptyFolder second("second");
  const Texts texts{{"vtk", "every 1 ms"}, {"checkpoint", "every 2 ms"}};
  Run(first.path, 0.02, texts).go(60);
  Run resumed(second.path, 0.02, texts);
  read_checkpoint(newest_checkpoint(first.path), resumed.small.scene, resumed.small.models,
                  resumed.record());
  rewind_output(resumed.small.models, resumed.record());
  CHECK(resumed.record().output.frames.empty());
  resumed.go();
  CHECK(fs::exists(second.path + "/vtk/panel_000000.vtu"));
  CHECK(resumed.record().output.frames.front().t > 0);
}

TEST_CASE("output: mistakes name their place", "[output]") {
  Run run("", 0.01, {{"vtk", "every 3 kg"}, {"checkpoint", "sometimes"}});
  std::vector<std::string> messages = run.mistakes.messages();
  REQUIRE(messages.size() == 2);
  CHECK_THAT(messages[0], Catch::StartsWith("case.yaml:42:3: output.vtk: 'every 3 kg' is"));
  CHECK_THAT(messages[1], Catch::StartsWith("case.yaml:43:3: output.checkpoint: 'sometimes'"));
}

TEST_CASE("output: two histories of one name are a mistake", "[output]") {
  SmallScene small;
  small.scene.measures.push_back({"probe.energy", "J", {"value"}, [](double*) {}});
  const Value root = output_case(1, {});
  Mistakes mistakes;
  output_effect().operations(Keys(root, mistakes), small.scene, small.models);
  REQUIRE(mistakes.messages().size() == 1);
  CHECK_THAT(mistakes.messages()[0], Catch::Contains("'energy.csv'; rename 'probe.energy'"));
}
