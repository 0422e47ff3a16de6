#include "fe/mooring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/isa.hpp"
#include "base/math.hpp"
#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr Index blocks_per_chunk = 64;

Index n_blocks(const MooringLine& line) { return blocks_for(line.n_nodes()); }

/// Velocity of the water at every lane.
void fill_current(MooringLine& line, const Nodes& nodes, double t) {
  const VectorFunction& u = line.water.current;
  const bool by_place =
      u.component[0].of_place || u.component[1].of_place || u.component[2].of_place;
  const Vec3 uniform = by_place ? Vec3(Vec3::Zero()) : value_at(u, t);
  for (Index lane = 0; lane < lanes * n_blocks(line); ++lane) {
    const Index k = std::min(lane, line.n_nodes() - 1);
    const Vec3 here = by_place
                          ? value_at(u, t, xyz(nodes.x[static_cast<std::size_t>(node_of(line, k))]))
                          : uniform;
    for (int c = 0; c < 3; ++c) line.current[place_in_blocks(lane, c, 3)] = here[c];
  }
}

LinePass pass_of(MooringLine& line, Nodes& nodes, const Vec3& gravity, const Step& step) {
  const LineWater& w = line.water;
  const double rho_d = 0.5 * w.density * line.diameter;
  LinePass pass;
  pass.displaced = w.density * line.area();
  pass.drag_across = rho_d * w.Cdn;
  pass.drag_along = rho_d * std::numbers::pi * w.Cdt;
  pass.added_across = pass.displaced * w.Can;
  pass.added_along = pass.displaced * w.Cat;
  pass.level = w.level;
  pass.diameter = line.diameter;
  for (int c = 0; c < 3; ++c) pass.g[c] = gravity[c];
  pass.current = w.flows ? line.current.data() : nullptr;
  pass.bed = line.bed.there;
  pass.bed_level = pushing_level(line, -gravity.z());
  pass.bed_stiffness = line.bed.stiffness * line.diameter;
  pass.bed_damping = line.bed.damping * line.diameter;
  pass.friction = line.bed.friction;
  pass.x = &nodes.x.data()->x;
  pass.v = &nodes.v.data()->x;
  pass.f = &nodes.f.data()->x;
  pass.nodes = line.nodes.data();
  pass.state = line.state.data();
  pass.stuck_x = line.stuck.data();
  pass.stuck_y = line.stuck.data() + line.stuck.size() / 2;
  pass.dt_old = step.dt_old;
  pass.dt = step.dt;
  return pass;
}

void note_extremes(MooringLine& line) {
  const bool first = line.begun == 0;
  line.begun = 1;
  for (std::size_t e = 0; e < 2; ++e) {
    const double tension = line.ends[e].force.norm();
    double& largest = line.extremes[2 * e];
    double& smallest = line.extremes[2 * e + 1];
    largest = first ? tension : std::max(largest, tension);
    smallest = first ? tension : std::min(smallest, tension);
  }
}

}  // namespace

double MooringLine::area() const { return 0.25 * std::numbers::pi * diameter * diameter; }

double MooringLine::displaced() const { return water.density * area(); }

Index node_of(const MooringLine& line, Index k) { return corner_of(line.nodes, 3, k, 1); }

void set_line_nodes(MooringLine& line, const std::vector<Index>& nodes) {
  const auto n = static_cast<std::size_t>(line.n_nodes());
  std::vector<Index> around;
  for (std::size_t k = 0; k < n; ++k) {
    around.insert(around.end(),
                  {nodes[k > 0 ? k - 1 : 0], nodes[k], nodes[std::min(k + 1, n - 1)]});
  }
  line.nodes = corners_by_block(around, 3);
  const auto all = static_cast<std::size_t>(lanes * n_blocks(line));
  line.state.assign(all * line_values, 0);
  line.stuck.assign(2 * all, 0);
  if (line.water.flows) line.current.assign(3 * all, 0);
  line.sums.resize(
      static_cast<std::size_t>((n_blocks(line) + blocks_per_chunk - 1) / blocks_per_chunk));
  for (Index k = 0; k < static_cast<Index>(all); ++k) {
    const bool end = k == 0 || k >= line.n;
    const double share = k > line.n ? 0 : (end ? 0.5 : 1);
    line.state[place_in_blocks(k, line_length, line_values)] = share * line.length / line.n;
    line.state[place_in_blocks(k, line_end, line_values)] = end ? 1 : 0;
    const bool held = end && line.ends[k == 0 ? 0 : 1].held;
    line.state[place_in_blocks(k, line_lies, line_values)] =
        held ? 0 : share * line.length / line.n;
  }
  line.ends[0].node = nodes.front();
  line.ends[1].node = nodes.back();
}

double pushing_level(const MooringLine& line, double g) {
  const double weight = (line.block.mu - line.displaced()) * g;
  if (!(line.bed.stiffness > 0)) return line.bed.level;
  return line.bed.level + 0.5 * std::max(0.0, weight) / (line.bed.stiffness * line.diameter);
}

void line_forces(MooringLine& line, Nodes& nodes, const Vec3& gravity, const Step& step) {
  if (line.water.flows) fill_current(line, nodes, step.t);
  const LinePass pass = pass_of(line, nodes, gravity, step);
  parallel_for(n_blocks(line), blocks_per_chunk, [&](Index begin, Index end) {
    isa() == Isa::avx512 ? avx512::line_force_pass(pass, begin, end)
                         : avx2::line_force_pass(pass, begin, end);
  });
  for (LineEnd& end : line.ends) {
    const auto i = static_cast<std::size_t>(end.node);
    end.force = xyz(nodes.f[i]);
    // What an end is tied to has its mass, and its weight with it.
    if (nodes.x[i].w == 0) end.force += 0.5 * line.block.mu * line.length / line.n * gravity;
  }
  note_extremes(line);
}

LineSums line_work(MooringLine& line, Nodes& nodes, const Vec3& gravity, const Step& step) {
  const LinePass pass = pass_of(line, nodes, gravity, step);
  parallel_for(n_blocks(line), blocks_per_chunk, [&](Index begin, Index end) {
    LineSums& sums = line.sums[static_cast<std::size_t>(begin / blocks_per_chunk)];
    isa() == Isa::avx512 ? avx512::line_work_pass(pass, begin, end, sums)
                         : avx2::line_work_pass(pass, begin, end, sums);
  });
  LineSums all;
  for (const LineSums& s : line.sums) {
    for (std::size_t h = 0; h < 2; ++h) {
      all.buoyancy[h] += s.buoyancy[h];
      all.drag[h] += s.drag[h];
      all.current[h] += s.current[h];
      all.added[h] += s.added[h];
      all.bed[h] += s.bed[h];
      all.friction[h] += s.friction[h];
    }
  }
  return all;
}

double bed_step(const MooringLine& line) {
  const double k = line.bed.stiffness * line.diameter;
  if (!line.bed.there || !(k > 0)) return std::numeric_limits<double>::infinity();
  const double omega = std::sqrt(k / line.block.mu);
  const double zeta = 0.5 * line.bed.damping * line.diameter / std::sqrt(k * line.block.mu);
  return 0.8 / omega * (std::sqrt(1 + zeta * zeta) - zeta);
}

void hold_ends(MooringLine& line, Nodes& nodes, const Step& step) {
  const double kick = 0.5 * (step.dt_old + step.dt);
  for (LineEnd& end : line.ends) {
    if (!end.held) continue;
    Line& v = nodes.v[static_cast<std::size_t>(end.node)];
    const Vec3 wanted =
        end.way.constant()
            ? Vec3(Vec3::Zero())
            : Vec3((value_at(end.way, step.t + step.dt) - value_at(end.way, step.t)) / step.dt);
    end.reaction = (wanted - xyz(v)) / (v.w * kick);
    add_xyz(nodes.f[static_cast<std::size_t>(end.node)], end.reaction);
    set_xyz(v, wanted);
  }
}

}  // namespace gannet
