// Energy over many steps where models take steps of their own: bars of coarse and fine elements,
// and a body on a soft and a stiff line.
#include <fmt/format.h>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// What a long run leaves of its energy.
struct Drift {
  double drift = 0;    ///< mean of the last tenth over that of the first, less 1
  double largest = 0;  ///< of the second half over the largest of the first
  double link = 0;     ///< largest size of the entry "link" over that mean
  std::int64_t substeps = 0;
};

double mechanical(const Simulation& s) {
  double sum = 0;
  for (const LedgerEntry& e : s.models.ledger.entries()) {
    if (e.name.starts_with("kinetic") || e.name == "internal") sum += e.value;
  }
  return sum;
}

Drift drift_over(Simulation& s, int steps) {
  Drift d;
  double first = 0;
  double last = 0;
  double largest[2] = {0, 0};
  for (int n = 0; n < steps; ++n) {
    advance(s.models);
    const double e = mechanical(s);
    if (n < steps / 10) first += e / (steps / 10);
    if (n >= steps - steps / 10) last += e / (steps / 10);
    double& most = largest[n < steps / 2 ? 0 : 1];
    most = std::max(most, e);
    d.link = std::max(d.link, std::abs(ledger_sum(s, "link")));
  }
  d.drift = last / first - 1;
  d.largest = largest[1] / largest[0];
  d.link /= first;
  d.substeps = s.models.list.back().step.n / s.models.list.front().step.n;
  return d;
}

/// A free bar of 12 coarse elements of 1 m and 12 fine ones, coarse over fine step `ratio`: smaller
/// by that (size) or as much stiffer a material (stiff). `buffer`: further coarse elements that
/// advance with the fine ones. All waves that the mesh holds run in it.
struct Chain {
  bool stiff = false;
  int ratio = 2;
  int buffer = 2;
  double cfl = 0.9;
};

std::string text_of(const Chain& c) {
  const double m = c.ratio;
  std::string text = "gannet: 1\nparts:\n";
  double x = 0;
  const auto part = [&](const char* name, int n, double h, double EA) {
    text += fmt::format(
        "  {}:\n    cable: {{EA: {:.17g}, mass_per_length: 1, tension_only: no, dt_factor: {}}}\n"
        "    shape: {{line: {{from: [{:.17g}, 0, 0], to: [{:.17g}, 0, 0], elements: {}}}}}\n"
        "    initial_velocity: [\"1e-7*(sin(37.7*x) + cos(5.3*x) + sin(1.1*x*x))\", 0, 0]\n",
        name, EA, c.cfl, x, x + n * h, n);
    x += n * h;
  };
  part("coarse", 12, 1, 1);
  const double seam = x;
  if (c.buffer > 0) part("buffer", c.buffer, 1, 1);
  const double join = x;
  part("fine", 12, c.stiff ? 1 : 1 / m, c.stiff ? m * m : 1);
  text += "ties:\n";
  if (c.buffer > 0) {
    text +=
        fmt::format("  seam: {{nodes: {{nearest: [{}, 0, 0], of: buffer}}, to: coarse}}\n", seam);
  }
  text += fmt::format("  join: {{nodes: {{nearest: [{}, 0, 0], of: fine}}, to: {}}}\n", join,
                      c.buffer > 0 ? "buffer" : "coarse");
  text += fmt::format("models: {{slow: {{parts: coarse}}, fast: {{parts: [{}fine]}}}}\n",
                      c.buffer > 0 ? "buffer, " : "");
  return text + "effects: {guards: off}\noutput: {until: 1e12 s, checkpoint: never}\n";
}

void check_chain(const Chain& c, int steps) {
  const auto s = make_simulation_of_text(text_of(c));
  const Drift d = drift_over(*s, steps);
  fmt::print(
      "{} ratio {} ({} substeps), share {:.2f} of the limit, {} steps: drift {:.2g}, largest "
      "{:.4f}, link {:.2g}\n",
      c.stiff ? "stiff" : "small", c.ratio, d.substeps, c.cfl, steps, d.drift, d.largest, d.link);
  CHECK(d.substeps == c.ratio);
  CHECK(std::abs(d.drift) < 1e-3);
  CHECK(d.largest < 1.02);
}

/// A body on a soft line of a slow model and a stiff one of 24 elements of a fast model. The body
/// has `mass_ratio` times the mass of a node of that line; the soft spring moves it by 0.05 rad a
/// step.
std::string body_text(double mass_ratio, int ratio) {
  const double dt = 0.9;  // of the stiff line: elements of 1 m, EA 1, 1 kg/m
  const double dT = ratio * dt;
  const double M = mass_ratio;
  const double k = M * std::pow(0.05 / dT, 2);
  // One element of the soft line of 10 m: EA = 10 k, a step of dT by its mass.
  const double mu = 10 * k * std::pow(dT / 0.9 / 10, 2) * 0.9999;
  return fmt::format(R"case(gannet: 1
parts:
  plate: {{rigid_surface: {{}}, shape: {{plate: {{size: [0.2, 0.2], elements: [2, 2], centre: [0, 0, 0]}}}}}}
  soft: {{cable: {{EA: {:.17g}, mass_per_length: {:.17g}, tension_only: no}}, shape: {{line: {{from: [-10, 0, 0], to: [0, 0, 0], elements: 1}}}}}}
  stiff:
    cable: {{EA: 1, mass_per_length: 1, tension_only: no}}
    shape: {{line: {{from: [0, 0, 0], to: [24, 0, 0], elements: 24}}}}
    initial_velocity: ["1e-3*sin(pi*x/24)", 0, 0]
bodies: {{body: {{parts: plate, mass: {:.17g}, centre: [0, 0, 0], inertia: [{:.17g}, {:.17g}, {:.17g}, 0, 0, 0], velocity: [1e-3, 0, 0]}}}}
ties:
  a: {{nodes: {{nearest: [0, 0, 0], of: soft}}, to: body}}
  b: {{nodes: {{nearest: [0, 0, 0], of: stiff}}, to: body}}
boundaries:
  left: {{nodes: {{nearest: [-10, 0, 0], of: soft}}, fix: [x, y, z]}}
  right: {{nodes: {{nearest: [24, 0, 0], of: stiff}}, fix: [x, y, z]}}
models: {{slow: {{parts: soft}}, fast: {{parts: [body, stiff]}}}}
output: {{until: 1e12 s, checkpoint: never}}
)case",
                     10 * k, mu, M, M, M, M);
}

void check_body(double mass_ratio, int ratio, int steps) {
  const auto s = make_simulation_of_text(body_text(mass_ratio, ratio));
  const Drift d = drift_over(*s, steps);
  fmt::print(
      "body of {:g} nodes, ratio {} ({} substeps), {} steps: drift {:.2g}, largest {:.4f}, "
      "link {:.2g}\n",
      mass_ratio, ratio, d.substeps, steps, d.drift, d.largest, d.link);
  CHECK(d.substeps == ratio);
  CHECK(std::abs(d.drift) < 1e-3);
  CHECK(d.largest < 1.02);
}

}  // namespace

TEST_CASE("subcycling: coarse and fine elements keep their energy", "[physics]") {
  for (const bool stiff : {false, true}) {
    for (const int ratio : {2, 4, 16}) {
      for (const double cfl : {0.5, 0.9}) check_chain({stiff, ratio, 2, cfl}, 20000);
    }
  }
}

TEST_CASE("subcycling: without coarse elements among the fast ones energy grows", "[physics]") {
  const auto s = make_simulation_of_text(text_of({false, 4, 0, 0.92}));
  const Drift d = drift_over(*s, 500);
  fmt::print("no buffer, ratio 4: energy grows by {:.3g}\n", d.drift);
  CHECK(d.drift > 10);
}

TEST_CASE("subcycling: a body on a soft and a stiff line keeps its energy", "[physics]") {
  for (const int ratio : {2, 8, 28}) {
    for (const double mass : {10., 1000., 45000.}) check_body(mass, ratio, 5000);
  }
}

TEST_CASE("subcycling: 100,000 coarse steps at ratios of 1 to 1,000", "[.][physics_long]") {
  for (const bool stiff : {false, true}) {
    for (const int ratio : {1, 2, 3, 8, 28, 100}) check_chain({stiff, ratio, 2, 0.9}, 100000);
  }
  check_chain({true, 1000, 2, 0.9}, 100000);
  for (const int ratio : {2, 28, 64}) {
    for (const double mass : {10., 45000.}) check_body(mass, ratio, 100000);
  }
}

TEST_CASE("subcycling: a tie across models without a buffer is warned of", "[physics]") {
  const auto warnings_of = [](const Chain& c) {
    const auto s = make_simulation_of_text(text_of(c));
    advance(s->models);
    std::string all;
    for (const std::string& warning : s->scene.warnings) all += warning + "\n";
    return all;
  };
  for (const bool stiff : {false, true}) {
    const std::string none = warnings_of({.stiff = stiff, .ratio = 4, .buffer = 0});
    CHECK_THAT(none, Catch::Contains("'join' ties 'fine' of 'fast' to 'coarse' of the slower "
                                     "'slow' with no layer"));
    const std::string one = warnings_of({.stiff = stiff, .ratio = 4, .buffer = 1});
    CHECK_THAT(one, Catch::Contains("'seam' ties 'buffer' of 'fast' to 'coarse' of the slower "
                                    "'slow' with one layer"));
    const std::string two = warnings_of({.stiff = stiff, .ratio = 4, .buffer = 2});
    CHECK_THAT(two, !Catch::Contains("ties: "));
  }
}
