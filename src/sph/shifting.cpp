// The effect `shifting`: particles drift from where they are crowded to where there is room, so
// that they stay evenly spread,
//   u_i = -4 h U C_i,   C_i = sum_j V (1 + 0.2 (W_ij/W(dx))^4) grad_i W_ij,   |u_i| <= U/2
// U is the coefficient times the largest speed at the moment. Sun, Colagrossi, Marrone and Zhang
// 2017, Comput. Methods Appl. Mech. Eng. 315, 25 (delta-plus-SPH), as a velocity.
//
// The free surface is left alone: there C_i points out of the water along the normal whatever the
// spread is. With d = div r over the dimension, a particle below 0.75 does not shift; up to 0.95
// the part of u_i along C_i, the normal, goes in linearly.
//
// Like XSPH it moves positions and leaves velocities: momentum and the energies that are functions
// of v and rho do not change; what the weight of shifted particles would have done stands in the
// entry `shifting`, which is shown and not added.
#include <algorithm>
#include <cmath>
#include <vector>

#include "plan/effect.hpp"
#include "sph/concentration.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace shifting {

/// div r over the dimension: below the first a particle is at the surface, above the second inside.
constexpr double at_surface = 0.75;
constexpr double inside = 0.95;

struct Shifting {
  double coefficient = 0;
};

Schema schema() {
  Key shifting{
      .name = "shifting",
      .kind = Kind::map,
      .text = "particles drift apart where they are crowded; the free surface is left alone"};
  shifting.keys = {{.name = "coefficient",
                    .text = "largest speed of the drift over half the largest speed of the flow",
                    .fallback = "0.5",
                    .limits = between(0, 2)}};
  return {{"effects", shifting}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "shifting", scene)) return;
  auto& shifting = scene.store.get<Shifting>();
  shifting.coefficient = root.map("effects").map("shifting").number("coefficient");
  if (shifting.coefficient == 0) return;
  auto& sph = scene.store.get<SphState>();
  want_concentration(sph, scene, "shifting");
  sph.shift.assign(static_cast<std::size_t>(scene.particles.size()), {});
  // Kept in checkpoints: how long lists last is judged by the shift of the step before.
  Field field = line_field("shift", "m/s", "", Over::particles, sph.shift, 0, 3, GhostRule::none);
  field.owner = "shifting";
  scene.fields.push_back(std::move(field));
}

double largest_speed(const Scene& scene) {
  const Line* v = scene.nodes.v.data() + scene.particles.begin;
  return parallel_reduce(
      scene.awake().size(), node_chunk, 0.0,
      [&](Index begin, Index end) {
        double most = 0;
        for (Index k = begin; k < end; ++k) most = std::max(most, xyz(v[k]).squaredNorm());
        return std::sqrt(most);
      },
      [](double a, double b) { return std::max(a, b); });
}

/// The drift of a particle for U [m/s].
Vec3 drift_of(const SphState& sph, Index k, double U) {
  const Vec3 C = xyz(sph.concentration[k]);
  const double d = sph.concentration[k].w / sph.kernel.dimension;
  if (d < at_surface) return Vec3::Zero();
  Vec3 u = -4 * sph.h * U * C;
  const double size = u.norm();
  if (size > 0.5 * U) u *= 0.5 * U / size;
  // All of u lies along C, which near the surface is its normal: what is left grows from 0.
  return std::clamp((d - at_surface) / (inside - at_surface), 0.0, 1.0) * u;
}

void find_shift(SphState& sph, const Scene& scene, double U) {
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const bool held = scene.nodes.v[scene.particles.begin + k].w == 0;
      set_xyz(sph.shift[k], held ? Vec3(Vec3::Zero()) : drift_of(sph, k, U));
    }
  });
}

void move(const SphState& sph, Scene& scene, double dt) {
  Line* x = scene.nodes.x.data() + scene.particles.begin;
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) add_xyz(x[k], dt * xyz(sph.shift[k]));
  });
}

/// Work of the weight along the drift that no work path holds: sum m g . u dt [J].
double work_of_weight(const SphState& sph, const Scene& scene, int part, double dt) {
  return sph.m * dt *
         sum_over_awake(scene, part, [&](Index k) { return scene.gravity.dot(xyz(sph.shift[k])); });
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  const double coefficient = scene.store.get<Shifting>().coefficient;
  if (coefficient == 0) return;
  auto& sph = scene.store.get<SphState>();
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry("shifting", scene.parts[part].name));
    entries.back()->within_other = true;
  }
  models.of_node(scene.particles.begin)
      .plan.add({.name = "shifting",
                 .reason = asked_for_at(root.map("effects").where("shifting")),
                 .stage = Stage::drift,
                 .reads = {"concentration", "v"},
                 .writes = {"shift", "x"},
                 .owns = {"shift"},
                 .run = [&, entries, coefficient](const Step& step) {
                   find_shift(sph, scene, coefficient * largest_speed(scene));
                   move(sph, scene, step.dt);
                   for (std::size_t k = 0; k < entries.size(); ++k) {
                     entries[k]->value += work_of_weight(sph, scene, sph.parts[k], step.dt);
                   }
                 }});
}

}  // namespace shifting
}  // namespace

Effect shifting_effect() {
  return {.name = "shifting",
          .schema = shifting::schema,
          .state = shifting::make_state,
          .operations = shifting::add_operations};
}

}  // namespace gannet
