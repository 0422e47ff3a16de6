#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "search/spatial_sort.hpp"
#include "sph/rest.hpp"

namespace gannet {

namespace {

Vec3 place(const Scene& scene, Index k) { return xyz(scene.nodes.x[scene.particles.begin + k]); }

/// Marks the cells that a box reaches into.
void mark_box(const RestCells& cells, const Vec3& low, const Vec3& high, CellMarks& marks) {
  const auto a = cells.place_of(low);
  const auto b = cells.place_of(high);
  // A box across the end of a direction that repeats: all of it, to be sure.
  std::array<Index, 3> first = a;
  std::array<Index, 3> last = b;
  for (std::size_t d = 0; d < 3; ++d) {
    if (a[d] <= b[d]) continue;
    first[d] = 0;
    last[d] = cells.n[d] - 1;
  }
  for (Index k = first[2]; k <= last[2]; ++k) {
    for (Index j = first[1]; j <= last[1]; ++j) {
      for (Index i = first[0]; i <= last[0]; ++i) {
        marks[(k * cells.n[1] + j) * cells.n[0] + i] = 1;
      }
    }
  }
}

/// Water near parts of elements never rests: they may touch it.
void mark_elements(const Scene& scene, const RestCells& cells, double margin, CellMarks& marks) {
  const Vec3 around = Vec3::Constant(margin);
  for (const Part& part : scene.parts) {
    const int n = nodes_per(part.cell);
    for (Index e = 0; n > 0 && e < part.n_cells(); ++e) {
      Vec3 low = xyz(scene.nodes.x[part.connectivity[e * n]]);
      Vec3 high = low;
      for (int a = 1; a < n; ++a) {
        const Vec3 x = xyz(scene.nodes.x[part.connectivity[e * n + a]]);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
      mark_box(cells, low - around, high + around, marks);
    }
  }
}

/// Nor does water at a plane that moves.
void mark_planes(const Scene& scene, const RestCells& cells, CellMarks& marks) {
  for (const Plane& plane : scene.planes) {
    if (!plane.moves) continue;
    const double reach = 0.5 * plane.normal.cwiseAbs().dot(cells.edge);
    for (Index c = 0; c < cells.size(); ++c) {
      const Vec3 at(c % cells.n[0], c / cells.n[0] % cells.n[1], c / (cells.n[0] * cells.n[1]));
      const Vec3 middle = cells.low + cells.edge.cwiseProduct(at + Vec3::Constant(0.5));
      if (std::abs(plane.normal.dot(middle - plane.point)) <= reach) marks[c] = 1;
    }
  }
}

/// Brings the flow in the cells to time t and marks where it is too fast.
void mark_flow(Rest& rest, double t) {
  const double share = 1 - std::exp(-4 * (t - rest.looked_at) / rest.quiet);
  const double limit = rest.tolerance * rest.speed;
  for (Index c = 0; c < rest.cells.size(); ++c) {
    const Line& sum = rest.sum_v[c];
    Eigen::Map<Vec3> flow(&rest.flow[3 * c]);
    flow += share * (xyz(sum) / std::max(sum.w, 1.0) - flow);
    if (!(flow.squaredNorm() <= limit * limit)) rest.marks[c] = 1;
  }
  rest.looked_at = t;
}

/// Whether a cell was left alone long enough at time t.
bool is_quiet(const Rest& rest, Index cell, double t) {
  return t - rest.disturbed_at[cell] >= rest.quiet;
}

/// 1 for particles that shall rest at time t.
Array<std::uint8_t> may_rest(const Rest& rest, const Scene& scene, double t) {
  const Index n = scene.particles.size();
  Array<std::uint8_t> rests(static_cast<std::size_t>(n));
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      rests[k] = is_quiet(rest, rest.cells.cell_of(place(scene, k)), t) ? 1 : 0;
    }
  });
  auto n_awake = static_cast<Index>(std::count(rests.begin(), rests.end(), 0));
  // Whole clusters, and at least one. Who is awake stands first, then who is near them.
  for (Index k = 0; k < n && (n_awake == 0 || n_awake % ClusterList::lanes != 0); ++k) {
    if (rests[k] == 0) continue;
    rests[k] = 0;
    ++n_awake;
  }
  return rests;
}

/// What is taken from particles that come to rest: w energy, x y z momentum.
Line taken_by_rest(const Rest& rest, const SphState& sph, const Scene& scene,
                   const Array<std::uint8_t>& rests, double dt) {
  const Nodes& nodes = scene.nodes;
  return parallel_reduce(
      scene.awake().size(), node_chunk, Line{},
      [&](Index begin, Index end) {
        Line sum{};
        for (Index k = begin; k < end; ++k) {
          // Particles of walls go where they are told: no force moves them, nor have they a rate.
          if (rests[k] == 0 || rest.state[k] >= rest_seen || !is_fluid(scene, k)) continue;
          const Index i = scene.particles.begin + k;
          const double m = nodes.x[i].w;
          const Vec3 v = xyz(nodes.v[i]);
          add_xyz(sum, m * v);
          sum.w += 0.5 * m * v.squaredNorm() + xyz(nodes.f[i]).squaredNorm() * dt * dt / (8 * m);
          const double diffusion = sph.drho_diffusion.empty() ? 0.0 : sph.drho_diffusion[k];
          const double rate = sph.drho_dt[k] - diffusion;
          sum.w += m * sph.p[k] / (sph.rho[k] * sph.rho[k]) * rate * 0.5 * dt;
        }
        return sum;
      },
      [](const Line& a, const Line& b) {
        return Line{a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
      });
}

/// Takes all motion from particle k.
void stop(SphState& sph, Scene& scene, Index k) {
  const Index i = scene.particles.begin + k;
  set_xyz(scene.nodes.v[i], Vec3::Zero());
  set_xyz(scene.nodes.f[i], Vec3::Zero());
  sph.drho_dt[k] = 0;
  // What passes store before it is read, and no checkpoint holds.
  for (Array<Line>* f : {&sph.f_viscous, &sph.f_laminar, &sph.f_tensile, &sph.f_correction}) {
    if (!f->empty()) (*f)[k] = {};
  }
  for (Array<double>* rate : {&sph.drho_diffusion, &sph.drho_correction}) {
    if (!rate->empty()) (*rate)[k] = 0;
  }
  if (!sph.concentration.empty()) sph.concentration[k] = {0, 0, 0, 1.0 * sph.kernel.dimension};
  if (!sph.X.empty()) set_xyz(sph.X[k], Vec3::Zero());
  if (!sph.shift.empty()) set_xyz(sph.shift[k], Vec3::Zero());
}

/// The new state of each particle; stops who comes to rest.
void set_states(Rest& rest, SphState& sph, Scene& scene, const Array<std::uint8_t>& rests) {
  const Index n = scene.particles.size();
  rest.marks.assign(static_cast<std::size_t>(rest.cells.size()), 0);
  for (Index k = 0; k < n; ++k) {
    if (rests[k] == 0) rest.marks[rest.cells.cell_of(place(scene, k))] = 1;
  }
  widen(rest.cells, 1, rest.marks);
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      std::uint8_t& state = rest.state[k];
      const bool rested = state >= rest_seen;
      if (rests[k] == 0) {
        if (rested) state = rest_woken;
        continue;
      }
      if (!rested) stop(sph, scene, k);
      const bool near = rest.marks[rest.cells.cell_of(place(scene, k))] != 0;
      state = near ? rest_seen : rest_unseen;
      if (!near && !sph.s.empty()) sph.s[k] = 0;
    }
  });
}

/// Who is awake first, who is not seen last, all else in its order.
void sort_by_state(const Rest& rest, Scene& scene) {
  const Index n = scene.particles.size();
  const auto group = [&](Index k) { return std::max(rest.state[k], std::uint8_t{rest_woken}); };
  Array<Index> order;
  order.reserve(static_cast<std::size_t>(n));
  for (const std::uint8_t g : {rest_woken, rest_seen, rest_unseen}) {
    for (Index k = 0; k < n; ++k) {
      if (group(k) == g) order.push_back(k);
    }
  }
  permute_particles(scene, order);
}

}  // namespace

std::array<Index, 3> RestCells::place_of(const Vec3& x) const {
  std::array<Index, 3> at{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    double place = std::floor((x[k] - low[k]) / edge[k]);
    if (repeats[d]) place -= n[d] * std::floor(place / n[d]);
    at[d] = static_cast<Index>(std::clamp(place, 0.0, static_cast<double>(n[d] - 1)));
  }
  return at;
}

Index RestCells::cell_of(const Vec3& x) const {
  const auto at = place_of(x);
  return (at[2] * n[1] + at[1]) * n[0] + at[0];
}

RestCells cells_over(const Vec3& low, const Vec3& high, double edge,
                     const std::array<bool, 3>& repeats, Index most) {
  RestCells cells;
  cells.low = low;
  cells.repeats = repeats;
  for (double wide = edge;; wide *= 1.25) {
    double count = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      const double extent = high[k] - low[k];
      const double n =
          repeats[d] ? std::max(1.0, std::floor(extent / wide)) : std::floor(extent / wide) + 1;
      cells.n[d] = static_cast<Index>(std::min(n, 1e9));
      cells.edge[k] = repeats[d] ? extent / n : wide;
      count *= n;
    }
    if (count <= most) return cells;
  }
}

void widen(const RestCells& cells, Index steps, CellMarks& marks) {
  std::array<Index, 3> stride{1, cells.n[0], cells.n[0] * cells.n[1]};
  CellMarks wider;
  for (std::size_t d = 0; d < 3; ++d) {
    const Index n = cells.n[d];
    if (n == 1) continue;
    wider.assign(marks.size(), 0);
    for (Index c = 0; c < cells.size(); ++c) {
      if (marks[c] == 0) continue;
      const Index at = c / stride[d] % n;
      for (Index s = -steps; s <= steps; ++s) {
        Index to = at + s;
        if (cells.repeats[d]) to = (to % n + n) % n;
        if (to >= 0 && to < n) wider[c + (to - at) * stride[d]] = 1;
      }
    }
    marks.swap(wider);
  }
}

void find_disturbed(Rest& rest, const SphState& sph, const Scene& scene, double t) {
  const Index n = scene.awake().size();
  const double limit = rest_jitter * rest.tolerance * rest.speed;
  rest.place.resize(static_cast<std::size_t>(n));
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Index c = rest.cells.cell_of(place(scene, k));
      const Vec3 v = xyz(scene.nodes.v[scene.particles.begin + k]);
      const bool restless = !sph.restless.empty() && sph.restless[scene.particle_part[k]];
      rest.place[k] = restless || !(v.squaredNorm() <= limit * limit) ? -1 - c : c;
    }
  });
  const auto n_cells = static_cast<std::size_t>(rest.cells.size());
  rest.marks.assign(n_cells, 0);
  rest.n_awake.assign(n_cells, 0);
  rest.sum_v.assign(n_cells, {});
  for (Index k = 0; k < n; ++k) {
    const Index c = rest.place[k] < 0 ? -1 - rest.place[k] : rest.place[k];
    ++rest.n_awake[c];
    if (rest.place[k] < 0) rest.marks[c] = 1;
    if (!is_fluid(scene, k)) continue;
    add_xyz(rest.sum_v[c], xyz(scene.nodes.v[scene.particles.begin + k]));
    rest.sum_v[c].w += 1;
  }
  mark_flow(rest, t);
  mark_elements(scene, rest.cells, sph.dx, rest.marks);
  mark_planes(scene, rest.cells, rest.marks);
}

bool look_for_rest(Rest& rest, const SphState& sph, const Scene& scene, double t) {
  find_disturbed(rest, sph, scene, t);
  widen(rest.cells, rest_margin, rest.marks);
  bool wake = false;
  Index sleepy = 0;
  for (Index c = 0; c < rest.cells.size(); ++c) {
    if (rest.marks[c] != 0) {
      rest.disturbed_at[c] = t;
      wake = wake || rest.n_resting[c] > 0;
    } else if (is_quiet(rest, c, t)) {
      sleepy += rest.n_awake[c];
    }
  }
  constexpr Index share = 16;
  if (wake) {
    widen(rest.cells, rest_ahead, rest.marks);
    for (Index c = 0; c < rest.cells.size(); ++c) {
      if (rest.marks[c] != 0 && rest.n_resting[c] > 0) rest.disturbed_at[c] = t;
    }
  }
  // Up to a cluster stays awake to fill up the last one.
  return wake || (sleepy > ClusterList::lanes && share * sleepy >= scene.awake().size());
}

double choose_rest(Rest& rest, SphState& sph, Scene& scene, double t, double dt) {
  const Array<std::uint8_t> rests = may_rest(rest, scene, t);
  const Line taken = taken_by_rest(rest, sph, scene, rests, dt);
  scene.resting.momentum += xyz(taken);
  set_states(rest, sph, scene, rests);
  sort_by_state(rest, scene);
  count_rest(rest, sph, scene);
  return taken.w;
}

void count_rest(Rest& rest, SphState& sph, Scene& scene) {
  const auto& state = rest.state;
  const auto count = [&](RestState s) {
    return static_cast<Index>(std::count(state.begin(), state.begin() + scene.particles.size(), s));
  };
  scene.resting.n_unseen = count(rest_unseen);
  scene.resting.n = count(rest_seen) + scene.resting.n_unseen;
  rest.woken = count(rest_woken) > 0;
  rest.n_resting.assign(static_cast<std::size_t>(rest.cells.size()), 0);
  for (Index k = scene.awake().size(); k < scene.particles.size(); ++k) {
    ++rest.n_resting[rest.cells.cell_of(place(scene, k))];
  }
  sph.internal_at_rest.assign(scene.parts.size(), 0);
  for (Index k = scene.awake().size(); k < scene.particles.size(); ++k) {
    if (!is_fluid(scene, k)) continue;
    sph.internal_at_rest[scene.particle_part[k]] +=
        sph.m * internal_energy(eos_of(sph, scene, k), sph.rho[k]);
  }
}

double energy_of_woken(Rest& rest, const Scene& scene, double dt) {
  if (!rest.woken) return 0;
  rest.woken = false;
  return parallel_sum(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    double e = 0;
    for (Index k = begin; k < end; ++k) {
      if (rest.state[k] != rest_woken) continue;
      rest.state[k] = rest_awake;
      const Index i = scene.particles.begin + k;
      e += 0.5 * scene.nodes.x[i].w * velocity_at_level(scene.nodes, i, dt).squaredNorm();
    }
    return e;
  });
}

double power_at_border(Rest& rest, const SphState& sph, const Scene& scene) {
  const ClusterList& list = sph.list;
  if (list.n_active == list.n_clusters) return 0;
  rest.border.clear();
  for (Index c = list.n_active; c < list.n_clusters; ++c) rest.border.push_back(c);
  rest.drho_dt.resize(static_cast<std::size_t>(list.n_targets));
  pair_rates(list, sph.packed, parameters_of(sph), {.drho_dt = rest.drho_dt.data()},
             {.clusters = rest.border});
  const Index first = scene.awake().size();
  return sph.m * parallel_sum(list.n_targets - first, node_chunk, [&](Index begin, Index end) {
           double sum = 0;
           for (Index k = first + begin; k < first + end; ++k) {
             sum += sph.p[k] / (sph.rho[k] * sph.rho[k]) * rest.drho_dt[k];
           }
           return sum;
         });
}

}  // namespace gannet
