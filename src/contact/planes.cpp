#include "contact/planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/parallel.hpp"
#include "contact/effects.hpp"
#include "contact/force.hpp"
#include "scene/particle_material.hpp"

namespace gannet {

namespace {
namespace planes {

constexpr Index particle_chunk = 2048;

double height(const Plane& plane, const Line& x) { return plane.normal.dot(xyz(x) - plane.point); }

Schema schema() {
  return {{"boundaries.*",
           {.name = "penalty",
            .kind = Kind::flag,
            .text = "whether the planes push particles that come nearer than half a spacing; on "
                    "unless said"}}};
}

/// The boundary that a plane belongs to: "basin" of "basin.x_min".
Keys boundary_of(const Keys& root, const Plane& plane) {
  return root.map("boundaries").map(plane.name.substr(0, plane.name.find('.')));
}

bool switched_off(const Keys& root, const Plane& plane) {
  const Keys boundary = boundary_of(root, plane);
  return boundary.has("penalty") && !boundary.flag("penalty");
}

/// Distance at which plane k begins to push particles [m]: half of what it is elsewhere where dummy
/// particles hold them off, so that only what comes too near is pushed twice; none where it is
/// switched off.
double distance(const Scene& scene, const ParticlesOnPlanes& state, std::size_t k,
                const PlaneLaw& law) {
  if (state.pushes[k] == 0) return -std::numeric_limits<double>::infinity();
  return scene.planes[k].behind == Behind::dummy ? 0.5 * law.distance : law.distance;
}

/// Force of a plane on a particle nearer than d [m]; zero where it does not touch.
Vec3 force_on_particle(const Plane& plane, const PlaneLaw& law, double d, const Line& x) {
  const double p = d - height(plane, x);
  return p > 0 ? Vec3(plane.normal * (law.rate2 * x.w * p)) : Vec3(Vec3::Zero());
}

void add_up(std::span<const PlaneSums> chunks, std::span<PlaneSums> sums) {
  std::fill(sums.begin(), sums.end(), PlaneSums{});
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    PlaneSums& s = sums[k % sums.size()];
    s.force += chunks[k].force;
    s.work += chunks[k].work;
    s.put_in += chunks[k].put_in;
  }
}

/// Before a loop over particles: chunks that it leaves out, of particles at rest, touch nothing.
void forget_chunks(ParticlesOnPlanes& state) {
  std::fill(state.chunks.begin(), state.chunks.end(), PlaneSums{});
  std::fill(state.n_touching.begin(), state.n_touching.end(), 0);
}

/// A particle that starts behind a wall would be shot out of it: a mistake in the case.
void complain_of_particles_behind(const Keys& root, const Scene& scene,
                                  const ParticlesOnPlanes& state) {
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    if (state.pushes[k] == 0 && plane.behind == Behind::nothing) continue;
    Index n = 0;
    Index part = 0;
    for (Index i = 0; i < scene.particles.size(); ++i) {
      const Index its_part = scene.particle_part[static_cast<std::size_t>(i)];
      if (!(state.law[static_cast<std::size_t>(its_part)].distance > 0)) continue;
      if (height(plane, scene.nodes.x[static_cast<std::size_t>(scene.particles.begin + i)]) >= 0) {
        continue;
      }
      ++n;
      part = its_part;
    }
    if (n == 0) continue;
    root.mistakes().add(plane.where,
                        fmt::format("{} particles (of part '{}') start behind the wall '{}'; its "
                                    "normal ({}, {}, {}) must point to where the material is",
                                    n, scene.parts[static_cast<std::size_t>(part)].name, plane.name,
                                    plane.normal.x(), plane.normal.y(), plane.normal.z()));
  }
}

void add_measures(Scene& scene, const ParticlesOnPlanes& state) {
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    scene.measures.push_back({"plane." + scene.planes[k].name + ".force",
                              "N",
                              {"x", "y", "z"},
                              [&state, k](double* out) {
                                for (int c = 0; c < 3; ++c) out[c] = state.sums[k].force[c];
                              }});
  }
}

void size_state(const Scene& scene, ParticlesOnPlanes& state) {
  const std::size_t n_planes = scene.planes.size();
  const auto n_chunks =
      static_cast<std::size_t>((scene.particles.size() + particle_chunk - 1) / particle_chunk);
  state.sums.resize(n_planes);
  state.chunks.resize(n_chunks * n_planes);
  state.touching.resize(n_chunks * static_cast<std::size_t>(particle_chunk));
  state.n_touching.assign(n_chunks, 0);
}

void set_laws(Scene& scene, ParticlesOnPlanes& state) {
  const auto& materials = scene.store.get<ParticleMaterials>().of_part;
  state.law.resize(scene.parts.size());
  for (std::size_t p = 0; p < std::min(materials.size(), scene.parts.size()); ++p) {
    const ParticleMaterial& m = materials[p];
    if (!(m.spacing > 0)) continue;
    state.law[p] = {0.5 * m.spacing, (m.c0 / m.spacing) * (m.c0 / m.spacing)};
  }
}

void add_look(Scene& scene, ParticlesOnPlanes& state, Model& model, Ledger& ledger) {
  std::vector<LedgerEntry*> entries;
  std::vector<LedgerEntry*> put_in;
  for (const Plane& plane : scene.planes) {
    entries.push_back(&ledger.entry("contact", "plane " + plane.name));
    put_in.push_back(plane.moves ? &ledger.entry("moving plane", plane.name) : nullptr);
    if (plane.moves) put_in.back()->external = true;
  }
  Operation look;
  look.name = "contact: work at planes";
  look.reason = "rule: every plane stops every particle";
  look.stage = Stage::look;
  look.run = [&scene, &state, entries, put_in](const Step& step) {
    work_of_planes(scene, state, step);
    for (std::size_t k = 0; k < entries.size(); ++k) {
      entries[k]->add_work(state.sums[k].put_in - state.sums[k].work);
      if (put_in[k] != nullptr) put_in[k]->add_work(state.sums[k].put_in);
    }
  };
  model.plan.add(std::move(look));
}

/// Which planes push; warns where a boundary is left with nothing that stops particles.
void set_switches(const Keys& root, Scene& scene, ParticlesOnPlanes& state) {
  std::string last;
  for (const Plane& plane : scene.planes) {
    const bool off = switched_off(root, plane);
    state.pushes.push_back(off ? 0 : 1);
    const Keys boundary = boundary_of(root, plane);
    if (!off || boundary.path() == last) continue;
    last = boundary.path();
    const std::string place = boundary.where("penalty").text() + ": " + last + ".penalty: off";
    scene.warnings.push_back(
        plane.behind == Behind::nothing
            ? place + ": nothing is left that stops particles at its planes"
            : place + ": particles that come through the " +
                  (plane.behind == Behind::dummy ? "dummy particles" : "mirror") +
                  " are not pushed back, and planes that lean or turn stop nothing");
  }
}

/// The switch of planes means nothing where there are none.
void complain_of_switch_without_planes(const Keys& root) {
  if (!root.has("boundaries")) return;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    const Keys boundary = boundaries.map(name);
    if (!boundary.has("penalty") || boundary.has("planes") || boundary.has("plane")) continue;
    boundary.complain("penalty", "says how planes act; there is no 'planes' or 'plane' here");
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  complain_of_switch_without_planes(root);
  if (scene.planes.empty() || scene.particles.empty()) return;
  auto& state = scene.store.get<ParticlesOnPlanes>();
  set_laws(scene, state);
  set_switches(root, scene, state);
  complain_of_particles_behind(root, scene, state);
  size_state(scene, state);
  add_measures(scene, state);
  const auto n_pushing = std::ranges::count(state.pushes, 1);
  if (n_pushing == 0) return;
  const auto first = std::ranges::find(state.pushes, 1) - state.pushes.begin();
  Model& model = models.of_node(scene.particles.begin);
  Operation op;
  op.name = "contact: particles and planes";
  op.reason = fmt::format("rule: {} rigid planes stop every particle, the first {}", n_pushing,
                          asked_for_at(scene.planes[static_cast<std::size_t>(first)].where));
  op.stage = Stage::force;
  op.reads = {"x"};
  op.writes = {"f"};
  op.run = [&scene, &state](const Step&) { particles_on_planes(scene, state); };
  double rate2 = 0;
  for (const PlaneLaw& law : state.law) rate2 = std::max(rate2, law.rate2);
  op.stable_dt = [dt = plane_step(rate2)] { return dt; };
  op.limited_by = [] { return std::string("contact of particles and planes"); };
  model.plan.add(std::move(op));
  add_look(scene, state, model, models.ledger);
}

/// The first boundary of planes that says `penalty`; with the value.
std::string said_at(const Keys& root, const Scene& scene, bool value) {
  for (const Plane& plane : scene.planes) {
    const Keys boundary = boundary_of(root, plane);
    if (!boundary.given("penalty") || boundary.flag("penalty") != value) continue;
    return fmt::format("{}.penalty: {} at {}", boundary.path(), value ? "on" : "off",
                       boundary.where("penalty").text());
  }
  return "";
}

Presence presence(const Keys& root, Scene& scene) {
  using State = Presence::State;
  if (scene.particles.empty()) return {State::off, "no part is made of particles"};
  if (scene.planes.empty()) return {State::off, "no boundary has planes"};
  const auto& pushes = scene.store.get<ParticlesOnPlanes>().pushes;
  const auto n = std::ranges::count(pushes, 1);
  if (n == 0) return {State::off, said_at(root, scene, false)};
  const std::string asked = said_at(root, scene, true);
  if (!asked.empty()) return {State::on, asked};
  return {
      State::automatic,
      fmt::format(
          "rule: {} rigid planes stop every particle, the first {}", n,
          asked_for_at(
              scene.planes[static_cast<std::size_t>(std::ranges::find(pushes, 1) - pushes.begin())]
                  .where))};
}

std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (scene.particles.empty()) return list;
  for (const Plane& plane : scene.planes) {
    const Keys boundary = boundary_of(root, plane);
    const std::string key = boundary.path() + ".penalty";
    if (boundary.given("penalty") || (!list.empty() && list.back().key == key)) continue;
    list.push_back({key, "on", "every plane pushes particles nearer than half a spacing"});
  }
  return list;
}

}  // namespace planes
}  // namespace

double plane_step(double rate2) { return contact_step(rate2, 0); }

void particles_on_planes(Scene& scene, ParticlesOnPlanes& state) {
  const std::size_t n_planes = scene.planes.size();
  Nodes& nodes = scene.nodes;
  planes::forget_chunks(state);
  parallel_for(scene.awake().size(), planes::particle_chunk, [&](Index begin, Index end) {
    const auto chunk = static_cast<std::size_t>(begin / planes::particle_chunk);
    PlaneSums* sums = &state.chunks[chunk * n_planes];
    std::fill(sums, sums + n_planes, PlaneSums{});
    auto next = static_cast<std::size_t>(begin);
    for (Index i = begin; i < end; ++i) {
      const auto node = static_cast<std::size_t>(scene.particles.begin + i);
      const auto part = static_cast<std::size_t>(scene.particle_part[static_cast<std::size_t>(i)]);
      const PlaneLaw& law = state.law[part];
      if (!(law.distance > 0)) continue;  // the particles of a wall
      bool touches = false;
      for (std::size_t k = 0; k < n_planes; ++k) {
        const double d = planes::distance(scene, state, k, law);
        if (planes::height(scene.planes[k], nodes.x[node]) >= d) continue;
        const Vec3 f = planes::force_on_particle(scene.planes[k], law, d, nodes.x[node]);
        add_xyz(nodes.f[node], f);
        sums[k].force -= f;
        touches = true;
      }
      if (touches) state.touching[next++] = i;
    }
    state.n_touching[chunk] = static_cast<Index>(next) - begin;
  });
  planes::add_up(state.chunks, state.sums);
}

void work_of_planes(const Scene& scene, ParticlesOnPlanes& state, const Step& step) {
  const std::size_t n_planes = scene.planes.size();
  parallel_for(static_cast<Index>(state.n_touching.size()), 1, [&](Index c, Index) {
    const auto chunk = static_cast<std::size_t>(c);
    PlaneSums* sums = &state.chunks[chunk * n_planes];
    const Index begin = c * planes::particle_chunk;
    for (Index t = begin; t < begin + state.n_touching[chunk]; ++t) {
      const Index i = state.touching[static_cast<std::size_t>(t)];
      const Index node = scene.particles.begin + i;
      const auto part = static_cast<std::size_t>(scene.particle_part[static_cast<std::size_t>(i)]);
      const WorkPath path = work_path(scene.nodes, node, step);
      const Line& x = scene.nodes.x[static_cast<std::size_t>(node)];
      for (std::size_t k = 0; k < n_planes; ++k) {
        const Plane& plane = scene.planes[k];
        const PlaneLaw& law = state.law[part];
        const Vec3 f =
            planes::force_on_particle(plane, law, planes::distance(scene, state, k, law), x);
        sums[k].work += work_along(path, f);
        if (plane.moves) sums[k].put_in += work_along(path_of_plane(plane, xyz(x), step), f);
      }
    }
  });
  planes::add_up(state.chunks, state.sums);
}

WorkPath path_of_plane(const Plane& plane, const Vec3& x, const Step& step) {
  const Vec3 arm = x - plane.point;
  WorkPath path;
  path.col(0) = (plane.velocity_old + plane.spin_old.cross(arm)) * (0.5 * step.dt_old);
  path.col(1) = (plane.velocity + plane.spin.cross(arm)) * (0.5 * step.dt);
  return path;
}

Effect plane_contact_effect() {
  return {.name = "contact with planes",
          .schema = planes::schema,
          .operations = planes::operations,
          .presence = planes::presence,
          .choices = planes::choices};
}

}  // namespace gannet
