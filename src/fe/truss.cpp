#include "fe/truss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/math.hpp"

namespace gannet {

namespace {

Vec3 along(const TrussBlock& block, const Nodes& nodes, std::size_t k) {
  return xyz(nodes.x[static_cast<std::size_t>(block.nodes[k + 1])]) -
         xyz(nodes.x[static_cast<std::size_t>(block.nodes[k])]);
}

bool slack(const TrussBlock& block, double l, double l0) { return block.tension_only && l < l0; }

}  // namespace

double truss_force(const TrussBlock& block, double l, double l0) {
  return slack(block, l, l0) ? 0.0 : block.EA * (l - l0) / l0;
}

double truss_energy(const TrussBlock& block, double l, double l0) {
  return slack(block, l, l0) ? 0.0 : 0.5 * block.EA * (l - l0) * (l - l0) / l0;
}

void rest_at_present_length(TrussBlock& block, const Nodes& nodes) {
  const std::size_t n = block.nodes.size() - 1;
  block.l0.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    block.l0[k] = along(block, nodes, k).norm();
    if (!(block.l0[k] > 0)) {
      throw std::invalid_argument("element " + std::to_string(k + 1) + " has no length");
    }
  }
  block.force.assign(n, 0);
  block.energy.assign(n, 0);
}

void add_truss_masses(const TrussBlock& block, Nodes& nodes) {
  for (std::size_t k = 0; k < block.l0.size(); ++k) {
    for (const Index node : {block.nodes[k], block.nodes[k + 1]}) {
      nodes.x[static_cast<std::size_t>(node)].w += 0.5 * block.mu * block.l0[k];
    }
  }
}

double truss_pass(TrussBlock& block, Nodes& nodes) {
  double energy = 0;
  double highest = 0;
  for (std::size_t k = 0; k < block.l0.size(); ++k) {
    const Vec3 r = along(block, nodes, k);
    const double l = r.norm();
    const double l0 = block.l0[k];
    const double F = truss_force(block, l, l0);
    block.force[k] = F;
    block.energy[k] = truss_energy(block, l, l0);
    energy += block.energy[k];
    const Vec3 pull = r * (F / l);
    add_xyz(nodes.f[static_cast<std::size_t>(block.nodes[k])], pull);
    add_xyz(nodes.f[static_cast<std::size_t>(block.nodes[k + 1])], -pull);
    const double omega2 = 4 * std::max(block.EA / l0, F / l) / (block.mu * l0);
    if (omega2 <= highest) continue;
    highest = omega2;
    block.limiting = static_cast<Index>(k);
  }
  block.shortest = highest > 0 ? 2 / std::sqrt(highest) : std::numeric_limits<double>::infinity();
  return energy;
}

void add_truss_operations(Scene& scene, Model& model, Ledger& ledger, TrussBlock& block) {
  LedgerEntry& internal = ledger.entry("internal", block.name);
  model.plan.add(
      {.name = "truss " + block.name,
       .reason = "chain of " + std::to_string(block.n_elements()) + " elements",
       .stage = Stage::force,
       .reads = {"x"},
       .writes = {"f"},
       .run = [&scene, &block,
               &internal](const Step&) { internal.value = truss_pass(block, scene.nodes); },
       .stable_dt = [&block] { return block.dt_factor * block.shortest; },
       .limited_by =
           [&block] { return block.name + ": element " + std::to_string(block.limiting + 1); }});
}

}  // namespace gannet
