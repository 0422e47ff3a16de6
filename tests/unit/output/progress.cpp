#include "output/progress.hpp"

#include <catch2/catch.hpp>

#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

TEST_CASE("progress: a line says time, step, who limits it, energy error, rate and ETA",
          "[output]") {
  ProgressValues v;
  v.done = 0.429;
  v.t = 0.0105;
  v.step = 8400;
  v.dt = 1.25e-6;
  v.who = "panel: element 7";
  v.energy_error = 1.2e-4;
  v.particle_steps_per_second = 1.25e6;
  v.seconds_left = 65;
  CHECK(progress_line(v) ==
        " 42 %  t 10.5 ms  step 8400  dt 1.25 us (panel: element 7)  energy error 0.012 %  "
        "1.25 M particles/s  ETA 1 min 05 s");
}

TEST_CASE("progress: off a terminal, a plain line for each tenth of the run", "[output]") {
  const EmptyFolder folder("progress");
  SmallScene small;
  RunRecord& record = small.record();
  record.plan.until = 0.05;
  begin_run(record, small.models);
  std::FILE* file = std::fopen((folder.path + "/log").c_str(), "w");
  Progress progress(file);
  while (small.models.list.front().step.t < record.plan.until) {
    advance(small.models);
    progress.update(small.scene, small.models, record);
  }
  progress.finish();
  std::fclose(file);
  const std::string log = read_file(folder.path + "/log");
  CHECK(std::count(log.begin(), log.end(), '\n') == 10);
  CHECK_THAT(log, Catch::StartsWith(" 10 %  t 5"));
  CHECK_THAT(log, Catch::Contains("\n100 %  t 50"));
  CHECK_THAT(log, Catch::Contains("(springs: node 3)"));
  CHECK(log.find('\r') == std::string::npos);
}
