// Parts that are rigid for a time: no strain before, momenta and energy over the switch and back.
#include "body/rigid_phase.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// What tumbles.
struct Piece {
  const char* name;
  const char* made;  ///< of what
  const char* shape;
  bool plane = false;
};

const char* const plate_shape =
    "plate: {size: [0.3, 0.2], elements: [9, 6], centre: [0.1, 0.2, 0.3], tilt: 20 deg";
const char* const block_shape =
    "block: {from: [0.1, 0.2, 0.3], to: [0.2, 0.27, 0.35], elements: [3, 2, 2]";

const std::vector<Piece> pieces = {
    {"plate", "shell: {material: skin, thickness: 5 mm", plate_shape},
    {"fully integrated plate",
     "shell: {material: skin, thickness: 5 mm, formulation: fully_integrated", plate_shape},
    {"triangles", "shell: {material: skin, thickness: 5 mm",
     "plate: {size: [0.3, 0.2], elements: [5, 3], centre: [0.1, 0.2, 0.3], tilt: 20 deg, "
     "triangles: yes"},
    {"one-point block", "solid: {material: skin", block_shape},
    {"eight-point block", "solid: {material: skin, formulation: eight_points", block_shape},
    {"tetrahedra", "solid: {material: skin, formulation: tetrahedra", block_shape},
    {"plane strain", "solid: {material: skin",
     "mapped: {corners: [[0.1, 0.2, 0], [0.2, 0.23, 0], [0.19, 0.3, 0], [0.1, 0.26, 0]], elements: "
     "[3, 2]",
     true},
    {"eight points in plane strain", "solid: {material: skin, formulation: eight_points",
     "mapped: {corners: [[0.1, 0.2, 0], [0.2, 0.23, 0], [0.19, 0.3, 0], [0.1, 0.26, 0]], elements: "
     "[3, 2]",
     true}};

/// It, in free flight.
std::string tumbling(const Piece& piece, const std::string& rigid) {
  return fmt::format(R"case(gannet: 1
{}materials: {{skin: {{density: 2700, young: 70 GPa, poisson: 0.3}}}}
parts:
  piece:
    {}}}
    shape: {{{}}}}}
bodies: {{piece: {{parts: piece, {}, rigid: {}}}}}
effects: {{guards: off}}
output: {{until: 1 s, checkpoint: never}}
)case",
                     piece.plane ? "dimension: 2\n" : "", piece.made, piece.shape,
                     piece.plane ? "velocity: [3, -2, 0], angular_velocity: [0, 0, -500]"
                                 : "velocity: [3, -2, 5], angular_velocity: [200, 300, -400]",
                     rigid);
}

/// About the origin, of velocities at n-1/2: of nodes with rotations too, and of parts that are
/// rigid that of the body, from which that of the chords which nodes walk along differs by (omega
/// dt)^2.
Vec3 angular(Scene& scene) {
  Vec3 sum = angular_momentum(scene).sum;
  for (Index i = scene.nodes.rotating.begin; i < scene.nodes.rotating.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    sum += scene.nodes.torque[k].w * xyz(scene.nodes.omega[k]);
  }
  for (const RigidPhase& p : scene.store.get<RigidPhases>().list) {
    if (!p.is_rigid()) continue;
    sum += Vec3(p.L[0], p.L[1], p.L[2]) -
           spin_about(scene.nodes, p.nodes, mass_centre(scene.nodes, p.nodes));
  }
  return sum;
}

/// Blocks of gum that meet at 10 m/s in free flight, the upper one rigid at first. It has a lid
/// that lies on it from the start.
std::string meeting(const std::string& rigid, bool lid = false) {
  return fmt::format(
      R"case(gannet: 1
materials: {{gum: {{density: 1100, young: 20 MPa, poisson: 0.4}}}}
parts:
  low:
    solid: {{material: gum}}
    shape: {{block: {{from: [0, 0, 0], to: [0.2, 0.2, 0.05], elements: [8, 8, 2]}}}}
  high:
    solid: {{material: gum}}
    shape: {{block: {{from: [0.03, 0.02, 0.06], to: [0.15, 0.14, 0.12], elements: [6, 6, 3]}}}}
{}bodies: {{high: {{parts: {}, velocity: [0, 0, -10], angular_velocity: [3, 5, 40], rigid: {}}}}}
contacts:
  hit: {{between: [low, high]}}
{}output: {{until: 1 s, checkpoint: never}}
)case",
      lid ? "  lid:\n    solid: {material: gum}\n    shape: {block: {from: [0.04, 0.04, "
            "0.122], to: [0.14, 0.13, 0.14], elements: [4, 4, 1]}}\n"
          : "",
      lid ? "[high, lid]" : "high", rigid,
      lid ? "  seam: {between: [high, lid], thickness: 3 mm}\n" : "");
}

/// A drop of water that hits a plate of a faster model, or of its own.
std::string struck(const std::string& rigid, bool models) {
  return fmt::format(R"case(gannet: 1
materials:
  water: {{density: 1000, c0: 30 m/s}}
  skin: {{density: 2700, young: 1 GPa, poisson: 0.3}}
parts:
  drop:
    sph: {{material: water, spacing: 20 mm}}
    fill: {{box: {{from: [-0.06, -0.06, 0.03], to: [0.06, 0.06, 0.15]}}}}
    initial_velocity: [0.2, 0.1, -3]
  plate:
    shell: {{material: skin, thickness: 5 mm}}
    shape: {{plate: {{size: [0.2, 0.2], elements: [8, 8], centre: [0.03, 0.01, 0]}}}}
bodies: {{plate: {{parts: plate{}}}}}
{}contacts: {{hit: {{between: [drop, plate]}}}}
effects: {{viscosity: {{alpha: 0.1}}}}
output: {{until: 1 s, checkpoint: never}}
)case",
                     rigid.empty() ? "" : ", rigid: " + rigid,
                     models ? "models: {water: {parts: drop}, skin: {parts: plate}}\n" : "");
}

}  // namespace

TEST_CASE("rigid for a time: free flight keeps momenta and energy over switches", "[physics]") {
  const Piece piece = GENERATE(from_range(pieces));
  const auto s = make_simulation_of_text(tumbling(piece, "{until: 4 ms, again_from: 8 ms}"));
  advance(s->models);
  const Vec3 p0 = linear_momentum(s->scene).sum;
  const Vec3 L0 = angular(s->scene);
  const double scale = angular_momentum(s->scene).scale;
  const double kinetic = ledger_sum(*s, "kinetic");
  double worst_p = 0;
  double worst_L = 0;
  double strained = 0;   // internal energy while rigid at first
  double vibrating = 0;  // largest internal energy once released
  double jump = 0;       // of the kinetic energy in the step of release
  double last = kinetic;
  bool was_rigid = true;
  int switches = 0;
  run_until(*s, 0.012, [&] {
    const bool rigid = measured(s->scene, "body.piece.rigid") == 1;
    const double now = ledger_sum(*s, "kinetic");
    const double internal = std::abs(ledger_sum(*s, "internal"));
    if (rigid != was_rigid) {
      ++switches;
      if (!rigid) jump = std::abs(now - last) / kinetic;
    }
    if (switches == 0) strained = std::max(strained, internal);
    if (switches == 1) vibrating = std::max(vibrating, internal);
    was_rigid = rigid;
    last = now;
    worst_p = std::max(worst_p, (linear_momentum(s->scene).sum - p0).norm() / p0.norm());
    worst_L = std::max(worst_L, (angular(s->scene) - L0).norm() / scale);
  });
  fmt::print(
      "tumbling {}: momentum {:.1e}, angular {:.1e}, internal energy {:.1e} while rigid and "
      "{:.1e} after, of {:.3g} J; kinetic energy jumps by {:.1e} at release; energy error {:.1e}, "
      "locking {:.2e} J\n",
      piece.name, worst_p, worst_L, strained, vibrating, kinetic, jump, energy_error(*s),
      ledger_sum(*s, "locking"));
  CHECK(switches == 2);
  CHECK(worst_p < 1e-12);
  CHECK(worst_L < 1e-12);
  CHECK(strained < 1e-15 * kinetic);
  CHECK(vibrating > 1e-6 * kinetic);
  CHECK(jump < 1e-5);  // (omega dt)^2 of the chords
  CHECK(energy_error(*s) < 1e-3);
}

TEST_CASE("rigid for a time: a block deforms once it is touched", "[physics]") {
  const auto s = make_simulation_of_text(meeting("until_contact"));
  advance(s->models);
  const Vec3 p0 = linear_momentum(s->scene).sum;
  const Vec3 L0 = angular(s->scene);
  const double scale = angular_momentum(s->scene).scale;
  double released = -1;
  double touched = -1;
  double before = 0;
  double worst_p = 0;
  double worst_L = 0;
  double internal = 0;
  const auto energy_of_high = [&] {
    double sum = 0;
    for (const LedgerEntry& e : s->models.ledger.entries()) {
      if (e.name == "internal" && e.part == "high") sum += e.value;
    }
    return sum;
  };
  run_until(*s, 4e-3, [&] {
    if (touched < 0 && measured(s->scene, "contact.hit.active") > 0) touched = time_of(*s);
    if (released < 0 && measured(s->scene, "body.high.rigid") == 0) released = time_of(*s);
    if (released < 0) before = std::max(before, std::abs(energy_of_high()));
    internal = std::max(internal, energy_of_high());
    worst_p = std::max(worst_p, (linear_momentum(s->scene).sum - p0).norm() / p0.norm());
    worst_L = std::max(worst_L, (angular(s->scene) - L0).norm() / scale);
  });
  fmt::print(
      "block: touched at {:.4g} ms, released at {:.4g} ms, internal energy {:.1e} J before and "
      "{:.3g} J after; momentum {:.1e}, angular {:.1e}, energy error {:.1e}\n",
      1e3 * touched, 1e3 * released, before, internal, worst_p, worst_L, energy_error(*s));
  CHECK(released > 0);
  CHECK(released == touched);
  CHECK(before < 1e-12 * internal);
  CHECK(internal > 1);
  CHECK(worst_p < 1e-12);
  CHECK(worst_L < 1e-12);
  CHECK(energy_error(*s) < 0.01);
}

TEST_CASE("rigid for a time: contact of its parts with each other sets nothing free", "[physics]") {
  const auto s = make_simulation_of_text(meeting("until_contact", true));
  advance(s->models);
  double leaning = 0;  // longest time with contact of its parts, while nothing else touches them
  double touched = -1;
  double released = -1;
  run_until(*s, 2e-3, [&] {
    if (touched < 0 && measured(s->scene, "contact.hit.active") > 0) touched = time_of(*s);
    if (released < 0 && measured(s->scene, "body.high.rigid") == 0) released = time_of(*s);
    if (touched < 0 && measured(s->scene, "contact.seam.active") > 0) leaning = time_of(*s);
  });
  fmt::print(
      "lid: leans on the block up to {:.4g} ms, touched at {:.4g} ms, released at {:.4g} ms\n",
      1e3 * leaning, 1e3 * touched, 1e3 * released);
  CHECK(leaning > 0.5e-3);
  CHECK(touched > leaning);
  CHECK(released == touched);
}

TEST_CASE("rigid for a time: touch after the time of the second phase sets nothing free",
          "[physics]") {
  const auto s = make_simulation_of_text(meeting("{until_contact: yes, again_from: 0.5 ms}"));
  advance(s->models);
  double touched = -1;
  bool rigid = true;
  double strained = 0;
  run_until(*s, 2e-3, [&] {
    if (touched < 0 && measured(s->scene, "contact.hit.active") > 0) touched = time_of(*s);
    rigid = rigid && measured(s->scene, "body.high.rigid") == 1;
    for (const LedgerEntry& e : s->models.ledger.entries()) {
      if (e.name != "internal" || e.part != "high") continue;
      strained = std::max(strained, std::abs(e.value));
    }
  });
  fmt::print("late touch: at {:.4g} ms, internal energy {:.1e} J of {:.3g} J\n", 1e3 * touched,
             strained, ledger_sum(*s, "internal"));
  CHECK(touched > 0.5e-3);
  CHECK(rigid);
  CHECK(strained < 1e-12 * ledger_sum(*s, "internal"));
}

namespace {

/// What a run of the plate that a drop strikes leaves.
struct Struck {
  double momentum = 0;  ///< worst error, over that of the drop
  double worst = 0;     ///< imbalance of energy at the levels of the water [J]
  double end = 0;       ///< and at the last
  double rest = 0;      ///< change from a level to the next, but for what leapfrog and link leave
  double level = 0;     ///< the largest that the link leaves
  double kinetic = 0;
  double height = 0;  ///< of the plate at the end [m]
  double ratio = 0;   ///< steps of the plate to one of the water
};

/// Sum of f^2 dt^2/(8 m): what the kinetic energy at a level has beyond the works up to it, which
/// are measured along the path.
double beyond_path(const Nodes& nodes, const Range& range, const Step& step) {
  double sum = 0;
  for (Index i = range.begin; i < range.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    sum += xyz(nodes.f[k]).squaredNorm() * nodes.v[k].w;
  }
  return 0.125 * step.dt_old * step.dt_old * sum;
}

/// Of an impulse the link measures the work in the middle of the kick, so that f^2 of it comes
/// with the other sign. Nothing but the drop pushes the plate, nor pushes it between levels.
Struck strike(const std::string& rigid, bool models) {
  const auto s = make_simulation_of_text(struck(rigid, models));
  const Scene& scene = s->scene;
  const Range water{scene.particles.begin, scene.particles.end};
  const Range plate = scene.parts[static_cast<std::size_t>(scene.part_number("plate"))].nodes;
  double of_water = 0;
  double of_plate = 0;
  // Steps that do not change leave nothing for good.
  s->models.list.front().plan.add(
      {.name = "water of the test",
       .stage = Stage::look,
       .run = [&](const Step& step) { of_water = beyond_path(scene.nodes, water, step); },
       .stable_dt = [] { return 150e-6; }});
  const auto look_at_plate = [&](const Step& step) {
    if (step.coincides) of_plate = beyond_path(scene.nodes, plate, step);
  };
  s->models.list.back().plan.add(
      {.name = "plate of the test", .stage = Stage::look, .run = look_at_plate, .stable_dt = [] {
         return 25e-6;
       }});
  advance(s->models);
  const Vec3 p0 = linear_momentum(scene).sum;
  Struck r;
  double last = 0;
  run_until(*s, 0.05, [&] {
    r.end = s->scene.store.get<GuardState>().balance.imbalance;
    r.worst = std::max(r.worst, std::abs(r.end));
    const double rest = r.end - of_water + (models ? of_plate : -of_plate);
    r.rest = std::max(r.rest, std::abs(rest - last));
    last = rest;
    r.level = std::max(r.level, of_plate);
    r.momentum = std::max(r.momentum, (linear_momentum(scene).sum - p0).norm() / p0.norm());
  });
  r.kinetic = ledger_sum(*s, "kinetic");
  r.height = measured(scene, "body.plate.position", 2);
  r.ratio = static_cast<double>(s->models.list.back().step.n) /
            static_cast<double>(s->models.list.front().step.n);
  fmt::print(
      "struck plate, rigid {}, {} steps to one of the water: momentum {:.1e}, energy off by "
      "{:.1e} J and {:.1e} J at the end, changes by {:.1e} J but for what levels leave ({:.1e} J "
      "at the plate), of {:.3g} J; plate at {:.5g} m\n",
      rigid, r.ratio, r.momentum, r.worst, r.end, r.rest, r.level, r.kinetic, r.height);
  return r;
}

}  // namespace

TEST_CASE("rigid for a time: a slower model pushes", "[physics]") {
  const Struck one = strike("{until: 1 s}", false);
  const Struck two = strike("{until: 1 s}", true);
  const Struck switching = strike("{until: 10.1 ms, again_from: 30 ms}", true);
  CHECK(two.ratio > 4);
  for (const Struck& r : {one, two, switching}) {
    CHECK(r.momentum < 1e-12);
    CHECK(r.worst < 0.01 * r.kinetic);
    CHECK(std::abs(r.end) < 1e-3 * r.kinetic);
  }
  CHECK(one.height < -0.02);
  CHECK(two.height == Approx(one.height).epsilon(0.02));
  // The projection leaves nothing at a level, be it of the size of the impulses.
  CHECK(one.rest < 0.1 * one.level);
  CHECK(two.rest < 0.1 * two.level);
}
