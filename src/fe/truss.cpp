#include "fe/truss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "base/math.hpp"
#include "fe/element_blocks.hpp"

namespace gannet {

namespace {

Vec3 along(const TrussBlock& block, const Nodes& nodes, std::size_t k) {
  return xyz(nodes.x[static_cast<std::size_t>(block.ends[2 * k + 1])]) -
         xyz(nodes.x[static_cast<std::size_t>(block.ends[2 * k])]);
}

bool slack(const TrussBlock& block, double l, double l0) { return block.tension_only && l < l0; }

/// beta + zeta l0/c: damping over stiffness [s].
double lag_of(const TrussBlock& block, double l0) {
  return block.damping_time + block.damping_ratio * l0 * std::sqrt(block.mu / block.EA);
}

/// The stable step of an element under the force F at length l [s].
double stable_step_of(const TrussBlock& block, double F, double l, double l0) {
  const double omega =
      2 * std::sqrt(std::max(block.EA / l0, l > 0 ? F / l : 0.0) / (block.mu * l0));
  const double xi = 0.5 * omega * lag_of(block, l0);
  return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

/// What leaves with an element that breaks between two levels.
void break_element(TrussBlock& block, std::size_t k, double stretch, ElementWork& work) {
  work.internal -= block.energy[k];
  work.eroded += block.energy[k] + 0.5 * block.force[k] * stretch;
  block.energy[k] = 0;
  block.force[k] = 0;
  block.damping[k] = 0;
  block.broken[k] = 1;
}

/// Brings element k to level n; r: from its first to its second node [m].
void update_element(TrussBlock& block, std::size_t k, double l, double dt_old, TrussSums& sums) {
  const double l0 = block.l0[k];
  const double stretch = l - block.length[k];
  const double elastic = truss_force(block, l, l0);
  double damping = 0;
  if (dt_old > 0 && !slack(block, l, l0)) {
    damping = block.EA / l0 * lag_of(block, l0) * stretch / dt_old;
    if (block.tension_only) damping = std::max(damping, -elastic);
  }
  block.length[k] = l;
  if (block.strength > 0 && std::abs(elastic + damping) >= block.strength) {
    break_element(block, k, stretch, sums.work);
    return;
  }
  const double energy = truss_energy(block, l, l0);
  sums.work.internal += energy - block.energy[k];
  sums.work.damping += 0.5 * (block.damping[k] + damping) * stretch;
  block.energy[k] = energy;
  block.damping[k] = damping;
  block.force[k] = elastic + damping;
}

/// Elements [begin, end): state to level n, forces added.
TrussSums pass_over(TrussBlock& block, Nodes& nodes, double dt_old, Index begin, Index end) {
  TrussSums sums;
  sums.shortest = std::numeric_limits<double>::infinity();
  for (Index e = begin; e < end; ++e) {
    const auto k = static_cast<std::size_t>(e);
    if (block.broken[k] == 0) {
      const Vec3 r = along(block, nodes, k);
      const double l = r.norm();
      update_element(block, k, l, dt_old, sums);
      const double F = block.force[k];
      const Vec3 pull = r * (l > 0 ? F / l : 0.0);
      add_xyz(nodes.f[static_cast<std::size_t>(block.ends[2 * k])], pull);
      add_xyz(nodes.f[static_cast<std::size_t>(block.ends[2 * k + 1])], -pull);
      const double dt = stable_step_of(block, F, l, block.l0[k]);
      if (dt < sums.shortest) {
        sums.shortest = dt;
        sums.element = e;
      }
    }
    sums.n_broken += block.broken[k] != 0 ? 1 : 0;
  }
  return sums;
}

}  // namespace

double truss_force(const TrussBlock& block, double l, double l0) {
  return slack(block, l, l0) ? 0.0 : block.EA * (l - l0) / l0;
}

double truss_energy(const TrussBlock& block, double l, double l0) {
  return slack(block, l, l0) ? 0.0 : 0.5 * block.EA * (l - l0) * (l - l0) / l0;
}

void rest_at_present_length(TrussBlock& block, const Nodes& nodes) {
  const std::size_t n = block.ends.size() / 2;
  block.l0.resize(n);
  block.length.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    block.length[k] = along(block, nodes, k).norm();
    block.l0[k] = block.length[k] / (1 + block.prestrain);
    if (!(block.l0[k] > 0)) {
      throw std::invalid_argument("element " + std::to_string(k + 1) + " has no length");
    }
  }
  for (auto* array : {&block.force, &block.damping, &block.energy, &block.broken}) {
    array->assign(n, 0);
  }
  block.colouring = colour_chunks(block.ends, 2, truss_chunk);
  block.sums.resize(static_cast<std::size_t>(block.colouring.n_chunks));
}

void add_truss_masses(const TrussBlock& block, Nodes& nodes) {
  for (std::size_t k = 0; k < block.ends.size(); ++k) {
    nodes.x[static_cast<std::size_t>(block.ends[k])].w += 0.5 * block.mu * block.l0[k / 2];
  }
}

ElementWork truss_pass(TrussBlock& block, Nodes& nodes, double dt_old) {
  const Index n = block.n_elements();
  for_chunks_by_colour(block.colouring, n, [&](Index chunk, Index begin, Index end) {
    block.sums[static_cast<std::size_t>(chunk)] =
        pass_over(block, nodes, dt_old, lanes * begin, std::min(n, lanes * end));
  });
  ElementWork work;
  block.shortest = std::numeric_limits<double>::infinity();
  block.limiting = -1;
  block.n_broken = 0;
  for (const TrussSums& s : block.sums) {
    work.internal += s.work.internal;
    work.damping += s.work.damping;
    work.eroded += s.work.eroded;
    block.n_broken += s.n_broken;
    if (s.shortest >= block.shortest) continue;
    block.shortest = s.shortest;
    block.limiting = s.element;
  }
  return work;
}

void add_truss_operations(Scene& scene, Model& model, Ledger& ledger, TrussBlock& block) {
  LedgerEntry& internal = ledger.entry("internal", block.name);
  model.plan.add(
      {.name = "truss " + block.name,
       .reason = "chain of " + std::to_string(block.n_elements()) + " elements",
       .stage = Stage::force,
       .reads = {"x"},
       .writes = {"f"},
       .run =
           [&scene, &block, &internal](const Step& step) {
             truss_pass(block, scene.nodes, step.dt_old);
             internal.value = std::accumulate(block.energy.begin(), block.energy.end(), 0.0);
           },
       .stable_dt = [&block] { return block.dt_factor * block.shortest; },
       .limited_by =
           [&block] { return block.name + ": element " + std::to_string(block.limiting + 1); }});
}

}  // namespace gannet
