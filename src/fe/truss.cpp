#include "fe/truss.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "base/isa.hpp"
#include "base/math.hpp"
#include "fe/element_blocks.hpp"

namespace gannet {

namespace {

double length_of(const TrussBlock& block, const Nodes& nodes, Index e) {
  const auto k = static_cast<std::size_t>(2 * e);
  return (xyz(nodes.x[static_cast<std::size_t>(block.ends[k + 1])]) -
          xyz(nodes.x[static_cast<std::size_t>(block.ends[k])]))
      .norm();
}

/// Sets one element up; lanes without an element have no stiffness.
void set_element(TrussBlock& block, Index e, double length) {
  const double l0 = block.unstretched > 0 ? block.unstretched : length / (1 + block.prestrain);
  const auto put = [&](TrussValue k, double value) {
    block.state[place_in_blocks(e, k, truss_values)] = value;
  };
  put(truss_l0, l0);
  put(truss_length, length);
  put(truss_stiffness, e < block.n_elements() ? block.EA / l0 : 0);
}

TrussPass pass_of(TrussBlock& block, Nodes& nodes, double dt_old) {
  return {
      .EA = block.EA,
      .corners_of_law = block.law.data(),
      .n_corners = static_cast<int>(block.law.size()),
      .mu = block.mu,
      .tension_only = block.tension_only,
      .damping_ratio = block.damping_ratio,
      .damping_time = block.damping_time,
      .strength = block.strength,
      .x = &nodes.x.data()->x,
      .f = &nodes.f.data()->x,
      .corners = block.corners.data(),
      .state = block.state.data(),
      .votes = {.inverse_mass = block.inverse_mass.empty() ? nullptr : block.inverse_mass.data()},
      .dt = dt_old};
}

}  // namespace

std::vector<TrussCorner> law_through(const std::vector<std::array<double, 2>>& points) {
  std::vector<TrussCorner> corners;
  std::array<double, 2> last{0, 0};
  double slope = 0;
  for (const auto& p : points) {
    const double next = (p[1] - last[1]) / (p[0] - last[0]);
    corners.push_back({last[0], next - slope});
    slope = next;
    last = p;
  }
  return corners;
}

void rest_at_present_length(TrussBlock& block, const Nodes& nodes) {
  const Index n = block.n_elements();
  const Index n_lanes = lanes * blocks_for(n);
  block.corners = corners_by_block(block.ends, 2);
  block.state.assign(static_cast<std::size_t>(n_lanes * truss_values), 0);
  for (Index e = 0; e < n_lanes; ++e) {
    const double length = length_of(block, nodes, std::min(e, n - 1));
    if (!(length > 0)) {
      throw std::invalid_argument("element " + std::to_string(e + 1) + " has no length");
    }
    set_element(block, e, length);
  }
  block.colouring = colour_chunks(block.ends, 2, truss_chunk);
  block.sums.resize(static_cast<std::size_t>(block.colouring.n_chunks));
}

Array<double> bounds_of(const TrussBlock& block, const Nodes& nodes) {
  TrussBlock copy = block;
  Nodes scratch;
  scratch.x = nodes.x;
  scratch.f.assign(nodes.f.size(), {});
  Array<double> bounds(static_cast<std::size_t>(lanes * blocks_for(block.n_elements())), 0);
  TrussPass pass = pass_of(copy, scratch, 0);
  pass.votes.omega2 = bounds.data();
  TrussSums sums;
  isa() == Isa::avx512 ? avx512::truss_force_pass(pass, 0, blocks_for(block.n_elements()), sums)
                       : avx2::truss_force_pass(pass, 0, blocks_for(block.n_elements()), sums);
  return bounds;
}

void add_truss_masses(const TrussBlock& block, Nodes& nodes) {
  for (std::size_t k = 0; k < block.ends.size(); ++k) {
    nodes.x[static_cast<std::size_t>(block.ends[k])].w +=
        0.5 * block.mu * block.value(static_cast<Index>(k / 2), truss_l0);
  }
}

ElementWork truss_pass(TrussBlock& block, Nodes& nodes, double dt_old) {
  const TrussPass pass = pass_of(block, nodes, dt_old);
  for_chunks_by_colour(block.colouring, block.n_elements(),
                       [&](Index chunk, Index begin, Index end) {
                         TrussSums& sums = block.sums[static_cast<std::size_t>(chunk)];
                         isa() == Isa::avx512 ? avx512::truss_force_pass(pass, begin, end, sums)
                                              : avx2::truss_force_pass(pass, begin, end, sums);
                       });
  ElementWork work;
  TrussSums all;
  for (const TrussSums& s : block.sums) {
    work.internal += s.internal;
    work.damping += s.damping;
    work.eroded += s.eroded;
    all.broken += s.broken;
    if (s.rate <= all.rate) continue;
    all.rate = s.rate;
    all.element = s.element;
  }
  block.n_broken = static_cast<Index>(all.broken);
  block.limiting = all.element;
  block.shortest = all.rate > 0 ? 2 / all.rate : std::numeric_limits<double>::infinity();
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
             internal.value = 0;
             for (Index e = 0; e < block.n_elements(); ++e) {
               internal.value += block.value(e, truss_energy);
             }
           },
       .stable_dt = [&block] { return block.dt_factor * block.shortest; },
       .limited_by =
           [&block] { return block.name + ": element " + std::to_string(block.limiting + 1); }});
}

}  // namespace gannet
