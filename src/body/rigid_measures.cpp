#include "body/rigid_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "plan/link.hpp"

namespace gannet {

namespace {

using Sample = std::function<Vec3()>;

/// A vector that a body can be asked for: its name in the scene, its unit, and what its components
/// are called in the table of a probe.
struct BodyVector {
  std::string name;
  std::string unit;
  std::array<const char*, 3> columns;
  bool turns = false;  ///< in the plane its component along z counts, else the others
  Sample sample;
};

/// What impulses of a slower model add to the force that the body was kicked with.
Excess excess_of(const Scene& scene, const RigidBody& body) {
  return excess_of_impulses(
      scene, xyz(scene.nodes.x[static_cast<std::size_t>(body.node)]),
      [&](Index i) { return i == body.node || std::ranges::binary_search(body.members, i); });
}

/// The components of a vector whose motion is given, from bit `first` of the mask on: there the
/// reaction has held back the impulses too.
Vec3 given(const RigidBody& body, unsigned first, Vec3 value) {
  for (unsigned d = 0; d < 3; ++d) {
    if ((body.given >> (first + d) & 1u) == 0) value[static_cast<int>(d)] = 0;
  }
  return value;
}

std::vector<BodyVector> vectors_of(const Scene& scene, const Model& model, const RigidBody& body) {
  const Nodes& nodes = scene.nodes;
  const auto c = static_cast<std::size_t>(body.node);
  const Step& step = model.step;
  return {
      {"position", "m", {"x", "y", "z"}, false, [&nodes, c]() -> Vec3 { return xyz(nodes.x[c]); }},
      {"velocity",
       "m/s",
       {"vx", "vy", "vz"},
       false,
       [&nodes, &body, &step] { return velocity_at_level(nodes, body.node, step.dt); }},
      {"angles", "rad", {"roll", "pitch", "yaw"}, true, [&body] { return roll_pitch_yaw(body.q); }},
      {"angular_velocity",
       "rad/s",
       {"wx", "wy", "wz"},
       true,
       [&body, &step] { return angular_velocity_at_level(body, step.dt); }},
      {"force",
       "N",
       {"fx", "fy", "fz"},
       false,
       [&scene, &body]() -> Vec3 { return body.force - excess_of(scene, body).force; }},
      {"moment",
       "N m",
       {"mx", "my", "mz"},
       true,
       [&scene, &body]() -> Vec3 { return body.moment - excess_of(scene, body).moment; }},
      {"reaction",
       "N",
       {"reaction x", "reaction y", "reaction z"},
       false,
       [&scene, &body]() -> Vec3 {
         return body.reaction + given(body, 0, excess_of(scene, body).force);
       }},
      {"reaction_moment",
       "N m",
       {"reaction mx", "reaction my", "reaction mz"},
       true,
       [&scene, &body]() -> Vec3 {
         return body.couple + given(body, 3, excess_of(scene, body).moment);
       }},
  };
}

}  // namespace

Vec3 roll_pitch_yaw(const Eigen::Vector4d& q) {
  const Mat3 R = Quaternion(q[3], q[0], q[1], q[2]).toRotationMatrix();
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
          std::atan2(R(1, 0), R(0, 0))};
}

void add_body_measures(Scene& scene, const Model& model, const RigidBody& body) {
  const std::string prefix = "body." + body.name + ".";
  for (const BodyVector& vector : vectors_of(scene, model, body)) {
    scene.measures.push_back(
        {prefix + vector.name, vector.unit, {"x", "y", "z"}, [sample = vector.sample](double* to) {
           const Vec3 value = sample();
           for (int d = 0; d < 3; ++d) to[d] = value[d];
         }});
  }
  scene.measures.push_back({prefix + "quaternion", "", {"x", "y", "z", "w"}, [&body](double* to) {
                              for (int d = 0; d < 4; ++d) to[d] = body.q[d];
                            }});
}

void add_body_probe(Scene& scene, const Model& model, const RigidBody& body,
                    const std::string& name) {
  Measure measure{name, "", {}, {}};
  std::vector<std::pair<Sample, int>> columns;
  for (const BodyVector& vector : vectors_of(scene, model, body)) {
    for (int d = 0; d < 3; ++d) {
      if (scene.dimension == 2 && (d == 2) != vector.turns) continue;
      if (!columns.empty()) measure.unit += ",";
      measure.unit += vector.unit;
      measure.components.emplace_back(vector.columns[static_cast<std::size_t>(d)]);
      columns.emplace_back(vector.sample, d);
    }
  }
  measure.sample = [columns](double* to) {
    for (std::size_t k = 0; k < columns.size(); ++k) to[k] = columns[k].first()[columns[k].second];
  };
  scene.measures.push_back(std::move(measure));
}

}  // namespace gannet
