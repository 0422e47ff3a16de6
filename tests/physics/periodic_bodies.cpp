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
