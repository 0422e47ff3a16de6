#include "sph/neighbour_lists.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "search/spatial_sort.hpp"
#include "sph/moving_walls.hpp"
#include "sph/sticking_walls.hpp"

namespace gannet {

namespace {

double reach(const SphState& sph) { return sph.kernel.reach() + sph.skin.width; }

/// The largest skin of the first n particles [m].
double largest_skin(const SphState& sph, Index n) {
  const double* own = sph.list_skin.data();
  return parallel_reduce(
      n, node_chunk, 0.0,
      [&](Index begin, Index end) { return *std::max_element(own + begin, own + end); },
      [](double a, double b) { return std::max(a, b); });
}

/// Brings the skins, which at the start come from elsewhere, within the bounds of this case.
void bound_skins(SphState& sph) {
  double* own = sph.list_skin.data();
  parallel_for(static_cast<Index>(sph.list_skin.size()), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      own[k] = std::clamp(own[k], sph.skin.least, sph.skin.most);
    }
  });
}

/// Images and list for the positions x_build of the owned particles and their skins; everything
/// that is a function of these, so that a restart finds the same.
void build_from_x_build(SphState& sph, Scene& scene) {
  const Index n = scene.particles.size();
  Halo& halo = sph.halo;
  sph.x_build.resize(static_cast<std::size_t>(n));
  // Who is not seen needs no images: nobody that they might be near to is computed.
  const Index n_seen = scene.seen().size();
  sph.skin.width = largest_skin(sph, n_seen);
  if (halo.active()) choose_images(sph.x_build.data(), n_seen, reach(sph), halo);
  resize_ghosts(halo, scene);
  sph.x_build.resize(static_cast<std::size_t>(n + halo.n_ghosts()));
  parallel_for(halo.n_ghosts(), node_chunk, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) {
      Line& x = sph.x_build[n + g];
      x = sph.x_build[halo.source[g]];
      set_xyz(x, halo.image_of(g).point(xyz(x)));
    }
  });
  copy_out(halo, scene);
  move_images(halo, scene);
  stick_images(halo, scene);
  const std::span<double> skins(sph.list_skin.data(), static_cast<std::size_t>(n_seen));
  start_ageing(sph.x_build, skins, sph.kernel.reach(), sph.dx, sph.age, {n_seen, n});
  build_cluster_list(sph.x_build, n_seen, sph.kernel.reach(), sph.list, isa(), {n_seen, n}, skins);
  if (scene.resting.n > 0) sph.list.n_active = scene.awake().size() / ClusterList::lanes;
  ++sph.n_builds;
}

/// Sorting needs numbers. Throws RunError that names the first particle without
/// a position.
void require_finite(const Scene& scene) {
  const Index n = scene.awake().size();
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  const Index first = parallel_reduce(
      n, node_chunk, n,
      [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
          if (!xyz(x[k]).allFinite()) return k;
        }
        return n;
      },
      [](Index a, Index b) { return std::min(a, b); });
  if (first == n) return;
  throw RunError({"a particle has no position any more (not a number)",
                  text_of_particle(scene, first),
                  "its velocity or a force on it grew without limit",
                  "look at the last frames near that place; a smaller cfl, a "
                  "larger c0 or some "
                  "viscosity may help"});
}

/// What the displacement of particles since the lists were made follows from.
struct Motion {
  const Line* x;
  const Line* v;
  const Line* x_build;
  const Line* X;      ///< null without XSPH
  const Line* shift;  ///< null without shifting
  double dt_half;
  Motion(const SphState& sph, const Scene& scene, double half)
      : x(scene.nodes.x.data() + scene.particles.begin),
        v(scene.nodes.v.data() + scene.particles.begin),
        x_build(sph.x_build.data()),
        X(sph.X.empty() ? nullptr : sph.X.data()),
        shift(sph.shift.empty() ? nullptr : sph.shift.data()),
        dt_half(half) {}
  /// Displacement of particle k, to the end of the step [m].
  [[nodiscard, gnu::always_inline]] inline Vec3 of(Index k) const {
    Vec3 d = xyz(x[k]) - xyz(x_build[k]) + dt_half * xyz(v[k]);
    if (X != nullptr) d += 2 * dt_half * xyz(X[k]);
    if (shift != nullptr) d += 2 * dt_half * xyz(shift[k]);
    return d;
  }
  /// In this step alone [m].
  [[nodiscard]] Vec3 of_step(Index k) const {
    Vec3 d = 2 * dt_half * xyz(v[k]);
    if (X != nullptr) d += 2 * dt_half * xyz(X[k]);
    if (shift != nullptr) d += 2 * dt_half * xyz(shift[k]);
    return d;
  }
};

/// Over particles [m].
struct MotionSum {
  double sum = 0;
  double largest = 0;
};

/// Gives the first n sources how much their cell moves a step: the larger of `until_now`, of so
/// many steps together, and `now`.
MotionSum spread_motion(const ListAge& age, Index n, double steps,
                        const std::vector<double>& until_now, const std::vector<double>& now,
                        Array<double>& of_particle) {
  return parallel_reduce(
      age.n_cells(), 64, MotionSum{},
      [&](Index begin, Index end) {
        MotionSum part;
        for (Index c = begin; c < end; ++c) {
          const double u = std::max(until_now[c] / std::max(1.0, steps), now[c]);
          for (Index k = age.start[c]; k < age.start[c + 1]; ++k) {
            if (age.member[k] >= n) continue;
            of_particle[age.member[k]] = u;
            part.sum += u;
            part.largest = std::max(part.largest, u);
          }
        }
        return part;
      },
      [](const MotionSum& a, const MotionSum& b) {
        return MotionSum{a.sum + b.sum, std::max(a.largest, b.largest)};
      });
}

/// Chooses the skin of each particle from how much its cell moves a step, relative to those near
/// it: on the mean while the last lists were used, and now. What is fast now moves on before
/// anybody asks again whether the new lists are old.
void choose_skins(SphState& sph, const Scene& scene, const Motion& motion) {
  ListAge& age = sph.age;
  const Index n = scene.awake().size();
  const std::vector<double> until_now = relative_motion(age);
  measure_motion(age, [&](Index source) -> Vec3 {
    if (source < scene.particles.size()) return motion.of_step(source);
    const Index g = source - scene.particles.size();
    return sph.halo.image_of(g).vector(motion.of_step(sph.halo.source[g]));
  });
  const std::vector<double> now = relative_motion(age);
  // Particles at rest are in no sum, and have the thinnest.
  const auto n_all = static_cast<Index>(sph.list_skin.size());
  parallel_for(n_all, node_chunk, [&](Index begin, Index end) {
    std::fill(sph.list_skin.begin() + begin, sph.list_skin.begin() + end, 0.0);
  });
  const MotionSum all = spread_motion(age, n, sph.skin.steps, until_now, now, sph.list_skin);
  const double steps = steps_to_last(sph.skin, all.sum / std::max(n, 1), all.largest, sph.dx);
  parallel_for(n_all, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      sph.list_skin[k] = skin_for(sph.skin, sph.list_skin[k], steps);
    }
  });
}

/// Whether a particle that was too far from a wall to have an image has come within 2 h of it, of
/// those in one cell. Water that falls on a floor as a whole does not move relative to itself, so
/// that the age of the lists does not tell.
bool image_is_missing(const SphState& sph, Index n, const Motion& motion, const WallsGone& gone,
                      Index cell) {
  const Halo& halo = sph.halo;
  const double near = sph.kernel.reach();
  const auto came_near = [&](const Vec3& from, const Vec3& to) {
    for (Eigen::Index d = 0; d < 3; ++d) {
      const auto at = static_cast<std::size_t>(d);
      const double low = halo.low[d];
      const double high = halo.high[d];
      if (halo.wall_low[at] && from[d] - low > reach(sph) && to[d] - low - gone.low[d] < near) {
        return true;
      }
      if (halo.wall_high[at] && high - from[d] > reach(sph) && high + gone.high[d] - to[d] < near) {
        return true;
      }
    }
    return false;
  };
  for (Index i = sph.age.start[cell]; i < sph.age.start[cell + 1]; ++i) {
    const Index k = sph.age.member[i];
    if (k >= n) continue;
    const Vec3 from = xyz(sph.x_build[k]);
    if (came_near(from, from + motion.of(k))) return true;
  }
  return false;
}

/// The same of all cells. Only who moved towards a wall by the skin can have come that near.
bool image_is_missing(const SphState& sph, Index n, const Motion& motion, const WallsGone& gone) {
  const Halo& halo = sph.halo;
  const double least = (1 - 1e-6) * sph.skin.width;
  const auto moved = [&](const MotionBox& box) {
    for (std::size_t d = 0; d < 3; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      if (halo.wall_low[d] && box.low[k] - gone.low[k] < -least) return true;
      if (halo.wall_high[d] && box.high[k] - gone.high[k] > least) return true;
    }
    return false;
  };
  return parallel_reduce(
             sph.age.n_cells(), 256, 0,
             [&](Index begin, Index end) {
               for (Index c = begin; c < end; ++c) {
                 const MotionBox& box = sph.age.motion[c];
                 if (moved(box) && image_is_missing(sph, n, motion, gone, c)) return 1;
               }
               return 0;
             },
             [](int a, int b) { return a | b; }) != 0;
}

}  // namespace

void rebuild_lists(SphState& sph, Scene& scene) {
  const Index n = scene.particles.size();
  require_finite(scene);
  if (sph.halo.active()) {
    sph.halo.clear_images();
    resize_ghosts(sph.halo, scene);
    wrap_particles(sph.halo, scene);
    follow_walls(sph.halo, scene);
  }
  sort_particles(scene, sph.dx);
  bound_skins(sph);
  sph.x_build.resize(static_cast<std::size_t>(n));
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    std::copy(x + begin, x + end, sph.x_build.data() + begin);
  });
  build_from_x_build(sph, scene);
  sph.skin.steps = 0;
}

void restore_lists(SphState& sph, Scene& scene) { build_from_x_build(sph, scene); }

void renew_lists(SphState& sph, Scene& scene, double dt_half) {
  if (lists_are_stale(sph, scene, dt_half)) {
    choose_skins(sph, scene, Motion(sph, scene, dt_half));
    rebuild_lists(sph, scene);
  }
  ++sph.skin.steps;
}

bool lists_are_stale(SphState& sph, const Scene& scene, double dt_half) {
  const Index n = scene.particles.size();
  const Motion motion(sph, scene, dt_half);
  const WallsGone gone = walls_gone(sph.halo, scene, dt_half);
  measure_motion(sph.age, [&](Index source) -> Vec3 {
    if (source < n) return motion.of(source);
    const Index g = source - n;
    const Image& image = sph.halo.image_of(g);
    return image.vector(motion.of(sph.halo.source[g])) + gone.of_image(sph.halo, image);
  });
  return outdated(sph.age) || (sph.halo.has_walls() && image_is_missing(sph, n, motion, gone));
}

}  // namespace gannet
