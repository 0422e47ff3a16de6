// Gravity: f += m g for every node, and its work. g may be a function of time: a frame that is
// accelerated by a feels -a.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "body/effects.hpp"

namespace gannet {

namespace {
namespace gravity {

/// The nodes of one part that move with one model, and where their work is written down.
struct Share {
  int part = 0;
  std::vector<Range> nodes;
  bool mixed = false;  ///< particles of several parts lie in these ranges
  LedgerEntry* work = nullptr;
};

void add_weight(Nodes& nodes, const Range& r, const Vec3& g) {
  parallel_for(r.size(), node_chunk, [&](Index a, Index b) {
    for (Index i = r.begin + a; i < r.begin + b; ++i) {
      const double m = nodes.x[static_cast<std::size_t>(i)].w;
      add_xyz(nodes.f[static_cast<std::size_t>(i)], m * g);
    }
  });
}

/// Sums over nodes: of m v(n+1/2), and of m a with a = f/m where forces move a node.
struct Momenta {
  Vec3 of_v = Vec3::Zero();
  Vec3 of_a = Vec3::Zero();
  Momenta operator+(const Momenta& other) const { return {of_v + other.of_v, of_a + other.of_a}; }
};

Momenta momenta_of(const Scene& scene, const Share& share, const Range& computed) {
  const Nodes& nodes = scene.nodes;
  return parallel_sum(computed.size(), node_chunk, Momenta{}, [&](Index a, Index b) {
    // Plain numbers stay in registers.
    double vx = 0, vy = 0, vz = 0, ax = 0, ay = 0, az = 0;
    for (Index i = computed.begin + a; i < computed.begin + b; ++i) {
      if (share.mixed &&
          scene.particle_part[static_cast<std::size_t>(i - scene.particles.begin)] != share.part) {
        continue;
      }
      const auto k = static_cast<std::size_t>(i);
      const Line& v = nodes.v[k];
      const Line& f = nodes.f[k];
      const double m = nodes.x[k].w;
      const double s = m * v.w;
      vx += m * v.x;
      vy += m * v.y;
      vz += m * v.z;
      ax += s * f.x;
      ay += s * f.y;
      az += s * f.z;
    }
    return Momenta{{vx, vy, vz}, {ax, ay, az}};
  });
}

/// Work of the weight of a share along the path of level n: sum m g . work_path [J], with g taken
/// out of the sum.
Work work_of_weight(const Scene& scene, const Share& share, const Step& step) {
  Momenta sum;
  for (const Range& r : share.nodes) sum = sum + momenta_of(scene, share, scene.computed(r));
  const Vec3 old = sum.of_v - 0.5 * (step.dt_old + step.dt) * sum.of_a;
  return {0.5 * step.dt_old * scene.gravity.dot(old), 0.5 * step.dt * scene.gravity.dot(sum.of_v)};
}

std::vector<Share> shares_of(const Scene& scene, const Model& model, Ledger& ledger) {
  const auto n_particle_parts = std::count_if(scene.parts.begin(), scene.parts.end(),
                                              [](const Part& p) { return p.is_particles(); });
  std::vector<Share> shares;
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    const Part& part = scene.parts[p];
    // Particles are sorted among all particles, whatever their part.
    const Range all = part.is_particles() ? scene.particles : part.nodes;
    Share share{.part = static_cast<int>(p), .mixed = part.is_particles() && n_particle_parts > 1};
    Index n = 0;
    for (const Range& r : model.ranges) {
      const Range mine{std::max(r.begin, all.begin), std::min(r.end, all.end)};
      if (mine.begin >= mine.end) continue;
      share.nodes.push_back(mine);
      n += mine.size();
    }
    if (share.nodes.empty()) continue;
    // Work that is pending belongs to the steps of one model.
    const bool whole = n == all.size();
    share.work = &ledger.entry("gravity", whole ? part.name : part.name + " in " + model.name);
    share.work->external = true;
    shares.push_back(std::move(share));
  }
  return shares;
}

Schema schema() {
  return {{"loads", Key{.name = "gravity",
                        .kind = Kind::vector_function,
                        .unit = dim::acceleration,
                        .text = "acceleration of gravity: [0, 0, -9.81 m/s^2]",
                        .variables = {"t"}}}};
}

bool asked_for(const Keys& root) { return root.has("loads") && root.map("loads").has("gravity"); }

void state(const Keys& root, Scene& scene) {
  if (asked_for(root)) {
    scene.gravity = value_at(root.map("loads").vector_function("gravity"), 0);
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!asked_for(root)) return;
  const std::string reason = asked_for_at(root.map("loads").where("gravity"));
  const VectorFunction g = root.map("loads").vector_function("gravity");
  for (Model& model : models.list) {
    const std::vector<Range> ranges = model.ranges;
    model.plan.add({.name = "gravity",
                    .reason = reason,
                    .stage = Stage::force,
                    .reads = {"m"},
                    .writes = {"f"},
                    .run = [&scene, ranges, g, changes = !g.constant()](const Step& step) {
                      if (changes) scene.gravity = value_at(g, step.t);
                      for (const Range& r : ranges) {
                        add_weight(scene.nodes, scene.computed(r), scene.gravity);
                      }
                    }});
    const std::vector<Share> shares = shares_of(scene, model, models.ledger);
    model.plan.add({.name = "work of gravity",
                    .reason = reason,
                    .stage = Stage::look,
                    .reads = {"v", "f", "m"},
                    .run = [&scene, shares](const Step& step) {
                      for (const Share& share : shares) {
                        share.work->add_work(work_of_weight(scene, share, step));
                      }
                    }});
  }
}

}  // namespace gravity
}  // namespace

Effect gravity_effect() {
  return {.name = "gravity",
          .schema = gravity::schema,
          .state = gravity::state,
          .operations = gravity::operations};
}

}  // namespace gannet
