// Bodies at the border of a periodic domain: particles are wrapped there, bodies are not, and
// neither contact nor walls on bodies may notice.
#include "body/rigid_body.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A pool of 1 m x 0.25 m that repeats along x. A moored box is `at` m to the right of its middle
/// at the start and moves by 0.2 m to the right; spacing and lattice are powers of two, so that a
/// shift by whole spacings changes nothing but roundings.
std::string moored(double at, bool walls, bool models) {
  std::string text = R"case(gannet: 1
dimension: 2
let: {dx: 0.015625, s: SHIFT}
materials: {water: {density: 1000, c0: 20 m/s}}
parts:
  pool:
    sph: {material: water, spacing: dx}
    fill: {box: {from: [0, -0.25, 0], to: [1, 0, 0]}, outside: box}
    start: hydrostatic
  box:
    rigid_surface: {}
    shape: {polyline: {points: [["s+0.375", -0.0625, 0], ["s+0.625", -0.0625, 0], ["s+0.625", 0.0625, 0], ["s+0.375", 0.0625, 0], ["s+0.375", -0.0625, 0]], elements: [8, 4, 8, 4]}}
  fore: {cable: {EA: 20 kN, mass_per_length: 0.2 kg/m}, shape: {line: {from: ["s+0.625", 0.0625, 0], to: ["s+1.625", 0.0625, 0], elements: 8}}}
bodies: {box: {parts: box, density: 500, velocity: [0.8, 0, 0], WALLS}}
ties: {fore: {nodes: {nearest: ["s+0.625", 0.0625, 0], of: fore}, to: box}}
boundaries:
  sea: {periodic: {x: [0, 1 m]}}
  bed: {planes: {y: -0.25}}
  pile: {nodes: {nearest: ["s+1.625", 0.0625, 0], of: fore}, fix: [x, y]}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects: {viscosity: {alpha: 0.1}}
CONTACT
MODELS
output: {until: 10 s, checkpoint: never}
)case";
  const auto put = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  put("SHIFT", fmt::format("{}", at));
  put("WALLS", walls ? "walls: dummy, slip: none" : "");
  put("CONTACT", walls ? "" : "contacts: {hull: {between: [pool, box], friction: 0.1}}");
  put("MODELS", models ? "models: {water: {parts: pool}, lines: {parts: fore}}" : "");
  return text;
}

/// Motion of the body over 0.1 s: x less that of the start, y, roll, at every 20th step. Later the
/// motion of the particles makes roundings grow, to 5e-7 m after 0.3 s.
struct Track {
  std::vector<Vec3> way;
  std::size_t particles = 0;
};

Track track_of(const std::string& text) {
  const auto s = make_simulation_of_text(text);
  Track track;
  track.particles = static_cast<std::size_t>(s->scene.particles.size());
  const double x0 = measured(s->scene, "body.box.position", 0);
  int n = 0;
  run_until(*s, 0.1, [&] {
    if (++n % 20 != 0) return;
    track.way.emplace_back(measured(s->scene, "body.box.position", 0) - x0,
                           measured(s->scene, "body.box.position", 1),
                           measured(s->scene, "body.box.angles", 0));
  });
  return track;
}

void compare(bool walls, bool models) {
  const Track inside = track_of(moored(0, walls, models));
  CHECK(inside.way.back().x() > 0.04);
  // Its bow crosses, its stern crosses, it starts across, five periods further.
  for (const double at : {0.359375, 0.609375, 0.5, 5.5}) {
    const Track other = track_of(moored(at, walls, models));
    CHECK(other.particles == inside.particles);
    REQUIRE(other.way.size() == inside.way.size());
    double most = 0;
    for (std::size_t k = 0; k < inside.way.size(); ++k) {
      most = std::max(most, (other.way[k] - inside.way[k]).norm());
    }
    fmt::print("{}{} from {:+} m: moves {:.3f} m, differs by {:.1e} m at most\n",
               walls ? "walls" : "contact", models ? ", models" : "", at, inside.way.back().x(),
               most);
    CHECK(most < 1e-12);
  }
}

}  // namespace

TEST_CASE("periodic: a moored body crosses the border as if it were not there", "[physics]") {
  compare(false, false);
  compare(true, false);
  compare(false, true);
}

namespace {

/// Water beside a hull of a diamond, which no lattice fits, in a period of 2 m in x, sorted by
/// height and then along x, the middle of the hull at 0 or at the border.
std::vector<Vec3> water_beside(double at, double half_length) {
  const std::string text = fmt::format(R"case(gannet: 1
dimension: 2
let: {{dx: 0.0625, s: {0}, a: {1}}}
materials: {{water: {{density: 1000, c0: 20 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: dx}}
    fill: {{box: {{from: [-1, -1, 0], to: [1, 0, 0]}}, outside: hull}}
  hull:
    rigid_surface: {{}}
    shape: {{polyline: {{points: [["s-a", 0, 0], ["s", -0.3, 0], ["s+a", 0, 0], ["s", 0.3, 0], ["s-a", 0, 0]], elements: [8, 8, 8, 8]}}}}
bodies: {{hull: {{parts: hull, density: 500}}}}
boundaries: {{sea: {{periodic: {{x: [-1, 1]}}}}}}
output: {{until: 1 s, checkpoint: never}}
)case",
                                       at, half_length);
  const auto s = make_simulation_of_text(text);
  std::vector<Vec3> water;
  for_particles(s->scene, [&](std::size_t, const Vec3& x, const Vec3&) {
    CHECK(std::abs(x.x()) <= 1);
    water.push_back(x);
  });
  return water;
}

}  // namespace

TEST_CASE("periodic bodies: water around a hull across the border is that around one in the middle",
          "[scene]") {
  const std::vector<Vec3> inside = water_beside(0, 0.37);
  const std::vector<Vec3> across = water_beside(1, 0.37);
  REQUIRE(across.size() == inside.size());
  for (const Vec3& x : inside) {
    const Vec3 image(x.x() < 0 ? x.x() + 1 : x.x() - 1, x.y(), 0);
    double nearest = 1;
    for (const Vec3& y : across) nearest = std::min(nearest, (y - image).norm());
    CHECK(nearest < 1e-6 * 0.0625);
  }
}

TEST_CASE("periodic bodies: water is cut off plainly by a hull that meets its images", "[scene]") {
  // Longer than the period: what is left stands on the lattice, half a spacing off every image.
  const Vec3 normal = Vec3(0.3, 1.2, 0).normalized();
  const auto depth = [&](double x) { return std::max(0.3 * (1 - std::abs(x) / 1.2), 0.0); };
  std::size_t expected = 0;
  for (int i = -16; i < 16; ++i) {
    for (int j = -16; j < 0; ++j) {
      const Vec3 x((i + 0.5) * 0.0625, (j + 0.5) * 0.0625, 0);
      const double below = -x.y() - depth(x.x());
      expected += below * normal.y() >= 0.03125 ? 1 : 0;
    }
  }
  const std::vector<Vec3> water = water_beside(0, 1.2);
  CHECK(water.size() == expected);
  for (const Vec3& x : water) {
    const Vec3 cell = x / 0.0625 - Vec3(0.5, 0.5, 0);
    CHECK(std::abs(cell.x() - std::round(cell.x())) < 1e-9);
    CHECK(std::abs(cell.y() - std::round(cell.y())) < 1e-9);
  }
}
