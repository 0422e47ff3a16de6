#include "fe/mooring_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <utility>

#include "fe/cable_part.hpp"
#include "fe/moordyn_file.hpp"
#include "fe/mooring_types.hpp"
#include "material/elastic_plastic.hpp"

namespace gannet {

namespace {

constexpr Dimension stiffness_per_area{{-2, 1, -2, 0, 0}};
constexpr Dimension damping_per_area{{-2, 1, -1, 0, 0}};

Key coefficient(const char* name, const char* text, const char* fallback) {
  return {.name = name, .text = text, .fallback = fallback, .limits = at_least(0)};
}

Key water_key() {
  Key water{
      .name = "water", .kind = Kind::map, .text = "water around the line: Morison's equation"};
  water.keys = {
      {.name = "density",
       .unit = dim::density,
       .text = "of the water",
       .fallback = "1025 kg/m^3",
       .limits = positive()},
      {.name = "level", .unit = dim::length, .text = "height of the surface", .fallback = "0 m"},
      {.name = "current",
       .kind = Kind::vector_function,
       .unit = dim::velocity,
       .text = "velocity of the water; still where it is not said",
       .variables = {"t", "x", "y", "z"}},
      coefficient("Cdn", "drag across the line, on diameter times length", "1.2"),
      coefficient("Cdt", "drag along it, on pi times diameter times length", "0"),
      coefficient("Can", "added mass across the line, on the displaced water", "1"),
      coefficient("Cat", "added mass along it", "0")};
  return water;
}

Key bed_key() {
  Key bed{.name = "bed", .kind = Kind::map, .text = "flat sea bed that the line may lie on"};
  bed.keys = {{.name = "level", .unit = dim::length, .text = "height; of the anchor unless said"},
              {.name = "stiffness",
               .unit = stiffness_per_area,
               .text = "push per depth, on diameter times length (Pa/m); unless said, that a line "
                       "at rest sinks in by a tenth of its diameter",
               .limits = positive()},
              {.name = "damping",
               .unit = damping_per_area,
               .text = "push per velocity, on diameter times length (Pa*s/m); unless said critical",
               .limits = at_least(0)},
              coefficient("friction", "coefficient of Coulomb", "0")};
  return bed;
}

Key end_key(const char* name, const char* text) {
  return {.name = name, .kind = Kind::vector, .unit = dim::length, .text = text, .required = true};
}

bool read_ends(const Keys& keys, MooringLine& line) {
  line.ends[0].at = keys.vector("to");
  line.ends[1].at = keys.vector("from");
  if (keys.has("free")) {
    for (const std::string& end : keys.words("free")) line.ends[end == "to" ? 0 : 1].held = false;
  }
  if (!keys.has("motion")) return true;
  if (!line.ends[1].held) {
    keys.complain("motion", "moves 'from', which 'free' leaves to others");
    return false;
  }
  line.ends[1].way = keys.vector_function("motion");
  return true;
}

bool read_water(const Keys& keys, MooringLine& line) {
  if (keys.has("diameter"))
    line.diameter = keys.number("diameter");
  else if (keys.has("area"))
    line.diameter = std::sqrt(4 / std::numbers::pi * keys.number("area"));
  for (const char* key : {"water", "bed"}) {
    if (!keys.has(key) || line.diameter > 0) continue;
    keys.complain(key, "needs the 'diameter' of the line, of a cylinder that displaces as much");
    return false;
  }
  if (!keys.has("water")) return true;
  const Keys water = keys.map("water");
  line.water = {.density = water.number("density"),
                .level = water.number("level"),
                .Cdn = water.number("Cdn"),
                .Cdt = water.number("Cdt"),
                .Can = water.number("Can"),
                .Cat = water.number("Cat"),
                .flows = water.has("current")};
  read_coefficients_of_type(keys, line.water);
  if (line.water.flows) line.water.current = water.vector_function("current");
  return true;
}

void read_bed(const Keys& keys, MooringLine& line, double g) {
  if (!keys.has("bed")) return;
  const Keys bed = keys.map("bed");
  line.bed.there = true;
  line.bed.level = bed.number_or("level", line.ends[0].at.z());
  line.bed.friction = bed.number("friction");
  choose_bed(line, g);
  line.bed.stiffness = bed.number_or("stiffness", line.bed.stiffness);
  line.bed.damping = bed.number_or("damping", line.bed.damping);
  if (!(line.bed.stiffness > 0)) {
    bed.complain("stiffness", "must be said for a line without weight in the water");
  }
}

bool can_be_moored(const Keys& root) {
  const Vec3 g = gravity_of(root);
  if (root.integer("dimension") == 3 && g.x() == 0 && g.y() == 0 && g.z() <= 0) return true;
  root.map("moorings").complain("", "mooring lines want three dimensions and gravity along -z");
  return false;
}

bool read_mooring(const Keys& root, const Keys& keys, MooringLine& line) {
  line.name = keys.name();
  line.where = keys.where();
  line.length = keys.number("length");
  line.n = keys.integer("elements");
  line.block.unstretched = line.length / line.n;
  line.material = keys.word("material");
  if (!read_mooring_type(keys, line) || !read_cable(root, keys, line.block)) return false;
  if (!read_ends(keys, line) || !read_water(keys, line)) return false;
  read_bed(keys, line, -gravity_of(root).z());
  return true;
}

/// The lines of a line file of MoorDyn.
void add_lines_of_file(const Keys& root, const Keys& moorings, std::vector<MooringLine>& lines) {
  const std::string path = moorings.word("file");
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  MoorDynFile file = read_moordyn(text.str(), path, moorings.word("coupled") != "free");
  for (const std::string& mistake : file.mistakes) moorings.complain("file", mistake);
  const double g = -gravity_of(root).z();
  if (file.mistakes.empty() && std::abs(g - file.g) > 1e-3 * file.g) {
    moorings.complain(
        "file", fmt::format("says g = {:.6g} m/s^2; loads.gravity says {:.6g} m/s^2", file.g, g));
  }
  for (MooringLine& line : file.lines) {
    line.where = moorings.where("file");
    if (moorings.has(line.name)) {
      moorings.complain("file", "has a line '" + line.name + "' too");
      continue;
    }
    lines.push_back(std::move(line));
  }
}

}  // namespace

Schema mooring_schema() {
  Schema s = elastic_plastic_schema();
  const auto key = [&](Key k) { s.push_back({"moorings.*", std::move(k)}); };
  s.push_back({"moorings",
               {.name = "file",
                .kind = Kind::path,
                .text = "line file of MoorDyn, whose lines are taken as line_ID"}});
  s.push_back({"moorings",
               {.name = "coupled",
                .kind = Kind::choice,
                .text = "ends of its lines at coupled points: held, or left to ties, boundaries",
                .fallback = "held",
                .choices = {"held", "free"}}});
  key(end_key("from", "upper end, at what is moored"));
  key(end_key("to", "the anchor"));
  key({.name = "length",
       .unit = dim::length,
       .text = "unstretched length of the line",
       .required = true,
       .limits = positive()});
  key({.name = "elements",
       .kind = Kind::integer,
       .text = "number of elements, all of one length",
       .fallback = "80",
       .limits = between(2, 1e7)});
  key(mooring_type_key());
  key(nominal_key());
  key({.name = "diameter",
       .unit = dim::length,
       .text = "of a cylinder that displaces as much water; of the 'area' unless said",
       .limits = positive()});
  key({.name = "free",
       .kind = Kind::names,
       .text = "ends that are left to boundaries, loads and ties; the others are held",
       .choices = {"from", "to"}});
  key({.name = "motion",
       .kind = Kind::vector_function,
       .unit = dim::length,
       .text = "how 'from' moves: its way in time, of which changes count",
       .variables = {"t"}});
  key(water_key());
  key(bed_key());
  for (const Key& k : cable_keys()) {
    if (k.name != "tension_only" && k.name != "prestrain") key(k);
  }
  return s;
}

Vec3 gravity_of(const Keys& root) {
  if (!root.has("loads") || !root.map("loads").has("gravity")) return Vec3::Zero();
  return value_at(root.map("loads").vector_function("gravity"), 0);
}

std::vector<MooringLine> read_moorings(const Keys& root) {
  std::vector<MooringLine> lines;
  if (!root.given("moorings") || !can_be_moored(root)) return lines;
  const Keys moorings = root.map("moorings");
  for (const std::string& name : moorings.names()) {
    if (name == "file" || name == "coupled") continue;
    MooringLine line;
    if (read_mooring(root, moorings.map(name), line)) lines.push_back(std::move(line));
  }
  if (moorings.has("file")) add_lines_of_file(root, moorings, lines);
  return lines;
}

void choose_bed(MooringLine& line, double g) {
  const double weight = std::abs(line.block.mu - line.displaced()) * g;
  const double d = line.diameter;
  line.bed.stiffness = 10 * weight / (d * d);
  line.bed.damping = 2 * std::sqrt(line.bed.stiffness * d * line.block.mu) / d;
}

}  // namespace gannet
