// Stop criteria: when they end a run, and that they change nothing before.
#include "output/stop.hpp"

#include <catch2/catch.hpp>

#include "input/case.hpp"
#include "small_run.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A run of the small scene as the text of its key `output` asks.
struct StoppingRun {
  std::unique_ptr<Case> the_case;
  SmallScene small;
  StoppingRun(const std::string& output, const std::string& folder = "") {
    the_case = read_case_text("gannet: 1\nlet: {limit: -3 mm}\noutput: " + output + "\n",
                              "case.yaml", output_effect().schema());
    small.record().folder = folder;
    guards_effect().state(the_case->keys(), small.scene);
    small.scene.store.get<GuardState>().limits = {1e9, 0, 0, 1e9};
    guards_effect().operations(the_case->keys(), small.scene, small.models);
    output_effect().operations(the_case->keys(), small.scene, small.models);
  }
  RunRecord& record() { return small.record(); }
  double tip_z() { return small.scene.nodes.x[0].z; }
  void go() {
    begin_run(record(), small.models);
    while (!record().output.finished) advance(small.models);
  }
};

std::string mistakes(const std::string& stop) {
  try {
    StoppingRun run("{until: 1 s, stop: " + stop + "}");
    std::string all;
    for (const std::string& m : run.the_case->mistakes.messages()) all += m + "\n";
    return all;
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("stop: at the first level past the limit, named, with a last line", "[output]") {
  const EmptyFolder folder("stop");
  // The tip falls with 6 m/s, slowed by its spring: at 3 mm after half a millisecond.
  StoppingRun run("{until: 1 s, vtk: never, stop: {probe: tip, component: z, below: -3 mm}}",
                  folder.path);
  run.go();
  const double last = run.record().output.last_look;
  CHECK(last > 0.5e-3);
  CHECK(last < 0.5e-3 + 3e-4);
  CHECK_THAT(run.record().stop_reason,
             Catch::StartsWith("tip z = -0.003") && Catch::Contains("m, below -0.003 m at "));
  const std::string tip = read_file(folder.path + "/history/tip.csv");
  CHECK(std::count(tip.begin(), tip.end(), '\n') == 3);  // header, start, the level of the stop
}

TEST_CASE("stop: a condition in a formula stops at the same level, with the same bits",
          "[output]") {
  StoppingRun probe("{until: 1 s, stop: {probe: tip, component: z, below: -3 mm}}");
  StoppingRun formula("{until: 1 s, stop: {when: \"tip_z < limit && t > 0.0001\"}}");
  StoppingRun none("{until: 1 s}");
  probe.go();
  formula.go();
  CHECK_THAT(formula.record().stop_reason,
             Catch::StartsWith("tip_z < limit && t > 0.0001, with tip_z = -0.003"));
  const auto n = probe.small.models.list.front().step.n;
  CHECK(formula.small.models.list.front().step.n == n);
  begin_run(none.record(), none.small.models);
  for (int k = 0; k < n; ++k) advance(none.small.models);
  CHECK(none.tip_z() == probe.tip_z());
  CHECK(formula.tip_z() == probe.tip_z());
}

TEST_CASE("stop: not before `after`; the length where no component is named", "[output]") {
  StoppingRun late("{until: 1 s, stop: {probe: tip, above: 3 mm, after: 2 ms}}");
  late.go();
  CHECK(late.record().output.last_look >= 2e-3);
  CHECK(late.record().output.last_look < 2e-3 + 3e-4);
  StoppingRun never("{until: 3 ms, stop: {probe: tip, above: 3 km}}");
  never.go();
  CHECK(never.record().stop_reason.empty());
  CHECK(never.record().output.last_look >= 3e-3);
}

TEST_CASE("stop: mistakes name their place and what there is", "[output]") {
  CHECK_THAT(mistakes("{probe: top, above: 1 m}"),
             Catch::Contains("output.stop.probe: there is no history 'top'") &&
                 Catch::Contains("tip, contact_slam_force"));
  CHECK_THAT(mistakes("{probe: tip, component: y, above: 1 m}"), Catch::Contains("(there: x, z)"));
  CHECK_THAT(mistakes("{probe: tip, component: z, above: 1 N}"),
             Catch::Contains("output.stop.above: '1 N' is a force; a length is wanted"));
  CHECK_THAT(mistakes("{probe: tip, component: z}"), Catch::Contains("one of above and below"));
  CHECK_THAT(mistakes("{when: \"tip_y > 1\"}"),
             Catch::Contains("output.stop.when: 'tip_y > 1': unknown name 'tip_y'") &&
                 Catch::Contains("variables: t, tip_x, tip_z, contact_slam_force"));
  CHECK_THAT(mistakes("{after: 1 s}"), Catch::Contains("one of when and probe"));
  CHECK_THAT(mistakes("{when: \"t > 1\", above: 3}"), Catch::Contains("goes with probe"));
}
