#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

/// Adds an operation that votes dt and writes the model's name, stage and time to a log.
void add_logged(Model& model, double* dt, std::vector<std::string>* log) {
  model.plan.add(
      {.name = "force " + model.name,
       .stage = Stage::force,
       .run = [&model, log](
                  const Step& s) { log->push_back(model.name + std::to_string(s.t).substr(0, 5)); },
       .stable_dt = [dt] { return *dt; },
       .limited_by = [&model] { return model.name; }});
}

}  // namespace

TEST_CASE("clock: the model furthest behind advances, levels coincide exactly", "[time]") {
  Models models;
  std::vector<std::string> log;
  double slow = 1.0;
  double fast = 0.3;
  double faster = 0.1;
  for (const char* name : {"a", "b", "c"}) models.list.emplace_back().name = name;
  add_logged(models.list[0], &slow, &log);
  add_logged(models.list[1], &fast, &log);
  add_logged(models.list[2], &faster, &log);
  advance(models);
  // b takes ceil(1/0.3) = 4 equal substeps of 0.25, c ceil(0.25/0.1) = 3 in each.
  CHECK(models.list[0].step.n == 1);
  CHECK(models.list[1].step.n == 4);
  CHECK(models.list[2].step.n == 12);
  CHECK(models.list[0].step.t == 1.0);
  CHECK(models.list[1].step.t == 1.0);
  CHECK(models.list[2].step.t == 1.0);
  REQUIRE(log.size() == 17);
  CHECK(log[0] == "a0.000");
  CHECK(log[1] == "b0.000");
  CHECK(log[2] == "c0.000");
  CHECK(log[5] == "b0.250");
  CHECK(log[6] == "c0.250");
}

TEST_CASE("clock: levels coincide bit for bit over many odd ratios", "[time]") {
  Models models;
  std::vector<std::string> log;
  double slow = 0.1;
  double fast = 0.0137;
  for (const char* name : {"a", "b"}) models.list.emplace_back().name = name;
  add_logged(models.list[0], &slow, &log);
  add_logged(models.list[1], &fast, &log);
  for (int k = 0; k < 1000; ++k) {
    fast = 0.0137 * (1 + 0.5 * (k % 7));
    slow = 0.1 / (1 + k % 3);
    advance(models);
    REQUIRE(models.list[0].step.t == models.list[1].step.t);
  }
}

TEST_CASE("clock: the rounding of a late time asks for no substep more", "[time]") {
  const int ratio = GENERATE(4, 1000);
  double slow = GENERATE(0.9, 0.3, 0.6, 0.7);  // times round up with some, down with others
  Models models;
  std::vector<std::string> log;
  double fast = slow / ratio;
  for (const char* name : {"a", "b"}) models.list.emplace_back().name = name;
  add_logged(models.list[0], &slow, &log);
  add_logged(models.list[1], &fast, &log);
  for (const double start : {1e3, 2.1e3, 7e4, 1e6, 1e7, 1e8}) {
    for (Model& model : models.list) model.step.t = start;
    for (int k = 0; k < 10; ++k) {
      const auto before = models.list[1].step.n;
      advance(models);
      CHECK(models.list[1].step.n - before == ratio);
    }
  }
}

TEST_CASE("clock: a vote that falls between two levels cuts what is left", "[time]") {
  Models models;
  std::vector<std::string> log;
  double slow = 1.0;
  double fast = 0.25;
  for (const char* name : {"a", "b"}) models.list.emplace_back().name = name;
  add_logged(models.list[0], &slow, &log);
  models.list[1].plan.add({.name = "force",
                           .stage = Stage::force,
                           .run =
                               [&](const Step& s) {
                                 if (s.t > 0.4) fast = 0.2;
                                 if (s.t > 0.8) fast = 1;  // more is for the next level
                               },
                           .stable_dt = [&] { return fast; }});
  advance(models);
  // 0.25 twice, then ceil(0.5/0.2) = 3 equal ones.
  CHECK(models.list[1].step.n == 5);
  CHECK(models.list[1].step.dt_old == Approx(0.5 / 3).epsilon(1e-12));
  CHECK(models.list[1].step.t == 1.0);
}

TEST_CASE("clock: a step that collapses to nothing stops the run and names who", "[time]") {
  Models models;
  std::vector<std::string> log;
  double dt = 0;
  models.list.emplace_back().name = "main";
  add_logged(models.list[0], &dt, &log);
  try {
    advance(models);
    FAIL("no error");
  } catch (const RunError& e) {
    CHECK(std::string(e.what()).find("model main, main") != std::string::npos);
  }
}
