// The effect `periodic`: directions in which the domain of the particles
// repeats. Images are ghost particles, made with the neighbour lists; here are
// the keys, and the halo operations that keep images of every kind. Without a
// periodic direction or a mirror wall none of these exists.
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "sph/effects.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

Schema schema() {
  Key periodic{.name = "periodic",
               .kind = Kind::map,
               .text = "directions in which the domain of the particles repeats"};
  for (const char* axis : axes) {
    periodic.keys.push_back({.name = axis,
                             .kind = Kind::numbers,
                             .unit = dim::length,
                             .text = "lower and upper end: [from, to]"});
  }
  return {{"boundaries.*", periodic}};
}

/// The maps `periodic` of all boundaries, in file order.
std::vector<Keys> asked_for(const Keys& root) {
  std::vector<Keys> found;
  if (!root.has("boundaries")) return found;
  for (const std::string& name : root.map("boundaries").names()) {
    const Keys boundary = root.map("boundaries").map(name);
    if (boundary.has("periodic")) found.push_back(boundary.map("periodic"));
  }
  return found;
}

void read_direction(const Keys& periodic, std::size_t d, const Scene& scene, SphState& sph) {
  const std::vector<double>& ends = periodic.numbers(axes[d]);
  const double shortest = 2 * sph.h + sph.skin;
  if (static_cast<int>(d) >= scene.dimension) {
    periodic.complain(axes[d], "a plane case lies in x and y");
  } else if (ends.size() != 2 || !(ends[0] < ends[1])) {
    periodic.complain(axes[d], "two numbers are wanted, the lower end first: [from, to]");
  } else if (ends[1] - ends[0] < 2 * shortest) {
    periodic.complain(axes[d], fmt::format("the period of {:g} m is shorter than twice the reach "
                                           "{:g} m of a particle",
                                           ends[1] - ends[0], shortest));
  } else if (sph.halo.periodic[d]) {
    periodic.complain(axes[d], "this direction is periodic already");
  } else {
    sph.halo.periodic[d] = true;
    sph.halo.low[static_cast<Eigen::Index>(d)] = ends[0];
    sph.halo.high[static_cast<Eigen::Index>(d)] = ends[1];
  }
}

void make_state(const Keys& root, Scene& scene) {
  for (const Keys& periodic : asked_for(root)) {
    if (scene.particles.empty()) {
      periodic.mistakes().add(periodic.where(), periodic.path() +
                                                    ": repeats particles, and no part is made of "
                                                    "them");
      continue;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      if (periodic.has(axes[d])) {
        read_direction(periodic, d, scene, scene.store.get<SphState>());
      }
    }
  }
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (!sph.halo.active()) return;
  const std::vector<Keys> asked = asked_for(root);
  Plan& plan = models.of_node(scene.particles.begin).plan;
  const std::string reason = asked.empty() ? "rule: walls across an axis mirror the water"
                                           : asked_for_at(asked.front().where());
  plan.add({.name = "halo: add back",
            .reason = reason,
            .stage = Stage::force,
            .reads = {"f of ghosts"},
            .writes = {"f"},
            .run = [&](const Step&) { add_back(sph.halo, scene); }});
  for (const Stage stage : {Stage::half_drift, Stage::rates, Stage::drift}) {
    plan.add({.name = fmt::format("halo: copy out after {}", name_of(stage)),
              .reason = reason,
              .stage = stage,
              .reads = {"every field that ghosts copy"},
              .writes = {"ghosts"},
              .run = [&](const Step&) { copy_out(sph.halo, scene); }});
  }
}

}  // namespace

Effect periodic_effect() {
  return {.name = "periodic", .schema = schema, .state = make_state, .operations = add_operations};
}

}  // namespace gannet
