#include "contact/particle_list.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace gannet {

std::span<const Line> particle_lines(const Scene& scene, const Array<Line>& lines) {
  return {lines.data() + scene.particles.begin, static_cast<std::size_t>(scene.particles.size())};
}

std::span<const Line> owned_lines(const Scene& scene, const Array<Line>& lines) {
  return {lines.data(), static_cast<std::size_t>(scene.particles.size())};
}

double list_skin(const Scene& scene, const Surface& surface, const Periods& periods, double dt,
                 SkinRange range) {
  Vec3 v_surface = Vec3::Zero();
  if (!surface.node.empty()) {
    v_surface = xyz(scene.nodes.v[static_cast<std::size_t>(surface.node[0])]);
  }
  const auto v = particle_lines(scene, scene.nodes.v);
  const double v2 = parallel_reduce(
      scene.particles.size(), node_chunk, 0.0,
      [&](Index begin, Index end) {
        double most = 0;
        for (Index i = begin; i < end; ++i) {
          most = std::max(most, (xyz(v[static_cast<std::size_t>(i)]) - v_surface).squaredNorm());
        }
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  double skin = std::clamp(8 * dt * std::sqrt(v2), range.least, range.most);
  for (const double L : periods.length) {
    if (L > 0) skin = std::min(skin, 0.25 * L);
  }
  return skin;
}

}  // namespace gannet
