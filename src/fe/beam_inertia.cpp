#include "fe/beam_inertia.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <cstddef>

#include "base/error.hpp"
#include "base/free_rotation.hpp"
#include "base/parallel.hpp"
#include "fe/beam_mass.hpp"
#include "fe/beam_turns.hpp"
#include "plan/effect.hpp"
#include "scene/given_rotations.hpp"

namespace gannet {

namespace {

constexpr Index beam_node_chunk = 256;

Quaternion turn_of(const BeamBlock& block, Index k) {
  const Line& line = block.turned[static_cast<std::size_t>(k)];
  return {line.x, line.y, line.z, line.w};
}

bool has_own(const BeamInertia& inertia, const Nodes& nodes, Index k, std::size_t i) {
  return inertia.own[static_cast<std::size_t>(k)] != 0 && nodes.omega[i].w > 0;
}

/// Takes what the node table has now.
void fit(BeamInertia& inertia, const Nodes& nodes, std::size_t k, std::size_t i) {
  double added = nodes.torque[i].w - inertia.number[k];
  if (!(added > 1e-12 * inertia.number[k])) added = 0;
  if (inertia.own[k] == 0 || added == inertia.added[k]) return;
  inertia.added[k] = added;
  inertia.J[k] = inertia.of_elements[k] + added * Mat3::Identity();
  inertia.inverse[k] = inertia.J[k].inverse();
}

}  // namespace

BeamInertia beam_inertia(const BeamBlock& block, const Nodes& nodes,
                         const std::vector<Index>& given) {
  const auto n = static_cast<std::size_t>(block.nodes.size());
  BeamInertia result;
  result.of_elements.assign(n, Mat3::Zero());
  result.number.assign(n, 0);
  result.own.assign(n, 1);
  for (std::size_t e = 0; e < block.l0.size(); ++e) {
    const BeamNodeMass mass = node_mass(block, static_cast<Index>(e));
    const Mat3 R = block.frame[e].toRotationMatrix();
    const Mat3 J = R * mass.I.asDiagonal() * R.transpose();
    for (const std::size_t end : {2 * e, 2 * e + 1}) {
      const auto k = static_cast<std::size_t>(block.ends[end] - block.nodes.begin);
      result.of_elements[k] += J;
      result.number[k] += mass.largest();
    }
  }
  result.added.assign(n, -1);
  result.J.assign(n, Mat3::Identity());
  result.inverse.assign(n, Mat3::Identity());
  for (std::size_t k = 0; k < n; ++k) {
    const Index node = block.nodes.begin + static_cast<Index>(k);
    const bool fixed = std::binary_search(given.begin(), given.end(), node);
    if (fixed || !(result.number[k] > 0)) result.own[k] = 0;
    fit(result, nodes, k, static_cast<std::size_t>(node));
  }
  return result;
}

Vec3 spin_of(const BeamInertia& inertia, const BeamBlock& block, const Nodes& nodes, Index k,
             double dt_old) {
  const auto i = static_cast<std::size_t>(block.nodes.begin + k);
  const Vec3 omega = xyz(nodes.omega[i]);
  if (!has_own(inertia, nodes, k, i)) return nodes.torque[i].w * omega;
  const Quaternion A = turn_of(block, k);
  const Vec3 Omega = A.conjugate() * omega;
  const Vec3 Pi = inertia.J[static_cast<std::size_t>(k)] * Omega;
  return A * (Pi + 0.5 * dt_old * Pi.cross(Omega));
}

void turn_by_inertia(BeamInertia& inertia, const BeamBlock& block, std::span<const Index> mine,
                     Nodes& nodes, const Step& step) {
  const double dt_kick = 0.5 * (step.dt_old + step.dt);
  parallel_for(std::ssize(mine), beam_node_chunk, [&](Index begin, Index end) {
    for (Index j = begin; j < end; ++j) {
      const Index k = mine[static_cast<std::size_t>(j)];
      const auto i = static_cast<std::size_t>(block.nodes.begin + k);
      if (!has_own(inertia, nodes, k, i)) continue;
      fit(inertia, nodes, static_cast<std::size_t>(k), i);
      const Vec3 L =
          spin_of(inertia, block, nodes, k, step.dt_old) + dt_kick * xyz(nodes.torque[i]);
      const FreeRotation turn = rotate_freely(
          turn_of(block, k), L, inertia.inverse[static_cast<std::size_t>(k)], step.dt);
      if (!turn.settled) {
        throw RunError({"the rotation of a node could not be found",
                        fmt::format("{}: node {}", block.name, nodes.id[i]),
                        fmt::format("at t = {:.6g} s, step {}", step.t, step.n),
                        "look for torques that grow without bound there"});
      }
      set_xyz(nodes.torque[i], (turn.omega - xyz(nodes.omega[i])) / (nodes.omega[i].w * dt_kick));
    }
  });
}

double energy_of_inertia(const BeamInertia& inertia, const BeamBlock& block,
                         std::span<const Index> mine, const Nodes& nodes, const Step& step) {
  return parallel_sum(std::ssize(mine), beam_node_chunk, [&](Index begin, Index end) {
    double energy = 0;
    for (Index j = begin; j < end; ++j) {
      const Index k = mine[static_cast<std::size_t>(j)];
      const auto i = static_cast<std::size_t>(block.nodes.begin + k);
      if (!has_own(inertia, nodes, k, i)) continue;
      const Vec3 at_level =
          xyz(nodes.omega[i]) - 0.5 * step.dt * nodes.omega[i].w * xyz(nodes.torque[i]);
      const Vec3 Omega = turn_of(block, k).conjugate() * at_level;
      energy += 0.5 * (Omega.dot(inertia.J[static_cast<std::size_t>(k)] * Omega) -
                       nodes.torque[i].w * Omega.squaredNorm());
    }
    return energy;
  });
}

void add_beam_inertia(Scene& scene, const BeamBlock& block, Models& models) {
  std::vector<Index> given = scene.store.get<GivenRotations>().nodes;
  std::sort(given.begin(), given.end());
  BeamInertia& inertia =
      scene.store.get<BeamInertias>().list.emplace_back(beam_inertia(block, scene.nodes, given));
  const std::string name = "beam " + block.name + ": rotary inertia";
  const std::string reason = asked_for_at(scene.parts[static_cast<std::size_t>(block.part)].where);
  for (Model& model : models.list) {
    const std::vector<Index> mine = nodes_in(block, model);
    if (mine.empty()) continue;
    // After all that adds torques, ties too, and before the kick of the leapfrog.
    model.plan.add_first({.name = name,
                          .reason = reason,
                          .stage = Stage::kick,
                          .reads = {"omega", "torque"},
                          .writes = {"torque"},
                          .run = [&scene, &block, &inertia, mine](const Step& step) {
                            turn_by_inertia(inertia, block, mine, scene.nodes, step);
                          }});
    const bool whole = std::ssize(mine) == block.nodes.size();
    LedgerEntry* entry = &models.ledger.entry(
        "rotary_inertia", whole ? block.name : block.name + " in " + model.name);
    model.plan.add({.name = name + ": energy",
                    .reason = reason,
                    .stage = Stage::look,
                    .reads = {"omega", "torque"},
                    .run = [&scene, &block, &inertia, entry, mine](const Step& step) {
                      entry->value = energy_of_inertia(inertia, block, mine, scene.nodes, step);
                    }});
  }
}

}  // namespace gannet
