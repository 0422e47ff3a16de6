#include "sph/particle_boxes.hpp"

#include "base/parallel.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {

void add_stretch(const Range& particles, ParticleBoxes& boxes) {
  for (Index k = particles.begin; k < particles.end; k += ParticleBoxes::per_box) {
    const Index end = std::min(particles.end, k + ParticleBoxes::per_box);
    boxes.box.push_back({Vec3::Zero(), Vec3::Zero(), k, end});
  }
}

/// True where a kind of images is shifted by a period.
bool is_shifted(const Image& image, const Vec3& period) {
  for (Eigen::Index d = 0; d < 3; ++d) {
    if (period[d] > 0 && image.shift[d] != 0) return true;
  }
  return false;
}

}  // namespace

void find_boxes(Scene& scene, ParticleBoxes& boxes) {
  const Halo& halo = scene.store.get<SphState>().halo;
  const Index n = scene.particles.size();
  for (std::size_t d = 0; d < 3; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    boxes.period[k] = halo.periodic[d] ? halo.high[k] - halo.low[k] : 0.0;
  }
  boxes.box.clear();
  add_stretch({0, n}, boxes);
  for (const ImageKind& kind : halo.kinds) {
    if (is_shifted(kind.image, boxes.period)) continue;
    add_stretch({n + kind.ghosts.begin, n + kind.ghosts.end}, boxes);
  }
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  parallel_for(static_cast<Index>(boxes.box.size()), 64, [&](Index first, Index last) {
    for (Index b = first; b < last; ++b) {
      ParticleBoxes::Box& box = boxes.box[static_cast<std::size_t>(b)];
      box.low = box.high = xyz(x[box.begin]);
      for (Index k = box.begin; k < box.end; ++k) {
        box.low = box.low.cwiseMin(xyz(x[k]));
        box.high = box.high.cwiseMax(xyz(x[k]));
      }
    }
  });
  if (!boxes.box.empty()) {
    boxes.low = boxes.box.front().low;
    boxes.high = boxes.box.front().high;
  }
  for (const ParticleBoxes::Box& box : boxes.box) {
    boxes.low = boxes.low.cwiseMin(box.low);
    boxes.high = boxes.high.cwiseMax(box.high);
  }
  boxes.fresh = true;
}

const ParticleBoxes& boxes_of(Scene& scene) {
  auto& boxes = scene.store.get<ParticleBoxes>();
  if (!boxes.fresh) find_boxes(scene, boxes);
  return boxes;
}

}  // namespace gannet
