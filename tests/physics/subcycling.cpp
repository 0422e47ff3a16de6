// Energy over many steps where models take steps of their own: bars of coarse and fine elements,
// and a body on a soft and a stiff line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "running.hpp"
#include "tied_bars.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// What a long run leaves of its energy. At single levels it swings by tenths, as what the impulses
/// move is not in it; means over tenths of the run do not.
struct Drift {
  double drift = 0;  ///< mean of the last tenth over that of the first, less 1
  double most = 0;   ///< largest difference of a tenth's mean from that of the first, over that
  double link = 0;   ///< largest size of the entry "link" over that mean
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
  std::array<double, 10> mean{};
  for (int n = 0; n < steps; ++n) {
    advance(s.models);
    mean[static_cast<std::size_t>(10LL * n / steps)] += mechanical(s) / (0.1 * steps);
    d.link = std::max(d.link, std::abs(ledger_sum(s, "link")));
  }
  for (const double e : mean) d.most = std::max(d.most, std::abs(e / mean.front() - 1));
  d.drift = mean.back() / mean.front() - 1;
  d.link /= mean.front();
  d.substeps = s.models.list.back().step.n / s.models.list.front().step.n;
  return d;
}

/// Places of the bar's nodes from left to right; what ties join counts once.
Eigen::VectorXd places_of_bar(const Scene& scene) {
  std::vector<double> x;
  for (const Part& part : scene.parts) {
    for (Index i = part.nodes.begin + (x.empty() ? 0 : 1); i < part.nodes.end; ++i) {
      x.push_back(scene.nodes.x[static_cast<std::size_t>(i)].x);
    }
  }
  return Eigen::Map<Eigen::VectorXd>(x.data(), std::ssize(x));
}

void check_chain(const Chain& c, int steps) {
  const auto s = make_simulation_of_text(text_of(c));
  const Drift d = drift_over(*s, steps);
  fmt::print(
      "{} ratio {} ({} substeps), share {:.2f} of the limit, {} steps: drift {:.2g}, most "
      "{:.2g}, link {:.2g}\n",
      c.stiff ? "stiff" : "small", c.ratio, d.substeps, c.cfl, steps, d.drift, d.most, d.link);
  CHECK(d.substeps == c.ratio);
  CHECK(d.most < 1e-3);
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
      "body of {:g} nodes, ratio {} ({} substeps), {} steps: drift {:.2g}, most {:.2g}, "
      "link {:.2g}\n",
      mass_ratio, ratio, d.substeps, steps, d.drift, d.most, d.link);
  CHECK(d.substeps == ratio);
  CHECK(d.most < 1e-3);
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

TEST_CASE("subcycling: bars move by the matrix of the impulse scheme", "[physics]") {
  for (const bool stiff : {false, true}) {
    const Chain c{stiff, 7, 3, 0.85};
    const auto s = make_simulation_of_text(text_of(c));
    const Eigen::VectorXd x = places_of_bar(s->scene);
    const Eigen::Index n = x.size();
    Eigen::MatrixXd y = Eigen::VectorXd::Zero(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) y(n + i) = start_velocity(x[i]);
    const Eigen::MatrixXd G = coarse_step(c);
    REQUIRE(G.cols() == 2 * n);
    for (int step = 0; step < 20; ++step) {
      advance(s->models);
      y = times(G, y);
    }
    const Eigen::VectorXd u = places_of_bar(s->scene) - x;
    const double error = (y.topRows(n) - u).norm() / u.norm();
    fmt::print("bar {} by its matrix: {:.2g}\n", stiff ? "stiff" : "small", error);
    CHECK(error < 1e-9);
  }
}

/// The fastest growth among `samples` steps between 0.8 and 0.9 of the limit.
double worst_growth(Chain c, int samples) {
  double most = 0;
  for (int i = 0; i < samples; ++i) {
    c.cfl = 0.8 + 0.1 * i / (samples - 1);
    most = std::max(most, growth_of(c));
  }
  return most;
}

TEST_CASE("subcycling: what layers between the meshes are worth", "[.][physics_long]") {
  for (const bool stiff : {false, true}) {
    for (const int ratio : {2, 3, 8, 28}) {
      double growth[5];
      for (int layers = 0; layers < 5; ++layers) {
        growth[layers] = worst_growth({stiff, ratio, layers}, 2000);
      }
      fmt::print("{} ratio {}: grows a coarse step by {:.1e} at most with 0 to 4 layers\n",
                 stiff ? "stiff" : "small", ratio, fmt::join(growth, ", "));
      CHECK(growth[2] < 1e-3);
      CHECK(growth[3] < 1e-5);
      CHECK(growth[4] < 1e-6);
    }
  }
}

TEST_CASE("subcycling: a body on a soft and a stiff line keeps its energy", "[physics]") {
  for (const int ratio : {2, 8, 28}) {
    for (const double mass : {10., 1000., 45000.}) check_body(mass, ratio, 5000);
  }
}

TEST_CASE("subcycling: 100,000 coarse steps at ratios of 1 to 1,000", "[.][physics_long]") {
  for (const bool stiff : {false, true}) {
    for (const int ratio : {1, 2, 3, 8, 28, 100}) check_chain({stiff, ratio, 4, 0.9}, 100000);
  }
  check_chain({true, 1000, 4, 0.9}, 100000);
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
    CHECK_THAT(two, Catch::Contains("'slow' with two layers"));
    const std::string three = warnings_of({.stiff = stiff, .ratio = 4, .buffer = 3});
    CHECK_THAT(three, !Catch::Contains("ties: "));
  }
}
