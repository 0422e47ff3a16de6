#include "scene/wave_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "input/functions.hpp"
#include "scene/wave_spectrum.hpp"

namespace gannet {

namespace {

using std::numbers::pi;

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
Vec3 direction_of(const Keys& wave, const char* key, double angle, int dimension) {
  if (dimension == 3) return {std::cos(angle), std::sin(angle), 0};
  if (std::abs(std::sin(angle)) > 1e-9) {
    wave.complain(key, "waves of a plane case go along x: 0 or 180 deg");
  }
  return {std::cos(angle) > 0 ? 1.0 : -1.0, 0, 0};
}

/// False, and a mistake noted, where a wave would break.
bool stands(const Keys& wave, const char* key, const WaveComponent& w) {
  const double length = 2 * pi / w.k;
  if (length > 0 && std::abs(w.a) * 2 * pi < 0.44 * length) return true;
  wave.complain(key, fmt::format("a wave of {:g} m height and {:g} m length breaks: height/length "
                                 "must lie below 0.14",
                                 2 * w.a, length));
  return false;
}

void read_list(const Keys& wave, int dimension, WaveField& field) {
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
    w.k = 2 * pi / length;
    if (!stands(wave, "length", w)) return;
    w.omega = dispersion(w.k, field.depth, field.g);
    if (wave.has("phase")) w.phase = of_list(wave.numbers("phase"), n);
    const double angle = wave.has("direction") ? of_list(wave.numbers("direction"), n) : 0;
    w.along = direction_of(wave, "direction", angle, dimension);
    field.waves.push_back(w);
  }
}

/// Column of a table that has one of these names, SI factors checked; its place, or nothing.
std::optional<std::vector<double>> column_of(const CsvTable& table, const char* name,
                                             std::initializer_list<Dimension> units) {
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const CsvTable::Column& column = table.columns[k];
    if (column.name != name) continue;
    const bool fits = column.unit.bare ||
                      std::find(units.begin(), units.end(), column.unit.dimension) != units.end();
    if (fits) return numbers_of(table, k);
    throw std::invalid_argument(fmt::format("{}: the column '{}' is {}", table.file, name,
                                            with_article(name_of(column.unit.dimension))));
  }
  return std::nullopt;
}

/// k of each line, from what stands for it.
std::vector<double> wave_numbers_of(const CsvTable& table, const WaveField& field) {
  if (auto length = column_of(table, "length", {dim::length})) {
    for (double& x : *length) x = 2 * pi / x;
    return *length;
  }
  auto omega = column_of(table, "omega", {dim::angular_velocity, dim::frequency});
  if (!omega && (omega = column_of(table, "frequency", {dim::frequency}))) {
    for (double& x : *omega) x *= 2 * pi;
  }
  if (!omega && (omega = column_of(table, "period", {dim::time}))) {
    for (double& x : *omega) x = 2 * pi / x;
  }
  if (!omega) {
    throw std::invalid_argument(table.file +
                                ": one column of length, period, frequency, omega is wanted");
  }
  for (double& x : *omega) x = wave_number(x, field.depth, field.g);
  return *omega;
}

/// Components of a sea state as they stand in a CSV file, one a line.
void read_components(const Keys& wave, int dimension, WaveField& field) try {
  const CsvTable table = read_csv_table(wave.word("components"));
  const std::vector<double> k = wave_numbers_of(table, field);
  auto a = column_of(table, "amplitude", {dim::length});
  if (!a && (a = column_of(table, "height", {dim::length}))) {
    for (double& x : *a) x *= 0.5;
  }
  if (!a) throw std::invalid_argument(table.file + ": a column amplitude or height is wanted");
  const auto phase = column_of(table, "phase", {dim::angle});
  const auto direction = column_of(table, "direction", {dim::angle});
  for (std::size_t n = 0; n < k.size(); ++n) {
    if (!(k[n] > 0 && std::isfinite(k[n]))) {
      throw std::invalid_argument(
          fmt::format("{}:{}: a wave has a length, period or frequency "
                      "greater than 0",
                      table.file, table.lines[n]));
    }
    WaveComponent w{.a = (*a)[n], .k = k[n], .omega = dispersion(k[n], field.depth, field.g)};
    if (phase) w.phase = (*phase)[n];
    w.along = direction_of(wave, "components", direction ? (*direction)[n] : 0, dimension);
    if (!stands(wave, "components", w)) return;
    field.waves.push_back(w);
  }
} catch (const std::invalid_argument& error) {
  wave.complain("components", error.what());
}

/// Length after which the scene repeats along a horizontal axis; 0 where it does not.
double repeat_along(const Keys& root, const Vec3& along, int up) {
  if (!root.has("boundaries")) return 0;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    if (!boundaries.map(name).has("periodic")) continue;
    const Keys periodic = boundaries.map(name).map("periodic");
    for (int d = 0; d < up; ++d) {
      const std::string axis(1, "xyz"[d]);
      if (std::abs(along[d]) < 1 - 1e-9 || !periodic.has(axis)) continue;
      const std::vector<double>& ends = periodic.numbers(axis);
      if (ends.size() == 2) return ends[1] - ends[0];
    }
  }
  return 0;
}

void read_spectrum(const Keys& root, const Keys& spectrum, int dimension, WaveField& field) {
  SeaState sea{.height = spectrum.number("height"), .period = spectrum.number("period")};
  sea.gamma = spectrum.word("type") == "jonswap" ? spectrum.number("gamma") : 1;
  sea.n = spectrum.integer("components");
  sea.seed = static_cast<std::uint64_t>(spectrum.integer("seed"));
  sea.shortest = spectrum.number_or("shortest", 0);
  sea.along = direction_of(spectrum, "direction", spectrum.number("direction"), dimension);
  sea.repeat = repeat_along(root, sea.along, field.up);
  for (const WaveComponent& w : components_of(sea, field.depth, field.g)) {
    if (!stands(spectrum, "height", w)) return;
    field.waves.push_back(w);
  }
  if (field.waves.empty()) {
    spectrum.complain("period",
                      "no wave of it fits between half and three times the peak's "
                      "frequency, into what repeats, and over the shortest");
  }
}

/// The one of the three ways to say what waves there are.
void read_waves(const Keys& root, const Keys& wave, int dimension, WaveField& field) {
  const bool list = wave.has("height") || wave.has("length");
  const int ways = static_cast<int>(list) + static_cast<int>(wave.has("components")) +
                   static_cast<int>(wave.has("spectrum"));
  if (ways != 1 || (list && !(wave.has("height") && wave.has("length")))) {
    wave.complain("",
                  "waves are given by height and length, by components: FILE, or by a spectrum");
    return;
  }
  if (!list && wave.word("type") == "stokes") {
    wave.complain("type", "waves of second order stand alone: one height");
  }
  if (list) read_list(wave, dimension, field);
  if (wave.has("components")) read_components(wave, dimension, field);
  if (wave.has("spectrum")) read_spectrum(root, wave.map("spectrum"), dimension, field);
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

/// wave.spectrum: a sea state by its height and period.
Key spectrum_key() {
  Key key{.name = "spectrum", .kind = Kind::map, .text = "a sea state"};
  key.keys = {{.name = "type",
               .kind = Kind::choice,
               .text = "the shape of the spectrum",
               .fallback = "jonswap",
               .choices = {"jonswap", "pierson_moskowitz"}},
              {.name = "height",
               .unit = dim::length,
               .text = "significant height, 4 sqrt(m0)",
               .required = true,
               .limits = positive()},
              {.name = "period",
               .unit = dim::time,
               .text = "of the peak",
               .required = true,
               .limits = positive()},
              {.name = "gamma",
               .text = "peak enhancement of jonswap",
               .fallback = "3.3",
               .limits = between(1, 20)},
              {.name = "components",
               .kind = Kind::integer,
               .text = "how many waves; where the sea repeats along them, all that fit",
               .fallback = "60",
               .limits = between(1, 10000)},
              {.name = "seed",
               .kind = Kind::integer,
               .text = "decides the phases",
               .fallback = "1",
               .limits = at_least(0)},
              {.name = "shortest",
               .unit = dim::length,
               .text = "shorter waves are left out",
               .limits = positive()},
              {.name = "direction",
               .unit = dim::angle,
               .text = "where the waves go, from x towards y",
               .fallback = "0 rad"}};
  return key;
}

}  // namespace

Schema sea_schema() {
  Key wave{.name = "wave", .kind = Kind::map, .text = "waves, a sum where there are several"};
  wave.keys = {
      {.name = "type",
       .kind = Kind::choice,
       .text = "linear theory, or Stokes to the second order in steepness",
       .fallback = "airy",
       .choices = {"airy", "stokes"}},
      {.name = "height",
       .kind = Kind::numbers,
       .unit = dim::length,
       .text = "from trough to crest; one a wave: [0.1 m, 50 mm]"},
      {.name = "length", .kind = Kind::numbers, .unit = dim::length, .text = "from crest to crest"},
      {.name = "phase",
       .kind = Kind::numbers,
       .unit = dim::angle,
       .text = "at x = 0 and the start; a crest at 0"},
      {.name = "direction",
       .kind = Kind::numbers,
       .unit = dim::angle,
       .text = "where it goes, from x towards y; 0 unless said"},
      {.name = "components",
       .kind = Kind::path,
       .text = "CSV file with a wave a line: length, period, frequency or omega; "
               "amplitude or height; phase; direction"},
      spectrum_key()};
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
  if (field.g > 0 && sea.has("wave")) read_waves(root, sea.map("wave"), dimension, field);
  require_whole_waves(root, field);
  if (!(field.g > 0) || tilted) field.depth = 0;
  return field;
}

}  // namespace gannet
