// What tests of whole runs share: reading off a scene, reading reference figures.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/simulation.hpp"
#include "sph/sph_state.hpp"
#include "time/guards.hpp"
#include "time/step.hpp"

namespace gannet::test {

inline double time_of(const Simulation& s) { return s.models.list.front().step.t; }

/// One component of a measure of the scene, "probe.front".
inline double measured(const Scene& scene, const std::string& name, int component = 0) {
  for (const Measure& m : scene.measures) {
    if (m.name != name) continue;
    std::vector<double> value(m.components.size());
    m.sample(value.data());
    return value[static_cast<std::size_t>(component)];
  }
  FAIL("no measure " << name);
  return 0;
}

inline double energy_error(Simulation& s) {
  return std::abs(s.scene.store.get<GuardState>().balance.error());
}

/// The value of all entries of that name in the ledger [J].
inline double ledger_sum(const Simulation& s, const std::string& name) {
  double sum = 0;
  for (const LedgerEntry& e : s.models.ledger.entries()) sum += e.name == name ? e.value : 0;
  return sum;
}

/// A sum over all nodes at entry to a step (x at n, v at n-1/2), and the sum of the sizes of its
/// terms.
struct Total {
  Vec3 sum = Vec3::Zero();
  double scale = 0;
};

inline Total linear_momentum(const Scene& scene) {
  Total p;
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 mv = scene.nodes.x[k].w * xyz(scene.nodes.v[k]);
    p.sum += mv;
    p.scale += mv.norm();
  }
  return p;
}

/// About the origin, without what rotating nodes add (spin_of_nodes()).
inline Total angular_momentum(const Scene& scene) {
  Total L;
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 x = xyz(scene.nodes.x[k]);
    const Vec3 v = xyz(scene.nodes.v[k]);
    L.sum += scene.nodes.x[k].w * x.cross(v);
    L.scale += scene.nodes.x[k].w * x.norm() * v.norm();
  }
  return L;
}

/// Of nodes of shells, which have a rotary inertia of their own.
inline Vec3 spin_of_nodes(const Scene& scene) {
  Vec3 sum = Vec3::Zero();
  for (Index i = scene.nodes.rotating.begin; i < scene.nodes.rotating.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    sum += scene.nodes.torque[k].w * xyz(scene.nodes.omega[k]);
  }
  return sum;
}

/// Calls f(x, v) for each particle, with its place among the particles.
template <class F>
void for_particles(const Scene& scene, F&& f) {
  for (Index k = 0; k < scene.particles.size(); ++k) {
    const auto i = static_cast<std::size_t>(scene.particles.begin + k);
    f(static_cast<std::size_t>(k), xyz(scene.nodes.x[i]), xyz(scene.nodes.v[i]));
  }
}

/// The numbers of a table with `#` lines and one line of column names above. A cell that is no
/// number is NaN.
inline std::vector<std::vector<double>> read_table(const std::string& file) {
  std::ifstream in(file);
  REQUIRE(in.good());
  std::vector<std::vector<double>> rows;
  bool names = true;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (names) {
      names = false;
      continue;
    }
    auto& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      row.push_back(end == cell.c_str() ? std::nan("") : value);
    }
  }
  return rows;
}

/// A curve through samples, straight between them and level beyond.
struct Curve {
  std::vector<double> t;
  std::vector<double> y;

  void add(double time, double value) {
    t.push_back(time);
    y.push_back(value);
  }
  [[nodiscard]] double at(double time) const {
    if (time <= t.front()) return y.front();
    const auto k = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time) - t.begin());
    if (k == t.size()) return y.back();
    return y[k - 1] + (y[k] - y[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
  }
};

/// Steps until the time is reached; calls look() after each step (x at n, v at n-1/2).
template <class F>
void run_until(Simulation& s, double until, F&& look) {
  while (time_of(s) < until) {
    advance(s.models);
    look();
  }
}

/// Lets motion die out: v and omega lose the share rate dt of themselves a step.
inline void add_drag(Simulation& s, double rate) {
  Nodes& nodes = s.scene.nodes;
  s.models.list.front().plan.add(
      {.name = "drag of the test", .stage = Stage::kick, .run = [&nodes, rate](const Step& step) {
         const double keep = std::exp(-rate * step.dt);
         for (auto* lines : {&nodes.v, &nodes.omega}) {
           for (Line& v : *lines) set_xyz(v, keep * xyz(v));
         }
       }});
}

}  // namespace gannet::test
