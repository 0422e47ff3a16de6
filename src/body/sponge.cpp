// boundaries.NAME.sponge: a box in which the velocity of water is damped towards a given one, with
// a rate that grows smoothly from the faces of the box,
//   gamma(x) = rate prod_d s(q_d),  q_d = distance to the nearer face across d / ramp,
//   s(q) = q^2 (3 - 2 q) for q in [0, 1], 1 beyond
// A wave whose velocity alone is damped at the rate gamma loses energy at that rate, for half of
// its energy is motion: its height falls as exp(-gamma t/2), so over the way L at the speed C by
// 1/e with gamma = 2 C/L.
#include "body/sponge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>

#include "body/damping.hpp"
#include "body/effects.hpp"

namespace gannet {

namespace {
namespace sponge {

struct Sponge {
  std::string name;
  Location where;
  SpongeZone zone;
  VectorFunction velocity{Vec3::Zero()};  ///< that it damps towards [m/s]
  DampingForce damping;
};

struct Sponges {
  std::deque<Sponge> list;
};

Schema schema() {
  Key box{.name = "box",
          .kind = Kind::map,
          .text = "where it acts; a face that lies a ramp beyond the water does not weaken it",
          .required = true};
  for (const char* end : {"from", "to"}) {
    box.keys.push_back({.name = end,
                        .kind = Kind::vector,
                        .unit = dim::length,
                        .text = "a corner of the box",
                        .required = true});
  }
  Key sponge{.name = "sponge", .kind = Kind::map, .text = "takes waves out of the water in a box"};
  sponge.keys = {box,
                 {.name = "ramp",
                  .unit = dim::length,
                  .text = "how far inside a face of the box the rate is full",
                  .required = true,
                  .limits = positive()},
                 {.name = "rate",
                  .unit = dim::frequency,
                  .text = "share of the velocity that is taken, per time",
                  .limits = positive()},
                 {.name = "length",
                  .unit = dim::length,
                  .text = "in place of rate: way on which a wave falls to 1/e; needs speed",
                  .limits = positive()},
                 {.name = "speed",
                  .unit = dim::velocity,
                  .text = "of the waves, for length",
                  .limits = positive()},
                 {.name = "velocity",
                  .kind = Kind::vector_function,
                  .unit = dim::velocity,
                  .text = "that it damps towards; rest unless said",
                  .variables = {"t"}}};
  return {{"boundaries.*", sponge}};
}

double read_rate(const Keys& sponge) {
  if (sponge.has("rate")) {
    for (const char* key : {"length", "speed"}) {
      if (sponge.has(key)) sponge.complain(key, "say either rate, or length and speed");
    }
    return sponge.number("rate");
  }
  if (!sponge.has("length") || !sponge.has("speed")) {
    sponge.complain("rate", "missing: rate: 5 1/s, or length: 0.5 m and speed: 2 m/s of the waves");
    return 0;
  }
  return 2 * sponge.number("speed") / sponge.number("length");
}

SpongeZone read_zone(const Keys& sponge, int dimension) {
  const Keys box = sponge.map("box");
  SpongeZone zone{dimension, box.vector("from"), box.vector("to"), sponge.number("ramp"),
                  read_rate(sponge)};
  for (int d = 0; d < dimension; ++d) {
    if (zone.low[d] < zone.high[d]) continue;
    box.complain("to", "each coordinate must be greater than that of 'from'");
    break;
  }
  return zone;
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("boundaries")) return;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    if (!boundaries.map(name).has("sponge")) continue;
    const Keys keys = boundaries.map(name).map("sponge");
    if (scene.particles.empty()) {
      keys.complain("", "damps the velocity of particles, and no part is made of 'sph'");
      continue;
    }
    Sponge& sponge = scene.store.get<Sponges>().list.emplace_back();
    sponge.name = name;
    sponge.where = keys.where();
    sponge.zone = read_zone(keys, scene.dimension);
    if (keys.has("velocity")) sponge.velocity = keys.vector_function("velocity");
    const Function& z = sponge.velocity.component[2];
    if (scene.dimension == 2 && !(z.constant() && z.factor == 0)) {
      keys.complain("velocity", "a plane case lies in x and y");
    }
    prepare_damping(sponge.damping, scene);
  }
}

void operations(const Keys& /*root*/, Scene& scene, Models& models) {
  if (!scene.store.has<Sponges>()) return;
  Plan& plan = models.of_node(scene.particles.begin).plan;
  for (Sponge& sponge : scene.store.get<Sponges>().list) {
    plan.add({.name = "sponge " + sponge.name,
              .reason = asked_for_at(sponge.where),
              .stage = Stage::kick,
              .reads = {"x", "v", "f"},
              .writes = {"v", "f"},
              .run = [&](const Step& step) {
                damp(sponge.damping, scene, step, value_at(sponge.velocity, step.t),
                     [&](const Vec3& x) { return rate_at(sponge.zone, x); });
              }});
    LedgerEntry& lost = models.ledger.entry("sponge", sponge.name);
    LedgerEntry* drive = nullptr;
    if (!(sponge.velocity.constant() && value_at(sponge.velocity, 0).isZero(0))) {
      drive = &models.ledger.entry("sponge drive", sponge.name);
      drive->external = true;
    }
    plan.add({.name = "work of sponge " + sponge.name,
              .reason = asked_for_at(sponge.where),
              .stage = Stage::look,
              .reads = {"v", "f"},
              .run = [&, drive](const Step& step) {
                const DampingWork work =
                    work_of(sponge.damping, scene, step, value_at(sponge.velocity, step.t));
                lost.add_work(work.lost);
                if (drive != nullptr) drive->add_work(work.drive);
              }});
  }
}

}  // namespace sponge
}  // namespace

double rate_at(const SpongeZone& zone, const Vec3& x) {
  double rate = zone.rate;
  for (int d = 0; d < zone.dimension; ++d) {
    const double inside = std::min(x[d] - zone.low[d], zone.high[d] - x[d]);
    if (inside <= 0) return 0;
    const double q = std::min(inside / zone.ramp, 1.0);
    rate *= q * q * (3 - 2 * q);
  }
  return rate;
}

Effect sponge_effect() {
  return {.name = "sponge",
          .schema = sponge::schema,
          .state = sponge::state,
          .operations = sponge::operations};
}

}  // namespace gannet
