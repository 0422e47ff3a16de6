#include "fe/shell.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "base/math.hpp"
#include "fe/element_blocks.hpp"
#include "fe/gauss.hpp"
#include "fe/shell_fibres.hpp"
#include "fe/shell_frame.hpp"

namespace gannet {

namespace {

ShellConstants make_constants(const ElasticPlastic& material, const ShellSection& section) {
  ShellConstants c;
  c.law = plane_stress_law(material);
  c.point_law = material.point_law();
  if (material.general()) {
    c.j2 = j2_law(material);
    c.history = history_of(c.j2, 3);
  }
  c.thickness_changes = section.thickness_changes;
  c.viscous_hourglass = section.hourglass == HourglassForm::viscous;
  c.n_points = section.points;
  const GaussRule rule = gauss_rule(section.points);
  for (int k = 0; k < section.points; ++k) {
    c.point[k] = rule.point[static_cast<std::size_t>(k)];
    c.weight[k] = 0.5 * rule.weight[static_cast<std::size_t>(k)];
  }
  c.shear_factor = section.shear_factor;
  const double r = section.hourglass_coefficient;
  c.hourglass_membrane = r * material.E / 8;
  c.hourglass_bending = r * material.E / 192;
  c.hourglass_warp = r * section.shear_factor * material.G() / 12;
  c.inverse_wave_speed = std::sqrt(material.rho * (1 - material.nu * material.nu) / material.E);
  c.membrane_modulus = material.E / (1 - std::abs(material.nu));
  c.nodal_mass_factor = material.rho * section.thickness / corners_per(section.kind);
  c.thickness = section.thickness;
  c.offset = section.offset;
  c.smallest_ratio = section.smallest_ratio;
  c.smallest_alpha = section.thickness * section.thickness / 12 + section.offset * section.offset;
  return c;
}

/// Thickness 0 in the empty lanes makes all their forces, energies and votes vanish.
void fill_state(ShellBlock& block, std::span<const Line> x) {
  const int n = block.layout.n_values();
  block.state.assign(static_cast<std::size_t>(block.n_blocks() * n) * 8, 0);
  for (Index e = 0; e < 8 * block.n_blocks(); ++e) {
    const double area = frame_of(block, e, x).area;
    if (!(area > 0)) {
      throw std::invalid_argument("element " + std::to_string(e + 1) + " has no area");
    }
    block.value(e, block.layout.inverse_area()) = 1 / area;
    block.value(e, block.layout.thickness()) = e < block.n_elements ? block.section.thickness : 0.0;
  }
}

/// Fibres of elements that know no others: those of quadrilaterals, of triangles with a corner
/// twice.
std::vector<Vec3> own_fibres(std::span<const Index> connectivity, int n_corners,
                             std::span<const Line> x) {
  if (n_corners == 4) return fibres_of(connectivity, x);
  std::vector<Index> quads;
  for (std::size_t k = 0; k < connectivity.size(); k += 3) {
    for (const std::size_t a : {0, 1, 2, 2}) quads.push_back(connectivity[k + a]);
  }
  const std::vector<Vec3> of_quads = fibres_of(quads, x);
  std::vector<Vec3> fibre;
  for (std::size_t k = 0; k < of_quads.size(); ++k) {
    if (k % 4 < 3) fibre.push_back(of_quads[k]);
  }
  return fibre;
}

/// Fibres into the frames of the elements.
void fill_fibres(ShellBlock& block, std::span<const Vec3> fibre, std::span<const Line> x) {
  const int n_corners = block.n_corners();
  for (Index e = 0; e < 8 * block.n_blocks(); ++e) {
    const Index of = std::min(e, block.n_elements - 1);
    const Mat3 R = frame_of(block, of, x).axes;
    for (int a = 0; a < n_corners; ++a) {
      const Vec3 p = R.transpose() * fibre[static_cast<std::size_t>(n_corners * of + a)];
      block.value(e, block.layout.fibres() + 2 * a) = p.x() / p.z();
      block.value(e, block.layout.fibres() + 2 * a + 1) = p.y() / p.z();
    }
  }
}

}  // namespace

ShellBlock make_shell_block(std::span<const Index> connectivity, std::span<const Line> x,
                            const ElasticPlastic& material, const ShellSection& section,
                            Index chunk, std::span<const Vec3> fibre) {
  assert(section.thickness > 0 && section.points >= 1 && section.points <= max_shell_points);
  assert(chunk > 0 && chunk % 8 == 0);
  ShellBlock block;
  block.material = material;
  block.section = section;
  block.constants = make_constants(material, section);
  const bool has_fibres = section.warping || section.kind != ShellKind::one_point;
  block.layout = {section.points, 3 + (material.plastic() ? block.constants.history.n : 0),
                  has_fibres, section.kind, section.damping.given()};
  const int n_corners = block.n_corners();
  block.n_elements = static_cast<Index>(connectivity.size()) / n_corners;
  block.corners = corners_by_block(connectivity, n_corners);
  fill_state(block, x);
  if (has_fibres && !fibre.empty()) {
    fill_fibres(block, fibre, x);
  } else if (has_fibres) {
    fill_fibres(block, own_fibres(connectivity, n_corners, x), x);
  }
  block.colouring = colour_chunks(connectivity, n_corners, chunk);
  block.sums.resize(static_cast<std::size_t>(block.colouring.n_chunks));
  return block;
}

double corner_mass(const ShellBlock& block, Index e) {
  const double area = 1 / block.value(e, block.layout.inverse_area());
  return block.constants.nodal_mass_factor * area;
}

double corner_alpha(const ShellBlock& block, Index e) {
  const double area = 1 / block.value(e, block.layout.inverse_area());
  return std::max(block.constants.smallest_alpha, area / (block.n_corners() == 3 ? 6 : 8));
}

void add_shell_masses(const ShellBlock& block, Nodes& nodes) {
  const int n_corners = block.n_corners();
  for (Index e = 0; e < block.n_elements; ++e) {
    const double mass = corner_mass(block, e);
    const double alpha = corner_alpha(block, e);
    for (int a = 0; a < n_corners; ++a) {
      const auto node = static_cast<std::size_t>(corner_of(block.corners, n_corners, e, a));
      nodes.x[node].w += mass;
      nodes.torque[node].w += alpha * mass;
    }
  }
}

namespace {

ShellPass pass_over(ShellBlock& block, const Nodes& nodes, Line* f, Line* torque, double dt) {
  return {.constants = &block.constants,
          .layout = block.layout,
          .x = &nodes.x.data()->x,
          .v = &nodes.v.data()->x,
          .omega = &nodes.omega.data()->x,
          .f = &f->x,
          .torque = &torque->x,
          .corners = block.corners.data(),
          .state = block.state.data(),
          .votes = votes_of(block.inverse_mass, block.damping_time),
          .dt = dt};
}

/// The pass over blocks [begin, end) that the kind of element has.
void pass_blocks(ShellKind kind, const ShellPass& pass, Index begin, Index end, ShellSums& sums,
                 Isa set) {
  const bool wide = set == Isa::avx512;
  switch (kind) {
    case ShellKind::one_point:
      (wide ? avx512::shell_force : avx2::shell_force)(pass, begin, end, sums);
      return;
    case ShellKind::quad:
      (wide ? avx512::shell_quad_force : avx2::shell_quad_force)(pass, begin, end, sums);
      return;
    case ShellKind::triangle:
      (wide ? avx512::shell_triangle_force : avx2::shell_triangle_force)(pass, begin, end, sums);
      return;
  }
}

}  // namespace

ElementWork shell_pass(ShellBlock& block, Nodes& nodes, double dt_old, Isa set) {
  const ShellPass pass = pass_over(block, nodes, nodes.f.data(), nodes.torque.data(), dt_old);
  for_chunks_by_colour(block.colouring, block.n_elements, [&](Index chunk, Index begin, Index end) {
    pass_blocks(block.section.kind, pass, begin, end, block.sums[static_cast<std::size_t>(chunk)],
                set);
  });
  ElementWork work;
  block.omega2 = 0;
  block.limiting = -1;
  block.area_ratio = 1;
  block.smallest = -1;
  for (const ShellSums& s : block.sums) {
    work.internal += s.internal;
    work.plastic += s.plastic;
    work.hourglass += s.hourglass;
    work.damping += s.damping;
    work.eroded += s.eroded;
    if (s.area_ratio < block.area_ratio) {
      block.area_ratio = s.area_ratio;
      block.smallest = s.smallest;
    }
    if (s.omega2 <= block.omega2) continue;
    block.omega2 = s.omega2;
    block.limiting = s.element;
  }
  return work;
}

double stable_step(const ShellBlock& block) {
  return block.section.dt_factor * 2 / std::sqrt(block.omega2);
}

Array<double> bounds_of(const ShellBlock& block, const Nodes& nodes) {
  ShellBlock copy = block;
  Array<Line> f(nodes.f.size(), Line{});
  Array<Line> torque(nodes.torque.size(), Line{});
  Array<double> bounds(static_cast<std::size_t>(8 * block.n_blocks()), 0);
  ShellPass pass = pass_over(copy, nodes, f.data(), torque.data(), 0);
  pass.votes.omega2 = bounds.data();
  ShellSums sums;
  pass_blocks(block.section.kind, pass, 0, copy.n_blocks(), sums, isa());
  return bounds;
}

void prepare_damping(ShellBlock& block, const Nodes& nodes) {
  if (!block.section.damping.given()) return;
  block.damping_time = damping_times(block.section.damping, bounds_of(block, nodes));
}

std::vector<ElementStep> smallest_steps(const ShellBlock& block, const Nodes& nodes,
                                        std::size_t n) {
  const Array<double> bounds = bounds_of(block, nodes);
  std::vector<Index> order;
  for (Index e = 0; e < block.n_elements; ++e) {
    if (bounds[static_cast<std::size_t>(e)] > 0) order.push_back(e);
  }
  n = std::min(n, order.size());
  const auto stiffer = [&](Index a, Index b) {
    const double of_a = bounds[static_cast<std::size_t>(a)];
    const double of_b = bounds[static_cast<std::size_t>(b)];
    return of_a != of_b ? of_a > of_b : a < b;
  };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end(),
                    stiffer);
  std::vector<ElementStep> steps;
  for (std::size_t k = 0; k < n; ++k) {
    const double omega2 = bounds[static_cast<std::size_t>(order[k])];
    steps.push_back({block.section.dt_factor * 2 / std::sqrt(omega2), order[k]});
  }
  return steps;
}

void erode_collapsed(ShellBlock& block, std::span<const Line> x) {
  const double limit = block.section.smallest_ratio;
  for (Index e = 0; e < block.n_elements; ++e) {
    // What the pass saw halfway is gone by now: the smallest of the pass is taken at its word.
    const bool seen = block.smallest == e && block.area_ratio <= limit;
    const double ratio = frame_of(block, e, x).area * block.value(e, block.layout.inverse_area());
    if (seen || !(ratio > limit)) block.value(e, block.layout.thickness()) = 0;
  }
}

Index n_eroded(const ShellBlock& block) {
  Index n = 0;
  for (Index e = 0; e < block.n_elements; ++e) {
    n += block.value(e, block.layout.thickness()) == 0 ? 1 : 0;
  }
  return n;
}

PlaneStress<double> stress_at(const ShellBlock& block, Index e, int k) {
  const int first = k * block.layout.per_point;
  return {block.value(e, first), block.value(e, first + 1), block.value(e, first + 2)};
}

}  // namespace gannet
