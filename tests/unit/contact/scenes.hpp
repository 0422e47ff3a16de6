// Small scenes for contact tests, built in C++: a plate of quads and some particles.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "contact/node_to_segment.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

namespace gannet::test {

/// A sheet of nx x ny quads over [0, nx le] x [0, ny le] with nodes at shape(x, y), then
/// particles. Masses: one number each for nodes and particles.
struct Builder {
  int nx = 1, ny = 1;
  double le = 1;
  double node_mass = 1;
  double particle_mass = 1;
  std::function<Vec3(double, double)> shape = [](double x, double y) { return Vec3(x, y, 0); };
  std::vector<Vec3> particles;
  Vec3 particle_velocity = Vec3::Zero();

  [[nodiscard]] Index n_nodes() const { return static_cast<Index>((nx + 1) * (ny + 1)); }

  void add_node(Scene& s, const Vec3& x, const Vec3& v, double m) const {
    s.nodes.x.push_back({x.x(), x.y(), x.z(), m});
    s.nodes.v.push_back({v.x(), v.y(), v.z(), m > 0 ? 1 / m : 0});
    s.nodes.f.push_back({});
    s.nodes.id.push_back(static_cast<std::int64_t>(s.nodes.x.size()));
  }

  void fill(Scene& s) const {
    Part plate;
    plate.name = "plate";
    plate.kind = "shell";
    plate.cell = Cell::quad;
    plate.nodes = {0, n_nodes()};
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) add_node(s, shape(i * le, j * le), Vec3::Zero(), node_mass);
    }
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const Index a = j * (nx + 1) + i;
        for (const Index k : {a, a + 1, a + nx + 2, a + nx + 1}) plate.connectivity.push_back(k);
        plate.cell_id.push_back(static_cast<std::int64_t>(plate.cell_id.size()) + 1);
      }
    }
    Part water;
    water.name = "water";
    water.kind = "sph";
    water.nodes = {n_nodes(), n_nodes() + static_cast<Index>(particles.size())};
    for (const Vec3& x : particles) add_node(s, x, particle_velocity, particle_mass);
    s.parts = {plate, water};
    s.particles = water.nodes;
    s.particle_part.assign(particles.size(), 1);
    s.nodes.n_owned = static_cast<Index>(s.nodes.x.size());
  }
};

/// A contact "c" with the given distance and k/m; no limit to k.
inline NodeToSegment& add_contact(Scene& s, double d, double rate2, double friction = 0,
                                  double damping = 0) {
  NodeToSegment& c = make_node_to_segment(s, "c", 1, 0, friction > 0);
  c.range = GapRange::of(d);
  c.law = {rate2, 1e300, friction, damping};
  return c;
}

/// One model with leapfrog over all nodes, a fixed step and the contact.
struct Run {
  Scene& scene;
  Models models;
  double dt = 0;

  Run(Scene& s, NodeToSegment* contact, double fixed_dt) : scene(s), dt(fixed_dt) {
    Model& m = models.list.emplace_back();
    m.ranges = {{0, s.nodes.n_owned}};
    add_leapfrog(s, m, models.ledger);
    if (contact != nullptr) add_node_to_segment(s, *contact, models);
    Operation vote;
    vote.name = "fixed step";
    vote.run = [](const Step&) {};
    vote.stable_dt = [this] { return dt; };
    m.plan.add(std::move(vote));
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  Model& model() { return models.list.front(); }
  void step() { advance(models); }
};

inline Vec3 momentum(const Scene& s) {
  Vec3 p = Vec3::Zero();
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i) p += s.nodes.x[i].w * xyz(s.nodes.v[i]);
  return p;
}

inline double kinetic(const Scene& s) {
  double e = 0;
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
    e += 0.5 * s.nodes.x[i].w * xyz(s.nodes.v[i]).squaredNorm();
  }
  return e;
}

}  // namespace gannet::test
