#include "body/damping.hpp"

#include "base/parallel.hpp"

namespace gannet {

void prepare_damping(DampingForce& damping, const Scene& scene) {
  damping.of_part.clear();
  for (const Part& part : scene.parts) damping.of_part.push_back(part.kind == "sph");
  damping.f.assign(static_cast<std::size_t>(scene.particles.size()), {});
}

DampingWork work_of(const DampingForce& damping, const Scene& scene, const Step& step,
                    const Vec3& u) {
  // Columns: lost and drive; rows: before and after the level.
  using Both = Eigen::Matrix2d;
  const Both none = Both::Zero();
  WorkPath along_u;
  along_u.col(0) = u * (0.5 * step.dt_old);
  along_u.col(1) = u * (0.5 * step.dt);
  const Both sum =
      parallel_sum(scene.awake().size(), node_chunk, none, [&](Index begin, Index end) {
        Both part = none;
        for (Index k = begin; k < end; ++k) {
          const Vec3 f = xyz(damping.f[k]);
          if (f.isZero(0)) continue;
          const WorkPath path = work_path(scene.nodes, scene.particles.begin + k, step);
          part.col(0) -= work_along(path - along_u, f);
          part.col(1) += work_along(along_u, f);
        }
        return part;
      });
  return {sum.col(0), sum.col(1)};
}

}  // namespace gannet
