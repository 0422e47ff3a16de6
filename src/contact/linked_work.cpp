#include "contact/linked_work.hpp"

#include <algorithm>
#include <utility>

namespace gannet {

namespace {

/// Forces on the surface nodes: -N_i f of every row that touches.
void spread(const ContactInput& in, const std::vector<Vec3>& of_rows, Array<Line>& f) {
  std::fill(f.begin(), f.end(), Line{});
  const auto n_rows = static_cast<std::size_t>(in.candidates->n_rows());
  for (std::size_t r = 0; r < n_rows; ++r) {
    const Gap& gap = in.gaps[r];
    if (gap.segment < 0 || !(gap.penetration > 0)) continue;
    const Segment& g = in.surface->segments[static_cast<std::size_t>(gap.segment)];
    for (std::size_t c = 0; c < static_cast<std::size_t>(g.n_corners); ++c) {
      add_xyz(f[static_cast<std::size_t>(g.corner[c])], -gap.N[c] * of_rows[r]);
    }
  }
}

}  // namespace

void add_linked_work(const ContactInput& in, const Link& link, LinkedForce& force) {
  spread(in, *force.of_rows, force.f);
  double work = 0;
  for (std::size_t i = 0; i < force.f.size(); ++i) {
    const Vec3 mean = 0.5 * (xyz(force.f[i]) + xyz(force.f_level[i]));
    work += mean.dot(xyz(link.path[i]));
  }
  force.entry->value -= work;
  std::swap(force.f, force.f_level);
}

}  // namespace gannet
