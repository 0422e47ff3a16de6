// The effect `flow_probes`: how much water goes through a plane.
//
// The volume that went through since the start is counted particle by particle: one that was within
// two spacings in front of the plane and is now behind it adds its m/rho, one that comes back takes
// it off. In a periodic domain the image nearest to the plane's point counts. The rate at this
// level is the sum over particles near the plane
//   Q = sum_j (m/rho_j) (v_j . n) w(d_j),  w(d) = (1 - |d|/l)/l for |d| < l = 2 dx,
// d the distance from the plane; it is smooth where the count goes in steps.
#include <array>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "sph/effects.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace flow_probe {

Schema schema() {
  Key plane{.name = "plane", .kind = Kind::map, .text = "the plane", .required = true};
  plane.keys = {{.name = "point",
                 .kind = Kind::vector,
                 .unit = dim::length,
                 .text = "a point of it",
                 .required = true},
                {.name = "normal",
                 .kind = Kind::vector,
                 .text = "direction that counts as positive, of any length",
                 .required = true}};
  Key flow{.name = "flow",
           .kind = Kind::map,
           .text = "water through a plane: volume rate, and volume since the start"};
  flow.keys = {plane};
  return {{"probes.*", flow}};
}

/// Where a particle was when last looked at.
enum : std::uint8_t { far_off, before, behind };

struct Flow {
  std::string name;
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitX();
  Array<std::uint8_t> side;  ///< tracked, of each particle
  Array<double> volume;      ///< tracked, one entry: what went through [m^3]
};

struct Flows {
  std::deque<Flow> list;
};

void track(Flow& flow, Scene& scene) {
  const std::string prefix = "flow." + flow.name + ".";
  for (Field field :
       {plain_field(prefix + "side", "", "", Over::particles, flow.side, 1, GhostRule::none),
        plain_field(prefix + "volume", "m^3", "", Over::scene, flow.volume, 1, GhostRule::none)}) {
    field.owner = "flow_probes";
    scene.fields.push_back(std::move(field));
  }
}

void make_state(const Keys& root, Scene& scene) {
  if (!root.has("probes")) return;
  for (const std::string& name : root.map("probes").names()) {
    const Keys probe = root.map("probes").map(name);
    if (!probe.has("flow")) continue;
    if (scene.particles.empty()) {
      probe.complain("flow", "measures particles, and no part is made of them");
      continue;
    }
    const Keys plane = probe.map("flow").map("plane");
    const Vec3 normal = plane.vector("normal");
    if (!(normal.norm() > 0)) {
      plane.complain("normal", "a normal needs a length above 0");
      continue;
    }
    Flow& flow = scene.store.get<Flows>().list.emplace_back();
    flow.name = name;
    flow.point = plane.vector("point");
    flow.normal = normal.normalized();
    flow.side.assign(static_cast<std::size_t>(scene.particles.size()), far_off);
    flow.volume.assign(1, 0);
    track(flow, scene);
  }
}

/// Distance of a particle in front of (below 0) or behind the plane [m]; in periodic directions of
/// its image that is nearest to the plane's point.
double distance(const Flow& flow, const Halo& halo, const Line& x) {
  Vec3 r = xyz(x) - flow.point;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    const double period = halo.high[k] - halo.low[k];
    if (halo.periodic[d]) r[k] -= period * std::floor(r[k] / period + 0.5);
  }
  return r.dot(flow.normal);
}

/// Counts what has crossed since the last call.
void count(Flow& flow, const SphState& sph, const Scene& scene) {
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  flow.volume[0] += parallel_sum(scene.particles.size(), node_chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index k = begin; k < end; ++k) {
      const double d = distance(flow, sph.halo, x[k]);
      std::uint8_t& side = flow.side[k];
      const std::uint8_t was = side;
      side = std::abs(d) > 2 * sph.dx ? far_off : (d > 0 ? behind : before);
      if (was == before && side == behind) sum += sph.m / sph.rho[k];
      if (was == behind && side == before) sum -= sph.m / sph.rho[k];
    }
    return sum;
  });
}

/// Volume rate at level n [m^3/s]; dt: the step after it [s].
double rate(const Flow& flow, const SphState& sph, const Scene& scene, double dt) {
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  const double l = 2 * sph.dx;
  return parallel_sum(scene.particles.size(), node_chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index k = begin; k < end; ++k) {
      const double d = std::abs(distance(flow, sph.halo, x[k]));
      if (d >= l) continue;
      Vec3 v = velocity_at_level(scene.nodes, scene.particles.begin + k, dt);
      if (!sph.X.empty()) v += xyz(sph.X[k]);
      sum += sph.m / sph.rho[k] * v.dot(flow.normal) * (1 - d / l) / l;
    }
    return sum;
  });
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  const SphState& sph = scene.store.get<SphState>();
  Model& model = models.of_node(scene.particles.begin);
  for (Flow& flow : scene.store.get<Flows>().list) {
    const std::string field = "flow." + flow.name + ".side";
    model.plan.add({.name = "flow " + flow.name,
                    .reason = asked_for_at(root.map("probes").map(flow.name).where("flow")),
                    .stage = Stage::look,
                    .reads = {"x", "rho"},
                    .writes = {field},
                    .owns = {field},
                    .run = [&](const Step&) { count(flow, sph, scene); }});
    scene.measures.push_back({.name = "probe." + flow.name,
                              .unit = "m^3/s,m^3",
                              .components = {"rate", "volume"},
                              .sample = [&](double* to) {
                                to[0] = rate(flow, sph, scene, model.step.dt);
                                to[1] = flow.volume[0];
                              }});
  }
}

}  // namespace flow_probe
}  // namespace

Effect flow_probes_effect() {
  return {.name = "flow_probes",
          .schema = flow_probe::schema,
          .state = flow_probe::make_state,
          .operations = flow_probe::add_operations};
}

}  // namespace gannet
