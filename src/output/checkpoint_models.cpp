#include "output/checkpoint_models.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plan/link.hpp"

namespace gannet {

bool same_models(const CheckpointHead& head, const Models& models) {
  const auto same = [](const CheckpointHead::ModelState& a, const Model& b) {
    return a.name == b.name && (a.ranges.empty() || a.ranges == b.ranges);
  };
  return std::ranges::equal(head.models, models.list, same);
}

bool is_state_of_another(const LedgerEntry& e, const Ledger& ledger) {
  const bool state = e.name == "kinetic" || e.name == "rotary_inertia";
  return state && std::ranges::none_of(ledger.entries(), [&](const LedgerEntry& own) {
           return own.name == e.name && own.part == e.part;
         });
}

bool is_of_link(const std::string& field) {
  return field.starts_with("link.") || field.find(".linked_") != std::string::npos;
}

std::string trouble_with_models(const CheckpointHead& head, const Scene& scene) {
  for (std::size_t k = 0; k + 1 < head.models.size(); ++k) {
    if (head.models[k].ranges.empty()) return "it does not say which nodes its models had";
    for (const Part& part : scene.parts) {
      if (part.is_particles() || part.rigid || part.cell == Cell::point) continue;
      for (const Range& r : head.models[k].ranges) {
        if (r.begin >= part.nodes.end || part.nodes.begin >= r.end) continue;
        return fmt::format(
            "part '{}' was in its model '{}', whose step was longer than that of "
            "others",
            part.name, head.models[k].name);
      }
    }
  }
  return "";
}

namespace {

/// v(n - dT/2) of the nodes of a model goes to n - dt/2.
void shift_velocities(const CheckpointHead::ModelState& model, double dt, Nodes& nodes) {
  const double shift = 0.5 * (model.step.dt_old - dt);
  if (shift == 0) return;
  for (const Range& r : model.ranges) {
    for (Index i = r.begin; i < r.end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      add_xyz(nodes.v[k], shift * nodes.v[k].w * xyz(nodes.f[k]));
    }
  }
}

Field* field_of(Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.fields, name, &Field::name);
  return found == scene.fields.end() ? nullptr : &*found;
}

void set_entry(Field* field, std::size_t k, const Vec3& value) {
  if (field == nullptr) return;
  for (int d = 0; d < 3; ++d) {
    *reinterpret_cast<double*>(field->at(static_cast<Index>(k), d)) = value[d];
  }
}

/// Where the nodes of a link were a step before, and how far they have turned since, which links
/// of elements want to know.
void begin_path(const Link& link, double dt, Scene& scene) {
  const Nodes& nodes = scene.nodes;
  Field* x_level = field_of(scene, "link." + link.name + ".x_level");
  Field* turned = field_of(scene, "link." + link.name + ".turned");
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(link.nodes[k]);
    set_entry(x_level, k, xyz(nodes.x[i]) - dt * xyz(nodes.v[i]));
    if (!nodes.rotating.contains(link.nodes[k])) continue;
    set_entry(turned, k, dt * xyz(nodes.omega[i]));
  }
}

}  // namespace

void take_other_models(const CheckpointHead& head, Scene& scene, Models& models) {
  const CheckpointHead::ModelState& fast = head.models.back();
  const double dt = fast.step.dt_old;
  for (const auto& model : head.models) shift_velocities(model, dt, scene.nodes);
  for (std::size_t k = 0; k < models.list.size(); ++k) {
    Model& m = models.list[k];
    const CheckpointHead::ModelState& like = k == 0 ? head.models.front() : fast;
    m.step = like.step;
    m.step.dt_old = dt;
    m.vote = like.vote;
    m.target = like.step.t;
    m.substeps_left = 0;
  }
  if (const Links* links = scene.store.find<Links>()) {
    for (const Link* link : links->list) begin_path(*link, dt, scene);
  }
}

}  // namespace gannet
