#include <catch2/catch.hpp>
#include <cmath>

#include "base/parallel.hpp"
#include "pool.hpp"
#include "sph/neighbour_lists.hpp"
#include "sph/probe_functions.hpp"

using namespace gannet;
using gannet::test::Pool;

namespace {

const char* materials = "materials: {water: {density: 1000, c0: 30 m/s}}\n";

std::string column(const std::string& more = "", const std::string& sph_keys = "") {
  return std::string(materials) + "parts: {pool: {sph: {material: water, spacing: 0.1" + sph_keys +
         "}, fill: {box: {from: [0, 0, -1], to: [0.6, 0.5, 0]}}" + more + "}}\n";
}

/// A blob of 512 particles that tumbles, with pressure in it.
std::string blob(const std::string& effects) {
  return std::string(materials) +
         "parts: {drop: {sph: {material: water, spacing: 0.1}, "
         "fill: {box: {from: [0, 0, 0], to: [0.8, 0.8, 0.8]}, jitter: 0.1}}}\n" +
         effects;
}

/// Velocities that differ from place to place, some particles approaching, some receding.
void stir(Scene& scene) {
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const Vec3 x = xyz(scene.nodes.x[i]);
    set_xyz(scene.nodes.v[i], {1 + std::sin(9 * x.y()), std::sin(8 * x.z()) - 0.5 * x.x(),
                               std::cos(7 * x.x()) + x.y()});
  }
}

struct Momenta {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
  double linear_scale = 0;
  double angular_scale = 0;
};

/// Momentum and moment of momentum at entry to a step: x at n, v at n-1/2 carried to n by half of
/// the next kick is not known yet, so both are taken at the midpoint x(n) - v dt/2.
Momenta momenta(const Pool& pool) {
  Momenta sum;
  for (Index k = 0; k < pool.scene.particles.size(); ++k) {
    const double m = pool.scene.nodes.x[pool.scene.particles.begin + k].w;
    const Vec3 v = pool.v(k);
    const Vec3 x = pool.x(k) - 0.5 * pool.at().dt_old * v;
    sum.linear += m * v;
    sum.angular += m * x.cross(v);
    sum.linear_scale += m * v.norm();
    sum.angular_scale += m * x.norm() * v.norm();
  }
  return sum;
}

}  // namespace

TEST_CASE("sph: masses fill the box, and a hydrostatic column has p = rho0 g depth", "[sph]") {
  Pool pool(column(", start: hydrostatic"), 3, {0, 0, -10});
  double mass = 0;
  for (const Line& x : pool.scene.nodes.x) mass += x.w;
  CHECK(mass == Approx(300).epsilon(1e-13));
  for (Index k = 0; k < pool.scene.particles.size(); ++k) {
    // B + p loses a digit or two against p near the surface.
    CHECK(pool.sph().p[k] == Approx(-1e4 * pool.x(k).z()).epsilon(1e-11));
  }
  CHECK(pool.sph().h == Approx(0.13));
}

TEST_CASE("sph: a surface that is given counts for the depth", "[sph]") {
  Pool pool(column(", start: hydrostatic, surface: 2 m"), 3, {0, 0, -10});
  for (Index k = 0; k < pool.scene.particles.size(); ++k) {
    CHECK(pool.sph().p[k] == Approx(1e4 * (2 - pool.x(k).z())).epsilon(1e-11));
  }
}

TEST_CASE("sph: velocity and pressure at the start by place", "[sph]") {
  Pool pool(column(", start: hydrostatic, initial_velocity: [\"2*y\", 0, \"-x\"], "
                   "initial_pressure: \"100*x\""),
            3, {0, 0, -10});
  for (Index k = 0; k < pool.scene.particles.size(); ++k) {
    const Vec3 x = pool.x(k);
    const Line& v = pool.scene.nodes.v[static_cast<std::size_t>(pool.scene.particles.begin + k)];
    CHECK((xyz(v) - Vec3(2 * x.y(), 0, -x.x())).norm() < 1e-15);
    CHECK(pool.sph().p[k] == Approx(-1e4 * x.z() + 100 * x.x()).epsilon(1e-9).margin(1e-6));
  }
}

TEST_CASE("sph: c0 auto is ten times the largest expected speed", "[sph]") {
  const auto c0_of = [](const std::string& material, const std::string& more, double g) {
    Pool pool("materials: {water: {density: 1000" + material + "}}\n" +
                  "parts: {pool: {sph: {material: water, spacing: 0.1}, "
                  "fill: {box: {from: [0, 0, 0], to: [0.6, 0.5, 0.8]}}" +
                  more + "}}\n",
              3, {0, 0, -g});
    return pool.sph().c0;
  };
  CHECK(c0_of("", "", 10) == Approx(10 * std::sqrt(2 * 10 * 0.8)).epsilon(1e-12));
  CHECK(c0_of(", c0: auto, expected_speed: 12 m/s", "", 10) == Approx(120).epsilon(1e-12));
  CHECK(c0_of("", ", initial_velocity: [3, 0, 4]", 0) == Approx(50).epsilon(1e-12));
  CHECK(c0_of(", bulk: 0.7 MPa", "", 10) == Approx(70).epsilon(1e-12));  // c0^2 = 7 B/rho0
}

TEST_CASE("sph: mistakes are answered with their place", "[sph]") {
  const std::string two_sizes =
      std::string(materials) +
      "parts:\n"
      "  a: {sph: {material: water, spacing: 0.1}, fill: {box: {from: [0,0,0], to: [1,1,1]}}}\n"
      "  b: {sph: {material: water, spacing: 0.2}, fill: {box: {from: [2,0,0], to: [3,1,1]}}}\n";
  CHECK_THROWS_WITH(Pool(two_sizes),
                    Catch::Contains("pool.yaml:5:") && Catch::Contains("parts.b.sph.spacing") &&
                        Catch::Contains("particles of different size in one pool"));
  const std::string two_waters =
      "materials: {water: {density: 1000, c0: 30}, oil: {density: 900, c0: 30}}\n"
      "parts:\n"
      "  a: {sph: {material: water, spacing: 0.1}, fill: {box: {from: [0,0,0], to: [1,1,1]}}}\n"
      "  b: {sph: {material: oil, spacing: 0.1}, fill: {box: {from: [2,0,0], to: [3,1,1]}}}\n";
  CHECK_THROWS_WITH(Pool(two_waters), Catch::Contains("pool.yaml:5:") &&
                                          Catch::Contains("parts.b.sph.material") &&
                                          Catch::Contains("different mass"));
  CHECK_THROWS_WITH(Pool(column(", start: hydrostatic")), Catch::Contains("needs gravity"));
  CHECK_THROWS_WITH(
      Pool("materials: {water: {density: 1000}}\nparts: {pool: {sph: {material: water, spacing: "
           "0.1}, fill: {box: {from: [0,0,0], to: [1,1,1]}}}}\n"),
      Catch::Contains("c0") && Catch::Contains("auto needs a speed"));
}

TEST_CASE("sph: viscosity and XSPH keep linear and angular momentum of a free drop", "[sph]") {
  Pool pool(blob("effects: {viscosity: {alpha: 0.1, beta: 0.2}, xsph: {epsilon: 0.5}}\n"), 3,
            Vec3::Zero(), stir);
  const Momenta before = momenta(pool);
  pool.run(200);
  const Momenta after = momenta(pool);
  // Sums of rounding over 200 steps and some 10^2 neighbours: measured below 1e-14 of the scale.
  CHECK((after.linear - before.linear).norm() < 1e-12 * before.linear_scale);
  CHECK((after.angular - before.angular).norm() < 1e-12 * before.angular_scale);
  CHECK(pool.sph().n_builds > 3);  // momentum survives sorting too
}

TEST_CASE("sph: kinetic, internal and dissipated energy add up, better with smaller steps",
          "[sph]") {
  const auto imbalance = [](const char* cfl) {
    std::string text =
        blob("effects: {viscosity: {alpha: 0.1, beta: 0.2}, xsph: {epsilon: 0.5}}\n");
    text.insert(text.find("spacing: 0.1") + 12, std::string(", cfl: ") + cfl);
    Pool pool(text, 3, Vec3::Zero(), stir);
    pool.run(1);
    const double start = pool.models.ledger.held();
    while (pool.at().t < 0.05) pool.run(1);
    double dissipated = 0;
    for (const LedgerEntry& e : pool.models.ledger.entries()) {
      if (e.name == "artificial_viscosity") dissipated += e.value;
    }
    CHECK(dissipated > 0.01 * start);
    return std::abs(pool.models.ledger.held() - start) / start;
  };
  const double coarse = imbalance("0.8");
  const double fine = imbalance("0.2");
  CHECK(coarse < 0.01);
  // Order one or better: viscosity works with v(n-1/2), and steps are not the same.
  CHECK(fine < 0.3 * coarse);
}

TEST_CASE("sph: a run cut by a checkpoint has the same bits as an unbroken one", "[sph]") {
  for (const char* effects : {"", "effects: {viscosity: {alpha: 0.1}, xsph: {epsilon: 0.5}}\n"}) {
    const std::string text = blob(effects) + "boundaries: {sides: {periodic: {x: [0, 0.8]}}}\n";
    Pool unbroken(text, 3, {0, 0, -10}, stir);
    unbroken.run(40);
    Pool first(text, 3, {0, 0, -10}, stir);
    first.run(17);
    Pool second(text, 3, {0, 0, -10}, stir);
    test::load(test::save(first.scene), second.scene);
    second.models.list.front().step = first.at();
    for (const auto& rebuild : second.scene.after_restart) rebuild();
    second.run(23);
    CHECK(unbroken.sph().n_builds > 2);
    CHECK(test::save(second.scene) == test::save(unbroken.scene));
  }
}

TEST_CASE("sph: one, two and three threads give the same bits", "[sph]") {
  const std::string text = blob("effects: {viscosity: {alpha: 0.1}, xsph: {epsilon: 0.5}}\n") +
                           "boundaries: {sides: {periodic: {x: [0, 0.8]}}}\n";
  std::vector<test::Saved> results;
  for (const int n : {1, 2, 3}) {
    set_threads(n);
    Pool pool(text, 3, {0, 0, -10}, stir);
    pool.run(30);
    results.push_back(test::save(pool.scene));
  }
  set_threads(0);
  CHECK(results[1] == results[0]);
  CHECK(results[2] == results[0]);
}

TEST_CASE("sph: what a case does not ask for is not in its plan", "[sph]") {
  const auto names = [](Pool& pool) {
    std::string all;
    for (int s = 0; s < n_stages; ++s) {
      for (const Operation& op : pool.plan().at(static_cast<Stage>(s))) all += op.name + "\n";
    }
    return all;
  };
  Pool plain(column());
  CHECK_THAT(names(plain),
             !Catch::Contains("viscosity") && !Catch::Contains("XSPH") && !Catch::Contains("halo"));
  CHECK(plain.sph().X.empty());
  CHECK(plain.sph().f_viscous.empty());
  CHECK(plain.scene.field("X") == nullptr);
  Pool full(column() + "effects: {viscosity: {alpha: 0.1}, xsph: {}}\n" +
            "boundaries: {sides: {periodic: {x: [0, 0.6]}}}\n");
  CHECK_THAT(names(full), Catch::Contains("viscosity") && Catch::Contains("XSPH") &&
                              Catch::Contains("halo: add back") && Catch::Contains("halo: copy"));
}

TEST_CASE("sph: a warning comes once when the flow is fast for c0", "[sph]") {
  Pool pool(column(", initial_velocity: [4, 0, 0]"));
  pool.run(201);
  REQUIRE(pool.scene.warnings.size() == 1);
  CHECK_THAT(pool.scene.warnings[0], Catch::Contains("c0 = 30 m/s"));
  Pool slow(column(", initial_velocity: [2, 0, 0]"));
  slow.run(101);
  CHECK(slow.scene.warnings.empty());
}

TEST_CASE("sph probes: pressure, surface and front of a column at rest", "[sph]") {
  Pool pool(column(", start: hydrostatic") +
                "boundaries: {sides: {periodic: {x: [0, 0.6]}}}\n"
                "probes:\n"
                "  deep: {pressure: {at: [0.3, 0.25, -0.5]}}\n"
                "  dry: {pressure: {at: [0.3, 0.25, 3]}}\n"
                "  level: {surface_height: {at: [0.33, 0.25]}}\n"
                "  reach: {front: {axis: y, part: pool}}\n",
            3, {0, 0, -10});
  const auto sample = [&](const std::string& name) {
    for (const Measure& m : pool.scene.measures) {
      double value = 0;
      if (m.name != "probe." + name) continue;
      m.sample(&value);
      return value;
    }
    FAIL("no probe " + name);
    return 0.0;
  };
  // Pressure is linear and the particles lie symmetrically about the point, but volumes m/rho fall
  // with depth: the mean is off by (g/c0^2) rho0 g <z^2> = 0.5 Pa, with <z^2> = 0.3 h^2.
  CHECK(sample("deep") == Approx(5000).margin(1));
  CHECK(sample("dry") == 0);
  // A sum over a lattice passes 1/2 at the surface to a few per cent of the spacing.
  CHECK(sample("level") == Approx(0).margin(0.05 * 0.1));
  CHECK(sample("reach") == Approx(0.45).epsilon(1e-12));
}

TEST_CASE("periodic: a shift of all particles by any vector changes no physics", "[sph]") {
  const std::string text =
      std::string(materials) +
      "parts: {sea: {sph: {material: water, spacing: 0.1}, "
      "fill: {box: {from: [0, 0, 0], to: [0.8, 0.7, 0.7]}, jitter: 0.1}}}\n"
      "effects: {viscosity: {alpha: 0.1}, xsph: {epsilon: 0.5}}\n"
      "boundaries: {sides: {periodic: {x: [0, 0.8], y: [0, 0.7], z: [0, 0.7]}}}\n";
  const Vec3 shift(0.237, -0.613, 1.91);
  const auto waves = [](Scene& scene, const Vec3& by) {
    for (Index i = 0; i < scene.nodes.n_owned; ++i) {
      const Vec3 x = xyz(scene.nodes.x[i]);
      set_xyz(scene.nodes.v[i],
              {std::sin(2 * M_PI * x.y() / 0.7), std::sin(2 * M_PI * x.x() / 0.8), 0});
      add_xyz(scene.nodes.x[i], by);
    }
  };
  Pool here(text, 3, Vec3::Zero(), [&](Scene& s) { waves(s, Vec3::Zero()); });
  Pool there(text, 3, Vec3::Zero(), [&](Scene& s) { waves(s, shift); });
  CHECK(here.scene.nodes.n_ghosts > 0);
  here.run(20);
  there.run(20);
  const std::vector<Index> a = here.by_id();
  const std::vector<Index> b = there.by_id();
  double v_off = 0;
  double rho_off = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    v_off = std::max(v_off, (here.v(a[i]) - there.v(b[i])).norm());
    rho_off = std::max(rho_off, std::abs(here.sph().rho[a[i]] - there.sph().rho[b[i]]));
  }
  // Rounding of positions (1e-16) through c0/h = 200/s over 20 steps, times order 10 sums.
  CHECK(v_off < 1e-11);
  CHECK(rho_off < 1e-9);
}
