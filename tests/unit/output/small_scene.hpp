// A scene small enough to check by hand: a shell of 2 x 2 quads, a line of two bars, and two parts
// of particles that lie mixed in memory; with a plan that moves it.
#pragma once

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "output/run_record.hpp"
#include "plan/plan.hpp"
#include "scene/draft.hpp"
#include "time/guards.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

namespace gannet::test {

namespace fs = std::filesystem;

/// A folder that is empty at the start and gone at the end.
struct EmptyFolder {
  std::string path;
  explicit EmptyFolder(const std::string& name)
      : path((fs::temp_directory_path() / ("gannet_" + name + "_" + std::to_string(getpid())))
                 .string()) {
    fs::remove_all(path);
    fs::create_directories(path + "/vtk");
    fs::create_directories(path + "/history");
  }
  ~EmptyFolder() { fs::remove_all(path); }
  EmptyFolder(const EmptyFolder&) = delete;
  EmptyFolder& operator=(const EmptyFolder&) = delete;
};

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// All files below a folder that pass, by relative name.
inline std::map<std::string, std::string> all_files(const std::string& folder,
                                                    const std::string& without) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && name.find(without) == std::string::npos) {
      files[name] = read_file(entry.path().string());
    }
  }
  return files;
}

inline PartDraft panel_draft() {
  PartDraft panel{.name = "panel", .kind = "shell", .rotations = true, .cell = Cell::quad};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) panel.points.emplace_back(0.1 * i, 0.1 * j, 0.0);
  }
  for (const int a : {0, 1, 3, 4}) {
    for (const int corner : {a, a + 1, a + 4, a + 3}) panel.connectivity.push_back(corner);
  }
  panel.velocity = {0, 0, -6};
  return panel;
}

inline PartDraft bars_draft() {
  PartDraft bars{.name = "bars & more", .kind = "truss", .cell = Cell::line};
  for (int i = 0; i < 3; ++i) bars.points.emplace_back(0.0, 0.2 * i, 1.0);
  bars.connectivity = {0, 1, 1, 2};
  return bars;
}

inline PartDraft particles_draft(const std::string& name, int n, double z) {
  PartDraft p{.name = name, .kind = "sph"};
  for (int i = 0; i < n; ++i) p.points.emplace_back(0.01 * i, 0.02 * i, z);
  return p;
}

/// Built where it stays: fields and operations point into it.
struct SmallScene {
  Scene scene;
  Models models;
  Array<double> rho;
  Array<double> p;
  Array<double> stress;  ///< six a cell of the panel
  Array<double> eps_p;   ///< in blocks of eight cells, two components
  Array<double> pairs;   ///< a list whose length varies
  Array<Index> marked;   ///< an index list
  int rebuilt = 0;       ///< calls of after_restart
  double dt = 1.3e-4;

  static constexpr Index n_pool = 5;
  static constexpr Index n_drop = 3;
  static constexpr Index n_particles = n_pool + n_drop;

  SmallScene() {
    Draft draft;
    draft.parts = {particles_draft("pool", n_pool, -1.0), panel_draft(), bars_draft(),
                   particles_draft("drop", n_drop, -2.0)};
    assemble(draft, scene);
    // As after a spatial sort: the two parts are mixed in memory.
    for (Index k = 0; k < n_particles; ++k) {
      scene.particle_part[static_cast<std::size_t>(k)] = k % 3 == 1 ? 3 : 0;
    }
    for (auto& x : scene.nodes.x) x.w = 2.0;
    for (auto& torque : scene.nodes.torque) torque.w = 0.5;
    finish_masses(scene);
    add_fields();
    add_plan();
  }
  SmallScene(const SmallScene&) = delete;
  SmallScene& operator=(const SmallScene&) = delete;

  RunRecord& record() { return scene.store.get<RunRecord>(); }

  void add_fields() {
    for (Index k = 0; k < n_particles; ++k) {
      rho.push_back(1000.0 + k);
      p.push_back(10.0 * k);
    }
    for (int k = 0; k < 4 * 6; ++k) stress.push_back(1e6 + k);
    for (int k = 0; k < 16; ++k) eps_p.push_back(0.01 * k);
    pairs = {1.5, 2.5};
    marked = {1, 4, 6};
    auto track = [&](Field f) { scene.fields.push_back(std::move(f)); };
    track(plain_field("rho", "kg/m^3", "Density", Over::particles, rho, 1, GhostRule::copy));
    track(plain_field("p", "Pa", "Pressure", Over::particles, p, 1, GhostRule::copy));
    Field s = plain_field("panel.stress", "Pa", "Stress", Over::cells, stress, 6, GhostRule::none);
    s.part = 1;
    track(std::move(s));
    track(blocked_field());
    track(plain_field("pairs", "", "", Over::scene, pairs, 1, GhostRule::none));
    scene.index_lists.push_back({"marked", &marked});
    scene.after_restart.push_back([this] { ++rebuilt; });
  }

  /// Four cells in one block of eight lanes: component c of cell e is number 8 c + e.
  Field blocked_field() {
    Field f =
        plain_field("panel.eps_p", "-", "PlasticStrain", Over::cells, eps_p, 1, GhostRule::none);
    f.part = 1;
    f.components = 2;
    f.layout = {16 * 8, 8, 8 * 8, 8};
    f.count = [] { return Index{4}; };
    return f;
  }

  /// Springs to the origin, a changing step, a density that follows, an energy entry each.
  void add_plan() {
    Model& model = models.list.emplace_back();
    model.ranges = {{0, scene.nodes.n_owned}};
    add_leapfrog(scene, model, models.ledger);
    LedgerEntry& spring = models.ledger.entry("internal", "springs");
    model.plan.add({.name = "springs",
                    .stage = Stage::force,
                    .run =
                        [this](const Step&) {
                          for (std::size_t i = 0; i < scene.nodes.f.size(); ++i) {
                            add_xyz(scene.nodes.f[i], -300.0 * xyz(scene.nodes.x[i]));
                          }
                        },
                    .stable_dt =
                        [this] {
                          const auto n = models.list.front().step.n;
                          return dt * (1 + 0.3 * static_cast<double>(n % 5));
                        },
                    .limited_by = [] { return std::string("springs: node 3"); }});
    model.plan.add(
        {.name = "spring energy", .stage = Stage::look, .run = [this, &spring](const Step&) {
           spring.value = 0;
           for (const Line& x : scene.nodes.x) {
             spring.value += 150.0 * xyz(x).squaredNorm();
           }
         }});
    model.plan.add({.name = "density", .stage = Stage::rates, .run = [this](const Step& s) {
                      for (std::size_t k = 0; k < rho.size(); ++k) {
                        rho[k] += s.dt * static_cast<double>(k);
                        p[k] = 1e3 * (rho[k] - 1000.0);
                      }
                      pairs.push_back(s.t);
                    }});
    scene.measures.push_back({"probe.tip", "m", {"x", "z"}, [this](double* to) {
                                to[0] = scene.nodes.x[0].x;
                                to[1] = scene.nodes.x[0].z;
                              }});
    scene.measures.push_back(
        {"contact.slam.force", "N", {"value"}, [this](double* to) { to[0] = scene.nodes.f[0].z; }});
    scene.measures.push_back({"mass.pool", "kg", {"value"}, [](double* to) { to[0] = 1; }});
  }
};

}  // namespace gannet::test
