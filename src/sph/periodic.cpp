// The effect `periodic`: directions in which the domain of the particles
// repeats. Images are ghost particles, made with the neighbour lists; here are
// the keys, and the halo operations that keep images of every kind. Without a
// periodic direction or a mirror wall none of these exists.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/periods.hpp"
#include "sph/effects.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace periodic {

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

void read_direction(const Keys& periodic, std::size_t d, Scene& scene, SphState& sph) {
  const std::vector<double>& ends = periodic.numbers(axes[d]);
  const double shortest = sph.kernel.reach() + sph.skin.least;
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
    sph.skin.most = std::min(sph.skin.most, 0.5 * (ends[1] - ends[0]) - sph.kernel.reach());
    sph.skin.width = std::min(sph.skin.width, sph.skin.most);
    sph.halo.low[static_cast<Eigen::Index>(d)] = ends[0];
    sph.halo.high[static_cast<Eigen::Index>(d)] = ends[1];
    scene.store.get<Periods>().length[static_cast<Eigen::Index>(d)] = ends[1] - ends[0];
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

constexpr std::string_view copy_name = "halo: copy out after ";

bool copies_out(const Operation& op) { return op.name.starts_with(copy_name); }

/// The operations of a step that come between the last copy to ghosts and this one, going back
/// from it; a step follows another.
std::vector<const Operation*> since_last_copy(const Plan& plan, Stage stage) {
  std::vector<const Operation*> step;
  std::size_t here = 0;
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : plan.at(static_cast<Stage>(s))) {
      if (copies_out(op) && op.stage == stage) here = step.size();
      step.push_back(&op);
    }
  }
  std::vector<const Operation*> found;
  for (std::size_t back = 1; back < step.size(); ++back) {
    const Operation* op = step[(here + step.size() - back) % step.size()];
    if (copies_out(*op)) break;
    found.push_back(op);
  }
  return found;
}

/// The copied fields that an operation said to write since the last copy to ghosts: the others
/// still hold what they were given then. (Whoever makes new ghosts fills all of them.)
FieldPlaces changed_fields(const Scene& scene, const Plan& plan, Stage stage) {
  const std::vector<const Operation*> before = since_last_copy(plan, stage);
  FieldPlaces changed;
  for (const std::size_t k : copied_fields(scene)) {
    const std::string& name = scene.fields[k].name;
    const bool written = std::ranges::any_of(before, [&](const Operation* op) {
      return std::ranges::find(op->writes, name) != op->writes.end();
    });
    if (written) changed.push_back(k);
  }
  return changed;
}

/// Copies to ghosts at the end of a stage; which fields is known once all operations are there, at
/// the first step.
void add_copy(Plan& plan, Stage stage, const std::string& reason, const Halo& halo, Scene& scene) {
  auto fields = std::make_shared<std::optional<FieldPlaces>>();
  plan.add({.name = std::string(copy_name) + name_of(stage),
            .reason = reason,
            .stage = stage,
            .reads = {"what was written since the last copy out"},
            .writes = {"ghosts"},
            .run = [&plan, &halo, &scene, stage, fields](const Step&) {
              if (!*fields) *fields = changed_fields(scene, plan, stage);
              copy_out(halo, scene, **fields);
            }});
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
    add_copy(plan, stage, reason, sph.halo, scene);
  }
}

}  // namespace periodic
}  // namespace

Effect periodic_effect() {
  return {.name = "periodic",
          .schema = periodic::schema,
          .state = periodic::make_state,
          .operations = periodic::add_operations};
}

}  // namespace gannet
