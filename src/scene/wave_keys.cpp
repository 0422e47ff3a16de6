#include "scene/wave_keys.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace gannet {

namespace {

constexpr double pi = std::numbers::pi;

/// Strength of gravity where it points down along an axis and does not change; 0 after a complaint.
double gravity_down(const Keys& root, int up, const Keys& sea) {
  const std::string wanted = "waves need a steady gravity along -" + std::string(1, "xyz"[up]) +
                             ": loads: {gravity: [0, 0, -9.81 m/s^2]}";
  if (!root.has("loads") || !root.map("loads").has("gravity")) {
    sea.complain("", wanted);
    return 0;
  }
  const VectorFunction g = root.map("loads").vector_function("gravity");
  const Vec3 now = value_at(g, 0);
  if (!g.constant() || !(now[up] < 0) || std::abs(now.norm() + now[up]) > 1e-12 * now.norm()) {
    sea.complain("", wanted);
    return 0;
  }
  return -now[up];
}

/// The n-th number of a list that may be a single one for all.
double of_list(const std::vector<double>& list, std::size_t n) {
  return list.size() == 1 ? list.front() : list[n];
}

bool lengths_agree(const Keys& wave, std::size_t n) {
  for (const char* key : {"height", "length", "phase", "direction"}) {
    if (!wave.has(key)) continue;
    const std::size_t here = wave.numbers(key).size();
    if (here == n || (here == 1 && key != std::string("height"))) continue;
    wave.complain(key, fmt::format("{} numbers for {} heights", here, n));
    return false;
  }
  return true;
}

/// Along e: horizontal; in the plane, to one side or the other.
Vec3 direction_of(const Keys& wave, double angle, int dimension) {
  if (dimension == 3) return {std::cos(angle), std::sin(angle), 0};
  if (std::abs(std::sin(angle)) > 1e-9) {
    wave.complain("direction", "waves of a plane case go along x: 0 or 180 deg");
  }
  return {std::cos(angle) > 0 ? 1.0 : -1.0, 0, 0};
}

void read_waves(const Keys& wave, int dimension, WaveField& field) {
  const std::vector<double>& heights = wave.numbers("height");
  if (!lengths_agree(wave, heights.size())) return;
  field.second_order = wave.word("type") == "stokes";
  if (field.second_order && heights.size() != 1) {
    wave.complain("type", "waves of second order stand alone: one height");
  }
  for (std::size_t n = 0; n < heights.size(); ++n) {
    const double length = of_list(wave.numbers("length"), n);
    WaveComponent w;
    w.a = 0.5 * heights[n];
    if (!(length > 0) || !(std::abs(w.a) * 2 * pi < 0.44 * length)) {
      wave.complain("length", fmt::format("a wave of {:g} m height and {:g} m length breaks: "
                                          "height/length must lie below 0.14",
                                          heights[n], length));
      return;
    }
    w.k = 2 * pi / length;
    w.omega = dispersion(w.k, field.depth, field.g);
    if (wave.has("phase")) w.phase = of_list(wave.numbers("phase"), n);
    const double angle = wave.has("direction") ? of_list(wave.numbers("direction"), n) : 0;
    w.along = direction_of(wave, angle, dimension);
    field.waves.push_back(w);
  }
}

/// In directions that repeat, waves must repeat too.
void require_whole_waves(const Keys& root, const WaveField& field) {
  if (!root.has("boundaries")) return;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    if (!boundaries.map(name).has("periodic")) continue;
    const Keys periodic = boundaries.map(name).map("periodic");
    for (int d = 0; d < field.up; ++d) {
      const std::string axis(1, "xyz"[d]);
      if (!periodic.has(axis) || periodic.numbers(axis).size() != 2) continue;
      const double period = periodic.numbers(axis)[1] - periodic.numbers(axis)[0];
      for (const WaveComponent& wave : field.waves) {
        const double n = wave.k * wave.along[d] * period / (2 * pi);
        if (std::abs(n - std::round(n)) < 1e-6) continue;
        periodic.complain(axis, fmt::format("{:g} m hold {:g} waves of {:g} m: a whole number is "
                                            "wanted",
                                            period, n, 2 * pi / wave.k));
      }
    }
  }
}

}  // namespace

Schema sea_schema() {
  Key wave{.name = "wave", .kind = Kind::map, .text = "waves, a sum where there are several"};
  wave.keys = {{.name = "type",
                .kind = Kind::choice,
                .text = "linear theory, or Stokes to the second order in steepness",
                .fallback = "airy",
                .choices = {"airy", "stokes"}},
               {.name = "height",
                .kind = Kind::numbers,
                .unit = dim::length,
                .text = "from trough to crest; one a wave: [0.1 m, 50 mm]",
                .required = true},
               {.name = "length",
                .kind = Kind::numbers,
                .unit = dim::length,
                .text = "from crest to crest",
                .required = true},
               {.name = "phase",
                .kind = Kind::numbers,
                .unit = dim::angle,
                .text = "at x = 0 and the start; a crest at 0"},
               {.name = "direction",
                .kind = Kind::numbers,
                .unit = dim::angle,
                .text = "where it goes, from x towards y; 0 unless said"}};
  Key sea{.name = "sea", .kind = Kind::map, .text = "waves that water starts in"};
  sea.keys = {{.name = "level",
               .unit = dim::length,
               .text = "height of the still water",
               .fallback = "0 m"},
              {.name = "depth",
               .unit = dim::length,
               .text = "of the sea below it, whatever part of it the case fills",
               .required = true,
               .limits = positive()},
              {.name = "current",
               .kind = Kind::vector,
               .unit = dim::velocity,
               .text = "horizontal velocity that carries water and waves"},
              wave};
  return {{"", sea}};
}

WaveField read_wave_field(const Keys& root, int dimension) {
  const Keys sea = root.map("sea");
  WaveField field;
  field.up = dimension - 1;
  field.level = sea.number("level");
  field.depth = sea.number("depth");
  field.g = gravity_down(root, field.up, sea);
  if (sea.has("current")) field.current = sea.vector("current");
  const bool tilted = field.current[field.up] != 0 || (dimension == 2 && field.current.z() != 0);
  if (tilted) sea.complain("current", "a current is horizontal");
  if (field.g > 0 && sea.has("wave")) read_waves(sea.map("wave"), dimension, field);
  require_whole_waves(root, field);
  if (!(field.g > 0) || tilted) field.depth = 0;
  return field;
}

}  // namespace gannet
