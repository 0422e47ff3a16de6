#include "body/body_mass.hpp"

#include <Eigen/Eigenvalues>

namespace gannet {

BodyMass mass_of_nodes(const Nodes& nodes, const std::vector<Index>& members) {
  BodyMass body;
  Vec3 first = Vec3::Zero();
  for (const Index member : members) {
    const Line& x = nodes.x[static_cast<std::size_t>(member)];
    body.mass += x.w;
    first += x.w * xyz(x);
  }
  if (!(body.mass > 0)) return {};
  body.centre = first / body.mass;
  for (const Index member : members) {
    const Line& x = nodes.x[static_cast<std::size_t>(member)];
    const Vec3 r = xyz(x) - body.centre;
    body.inertia += x.w * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  return body;
}

BodyMass mass_inside(const ClosedSurface& surface, double density) {
  const VolumeMoments m = volume_moments(surface);
  return {density * m.volume, m.centre, density * (m.second.trace() * Mat3::Identity() - m.second)};
}

BodyMass with_nodes(const BodyMass& body, const Nodes& nodes, const std::vector<Index>& members) {
  const BodyMass more = mass_of_nodes(nodes, members);
  if (!(more.mass > 0)) return body;
  BodyMass both;
  both.mass = body.mass + more.mass;
  both.centre = (body.mass * body.centre + more.mass * more.centre) / both.mass;
  for (const BodyMass* one : {&body, &more}) {
    const Vec3 r = one->centre - both.centre;
    both.inertia +=
        one->inertia + one->mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  return both;
}

void flatten(BodyMass& body) { body.inertia = body.inertia(2, 2) * Mat3::Identity(); }

double least_inertia(const BodyMass& body) {
  const double least = Eigen::SelfAdjointEigenSolver<Mat3>(body.inertia).eigenvalues()[0];
  return least > 1e-12 * body.inertia.trace() ? least : 0;
}

}  // namespace gannet
