// The effect `sph_probes`: gauges in the water, as measures of the scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "scene/surface_data.hpp"
#include "scene/surface_point.hpp"
#include "sph/effects.hpp"
#include "sph/moving_gauges.hpp"
#include "sph/probe_functions.hpp"

namespace gannet {

namespace {
namespace sph_probes {

Schema schema() {
  Key pressure{.name = "pressure", .kind = Kind::map, .text = "pressure in the water at a point"};
  pressure.keys = {{.name = "at",
                    .kind = Kind::vector,
                    .unit = dim::length,
                    .text = "the point",
                    .required = true},
                   {.name = "on",
                    .kind = Kind::text,
                    .text = "what the point moves with: a part of shells, at the place nearest to "
                            "it (read is the side that `at` lies on, or, for a point on the shell, "
                            "the one with more water); a part that is a wall; or a boundary with "
                            "planes"}};
  Key height{.name = "surface_height",
             .kind = Kind::map,
             .text = "height of the water's surface on a vertical line, from the origin"};
  height.keys = {{.name = "at",
                  .kind = Kind::numbers,
                  .unit = dim::length,
                  .text = "where the line stands: [x, y], in a plane case [x]",
                  .required = true}};
  Key front{.name = "front", .kind = Kind::map, .text = "how far the water of a part reaches"};
  front.keys = {{.name = "axis",
                 .kind = Kind::choice,
                 .text = "direction",
                 .fallback = "x",
                 .choices = {"x", "y", "z"}},
                {.name = "part",
                 .kind = Kind::reference,
                 .text = "part that is made of particles",
                 .required = true,
                 .refers_to = "parts"},
                {.name = "edge",
                 .kind = Kind::flag,
                 .text = "half a spacing is added: where the water of the foremost particle ends",
                 .fallback = "no"}};
  Key deviation{.name = "deviation",
                .kind = Kind::map,
                .text = "how far the water of a part is from a pressure that is known"};
  deviation.keys = {{.name = "part",
                     .kind = Kind::reference,
                     .text = "part that is made of particles",
                     .required = true,
                     .refers_to = "parts"},
                    {.name = "pressure",
                     .kind = Kind::function,
                     .unit = dim::pressure,
                     .text = "what it should be at the place of each particle",
                     .required = true,
                     .variables = {"x", "y", "z"}}};
  Schema s;
  for (const Key& key : {pressure, height, front, deviation}) s.push_back({"probes.*", key});
  return s;
}

/// The direction that heights are measured along: the axis nearest to "against gravity".
Eigen::Index vertical(const Scene& scene) {
  Eigen::Index axis = scene.dimension - 1;
  if (scene.gravity.norm() > 0) scene.gravity.cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// A point of the line of a surface gauge; its coordinates fill the horizontal axes in order.
Vec3 foot_of(const Keys& gauge, Eigen::Index up, int dimension) {
  const std::vector<double>& at = gauge.numbers("at");
  Vec3 foot = Vec3::Zero();
  if (static_cast<int>(at.size()) != dimension - 1) {
    gauge.complain("at", dimension == 3 ? "two numbers are wanted: [x, y]"
                                        : "one number is wanted in a plane case: [x]");
    return foot;
  }
  std::size_t next = 0;
  for (Eigen::Index d = 0; d < dimension; ++d) {
    if (d != up) foot[d] = at[next++];
  }
  return foot;
}

void add_surface(const Keys& gauge, Measure measure, Scene& scene) {
  const Eigen::Index axis = vertical(scene);
  const double sense = scene.gravity[axis] > 0 ? -1 : 1;
  const Vec3 foot = foot_of(gauge, axis, scene.dimension);
  const Vec3 up = sense * Vec3::Unit(axis);
  measure.unit = "m";
  measure.sample = [&scene, foot, up](double* value) {
    *value = surface_height_on(scene.store.get<SphState>(), scene, boxes_of(scene), foot, up);
  };
  scene.measures.push_back(std::move(measure));
}

void add_front(const Keys& gauge, Measure measure, Scene& scene) {
  const int part = scene.part_number(gauge.word("part"));
  if (part < 0 || !scene.parts[part].is_particles()) {
    gauge.complain("part", "'" + gauge.word("part") + "' is not made of particles");
    return;
  }
  const int axis = gauge.word("axis")[0] - 'x';
  measure.unit = "m";
  const double beyond = gauge.flag("edge") ? 0.5 * scene.store.get<SphState>().dx : 0;
  measure.sample = [&scene, part, axis, beyond](double* value) {
    *value = front_of_part(scene, part, axis) + beyond;
  };
  scene.measures.push_back(std::move(measure));
}

/// sqrt(mean (p_i - p(x_i))^2) over the particles of a part, and the largest |p_i - p(x_i)| [Pa].
std::array<double, 2> deviation_of(Scene& scene, int part, const Function& pressure) {
  struct Sum {
    double square = 0, largest = 0, n = 0;
  };
  const SphState& sph = scene.store.get<SphState>();
  const auto of_chunk = [&](Index begin, Index end) {
    Sum sum;
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      if (scene.particle_part[k] != part) continue;
      const auto i = static_cast<std::size_t>(scene.particles.begin) + k;
      const double d = sph.p[k] - value_at(pressure, 0, xyz(scene.nodes.x[i]));
      sum.square += d * d;
      sum.largest = std::max(sum.largest, std::abs(d));
      ++sum.n;
    }
    return sum;
  };
  const Sum all =
      parallel_reduce(scene.particles.size(), 512, Sum{}, of_chunk, [](const Sum& a, const Sum& b) {
        return Sum{a.square + b.square, std::max(a.largest, b.largest), a.n + b.n};
      });
  return {std::sqrt(all.square / all.n), all.largest};
}

void add_deviation(const Keys& gauge, Measure measure, Scene& scene) {
  const int part = scene.part_number(gauge.word("part"));
  if (part < 0 || !scene.parts[part].is_particles()) {
    gauge.complain("part", "'" + gauge.word("part") + "' is not made of particles");
    return;
  }
  measure.unit = "Pa";
  measure.components = {"rms", "largest"};
  measure.sample = [&scene, part, pressure = gauge.function("pressure")](double* value) {
    const auto found = deviation_of(scene, part, pressure);
    std::copy(found.begin(), found.end(), value);
  };
  scene.measures.push_back(std::move(measure));
}

/// A gauge that sits on a wall or a plane; false where it sits on something else.
bool add_pressure_on_wall(const Keys& gauge, Measure& measure, Scene& scene) {
  const MovingGauge* place =
      gauge_on_wall(measure.name, gauge.word("on"), gauge.vector("at"), scene);
  if (place == nullptr) return false;
  measure.sample = [&scene, place](double* value) {
    *value = pressure_at(scene.store.get<SphState>(), scene, boxes_of(scene), place->x);
  };
  scene.measures.push_back(std::move(measure));
  return true;
}

/// A gauge that sits on a part.
void add_pressure_on(const Keys& gauge, Measure measure, Scene& scene) {
  if (add_pressure_on_wall(gauge, measure, scene)) return;
  const int part = scene.part_number(gauge.word("on"));
  const std::string kind = part >= 0 ? scene.parts[static_cast<std::size_t>(part)].kind : "";
  const bool shells = kind == "shell" || kind == "rigid_surface";
  const SurfacePoint point =
      shells ? nearest_on_part(scene, part, gauge.vector("at")) : SurfacePoint{};
  if (point.n == 0) {
    gauge.complain("on",
                   "'" + gauge.word("on") +
                       "' is neither a part of shells, nor a wall, nor a boundary with planes");
    return;
  }
  const auto& surfaces = scene.store.get<SurfaceData>().of_part;
  const auto at = static_cast<std::size_t>(part);
  const double thickness = at < surfaces.size() ? surfaces[at].thickness : 0;
  const double dx = scene.store.get<SphState>().dx;
  const double side = std::abs(point.height) < 1e-3 * dx ? 0 : std::copysign(1, point.height);
  measure.sample = [&scene, point, side, distance = 0.5 * (thickness + dx)](double* value) {
    const WettedPoint here{place_of(point, scene.nodes), normal_of(point, scene.nodes), distance,
                           side};
    *value = pressure_beside(scene.store.get<SphState>(), scene, boxes_of(scene), here);
  };
  scene.measures.push_back(std::move(measure));
}

void add_pressure(const Keys& gauge, Measure measure, Scene& scene) {
  const Vec3 at = gauge.vector("at");
  measure.unit = "Pa";
  if (gauge.has("on")) return add_pressure_on(gauge, std::move(measure), scene);
  measure.sample = [&scene, at](double* value) {
    *value = pressure_at(scene.store.get<SphState>(), scene, boxes_of(scene), at);
  };
  scene.measures.push_back(std::move(measure));
}

void make_state(const Keys& root, Scene& scene) {
  using Add = void (*)(const Keys&, Measure, Scene&);
  const std::array<std::pair<const char*, Add>, 4> kinds{{{"pressure", add_pressure},
                                                          {"surface_height", add_surface},
                                                          {"front", add_front},
                                                          {"deviation", add_deviation}}};
  if (!root.has("probes")) return;
  for (const std::string& name : root.map("probes").names()) {
    const Keys probe = root.map("probes").map(name);
    for (const auto& [key, add] : kinds) {
      if (!probe.has(key)) continue;
      if (scene.particles.empty()) {
        probe.complain(key, "measures particles, and no part is made of them");
        continue;
      }
      scene.store.get<ParticleBoxes>();
      add(probe.map(key),
          {.name = "probe." + name, .unit = "", .components = {"value"}, .sample = {}}, scene);
    }
  }
}

/// Where particles are is found anew at each level that a gauge is read at.
void add_operations(const Keys&, Scene& scene, Models& models) {
  if (!scene.store.has<ParticleBoxes>()) return;
  add_gauge_motion(scene, models);
  auto& boxes = scene.store.get<ParticleBoxes>();
  models.of_node(scene.particles.begin)
      .plan.add({.name = "gauges look anew",
                 .reason = "rule: boxes of particles are found when a probe is read",
                 .stage = Stage::drift,
                 .run = [&boxes](const Step&) { boxes.fresh = false; }});
}

}  // namespace sph_probes
}  // namespace

Effect sph_probes_effect() {
  return {.name = "sph_probes",
          .schema = sph_probes::schema,
          .state = sph_probes::make_state,
          .operations = sph_probes::add_operations};
}

}  // namespace gannet
