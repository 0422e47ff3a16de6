#include "fe/solid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "base/math.hpp"

namespace gannet {

namespace {

SolidConstants make_constants(const ElasticPlastic& material, const SolidSection& section) {
  SolidConstants c;
  c.law = solid_law(material);
  c.point_law = material.point_law();
  if (material.general()) {
    c.j2 = j2_law(material);
    c.history = history_of(c.j2, 6);
  }
  c.rubber = material.rubber;
  c.hourglass = section.shape == SolidShape::tetrahedron ? 0 : section.hourglass_coefficient;
  // Of rubber a multiple of its shear modulus, as of a metal: its bulk modulus would make the
  // hourglass patterns far stiffer than bending is.
  c.hourglass_modulus =
      material.hyperelastic() ? 3.5 * c.law.shear : c.law.bulk + 4.0 / 3.0 * c.law.shear;
  c.rho0 = material.rho;
  c.smallest_ratio = section.smallest_ratio;
  c.inverse_wave_speed = std::sqrt(material.rho / (c.law.bulk + 4.0 / 3.0 * c.law.shear));
  c.linear_viscosity = section.linear_viscosity;
  c.quadratic_viscosity = section.quadratic_viscosity;
  return c;
}

/// Signs of xi, eta, zeta at the corners.
constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// Keeps the coefficients of the positions at hand, also in the empty lanes. The two faces of a
/// plane case are one unit apart.
void keep_start(SolidBlock& block, std::span<const Line> x) {
  for (Index e = 0; e < lanes * blocks_for(block.n_elements); ++e) {
    for (int a = 0; a < 8; ++a) {
      const int* s = sign[a];
      const int pattern[7] = {
          s[0], s[1], s[2], s[1] * s[2], s[2] * s[0], s[0] * s[1], s[0] * s[1] * s[2]};
      const bool plane = block.layout.plane();
      const Index node =
          plane ? corner_of(block.corners, 4, e, a % 4) : corner_of(block.corners, 8, e, a);
      Vec3 p = 0.125 * xyz(x[static_cast<std::size_t>(node)]);
      if (plane) p.z() = 0.125 * 0.5 * s[2];
      for (int k = 0; k < 7; ++k) {
        for (int i = 0; i < 3; ++i) {
          block.value(e, block.layout.start() + 3 * k + i) += pattern[k] * p[i];
        }
      }
    }
  }
}

double area_of(const SolidBlock& block, Index e, std::span<const Line> x) {
  const auto corner = [&](int k) {
    return xyz(x[static_cast<std::size_t>(corner_of(block.corners, 4, e, k))]);
  };
  return 0.5 * (corner(2) - corner(0)).cross(corner(3) - corner(1)).z();
}

double tetrahedron_volume(const SolidBlock& block, Index e, std::span<const Line> x) {
  const auto edge = [&](int k) -> Vec3 {
    return xyz(x[static_cast<std::size_t>(corner_of(block.corners, 4, e, k))]) -
           xyz(x[static_cast<std::size_t>(corner_of(block.corners, 4, e, 0))]);
  };
  return edge(1).dot(edge(2).cross(edge(3))) / 6;
}

/// A line for each node that the block may use.
void make_nodal(SolidBlock& block, std::span<const Index> connectivity) {
  if (connectivity.empty()) return;
  const auto [low, high] = std::minmax_element(connectivity.begin(), connectivity.end());
  block.first_nodal = *low;
  block.nodal.resize(static_cast<std::size_t>(*high - *low + 1));
}

/// The volumes around the nodes of tetrahedra in the positions at hand.
void sum_nodal_volumes(SolidBlock& block, const SolidPass& pass, Isa set) {
  const auto n = static_cast<Index>(block.nodal.size());
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    std::fill(block.nodal.begin() + begin, block.nodal.begin() + end, Line{});
  });
  for_chunks_by_colour(block.colouring, block.n_elements, [&](Index, Index begin, Index end) {
    set == Isa::avx512 ? avx512::solid_volumes(pass, begin, end)
                       : avx2::solid_volumes(pass, begin, end);
  });
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      Line& node = block.nodal[static_cast<std::size_t>(k)];
      node.z = node.y > 0 ? std::log(node.x / node.y) : 0;
    }
  });
}

}  // namespace

double volume_of(const SolidBlock& block, Index e, std::span<const Line> x) {
  if (block.layout.plane()) return area_of(block, e, x);
  if (block.layout.tetrahedra()) return tetrahedron_volume(block, e, x);
  Vec3 a[3] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  Vec3 g[3] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int k = 0; k < 8; ++k) {
    const Vec3 p = 0.125 * xyz(x[static_cast<std::size_t>(corner_of(block.corners, 8, e, k))]);
    for (int i = 0; i < 3; ++i) {
      a[i] += sign[k][i] * p;
      g[i] += sign[k][(i + 1) % 3] * sign[k][(i + 2) % 3] * p;
    }
  }
  const auto triple = [](const Vec3& p, const Vec3& q, const Vec3& r) { return p.dot(q.cross(r)); };
  return 8 * (triple(a[0], a[1], a[2]) +
              (triple(a[0], g[2], g[1]) + triple(g[2], a[1], g[0]) + triple(g[1], g[0], a[2])) / 3);
}

SolidBlock make_solid_block(std::span<const Index> connectivity, std::span<const Line> x,
                            const ElasticPlastic& material, const SolidSection& section,
                            Index chunk) {
  assert(chunk > 0 && chunk % lanes == 0);
  SolidBlock block;
  block.material = material;
  block.section = section;
  block.constants = make_constants(material, section);
  assert(section.points == 1 || section.points == 8);
  block.layout = {
      material.plastic() ? block.constants.history.n : 0,
      section.points == 1 && !section.viscous_hourglass && section.shape != SolidShape::tetrahedron,
      section.points,
      section.shape,
      material.hyperelastic(),
      section.damping.given()};
  const int n_corners = block.layout.n_corners();
  block.n_elements = static_cast<Index>(connectivity.size()) / n_corners;
  block.corners = corners_by_block(connectivity, n_corners);
  block.state.assign(
      static_cast<std::size_t>(blocks_for(block.n_elements) * block.layout.n_values() * lanes), 0);
  for (Index e = 0; e < block.n_elements; ++e) {
    const double volume = volume_of(block, e, x);
    if (!(volume > 0)) {
      throw std::invalid_argument("element " + std::to_string(e + 1) +
                                  (volume < 0 ? " is inside out" : " has no volume"));
    }
    block.value(e, block.layout.inverse_volume()) = 1 / volume;
  }
  if (block.layout.has_start) keep_start(block, x);
  if (block.layout.tetrahedra()) make_nodal(block, connectivity);
  block.colouring = colour_chunks(connectivity, n_corners, chunk);
  block.sums.resize(static_cast<std::size_t>(block.colouring.n_chunks));
  return block;
}

double corner_mass(const SolidBlock& block, Index e) {
  return block.material.rho /
         (block.layout.n_corners() * block.value(e, block.layout.inverse_volume()));
}

void add_solid_masses(const SolidBlock& block, Nodes& nodes) {
  const int n_corners = block.layout.n_corners();
  for (Index e = 0; e < block.n_elements; ++e) {
    const double mass = corner_mass(block, e);
    for (int a = 0; a < n_corners; ++a) {
      nodes.x[static_cast<std::size_t>(corner_of(block.corners, n_corners, e, a))].w += mass;
    }
  }
}

namespace {

/// f: lines that the forces are added to.
SolidPass pass_over(SolidBlock& block, const Nodes& nodes, Array<Line>& f, double dt_old) {
  return {.constants = &block.constants,
          .layout = block.layout,
          .x = &nodes.x.data()->x,
          .v = &nodes.v.data()->x,
          .f = &f.data()->x,
          .corners = block.corners.data(),
          .state = block.state.data(),
          .nodal = block.layout.tetrahedra()
                       ? &block.nodal.data()->x - 4 * std::ptrdiff_t{block.first_nodal}
                       : nullptr,
          .votes = votes_of(block.inverse_mass, block.damping_time),
          .dt = dt_old};
}

}  // namespace

Array<double> bounds_of(const SolidBlock& block, const Nodes& nodes) {
  SolidBlock copy = block;
  Array<Line> f(nodes.f.size(), Line{});
  Array<double> bounds(static_cast<std::size_t>(lanes * blocks_for(block.n_elements)), 0);
  SolidPass pass = pass_over(copy, nodes, f, 0);
  pass.votes.omega2 = bounds.data();
  if (pass.nodal != nullptr) sum_nodal_volumes(copy, pass, isa());
  SolidSums sums;
  isa() == Isa::avx512 ? avx512::solid_force(pass, 0, blocks_for(block.n_elements), sums)
                       : avx2::solid_force(pass, 0, blocks_for(block.n_elements), sums);
  return bounds;
}

void prepare_damping(SolidBlock& block, const Nodes& nodes) {
  if (!block.section.damping.given()) return;
  Array<double> bounds = bounds_of(block, nodes);
  const double zeta = block.section.linear_viscosity;
  const double factor = std::sqrt(1 + zeta * zeta) + zeta;
  for (double& bound : bounds) bound /= factor * factor;
  block.damping_time = damping_times(block.section.damping, bounds);
}

ElementWork solid_pass(SolidBlock& block, Nodes& nodes, double dt_old, Isa set) {
  const SolidPass pass = pass_over(block, nodes, nodes.f, dt_old);
  if (pass.nodal != nullptr) sum_nodal_volumes(block, pass, set);
  for_chunks_by_colour(block.colouring, block.n_elements, [&](Index chunk, Index begin, Index end) {
    SolidSums& sums = block.sums[static_cast<std::size_t>(chunk)];
    if (set == Isa::avx512) {
      avx512::solid_force(pass, begin, end, sums);
    } else {
      avx2::solid_force(pass, begin, end, sums);
    }
  });
  ElementWork work;
  block.omega2 = 0;
  block.limiting = -1;
  block.volume_ratio = 1;
  block.smallest = -1;
  for (const SolidSums& s : block.sums) {
    work.internal += s.internal;
    work.plastic += s.plastic;
    work.hourglass += s.hourglass;
    work.viscous += s.viscous;
    work.damping += s.damping;
    work.eroded += s.eroded;
    if (s.omega2 > block.omega2) {
      block.omega2 = s.omega2;
      block.limiting = s.element;
    }
    if (s.volume_ratio < block.volume_ratio) {
      block.volume_ratio = s.volume_ratio;
      block.smallest = s.smallest;
    }
  }
  return work;
}

double stable_step(const SolidBlock& block) {
  return block.section.dt_factor * 2 / std::sqrt(block.omega2);
}

Index erode_collapsed(SolidBlock& block, std::span<const Line> x) {
  Index n = 0;
  for (Index e = 0; e < block.n_elements; ++e) {
    double& inverse_V0 = block.value(e, block.layout.inverse_volume());
    if (inverse_V0 == 0) continue;
    // What the pass saw halfway is gone by now: the smallest of the pass is taken at its word.
    const bool seen = block.smallest == e && block.volume_ratio <= block.section.smallest_ratio;
    if (!seen && volume_of(block, e, x) * inverse_V0 > block.section.smallest_ratio) continue;
    inverse_V0 = 0;
    ++n;
  }
  return n;
}

Index n_eroded(const SolidBlock& block) {
  Index n = 0;
  for (Index e = 0; e < block.n_elements; ++e) {
    n += block.value(e, block.layout.inverse_volume()) == 0 ? 1 : 0;
  }
  return n;
}

Symmetric<double> stress_at(const SolidBlock& block, Index e, int point) {
  const auto at = [&](int k) { return block.value(e, block.layout.stress(point) + k); };
  return {at(0), at(1), at(2), at(3), at(4), at(5)};
}

void show_state(SolidBlock& block) {
  const auto n = static_cast<std::size_t>(block.n_elements);
  block.stress_shown.assign(6 * n, 0);
  const int damage = block.constants.history.damage;
  block.plastic_shown.assign(block.layout.plastic() ? n : 0, 0);
  block.damage_shown.assign(damage >= 0 ? n : 0, 0);
  parallel_for(block.n_elements, node_chunk, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      // Who has left goes on being strained by corners that others move, and stands for nothing.
      const bool there = block.value(e, block.layout.inverse_volume()) > 0;
      for (int point = 0; point < block.layout.n_points; ++point) {
        const Symmetric<double> s = there ? stress_at(block, e, point) : Symmetric<double>{};
        const double part[6] = {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx};
        for (std::size_t k = 0; k < 6; ++k) {
          block.stress_shown[6 * static_cast<std::size_t>(e) + k] +=
              part[k] / block.layout.n_points;
        }
        if (!block.layout.plastic()) continue;
        const int first = block.layout.plastic_strain(point);
        double& eps_p = block.plastic_shown[static_cast<std::size_t>(e)];
        if (there) eps_p = std::max(eps_p, block.value(e, first));
        if (damage < 0) continue;
        double& worst = block.damage_shown[static_cast<std::size_t>(e)];
        worst = std::max(worst, block.value(e, first + damage));
      }
    }
  });
}

}  // namespace gannet
