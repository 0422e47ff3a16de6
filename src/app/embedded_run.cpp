#include "gannet/embedded_run.hpp"

#include <stdexcept>

#include "app/simulation.hpp"
#include "scene/part_nodes.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

/// Calls f(node) for the nodes or particles of a part, in table order.
template <class F>
void for_nodes_of(const Scene& scene, const std::string& name, F&& f) {
  const int number = scene.part_number(name);
  if (number < 0) throw std::invalid_argument("no part is called '" + name + "'");
  for_nodes_of_part(scene, number, f);
}

}  // namespace

EmbeddedRun::EmbeddedRun(const std::string& case_file, const std::vector<std::string>& set)
    : simulation_(make_simulation(case_file, set)) {}
EmbeddedRun::~EmbeddedRun() = default;
EmbeddedRun::EmbeddedRun(EmbeddedRun&&) noexcept = default;
EmbeddedRun& EmbeddedRun::operator=(EmbeddedRun&&) noexcept = default;

void EmbeddedRun::advance() { gannet::advance(simulation_->models); }

double EmbeddedRun::time() const { return simulation_->models.list.front().step.t; }

std::int64_t EmbeddedRun::steps() const { return simulation_->models.list.front().step.n; }

double EmbeddedRun::last_step() const { return simulation_->models.list.front().step.dt_old; }

std::vector<std::string> EmbeddedRun::parts() const {
  std::vector<std::string> names;
  for (const Part& part : simulation_->scene.parts) names.push_back(part.name);
  return names;
}

std::vector<std::int64_t> EmbeddedRun::ids(const std::string& part) const {
  std::vector<std::int64_t> result;
  const Scene& scene = simulation_->scene;
  for_nodes_of(scene, part, [&](Index i) { result.push_back(scene.nodes.id[i]); });
  return result;
}

std::vector<double> EmbeddedRun::positions(const std::string& part) const {
  std::vector<double> result;
  const Scene& scene = simulation_->scene;
  for_nodes_of(scene, part, [&](Index i) {
    const Line& x = scene.nodes.x[i];
    result.insert(result.end(), {x.x, x.y, x.z});
  });
  return result;
}

std::vector<std::string> EmbeddedRun::measures() const {
  std::vector<std::string> names;
  for (const Measure& m : simulation_->scene.measures) names.push_back(m.name);
  return names;
}

std::vector<double> EmbeddedRun::measure(const std::string& name) const {
  for (const Measure& m : simulation_->scene.measures) {
    if (m.name != name) continue;
    std::vector<double> values(m.components.size());
    m.sample(values.data());
    return values;
  }
  throw std::invalid_argument("no measure is called '" + name + "'");
}

}  // namespace gannet
