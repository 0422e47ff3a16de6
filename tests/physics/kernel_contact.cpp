// Kernel contact: momentum, energy, and the impulse of the penalty contact that it stands for.
#include <algorithm>

#include "body/rigid_body.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A tilted panel of shells, fast enough to yield, or a rigid one, meets a block of water in free
/// flight; nodes are as far apart as particles.
std::string case_of_flight(bool rigid) {
  return fmt::format(
      R"case(gannet: 1
materials:
  water: {{density: 1000, c0: 200 m/s}}
  skin: {{density: 2700, young: 70 GPa, poisson: 0.3, yield_stress: 50 MPa, hardening_modulus: 300 MPa}}
parts:
  block:
    sph: {{material: water, spacing: 20 mm}}
    fill: {{box: {{from: [0, 0, -0.16 m], to: [0.16 m, 0.16 m, 0]}}}}
    initial_velocity: [0.5 m/s, -1 m/s, 2 m/s]
  panel:
    shell: {{material: skin, thickness: 2 mm, points: 5}}
    shape: {{plate: {{size: [240 mm, 240 mm], elements: [12, 12], tilt: 8 deg, lowest_point: [-20 mm, 0.1 m, 42 mm]}}}}
{}contacts: {{slam: {{between: [block, panel], type: kernel}}}}
effects:
  viscosity: {{type: monaghan, alpha: 0.1}}
output: {{until: 1 s, checkpoint: never}}
)case",
      rigid ? "bodies: {panel: {parts: panel, velocity: [2 m/s, 1 m/s, -20 m/s]}}\n"
            : "    initial_velocity: [2 m/s, 1 m/s, -20 m/s]\n");
}

/// Water that falls at 2 m/s onto a fixed line of 1.28 m.
struct Fall {
  double width = 0, height = 0;  ///< of the water [m]
  double tilt = 0;               ///< of the line [rad]
  double until = 0;              ///< [s]
};

/// The impulse on the line, per metre. spacing of the particles 5 mm; `elements` of the line.
double impulse(const Fall& fall, int elements, const std::string& contact) {
  const auto s = make_simulation_of_text(fmt::format(
      R"case(gannet: 1
dimension: 2
let: {{dx: 5 mm, W: {}, H: {}, tilt: {}, l: 0.64}}
materials: {{water: {{density: 1000, c0: 40 m/s}}}}
parts:
  block:
    sph: {{material: water, spacing: dx}}
    fill: {{box: {{from: ["-W/2", "3*dx", 0], to: ["W/2", "H + 3*dx", 0]}}}}
    initial_velocity: [0, -2, 0]
  floor:   # below the lower left corner of the water, whatever its tilt
    rigid_surface: {{}}
    shape: {{line: {{from: ["-l*cos(tilt) - W/2", "l*sin(tilt)", 0], to: ["l*cos(tilt) - W/2", "-l*sin(tilt)", 0], elements: {}}}}}
contacts: {{hit: {{between: [block, floor], {}}}}}
effects: {{viscosity: {{type: monaghan, alpha: 0.1}}}}
output: {{until: 1 s, checkpoint: never}}
)case",
      fall.width, fall.height, fall.tilt, elements, contact));
  double sum = 0;
  double last = 0;
  run_until(*s, fall.until, [&] {
    const double now = std::hypot(measured(s->scene, "contact.hit.force", 0),
                                  measured(s->scene, "contact.hit.force", 1));
    sum += 0.5 * (last + now) * s->models.list.front().step.dt_old;
    last = now;
  });
  CHECK(energy_error(*s) < 0.01);
  return sum;
}

}  // namespace

TEST_CASE("kernel contact: momentum is kept to rounding over a violent impact", "[physics]") {
  for (const bool rigid : {false, true}) {
    const auto s = make_simulation_of_text(case_of_flight(rigid));
    advance(s->models);
    const auto angular = [&] {
      Vec3 sum = angular_momentum(s->scene).sum + spin_of_nodes(s->scene);
      if (!rigid) return sum;
      for (const RigidBody& body : s->scene.store.get<RigidBodies>().list) {
        sum = angular_momentum(s->scene).sum + body.L;
      }
      return sum;
    };
    const Total p0 = linear_momentum(s->scene);
    const Vec3 L0 = angular();
    const double L_scale = angular_momentum(s->scene).scale;
    const double v0 = s->scene.nodes.v[0].z;
    double worst_p = 0;
    double worst_L = 0;
    double most = 0;
    run_until(*s, 0.012, [&] {
      worst_p = std::max(worst_p, (linear_momentum(s->scene).sum - p0.sum).norm() / p0.scale);
      worst_L = std::max(worst_L, (angular() - L0).norm() / L_scale);
      most = std::max(most, ledger_sum(*s, "contact"));
    });
    fmt::print(
        "{} panel: momentum {:.1e}, angular {:.1e}, energy {:.1e}, largest energy of contact "
        "{:.3g} J, a corner went from {:.1f} to {:.1f} m/s\n",
        rigid ? "rigid" : "soft", worst_p, worst_L, energy_error(*s), most, v0,
        s->scene.nodes.v[0].z);
    CHECK(most > 1);
    CHECK(worst_p < 1e-12);
    CHECK(worst_L < 1e-9);
    CHECK(energy_error(*s) < 0.01);
  }
}

// A potential is elastic: a block that falls flat, whose impulse is that of a blow, is thrown back
// more.
TEST_CASE("kernel contact: the impulse of water is that of penalty contact", "[physics]") {
  struct Compared {
    const char* what;
    Fall fall;
    double equal;        ///< how near to a penalty that stands off by 1.8 spacings
    double unless_said;  ///< to one that stands off as it does unless said, half a spacing
  };
  const double degree = 3.14159265358979 / 180;
  for (const Compared& c :
       {Compared{"jet", {.width = 0.08, .height = 0.32, .tilt = 0, .until = 0.18}, 0.02, 0.03},
        Compared{"slope of 15 deg", {0.32, 0.16, 15 * degree, 0.1}, 0.02, 0.03},
        Compared{"slope of 30 deg", {0.32, 0.16, 30 * degree, 0.1}, 0.025, 0.05},
        Compared{"flat", {0.32, 0.16, 0, 0.1}, 0.1, 0.1}}) {
    const double equal = impulse(c.fall, 256, "thickness: \"1.8*dx\"");
    const double unless_said = impulse(c.fall, 256, "friction: 0");
    for (const int elements : {256, 512}) {  // of 5 mm, as the particles, and of half of that
      const double kernel = impulse(c.fall, elements, "type: kernel");
      fmt::print(
          "{}, elements of {:.3g} mm: {:.2f} N s, {:.4f} of penalty contact that stands off "
          "as far, {:.4f} of one at half a spacing\n",
          c.what, 1280.0 / elements, kernel, kernel / equal, kernel / unless_said);
      CHECK(kernel == Approx(equal).epsilon(c.equal));
      CHECK(kernel == Approx(unless_said).epsilon(c.unless_said));
    }
  }
}

TEST_CASE("kernel contact: it goes on across a periodic border", "[physics]") {
  const auto impulse_at = [](double at) {
    const auto s = make_simulation_of_text(fmt::format(
        R"case(gannet: 1
dimension: 2
let: {{s: {}}}
materials: {{water: {{density: 1000, c0: 40 m/s}}}}
parts:
  block:
    sph: {{material: water, spacing: 0.015625}}
    fill: {{box: {{from: [0, 0.03125, 0], to: [1, 0.15625, 0]}}}}
    initial_velocity: [0.5, -1, 0]
  plate: {{rigid_surface: {{mass_per_area: 100 kg/m^2}}, shape: {{line: {{from: ["s - 0.125", 0, 0], to: ["s + 0.125", 0, 0], elements: 16}}}}}}
bodies: {{plate: {{parts: plate}}}}
boundaries: {{sides: {{periodic: {{x: [0, 1 m]}}}}}}
contacts: {{hit: {{between: [block, plate], type: kernel}}}}
output: {{until: 1 s, checkpoint: never}}
)case",
        at));
    run_until(*s, 0.05, [] {});
    return Vec3(measured(s->scene, "body.plate.velocity", 0),
                measured(s->scene, "body.plate.velocity", 1),
                measured(s->scene, "body.plate.angular_velocity", 0));
  };
  const Vec3 inside = impulse_at(0.5);
  CHECK(inside.y() < -0.2);
  CHECK((impulse_at(1) - inside).norm() < 1e-9);
  CHECK((impulse_at(-3) - inside).norm() < 1e-9);
}

// XSPH moves particles beside their own velocities: what the potential holds is then not what the
// motion has paid.
TEST_CASE("kernel contact: the energy closes where XSPH moves the particles", "[physics]") {
  const auto s = make_simulation_of_text(R"case(gannet: 1
dimension: 2
let: {dx: 5 mm}
materials: {water: {density: 1000, c0: 40 m/s}}
parts:
  block:
    sph: {material: water, spacing: dx}
    fill: {box: {from: [-80 mm, "2*dx", 0], to: [80 mm, "0.16 + 2*dx", 0]}}
    initial_velocity: [0, -2, 0]
  floor: {rigid_surface: {}, shape: {line: {from: [-0.64, 0, 0], to: [0.64, 0, 0], elements: 256}}}
contacts: {hit: {between: [block, floor], type: kernel}}
effects: {viscosity: {type: monaghan, alpha: 0.1}, xsph: {epsilon: 0.5}}
output: {until: 1 s, checkpoint: never}
)case");
  double worst = 0;
  run_until(*s, 0.1, [&] { worst = std::max(worst, energy_error(*s)); });
  fmt::print("with XSPH: energy {:.1e}\n", worst);
  CHECK(worst < 2e-3);
}

TEST_CASE("kernel contact: the energy closes where the surface is torn", "[physics]") {
  const auto s = make_simulation_of_text(R"case(gannet: 1
let: {dx: 8 mm}
materials:
  water: {card: water, c0: 600 m/s}
  foil:
    {density: 2700, young: 70 GPa, poisson: 0.3, yield_stress: 50 MPa, hardening_modulus: 100 MPa,
     failure: {plastic_strain: 0.1}}
parts:
  block:
    sph: {material: water, spacing: dx}
    fill: {box: {from: [-40 mm, -40 mm, 16 mm], to: [40 mm, 40 mm, 64 mm]}}
    initial_velocity: [0, 0, -60 m/s]
  panel:
    shell: {material: foil, thickness: 0.3 mm}
    shape: {plate: {size: [120 mm, 120 mm], elements: [15, 15]}}
boundaries: {frame: {nodes: {edge_of: panel}, fix: [x, y, z, rx, ry, rz]}}
contacts: {slam: {between: [block, panel], type: kernel}}
effects: {viscosity: {alpha: 0.1}}
output: {until: 1 s, checkpoint: never}
)case");
  double worst = 0;
  double most = 0;
  run_until(*s, 1.6e-3, [&] {
    worst = std::max(worst, energy_error(*s));
    most = std::max(most, ledger_sum(*s, "contact"));
  });
  const double left = measured(s->scene, "shell.panel.eroded");
  fmt::print("torn: {:.0f} elements left, energy {:.1e}, largest energy of contact {:.3g} J\n",
             left, worst, most);
  CHECK(left > 5);
  CHECK(worst < 5e-5);
}

namespace {

/// A tank of water on a plate, its lowest row of particles that far above the nodes.
std::string on_plate(const std::string& height) {
  return R"case(gannet: 1
dimension: 2
let: {dx: 5 mm, z: )case" +
         height + R"case(}
materials: {water: {density: 1000, c0: 40 m/s}}
parts:
  block:
    sph: {material: water, spacing: dx}
    fill: {box: {from: [-50 mm, "z - dx/2", 0], to: [50 mm, "z + 9.5*dx", 0]}}
  plate: {rigid_surface: {}, shape: {line: {from: [-0.1, 0, 0], to: [0.1, 0, 0], elements: 40}}}
contacts: {bed: {between: [block, plate], type: kernel}}
output: {until: 1 s, checkpoint: never}
)case";
}

}  // namespace

TEST_CASE("kernel contact: water that starts within reach is told of", "[physics]") {
  const auto flush = make_simulation_of_text(on_plate("dx/2"));
  const auto warned = [](const Simulation& s) {
    return std::count_if(s.scene.warnings.begin(), s.scene.warnings.end(), [](const auto& w) {
      return w.find("contacts.bed: ") != std::string::npos;
    });
  };
  CHECK(warned(*flush) == 1);
  for (const std::string& w : flush->scene.warnings) fmt::print("{}\n", w);
  CHECK(measured(flush->scene, "contact.bed.overlaps") == 40);  // two rows of 20
  CHECK(measured(flush->scene, "contact.bed.overlap_depth") == Approx(1.3 * 5e-3).epsilon(0.05));
  double fastest = 0;
  run_until(*flush, 2e-3, [&] {
    for (const Line& v : flush->scene.nodes.v) fastest = std::max(fastest, xyz(v).norm());
  });
  fmt::print("flush: the fastest particle reaches {:.3g} m/s\n", fastest);
  CHECK(fastest > 10);  // this is what it is told of
  const auto off = make_simulation_of_text(on_plate("1.8*dx"));
  CHECK(warned(*off) == 0);
  CHECK(measured(off->scene, "contact.bed.overlaps") == 0);
  fastest = 0;
  run_until(*off, 2e-3, [&] {
    for (const Line& v : off->scene.nodes.v) fastest = std::max(fastest, xyz(v).norm());
  });
  fmt::print("1.8 dx off: {:.3g} m/s\n", fastest);
  CHECK(fastest < 2);
}
