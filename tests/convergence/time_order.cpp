// Order in time of the whole step, with the real operations of a nonlinear column of water.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "app/simulation.hpp"
#include "sph/sph_state.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

// A column 1 m long, periodic, in which a strong standing wave (a tenth of the speed of sound)
// steepens; XSPH on, viscosity off, so that every term is smooth in time.
const char* standing_wave = R"(gannet: 1
dimension: 2
materials:
  water: {card: water, c0: 10 m/s}
parts:
  column:
    sph: {material: water, spacing: 25 mm}
    fill: {box: {from: [0, 0, 0], to: [1 m, 250 mm, 0]}}
boundaries:
  around: {periodic: {x: [0, 1 m], y: [0, 250 mm]}}
effects:
  xsph: {epsilon: 0.5}
output: {until: 1 s}
)";

/// State at one level, by stable number of the particle: x, v_x, rho.
using State = std::map<std::int64_t, Vec3>;

State take(const Scene& scene, const Step& step) {
  State state;
  const Field& rho = *scene.field("rho");
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    const Index k = i - scene.particles.begin;
    double x = scene.nodes.x[i].x;
    x -= std::floor(x);  // where the particle is in the period
    state[scene.nodes.id[i]] = {x, velocity_at_level(scene.nodes, i, step.dt).x(),
                                *reinterpret_cast<const double*>(rho.at(k))};
  }
  return state;
}

/// The state at 30 ms after n steps whose sizes vary by 30 %.
State state_with(int n) {
  const auto simulation = make_simulation_of_text(standing_wave);
  Scene& scene = simulation->scene;
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    scene.nodes.v[i].x = 1.0 * std::sin(2 * M_PI * scene.nodes.x[i].x);
  }
  double limit = 0;
  State state;
  Plan& plan = simulation->models.list[0].plan;
  plan.add({.name = "chosen step",
            .stage = Stage::force,
            .run = [](const Step&) {},
            .stable_dt = [&limit] { return limit; }});
  plan.add({.name = "take state", .stage = Stage::look, .run = [&](const Step& s) {
              if (s.n == n) state = take(scene, s);
            }});
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += 1 + 0.3 * std::sin(0.7 * k);
  for (int k = 0; k <= n; ++k) {
    limit = 0.03 / sum * (1 + 0.3 * std::sin(0.7 * k));
    advance(simulation->models);
    REQUIRE(simulation->models.list[0].step.dt_old == limit);
  }
  return state;
}

/// Root mean square difference of one component over the largest value.
double difference(const State& a, const State& b, int c) {
  double sum = 0;
  double largest = 0;
  for (const auto& [id, value] : a) {
    double d = value[c] - b.at(id)[c];
    if (c == 0) d -= std::round(d);
    sum += d * d;
    largest = std::max(largest, std::abs(value[c]));
  }
  return std::sqrt(sum / static_cast<double>(a.size())) / largest;
}

}  // namespace

TEST_CASE("whole step: order 2 in x, v and rho with a changing step", "[convergence][time]") {
  const std::vector<int> steps = {40, 80, 160};
  const State finest = state_with(1280);
  std::vector<State> states;
  for (const int n : steps) states.push_back(state_with(n));
  const char* names[] = {"x", "v", "rho"};
  for (int c = 0; c < 3; ++c) {
    for (std::size_t k = 1; k < steps.size(); ++k) {
      const double coarse = difference(states[k - 1], finest, c);
      const double fine = difference(states[k], finest, c);
      const double order = std::log2(coarse / fine);
      WARN(names[c] << ": " << steps[k] << " steps, error " << fine << ", order " << order);
      // 2 in the limit. The pattern of the changing step scatters it.
      CHECK(order > 1.8);
    }
  }
}
