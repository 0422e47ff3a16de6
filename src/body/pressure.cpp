#include "body/pressure.hpp"

#include <cassert>

#include "base/parallel.hpp"
#include "plan/effect.hpp"
#include "plan/model_of_part.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {

constexpr Index face_chunk = 1024;

/// Pressure at the centre of a cell at time t [Pa], positive along the normals.
double pressure_of(const PressureLoad& load, const Scene& scene, const Part& part, std::size_t cell,
                   double t) {
  const auto n = static_cast<std::size_t>(nodes_per(part.cell));
  const Index* corner = &part.connectivity[cell * n];
  // A triangle among quadrilaterals has its last corner twice.
  const std::size_t m = corner[n - 1] == corner[n - 2] ? n - 1 : n;
  Vec3 centre = Vec3::Zero();
  for (std::size_t a = 0; a < m; ++a) {
    centre += xyz(scene.nodes.x[static_cast<std::size_t>(corner[a])]);
  }
  return load.side * value_at(load.pressure, t, centre / static_cast<double>(m));
}

void push_cells(PressureLoad& load, const Scene& scene, double t) {
  const Part& part = scene.parts[static_cast<std::size_t>(load.part)];
  const auto n = static_cast<std::size_t>(nodes_per(part.cell));
  const bool of_place = load.pressure.of_place;
  const double everywhere = of_place ? 0 : load.side * value_at(load.pressure, t);
  const auto corner = [&](std::size_t k) {
    return xyz(scene.nodes.x[static_cast<std::size_t>(part.connectivity[k])]);
  };
  parallel_for(part.n_cells(), face_chunk, [&](Index begin, Index end) {
    for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) {
      const std::size_t k = c * n;
      const bool left = load.gone != nullptr && (*load.gone)[c] != 0;
      const double there = of_place ? pressure_of(load, scene, part, c, t) : everywhere;
      const double p = left ? 0 : there;
      Line* to = load.corner_force.data() + k;
      if (n == 4) {
        const auto force =
            pressure_on_quad(p, {corner(k), corner(k + 1), corner(k + 2), corner(k + 3)});
        for (std::size_t a = 0; a < 4; ++a) set_xyz(to[a], force[a]);
      } else {
        const auto force = pressure_on_triangle(p, {corner(k), corner(k + 1), corner(k + 2)});
        for (std::size_t a = 0; a < 3; ++a) set_xyz(to[a], force[a]);
      }
    }
  });
}

}  // namespace

std::array<Vec3, 4> pressure_on_quad(double p, const std::array<Vec3, 4>& x) {
  constexpr std::array<double, 4> xi{-1, 1, 1, -1};
  constexpr std::array<double, 4> eta{-1, -1, 1, 1};
  const Vec3 b = 0.25 * ((x[1] - x[0]) + (x[2] - x[3]));
  const Vec3 c = 0.25 * ((x[3] - x[0]) + (x[2] - x[1]));
  const Vec3 d = 0.25 * ((x[0] - x[1]) + (x[2] - x[3]));
  const Vec3 bc = p * b.cross(c);
  const Vec3 bd = p / 3 * b.cross(d);
  const Vec3 dc = p / 3 * d.cross(c);
  std::array<Vec3, 4> force;
  for (std::size_t a = 0; a < 4; ++a) force[a] = bc + xi[a] * bd + eta[a] * dc;
  return force;
}

std::array<Vec3, 3> pressure_on_triangle(double p, const std::array<Vec3, 3>& x) {
  const Vec3 third = p / 6 * (x[1] - x[0]).cross(x[2] - x[0]);
  return {third, third, third};
}

void prepare(PressureLoad& load, const Scene& scene) {
  const Part& part = scene.parts[static_cast<std::size_t>(load.part)];
  assert(part.cell == Cell::quad || part.cell == Cell::triangle);
  const auto n_nodes = static_cast<std::size_t>(part.nodes.size());
  const auto local = [&](Index node) { return static_cast<std::size_t>(node - part.nodes.begin); };
  load.first.assign(n_nodes + 1, 0);
  for (const Index node : part.connectivity) ++load.first[local(node) + 1];
  for (std::size_t k = 0; k < n_nodes; ++k) load.first[k + 1] += load.first[k];
  load.corners.resize(part.connectivity.size());
  std::vector<Index> next(load.first.begin(), load.first.end() - 1);
  for (std::size_t k = 0; k < part.connectivity.size(); ++k) {
    Index& slot = next[local(part.connectivity[k])];
    load.corners[static_cast<std::size_t>(slot++)] = static_cast<Index>(k);
  }
  load.corner_force.assign(part.connectivity.size(), {});
  load.force.assign(n_nodes, {});
}

void add_pressure(PressureLoad& load, Scene& scene, double t) {
  const Range nodes = scene.parts[static_cast<std::size_t>(load.part)].nodes;
  push_cells(load, scene, t);
  parallel_for(nodes.size(), face_chunk, [&](Index begin, Index end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      Vec3 sum = Vec3::Zero();
      for (Index e = load.first[k]; e < load.first[k + 1]; ++e) {
        const Index corner = load.corners[static_cast<std::size_t>(e)];
        sum += xyz(load.corner_force[static_cast<std::size_t>(corner)]);
      }
      set_xyz(load.force[k], sum);
      add_xyz(scene.nodes.f[static_cast<std::size_t>(nodes.begin) + k], sum);
    }
  });
}

Work work_of_pressure(const PressureLoad& load, const Scene& scene, const Step& step) {
  const Range nodes = scene.parts[static_cast<std::size_t>(load.part)].nodes;
  const Work none = Work::Zero();
  return parallel_sum(nodes.size(), face_chunk, none, [&](Index begin, Index end) {
    Work work = none;
    for (Index k = begin; k < end; ++k) {
      work += work_along(work_path(scene.nodes, nodes.begin + k, step),
                         xyz(load.force[static_cast<std::size_t>(k)]));
    }
    return work;
  });
}

void add_pressure_load(PressureLoad& load, Scene& scene, Models& models) {
  prepare(load, scene);
  const auto& surfaces = scene.store.get<SurfaceData>().of_part;
  const auto number = static_cast<std::size_t>(load.part);
  if (number < surfaces.size()) load.gone = surfaces[number].gone;
  Model& model = model_of_part(scene, models, load.part);
  LedgerEntry& work = models.ledger.entry("pressure load", load.name);
  work.external = true;
  model.plan.add({.name = "pressure " + load.name,
                  .reason = asked_for_at(load.where),
                  .stage = Stage::force,
                  .reads = {"x"},
                  .writes = {"f"},
                  .run = [&load, &scene](const Step& step) { add_pressure(load, scene, step.t); }});
  model.plan.add({.name = "work of " + load.name,
                  .reason = asked_for_at(load.where),
                  .stage = Stage::look,
                  .reads = {"v", "f"},
                  .run = [&load, &scene, &work](const Step& step) {
                    work.add_work(work_of_pressure(load, scene, step));
                  }});
}

}  // namespace gannet
