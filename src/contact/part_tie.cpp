#include "contact/part_tie.hpp"

#include <algorithm>
#include <cstddef>

#include "plan/effect.hpp"
#include "scene/given_velocities.hpp"

namespace gannet {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Calls f(corner, N) for the corners of a tied node.
template <class F>
void for_corners(const TiedNode& row, F&& f) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(row.n); ++k) f(at(row.corner[k]), row.N[k]);
}

/// sum N_k a_k of the corners.
Vec3 mean_of(const TiedNode& row, const Array<Line>& a) {
  Vec3 sum = Vec3::Zero();
  for_corners(row, [&](std::size_t c, double N) { sum += N * xyz(a[c]); });
  return sum;
}

/// `value` without the components of a node's velocity that are given.
Vec3 free_part(const Scene& scene, std::size_t node, Vec3 value) {
  const GivenVelocities* given = scene.store.find<GivenVelocities>();
  const unsigned mask = given == nullptr ? 0 : given->mask_of(static_cast<Index>(node));
  for (unsigned d = 0; d < 3; ++d) {
    if ((mask >> d & 1u) != 0) value[d] = 0;
  }
  return value;
}

/// Gives a share of a mass to a corner that moves at v_c; it moves at v. What is given of v_c
/// stays.
void add_mass(Scene& scene, std::size_t c, double m, const Vec3& v) {
  Nodes& nodes = scene.nodes;
  const double all = nodes.x[c].w + m;
  const Vec3 p = m * (v - xyz(nodes.v[c]));
  nodes.x[c].w = all;
  nodes.v[c].w = all > 0 ? 1 / all : 0;
  if (all > 0) add_xyz(nodes.v[c], free_part(scene, c, p / all));
}

void add_inertia(Nodes& nodes, std::size_t c, double I) {
  nodes.torque[c].w += I;
  nodes.omega[c].w = nodes.torque[c].w > 0 ? 1 / nodes.torque[c].w : 0;
}

/// sum_s (f_s + m_s g) with the forces that act at this level.
Vec3 pull_of(const PartTie& tie, const Scene& scene) {
  Vec3 pull = Vec3::Zero();
  for (std::size_t s = 0; s < tie.rows.size(); ++s) {
    const Index i = tie.rows[s].node;
    pull += xyz(scene.nodes.f[at(i)]) - excess_on_node(scene, i) + tie.mass[s] * scene.gravity;
  }
  return pull;
}

/// Adds what acts on the tied nodes to the corners, and notes there how far it is more than the
/// forces at this level.
void spread_forces(const PartTie& tie, Scene& scene, Impulses& impulses) {
  Nodes& nodes = scene.nodes;
  for (const TiedNode& row : tie.rows) {
    const Vec3 f = xyz(nodes.f[at(row.node)]);
    for_corners(row, [&](std::size_t c, double N) { add_xyz(nodes.f[c], N * f); });
    const Vec3 excess = excess_on_node(scene, row.node);
    if (!excess.isZero(0)) {
      for_corners(row, [&](std::size_t c, double N) { impulses.add(c, N * excess); });
    }
    if (!row.turns) continue;
    const Vec3 torque = xyz(nodes.torque[at(row.node)]);
    for_corners(row, [&](std::size_t c, double N) { add_xyz(nodes.torque[c], N * torque); });
  }
}

/// What impulses of links add to the acceleration of a tied node, beyond the forces that they stand
/// for. Where velocities are given they add nothing.
Vec3 jolt_of(const TiedNode& row, const Scene& scene, const Impulses& impulses) {
  Vec3 sum = Vec3::Zero();
  for_corners(row, [&](std::size_t c, double N) {
    const Vec3 excess = excess_on_node(scene, static_cast<Index>(c)) + impulses.at(c);
    sum += N * scene.nodes.v[c].w * free_part(scene, c, excess);
  });
  return sum;
}

/// Gives the nodes their masses back. The kinetic energy of a mass at the corners less that of the
/// mass at the node leaves with the tie.
void let_go(PartTie& tie, Nodes& nodes, Followers& followers) {
  for (std::size_t s = 0; s < tie.rows.size(); ++s) {
    const TiedNode& row = tie.rows[s];
    const auto i = at(row.node);
    const double m = tie.mass[s];
    tie.lost->value -= 0.5 * m * xyz(nodes.v[i]).squaredNorm();
    for_corners(row, [&](std::size_t c, double N) {
      tie.lost->value += 0.5 * N * m * xyz(nodes.v[c]).squaredNorm();
      nodes.x[c].w -= N * m;
      nodes.v[c].w = nodes.x[c].w > 0 ? 1 / nodes.x[c].w : 0;
      if (row.turns) add_inertia(nodes, c, -N * tie.inertia[s]);
    });
    nodes.x[i].w = m;
    nodes.v[i].w = m > 0 ? 1 / m : 0;
    if (row.turns) add_inertia(nodes, i, tie.inertia[s]);
    followers.leader[i] = -1;
  }
  tie.broken[0] = 1;
  tie.force.setZero();
}

/// Tied nodes are not kicked; a tie that carried too much lets go.
void release(PartTie& tie, Scene& scene, Impulses& impulses) {
  if (!tie.holds()) return;
  Nodes& nodes = scene.nodes;
  for (const TiedNode& row : tie.rows) {
    for_corners(row, [&](std::size_t c, double) { impulses.clear(c); });
  }
  if (tie.breaks_at > 0 && tie.force.norm() > tie.breaks_at) {
    return let_go(tie, nodes, scene.store.get<Followers>());
  }
  for (const TiedNode& row : tie.rows) nodes.v[at(row.node)].w = 0;
}

void place(const PartTie& tie, Nodes& nodes) {
  for (const TiedNode& row : tie.rows) set_xyz(nodes.x[at(row.node)], mean_of(row, nodes.x));
}

}  // namespace

void take_masses(PartTie& tie, Scene& scene) {
  Nodes& nodes = scene.nodes;
  tie.mass.assign(tie.rows.size(), 0);
  tie.inertia.assign(tie.rows.size(), 0);
  tie.broken.assign(1, 0);
  for (std::size_t s = 0; s < tie.rows.size(); ++s) {
    const TiedNode& row = tie.rows[s];
    const auto i = at(row.node);
    tie.mass[s] = nodes.x[i].w;
    const Vec3 v = xyz(nodes.v[i]);
    for_corners(row, [&](std::size_t c, double N) { add_mass(scene, c, N * tie.mass[s], v); });
    nodes.x[i].w = 0;
    nodes.v[i].w = 0;
    if (!row.turns) continue;
    tie.inertia[s] = nodes.torque[i].w;
    for_corners(row, [&](std::size_t c, double N) { add_inertia(nodes, c, N * tie.inertia[s]); });
    nodes.torque[i].w = 0;
    nodes.omega[i].w = 0;
  }
}

void start_tied(const PartTie& tie, Nodes& nodes, Followers& followers) {
  const auto n = static_cast<std::size_t>(nodes.n_owned);
  followers.leader.resize(n, -1);
  followers.inverse_mass.resize(n, 0);
  for (const TiedNode& row : tie.rows) {
    const auto i = at(row.node);
    set_xyz(nodes.v[i], mean_of(row, nodes.v));
    if (row.turns) set_xyz(nodes.omega[i], mean_of(row, nodes.omega));
    const auto first = std::max_element(row.N.begin(), row.N.begin() + row.n) - row.N.begin();
    followers.leader[i] = row.corner[static_cast<std::size_t>(first)];
    followers.inverse_mass[i] = 0;
    for_corners(
        row, [&](std::size_t c, double N) { followers.inverse_mass[i] += N * N * nodes.v[c].w; });
  }
}

void gather_tie(PartTie& tie, Scene& scene, Impulses& impulses) {
  if (!tie.holds()) return;
  tie.force = pull_of(tie, scene);
  spread_forces(tie, scene, impulses);
}

void follow_corners(PartTie& tie, Scene& scene, const Impulses& impulses, const Step& step) {
  if (!tie.holds()) return;
  Nodes& nodes = scene.nodes;
  const double kick = 0.5 * (step.dt_old + step.dt);
  for (std::size_t s = 0; s < tie.rows.size(); ++s) {
    const TiedNode& row = tie.rows[s];
    const auto i = at(row.node);
    const Vec3 v = mean_of(row, nodes.v);
    const Vec3 a = (v - xyz(nodes.v[i])) / kick;
    tie.force -= tie.mass[s] * (a - jolt_of(row, scene, impulses));
    set_xyz(nodes.f[i], a);
    nodes.v[i] = {v.x(), v.y(), v.z(), 1};
    if (row.turns) set_xyz(nodes.omega[i], mean_of(row, nodes.omega));
  }
}

void add_tie_operations(Scene& scene, Model& model, Ledger& ledger, PartTie& tie) {
  Nodes& nodes = scene.nodes;
  Impulses& impulses = scene.store.get<PartTies>().impulses;
  tie.lost = &ledger.entry("tie", tie.name);
  const auto add = [&](const char* what, Stage stage, std::vector<std::string> reads,
                       std::vector<std::string> writes, std::function<void(const Step&)> run) {
    model.plan.add({.name = "tie " + tie.name + ": " + what,
                    .reason = asked_for_at(tie.where),
                    .stage = stage,
                    .reads = std::move(reads),
                    .writes = std::move(writes),
                    .run = std::move(run)});
  };
  add("forces", Stage::accelerate, {"f"}, {"f", "torque"},
      [&](const Step&) { gather_tie(tie, scene, impulses); });
  add("velocities", Stage::kick, {"v", "omega"}, {"v", "f", "omega"},
      [&](const Step& step) { follow_corners(tie, scene, impulses, step); });
  add("release", Stage::half_drift, {}, {"v"}, [&](const Step&) { release(tie, scene, impulses); });
  add("places", Stage::drift, {"x"}, {"x"}, [&](const Step&) {
    if (tie.holds()) place(tie, nodes);
  });
}

}  // namespace gannet
