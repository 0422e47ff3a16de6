#include "contact/tie_buffer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plan/model_of_part.hpp"
#include "plan/vote_of_part.hpp"

namespace gannet {

namespace {

constexpr double share_of_step = 0.7;
constexpr int least_layers = 3;

/// Nodes of a part that a tie holds, on either side of it.
std::vector<Index> nodes_at(const PartTie& tie, const Part& part) {
  std::vector<Index> nodes;
  const auto take = [&](Index node) {
    if (part.nodes.contains(node)) nodes.push_back(node);
  };
  for (const TiedNode& row : tie.rows) {
    take(row.node);
    for (int k = 0; k < row.n; ++k) take(row.corner[static_cast<std::size_t>(k)]);
  }
  return nodes;
}

}  // namespace

int layers_from(const Part& part, const std::vector<Index>& nodes, int most) {
  const auto per_cell = static_cast<std::size_t>(nodes_per(part.cell));
  if (nodes.empty() || per_cell < 2) return 0;
  std::vector<int> layer(static_cast<std::size_t>(part.nodes.size()), -1);
  const auto at = [&](Index node) -> int& {
    return layer[static_cast<std::size_t>(node - part.nodes.begin)];
  };
  for (const Index node : nodes) at(node) = 0;
  for (int n = 0; n < most; ++n) {
    bool found = false;
    for (std::size_t c = 0; c + per_cell <= part.connectivity.size(); c += per_cell) {
      const auto cell = part.connectivity.begin() + static_cast<std::ptrdiff_t>(c);
      const auto end = cell + static_cast<std::ptrdiff_t>(per_cell);
      if (std::none_of(cell, end, [&](Index node) { return at(node) == n; })) continue;
      for (auto node = cell; node != end; ++node) {
        if (at(*node) >= 0) continue;
        at(*node) = n + 1;
        found = true;
      }
    }
    if (!found) return n;
  }
  return most;
}

std::string missing_buffer(const Scene& scene, Models& models, const PartTie& tie) {
  Model* slow = &model_of_part(scene, models, tie.part);
  Model* fast = &model_of_part(scene, models, tie.to);
  if (slow == fast) return "";
  const Part* of_slow = &scene.parts[static_cast<std::size_t>(tie.part)];
  const Part* of_fast = &scene.parts[static_cast<std::size_t>(tie.to)];
  if (models.rank(*slow) > models.rank(*fast)) {
    std::swap(slow, fast);
    std::swap(of_slow, of_fast);
  }
  if (std::round(slow->step.dt / fast->step.dt) < 2) return "";
  const double there = vote_of_part(slow->plan, of_slow->name);
  const double here = vote_of_part(fast->plan, of_fast->name);
  if (!std::isfinite(there) || !std::isfinite(here)) return "";
  const int layers = here < share_of_step * there
                         ? 0
                         : layers_from(*of_fast, nodes_at(tie, *of_fast), least_layers);
  if (layers >= least_layers) return "";
  return fmt::format(
      "'{}' ties '{}' of '{}' to '{}' of the slower '{}' with {} of elements of "
      "its step in between, where three are needed",
      tie.name, of_fast->name, fast->name, of_slow->name, slow->name,
      std::array{"no layer", "one layer", "two layers"}[static_cast<std::size_t>(layers)]);
}

}  // namespace gannet
