// The effect `sph`: parts made of particles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "mesh/fill.hpp"
#include "scene/particle_material.hpp"
#include "scene/tracked_values.hpp"
#include "sph/effects.hpp"
#include "sph/neighbour_lists.hpp"
#include "sph/sph_operations.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace sph {

Schema schema() {
  Key sph{.name = "sph", .kind = Kind::map, .text = "the part is made of particles"};
  sph.keys = {
      {.name = "material",
       .kind = Kind::reference,
       .text = "the fluid",
       .required = true,
       .refers_to = "materials"},
      {.name = "spacing",
       .unit = dim::length,
       .text = "distance of neighbouring particles",
       .required = true,
       .limits = positive()},
      {.name = "kernel",
       .kind = Kind::choice,
       .text = "smoothing kernel",
       .fallback = "cubic_spline",
       .choices = {"cubic_spline", "wendland_c2", "wendland_c4", "quintic_spline"}},
      {.name = "smoothing_ratio",
       .text = "smoothing length h over spacing (1.3, 1.5, 1.7, 1 for these kernels)",
       .limits = between(0.9, 3)},
      {.name = "precision",
       .kind = Kind::choice,
       .text = "arithmetic of pairs; the state is in double precision",
       .fallback = "double",
       .choices = {"double", "single"}},
      {.name = "cfl",
       .text = "time step times speed of sound over h, before viscosity",
       .fallback = "0.7",
       .limits = between(0.01, 1.5)},
      {.name = "skin",
       .text = "how much further than 2 h neighbour lists reach, over spacing; where absent it "
               "follows the motion at each place, within 0.03 and 0.5",
       .limits = between(0.02, 2)},
      {.name = "sound_speed_check",
       .kind = Kind::flag,
       .text = "whether to warn where the flow becomes too fast for the speed of sound",
       .fallback = "on"}};
  const Key start{.name = "start",
                  .kind = Kind::choice,
                  .text =
                      "pressure at the start: p0 everywhere, p0 + density g depth, or place, "
                      "velocity and pressure of the waves of `sea`",
                  .choices = {"rest", "hydrostatic", "waves"}};
  const Key surface{.name = "surface",
                    .unit = dim::length,
                    .text =
                        "height of the free surface for a hydrostatic start, measured against "
                        "gravity from the origin (the top of the part where absent)"};
  const Key pressure{.name = "initial_pressure",
                     .kind = Kind::function,
                     .unit = dim::pressure,
                     .text = "added to the pressure that `start` gives",
                     .variables = {"x", "y", "z"}};
  Schema s = murnaghan_schema();
  for (const Key& key : {sph, start, surface, initial_velocity_key(), pressure})
    s.push_back({"parts.*", key});
  return s;
}

/// The parts that are made of particles, in file order.
std::vector<Keys> sph_parts(const Keys& root) {
  std::vector<Keys> parts;
  if (!root.has("parts")) return parts;
  for (const std::string& name : root.map("parts").names()) {
    const Keys part = root.map("parts").map(name);
    if (part.has("sph")) parts.push_back(part);
  }
  return parts;
}

/// Notes where a part asks for another particle size than the first one.
void require_same(const std::vector<Keys>& parts) {
  for (const char* key : {"spacing", "smoothing_ratio", "cfl", "skin"}) {
    const double first = parts.front().map("sph").number_or(key, 0);
    for (const Keys& part : parts) {
      const double here = part.map("sph").number_or(key, 0);
      if (here == first) continue;
      part.map("sph").complain(
          key, fmt::format("{:g} differs from {:g} of '{}': particles of different size in one "
                           "pool are not built yet",
                           here, first, parts.front().name()));
    }
  }
  for (const char* key : {"kernel", "precision"}) {
    const std::string first = parts.front().map("sph").word(key);
    for (const Keys& part : parts) {
      if (part.map("sph").word(key) == first) continue;
      part.map("sph").complain(key, fmt::format("differs from {} of '{}': one pool has one {}",
                                                first, parts.front().name(), key));
    }
  }
  for (const Keys& part : parts) {
    if (part.map("sph").flag("sound_speed_check") ==
        parts.front().map("sph").flag("sound_speed_check")) {
      continue;
    }
    part.map("sph").complain(
        "sound_speed_check",
        fmt::format("differs from '{}': one pool is watched or it is not", parts.front().name()));
  }
}

void add_parts(const Keys& root, Draft& draft) {
  const std::vector<Keys> parts = sph_parts(root);
  if (parts.empty()) return;
  require_same(parts);
  for (const Keys& part : parts) {
    const Keys sph = part.map("sph");
    if (part.has("map")) part.complain("map", "moves the points of elements, not those of a fill");
    if (!part.has("fill")) {
      part.complain("fill", "missing; particles need a region to fill: fill: {box: {from, to}}");
      continue;
    }
    PartDraft p;
    p.name = part.name();
    p.kind = "sph";
    p.material = sph.word("material");
    p.where = part.where();
    p.points = fill_points(part, sph.number("spacing"), draft.dimension);
    p.velocity = initial_velocity(part, p.points);
    draft.parts.push_back(std::move(p));
  }
}

/// Upwards: against gravity; without it, the last direction of the space.
Vec3 upwards(const Scene& scene) {
  if (scene.gravity.norm() > 0) return -scene.gravity.normalized();
  return scene.dimension == 3 ? Vec3::UnitZ() : Vec3::UnitY();
}

/// Highest particle of a part (of all that are fluid, for part < 0) along a direction [m].
double highest(const Scene& scene, const Vec3& along, int part) {
  double most = -std::numeric_limits<double>::infinity();
  for (Index k = 0; k < scene.particles.size(); ++k) {
    if (part >= 0 && scene.particle_part[k] != part) continue;
    if (!is_fluid(scene, k)) continue;
    most = std::max(most, along.dot(xyz(scene.nodes.x[scene.particles.begin + k])));
  }
  return most;
}

/// What the scene itself says about the speed that water may reach: the largest speed at the
/// start, and sqrt(2 g H) of a column of the particles' height [m/s].
double speed_of_scene(const Scene& scene, double dx) {
  double speed = 0;
  for (const Line& v : scene.nodes.v) speed = std::max(speed, xyz(v).norm());
  const Vec3 up = upwards(scene);
  const double height = highest(scene, up, -1) + highest(scene, -up, -1) + dx;
  return std::max(speed, std::sqrt(2 * scene.gravity.norm() * height));
}

/// Mass of a particle from the volume that each stands for; notes where parts disagree.
double particle_mass(const std::vector<Keys>& parts, const Scene& scene, const SphState& sph) {
  double m = 0;
  for (const Keys& part : parts) {
    const double volume = fill_cell_volume(part, sph.dx, scene.dimension);
    const Murnaghan& eos = sph.eos[scene.part_number(part.name())];
    const double here = eos.rho0 * volume;
    if (m == 0) m = here;
    if (std::abs(here - m) <= 1e-9 * m) continue;
    part.map("sph").complain(
        "material", fmt::format("a particle would have {:g} kg here and {:g} kg in '{}': particles "
                                "of different mass in one pool are not built yet; use one density, "
                                "and boxes that are whole numbers of spacings",
                                here, m, parts.front().name()));
  }
  return m;
}

void track_fields(SphState& sph, Scene& scene) {
  const auto track = [&](Field field) {
    field.owner = "sph";
    scene.fields.push_back(std::move(field));
  };
  const Over over = Over::particles;
  track(plain_field("rho", "kg/m^3", "Density", over, sph.rho, 1, GhostRule::copy));
  track(plain_field("p", "Pa", "Pressure", over, sph.p, 1, GhostRule::copy));
  track(plain_field("drho_dt", "kg/(m^3 s)", "", over, sph.drho_dt, 1, GhostRule::none));
  track(plain_field("h", "m", "SmoothingLength", over, sph.smoothing_length, 1, GhostRule::copy));
  track(line_field("x_build", "m", "", over, sph.x_build, 0, 3, GhostRule::none));
  track(plain_field("list_skin", "m", "", over, sph.list_skin, 1, GhostRule::none));
  track_values(scene, "sph", "list.steps", "", 1, [&sph] { return &sph.skin.steps; });
}

/// Density and pressure of one part at the start.
void set_start(const Keys& part, SphState& sph, const Scene& scene) {
  const int number = scene.part_number(part.name());
  const Murnaghan& eos = sph.eos[number];
  const bool hydrostatic = part.has("start") && part.word("start") == "hydrostatic";
  if (hydrostatic && scene.gravity.norm() == 0) {
    part.complain("start", "hydrostatic needs gravity: loads: {gravity: [0, 0, -9.81 m/s^2]}");
  }
  const Vec3 up = upwards(scene);
  const double surface =
      part.has("surface") ? part.number("surface") : highest(scene, up, number) + 0.5 * sph.dx;
  const Function added =
      part.has("initial_pressure") ? part.function("initial_pressure") : Function(0.0);
  for (Index k = 0; k < scene.particles.size(); ++k) {
    if (scene.particle_part[k] != number) continue;
    const Vec3 x = xyz(scene.nodes.x[scene.particles.begin + k]);
    const double depth = hydrostatic ? std::max(surface - up.dot(x), 0.0) : 0.0;
    const double p = eos.p0 + eos.rho0 * scene.gravity.norm() * depth + value_at(added, 0, x);
    if (!(p > eos.p0 - eos.B) || !std::isfinite(p)) {
      part.complain("initial_pressure",
                    fmt::format("{:g} Pa at ({:g}, {:g}, {:g}) m: no density of the material goes "
                                "with it",
                                p, x.x(), x.y(), x.z()));
      return;
    }
    sph.rho[k] = density(eos, p);
    sph.p[k] = pressure(eos, sph.rho[k]);
  }
}

void read_materials(const Keys& root, const std::vector<Keys>& parts, SphState& sph, Scene& scene) {
  const double speed = speed_of_scene(scene, sph.dx);
  auto& materials = scene.store.get<ParticleMaterials>().of_part;
  materials.resize(std::max(materials.size(), scene.parts.size()));
  sph.eos.resize(scene.parts.size());
  for (const Keys& part : parts) {
    const int number = scene.part_number(part.name());
    const Keys material = root.map("materials").map(part.map("sph").word("material"));
    const Murnaghan eos = read_murnaghan(material, speed);
    const double c0 = sound_speed(eos, eos.rho0);
    sph.eos[number] = eos;
    sph.parts.push_back(number);
    sph.c0 = std::max(sph.c0, c0);
    sph.rho0 = std::max(sph.rho0, eos.rho0);
    materials[number] = {sph.dx, eos.rho0, c0, sph.kernel};
  }
}

/// What the case says, or bounds and a start for what is chosen.
ListSkin skin_of(const Keys& sph, double dx) {
  if (!sph.has("skin")) return {.width = 0.26 * dx, .least = 0.03 * dx, .most = 0.5 * dx};
  const double width = sph.number("skin") * dx;
  return {.width = width, .least = width, .most = width};
}

void make_state(const Keys& root, Scene& scene) {
  const std::vector<Keys> parts = sph_parts(root);
  if (parts.empty() || scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  const Keys first = parts.front().map("sph");
  sph.dx = first.number("spacing");
  const KernelType kernel = kernel_named(first.word("kernel"));
  const double ratio =
      first.number_or("smoothing_ratio", usual_smoothing_ratio(kernel, scene.dimension));
  sph.h = ratio * sph.dx;
  sph.kernel = {kernel, scene.dimension, sph.h};
  sph.packed.single = first.word("precision") == "single";
  sph.skin = skin_of(first, sph.dx);
  sph.cfl = first.number("cfl");
  sph.limits = lattice_limits(kernel, scene.dimension, ratio);
  read_materials(root, parts, sph, scene);
  sph.m = particle_mass(parts, scene, sph);
  for (const Keys& part : parts) {
    const std::string note = fill_note(part, sph.dx, scene.dimension);
    if (!note.empty()) scene.warnings.push_back(note);
  }
  const auto n = static_cast<std::size_t>(scene.particles.size());
  sph.rho.assign(n, 0);
  sph.p.assign(n, 0);
  sph.drho_dt.assign(n, 0);
  sph.smoothing_length.assign(n, sph.h);
  sph.x_build.assign(n, {});
  sph.list_skin.assign(n, sph.skin.width);
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    scene.nodes.x[i].w = sph.m;
  }
  for (const Keys& part : parts) set_start(part, sph, scene);
  track_fields(sph, scene);
  scene.after_restart.emplace_back([&sph, &scene] { restore_lists(sph, scene); });
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  const std::vector<Keys> parts = sph_parts(root);
  if (parts.empty() || scene.particles.empty()) return;
  add_particle_operations(scene.store.get<SphState>(), scene, models,
                          asked_for_at(parts.front().where("sph")),
                          parts.front().map("sph").flag("sound_speed_check"));
}

/// Smoothing length and free surfaces, where the case leaves them open.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  const std::vector<Keys> parts = sph_parts(root);
  if (parts.empty() || scene.particles.empty()) return list;
  const auto& sph = scene.store.get<SphState>();
  for (const Keys& part : parts) {
    const Keys keys = part.map("sph");
    if (!keys.has("smoothing_ratio")) {
      list.push_back({keys.path() + ".smoothing_ratio", fmt::format("{:.4g}", sph.h / sph.dx),
                      fmt::format("the usual h over spacing of {} in {} dimensions",
                                  keys.word("kernel"), scene.dimension)});
    }
    const bool hydrostatic = part.has("start") && part.word("start") == "hydrostatic";
    if (!hydrostatic || part.has("surface")) continue;
    const double top = highest(scene, upwards(scene), scene.part_number(part.name()));
    list.push_back({part.path() + ".surface", fmt::format("{:.4g} m", top + 0.5 * sph.dx),
                    "half a spacing above the highest particle of the part"});
  }
  return list;
}

}  // namespace sph
}  // namespace

Effect sph_effect() {
  return {.name = "sph",
          .schema = sph::schema,
          .parts = sph::add_parts,
          .state = sph::make_state,
          .operations = sph::add_operations,
          .choices = sph::choices};
}

}  // namespace gannet
