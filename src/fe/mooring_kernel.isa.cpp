#include "fe/mooring_kernel.hpp"

#include "fe/vec_x3.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

constexpr double tiny = 1e-300;  // keeps 1/|a| finite where a is 0

/// The numbers of eight nodes.
struct Numbers {
  double* at;
  GANNET_INLINE Numbers(const LinePass& pass, std::int32_t block)
      : at(pass.state + 8 * line_values * static_cast<std::int64_t>(block)) {}
  GANNET_INLINE Vec8 get(LineValue k) const { return Vec8::load(at + 8 * k); }
  GANNET_INLINE void put(LineValue k, Vec8 a) const { a.store(at + 8 * k); }
  GANNET_INLINE Vec8x3 get3(LineValue k) const {
    return {Vec8::load(at + 8 * k), Vec8::load(at + 8 * (k + 1)), Vec8::load(at + 8 * (k + 2))};
  }
  GANNET_INLINE void put3(LineValue k, const Vec8x3& a) const {
    a.x.store(at + 8 * k);
    a.y.store(at + 8 * (k + 1));
    a.z.store(at + 8 * (k + 2));
  }
};

GANNET_INLINE Vec8x3 current_of(const LinePass& pass, std::int32_t block) {
  const double* u = pass.current + 24 * static_cast<std::int64_t>(block);
  return {Vec8::load(u), Vec8::load(u + 8), Vec8::load(u + 16)};
}

/// What is known of eight nodes before the forces.
struct Nodes8 {
  Vec8x3 x, v, f;
  Vec8 m, inverse_m, length, inner;  ///< inner: 0 at the ends, else 1
  Vec8x3 d;                          ///< from the node before to the node after
  Vec8 bend;                         ///< z before - 2 z + z after
};

GANNET_INLINE Nodes8 gather_nodes(const LinePass& pass, const Numbers& n, std::int32_t block) {
  const std::int32_t* nodes = pass.nodes + 24 * static_cast<std::int64_t>(block);
  Nodes8 a;
  Vec8 line[4];
  gather_lines(pass.x, nodes + 8, 1, line);
  a.x = {line[0], line[1], line[2]};
  a.m = line[3];
  // The node before that of a lane is the one of the lane below.
  const double* first = pass.x + 4 * static_cast<std::int64_t>(nodes[0]);
  const double* last = pass.x + 4 * static_cast<std::int64_t>(nodes[23]);
  const Vec8x3 before{lanes_up(a.x.x, first[0]), lanes_up(a.x.y, first[1]),
                      lanes_up(a.x.z, first[2])};
  const Vec8x3 after{lanes_down(a.x.x, last[0]), lanes_down(a.x.y, last[1]),
                     lanes_down(a.x.z, last[2])};
  gather_lines(pass.v, nodes + 8, 1, line);
  a.v = {line[0], line[1], line[2]};
  a.inverse_m = line[3];
  a.f = gather_corner<Vec8>(pass.f, nodes, 1);
  a.d = after - before;
  a.bend = before.z + after.z - Vec8(2.0) * a.x.z;
  a.length = n.get(line_length);
  a.inner = Vec8(1.0) - n.get(line_end);
  return a;
}

/// The bed: a spring and a damper that push up, and a tangential spring and damper up to Coulomb's
/// limit. Adds to f.
GANNET_INLINE void bed_forces(const LinePass& pass, const Numbers& n, std::int32_t block,
                              const Nodes8& a, Vec8x3& f) {
  const Vec8 zero(0.0);
  double* stuck_x = pass.stuck_x + 8 * static_cast<std::int64_t>(block);
  double* stuck_y = pass.stuck_y + 8 * static_cast<std::int64_t>(block);
  const Vec8 depth = Vec8(pass.bed_level) - a.x.z;
  const auto touches = less(zero, depth);
  if (!any(touches)) {
    n.put(line_bed, zero);
    if (pass.friction > 0) {
      n.put(line_friction_x, zero);
      n.put(line_friction_y, zero);
      a.x.x.store(stuck_x);
      a.x.y.store(stuck_y);
    }
    return;
  }
  const Vec8 lies = n.get(line_lies);
  const Vec8 k = Vec8(pass.bed_stiffness) * lies;
  const Vec8 c = Vec8(pass.bed_damping) * lies;
  const Vec8 push = select(touches, max(fnma(c, a.v.z, k * depth), zero), zero);
  n.put(line_bed, push);
  f.z += push;
  if (!(pass.friction > 0)) return;
  const Vec8 away_x = a.x.x - Vec8::load(stuck_x);
  const Vec8 away_y = a.x.y - Vec8::load(stuck_y);
  Vec8 fx = -fma(k, away_x, c * a.v.x);
  Vec8 fy = -fma(k, away_y, c * a.v.y);
  const Vec8 limit = Vec8(pass.friction) * push;
  const Vec8 f2 = fx * fx + fy * fy;
  const auto slides = less(limit * limit, f2);
  const Vec8 share = select(slides, limit * rsqrt(f2 + Vec8(tiny)), Vec8(1.0));
  fx *= share;
  fy *= share;
  // A node that slides takes its spring along, so that the spring holds the limit; in the lanes
  // that do not touch there is no stiffness to divide by, and no limit.
  const Vec8 give = select(less(zero, limit), reciprocal(max(k, Vec8(tiny))), zero);
  select(slides, fma(fx, give, a.x.x), Vec8::load(stuck_x)).store(stuck_x);
  select(slides, fma(fy, give, a.x.y), Vec8::load(stuck_y)).store(stuck_y);
  n.put(line_friction_x, fx);
  n.put(line_friction_y, fy);
  f.x += fx;
  f.y += fy;
}

/// The share of a node's length that is under water: its middle (a quarter of its element inwards
/// at the ends) against the level, over its height and a diameter.
GANNET_INLINE Vec8 wet_share(const LinePass& pass, const Nodes8& a) {
  const Vec8 middle = fma(a.bend, fnma(a.inner, Vec8(0.125), Vec8(0.25)), a.x.z);
  const Vec8 height = fma(max(a.d.z, -a.d.z), Vec8(0.5), Vec8(pass.diameter));
  const Vec8 share = fma(Vec8(pass.level) - middle, reciprocal(height), Vec8(0.5));
  return min(max(share, Vec8(0.0)), Vec8(1.0));
}

/// Buoyancy, drag and added mass. f: all that acts so far; on return with these.
template <bool flows>
GANNET_INLINE void water_forces(const LinePass& pass, const Numbers& n, std::int32_t block,
                                const Nodes8& a, Vec8x3& f) {
  const Vec8 wet = wet_share(pass, a) * a.length;
  const Vec8 displaced = Vec8(pass.displaced) * wet;
  n.put(line_buoyancy, displaced);
  f.x = fnma(displaced, Vec8(pass.g[0]), f.x);
  f.y = fnma(displaced, Vec8(pass.g[1]), f.y);
  f.z = fnma(displaced, Vec8(pass.g[2]), f.z);

  const Vec8x3 t = scaled(a.d, rsqrt(dot(a.d, a.d) + Vec8(tiny)));
  Vec8x3 v = a.v;
  if constexpr (flows) v = v - current_of(pass, block);
  const Vec8 vt = dot(v, t);
  const Vec8x3 vn = v - scaled(t, vt);
  const Vec8 vn2 = dot(vn, vn);
  const Vec8 Cn = Vec8(pass.drag_across) * wet * vn2 * rsqrt(vn2 + Vec8(tiny));
  const Vec8 Ct = Vec8(pass.drag_along) * wet * max(vt, -vt);
  // (m + M_a + C tau) a = f - C v, across and along the line; tau: from v(n-1/2) to the mean of
  // the velocities before and after the kick. The ends take no part in it: their motion is given.
  const Vec8 tau = Vec8(0.25 * (pass.dt_old + pass.dt)) * a.inner;
  const Vec8 Mn = Vec8(pass.added_across) * wet * a.inner;
  const Vec8 Mt = Vec8(pass.added_along) * wet * a.inner;
  const Vec8 ft = dot(f, t);
  const Vec8x3 fn = f - scaled(t, ft);
  const Vec8 m = a.m + n.get(line_end);  // above 0 also where another has taken an end's mass
  const Vec8 sn = reciprocal(m + Mn + Cn * tau);
  const Vec8 at = fnma(Ct, vt, ft) * reciprocal(m + Mt + Ct * tau);
  const Vec8x3 an = scaled(fn - scaled(vn, Cn), sn);
  const Vec8x3 drag = -(scaled(vn + scaled(an, tau), Cn) + scaled(t, Ct * fma(at, tau, vt)));
  const Vec8x3 added = -(scaled(an, Mn) + scaled(t, Mt * at));
  n.put3(line_drag_x, drag);
  n.put3(line_added_x, added);
  f = f + drag + added;
}

template <bool flows>
GANNET_INLINE void force_block(const LinePass& pass, std::int32_t block) {
  const Numbers n(pass, block);
  const Nodes8 a = gather_nodes(pass, n, block);
  Vec8x3 f = a.f;
  if (pass.bed) bed_forces(pass, n, block, a, f);
  if (pass.displaced > 0) water_forces<flows>(pass, n, block, a, f);
  scatter_corner(pass.f, pass.nodes + 24 * static_cast<std::int64_t>(block), 1, f - a.f);
}

/// Work of one force along both halves of the path.
struct Halves {
  Vec8 before{0.0}, after{0.0};
  GANNET_INLINE void add(const Vec8x3& f, const Vec8x3& old_path, const Vec8x3& new_path) {
    before += dot(f, old_path);
    after += dot(f, new_path);
  }
  GANNET_INLINE void to(double out[2]) const {
    out[0] = sum(before);
    out[1] = sum(after);
  }
};

/// The path of eight nodes, as work_path() in plan/plan.hpp.
struct Paths {
  Vec8x3 before, after;
  GANNET_INLINE Paths(const LinePass& pass, const std::int32_t* nodes) {
    Vec8 line[4];
    gather_lines(pass.v, nodes + 8, 1, line);
    const Vec8x3 v{line[0], line[1], line[2]};
    const Vec8x3 f = gather_corner<Vec8>(pass.f, nodes, 1);
    const Vec8 kick = line[3] * Vec8(0.5 * (pass.dt_old + pass.dt));
    before = scaled(v - scaled(f, kick), Vec8(0.5 * pass.dt_old));
    after = scaled(v, Vec8(0.5 * pass.dt));
  }
};

}  // namespace

__attribute__((flatten)) void line_force_pass(const LinePass& pass, std::int32_t begin,
                                              std::int32_t end) {
  if (pass.current != nullptr) {
    for (std::int32_t b = begin; b < end; ++b) force_block<true>(pass, b);
  } else {
    for (std::int32_t b = begin; b < end; ++b) force_block<false>(pass, b);
  }
}

__attribute__((flatten)) void line_work_pass(const LinePass& pass, std::int32_t begin,
                                             std::int32_t end, LineSums& sums) {
  const Vec8 zero(0.0);
  Halves buoyancy, drag, current, added, bed, friction;
  for (std::int32_t block = begin; block < end; ++block) {
    const Numbers n(pass, block);
    const Paths path(pass, pass.nodes + 24 * static_cast<std::int64_t>(block));
    if (pass.bed) {
      bed.add({zero, zero, n.get(line_bed)}, path.before, path.after);
      if (pass.friction > 0) {
        friction.add({n.get(line_friction_x), n.get(line_friction_y), zero}, path.before,
                     path.after);
      }
    }
    if (!(pass.displaced > 0)) continue;
    const Vec8 water = -n.get(line_buoyancy);
    buoyancy.add({water * Vec8(pass.g[0]), water * Vec8(pass.g[1]), water * Vec8(pass.g[2])},
                 path.before, path.after);
    const Vec8x3 f = n.get3(line_drag_x);
    drag.add(f, path.before, path.after);
    added.add(n.get3(line_added_x), path.before, path.after);
    if (pass.current == nullptr) continue;
    const Vec8x3 u = current_of(pass, block);
    current.add(f, scaled(u, Vec8(0.5 * pass.dt_old)), scaled(u, Vec8(0.5 * pass.dt)));
  }
  buoyancy.to(sums.buoyancy);
  drag.to(sums.drag);
  current.to(sums.current);
  added.to(sums.added);
  bed.to(sums.bed);
  friction.to(sums.friction);
}

}  // namespace gannet::GANNET_ISA_NS
