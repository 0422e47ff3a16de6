// loads.NAME.acceleration: [ax, ay, az], a force on every node that is its mass times a function of
// place and time,
//   f += m a(x, t)
// as of a central force, a spinning frame, or a field that is not even. Beside gravity, it does not
// change what water at rest is: hydrostatic starts, density diffusion, walls of dummy particles and
// gauges know of gravity alone.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "body/effects.hpp"

namespace gannet {

namespace {
namespace acceleration {

/// A formula takes some 0.1 us: chunks of these are long enough to be worth a task.
constexpr Index chunk = 512;

struct Acceleration {
  std::string name;
  Location where;
  VectorFunction a;   ///< [m/s^2]
  Array<Line> force;  ///< one a node, made in the force stage and read at the same level [N]
};

struct Accelerations {
  std::deque<Acceleration> list;
};

Schema schema() {
  return {{"loads.*", Key{.name = "acceleration",
                          .kind = Kind::vector_function,
                          .unit = dim::acceleration,
                          .text = "of every node, by its place now and the time",
                          .variables = {"t", "x", "y", "z"}}}};
}

bool of_place(const VectorFunction& f) {
  return std::any_of(f.component.begin(), f.component.end(),
                     [](const Function& c) { return c.of_place; });
}

/// Notes a mistake where the field is not finite at the start, or leaves the plane of a plane case.
void check(const Acceleration& load, const Scene& scene, const Keys& keys) {
  const Function& z = load.a.component[2];
  if (scene.dimension == 2 && !(z.constant() && z.factor == 0)) {
    keys.complain("acceleration", "a plane case lies in x and y");
    return;
  }
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(i)]);
    const Vec3 a = value_at(load.a, 0, x);
    if (a.allFinite()) continue;
    keys.complain("acceleration",
                  fmt::format("gives [{:.6g}, {:.6g}, {:.6g}] at t = 0 for a node at [{:.6g}, "
                              "{:.6g}, {:.6g}] m; finite numbers are wanted",
                              a.x(), a.y(), a.z(), x.x(), x.y(), x.z()));
    return;
  }
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("loads")) return;
  const Keys loads = root.map("loads");
  for (const std::string& name : loads.names()) {
    if (!loads.value(name).is_map || !loads.map(name).has("acceleration")) continue;
    const Keys keys = loads.map(name);
    Acceleration& load = scene.store.get<Accelerations>().list.emplace_back();
    load.name = name;
    load.where = keys.where("acceleration");
    load.a = keys.vector_function("acceleration");
    load.force.assign(static_cast<std::size_t>(scene.nodes.n_owned), {});
    check(load, scene, keys);
  }
}

/// f += m a(x, t) over a range of nodes, and keeps it for its work.
void push(Acceleration& load, Nodes& nodes, const Range& range, double t) {
  const bool everywhere_the_same = !of_place(load.a);
  const Vec3 even = everywhere_the_same ? value_at(load.a, t) : Vec3::Zero();
  parallel_for(range.size(), chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(range.begin + k);
      const Vec3 a = everywhere_the_same ? even : value_at(load.a, t, xyz(nodes.x[i]));
      set_xyz(load.force[i], nodes.x[i].w * a);
      add_xyz(nodes.f[i], xyz(load.force[i]));
    }
  });
}

/// Sum over nodes of force . work_path [J].
Work work_of(const Acceleration& load, const Nodes& nodes, const Range& range, const Step& step) {
  const Work none = Work::Zero();
  return parallel_sum(range.size(), node_chunk, none, [&](Index begin, Index end) {
    Work work = none;
    for (Index i = range.begin + begin; i < range.begin + end; ++i) {
      work += work_along(work_path(nodes, i, step), xyz(load.force[static_cast<std::size_t>(i)]));
    }
    return work;
  });
}

void add_operations(Acceleration& load, Nodes& nodes, Model& model, LedgerEntry& work) {
  model.plan.add({.name = "acceleration " + load.name,
                  .reason = asked_for_at(load.where),
                  .stage = Stage::force,
                  .reads = {"x", "m"},
                  .writes = {"f"},
                  .run = [&load, &nodes, ranges = model.ranges](const Step& step) {
                    for (const Range& range : ranges) push(load, nodes, range, step.t);
                  }});
  model.plan.add({.name = "work of " + load.name,
                  .reason = asked_for_at(load.where),
                  .stage = Stage::look,
                  .reads = {"v", "f"},
                  .run = [&load, &nodes, &work, ranges = model.ranges](const Step& step) {
                    Work sum = Work::Zero();
                    for (const Range& range : ranges) sum += work_of(load, nodes, range, step);
                    work.add_work(sum);
                  }});
}

void operations(const Keys& /*root*/, Scene& scene, Models& models) {
  if (!scene.store.has<Accelerations>()) return;
  for (Acceleration& load : scene.store.get<Accelerations>().list) {
    for (Model& model : models.list) {
      // An entry for each model: work that is pending belongs to the steps of one.
      const bool one = models.list.size() == 1;
      LedgerEntry& work =
          models.ledger.entry("acceleration load", one ? load.name : load.name + " " + model.name);
      work.external = true;
      add_operations(load, scene.nodes, model, work);
    }
  }
}

}  // namespace acceleration
}  // namespace

Effect acceleration_effect() {
  return {.name = "acceleration",
          .schema = acceleration::schema,
          .state = acceleration::state,
          .operations = acceleration::operations};
}

}  // namespace gannet
