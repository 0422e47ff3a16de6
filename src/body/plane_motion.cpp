#include "body/plane_motion.hpp"

#include <fmt/format.h>

#include "body/effects.hpp"
#include "scene/tracked_values.hpp"

namespace gannet {

namespace {
namespace plane_motion {

Schema schema() {
  Key rotation{.name = "rotation", .kind = Kind::map, .text = "turns the planes about an axis"};
  rotation.keys = {Key{.name = "axis",
                       .kind = Kind::vector,
                       .text = "direction of the axis, of any length",
                       .required = true},
                   Key{.name = "centre",
                       .kind = Kind::vector,
                       .unit = dim::length,
                       .text = "a point of the axis",
                       .fallback = "[0, 0, 0]"},
                   Key{.name = "angle",
                       .kind = Kind::function,
                       .unit = dim::angle,
                       .text = "by how much they are turned since the start",
                       .variables = {"t"}},
                   Key{.name = "rate",
                       .kind = Kind::function,
                       .unit = dim::angular_velocity,
                       .text = "how fast they turn",
                       .variables = {"t"}}};
  Key motion{.name = "motion", .kind = Kind::map, .text = "how the planes of the boundary move"};
  motion.keys = {Key{.name = "velocity",
                     .kind = Kind::vector_function,
                     .unit = dim::velocity,
                     .text = "velocity of the planes",
                     .variables = {"t"}},
                 Key{.name = "displacement",
                     .kind = Kind::vector_function,
                     .unit = dim::length,
                     .text = "how far they are from where they started",
                     .variables = {"t"}},
                 rotation};
  return {{"boundaries.*", motion}};
}

void read_rotation(const Keys& keys, PlaneMotion& motion) {
  if (keys.has("angle") == keys.has("rate")) {
    keys.complain("", "a rotation is given by one of angle and rate");
    return;
  }
  const Vec3 axis = keys.vector("axis");
  if (!(axis.norm() > 0)) {
    keys.complain("axis", "an axis needs a length above 0");
    return;
  }
  motion.turns = true;
  motion.by_angle = keys.has("angle");
  motion.turn = keys.function(motion.by_angle ? "angle" : "rate");
  motion.axis = axis.normalized();
  motion.centre = keys.vector("centre");
}

void read_motion(const Keys& keys, const std::string& boundary, Scene& scene) {
  PlaneMotion motion;
  motion.name = boundary;
  motion.where = keys.where();
  if (keys.has("velocity") && keys.has("displacement")) {
    keys.complain("displacement", "a motion is given by one of velocity and displacement");
    return;
  }
  motion.by_place = keys.has("displacement");
  if (motion.by_place || keys.has("velocity")) {
    motion.shift = keys.vector_function(motion.by_place ? "displacement" : "velocity");
  } else if (!keys.has("rotation")) {
    keys.complain("", "say how the planes move: velocity, displacement or rotation");
    return;
  }
  if (keys.has("rotation")) read_rotation(keys.map("rotation"), motion);
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    Plane& plane = scene.planes[k];
    if (plane.name != boundary && !plane.name.starts_with(boundary + ".")) continue;
    plane.moves = true;
    plane.turns = motion.turns;
    motion.planes.push_back(k);
    motion.point.push_back(plane.point);
    motion.normal.push_back(plane.normal);
    if (motion.by_place || motion.turns) continue;
    plane.velocity = plane.velocity_old = value_at(motion.shift, 0);
  }
  if (motion.planes.empty()) {
    keys.complain("", "the boundary has no planes to move");
    return;
  }
  scene.store.get<PlaneMotions>().list.push_back(std::move(motion));
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("boundaries")) return;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    const Keys boundary = boundaries.map(name);
    if (boundary.has("motion")) read_motion(boundary.map("motion"), name, scene);
  }
}

/// Where planes are and how they move goes into checkpoints as it is: who looks at them after a
/// restart, in whatever order, finds what an unbroken run has.
void track_motion(PlaneMotion& motion, Scene& scene) {
  const std::string owner = "moving planes";
  const std::string name = "motion." + motion.name + ".";
  track_values(scene, owner, name + "d", "m", 3, [&motion] { return motion.d.data(); });
  track_values(scene, owner, name + "theta", "rad", 1, [&motion] { return &motion.theta; });
  for (const std::size_t k : motion.planes) {
    const std::string plane = "plane." + scene.planes[k].name + ".";
    const auto add = [&](const char* what, const char* unit, Vec3 Plane::*member) {
      track_values(scene, owner, plane + what, unit, 3,
                   [&scene, k, member] { return (scene.planes[k].*member).data(); });
    };
    add("point", "m", &Plane::point);
    add("normal", "", &Plane::normal);
    add("velocity", "m/s", &Plane::velocity);
    add("velocity_old", "m/s", &Plane::velocity_old);
    add("spin", "rad/s", &Plane::spin);
    add("spin_old", "rad/s", &Plane::spin_old);
  }
}

void operations(const Keys&, Scene& scene, Models& models) {
  if (!scene.store.has<PlaneMotions>()) return;
  const bool particles = !scene.particles.empty();
  Model& model = particles ? models.of_node(scene.particles.begin) : models.list.back();
  for (PlaneMotion& motion : scene.store.get<PlaneMotions>().list) {
    track_motion(motion, scene);
    const auto add = [&](const char* what, Stage stage, std::function<void(const Step&)> run) {
      model.plan.add({.name = fmt::format("planes of {}: {}", motion.name, what),
                      .reason = asked_for_at(motion.where),
                      .stage = stage,
                      .writes = {"planes"},
                      .run = std::move(run)});
    };
    add("velocity", Stage::kick, [&](const Step& step) { choose_motion(motion, scene, step); });
    add("half way", Stage::half_drift, [&](const Step&) {
      place_planes(motion, 0.5 * (motion.d + motion.d_next),
                   0.5 * (motion.theta + motion.theta_next), scene);
    });
    add("new place", Stage::drift, [&](const Step&) {
      motion.d = motion.d_next;
      motion.theta = motion.theta_next;
      place_planes(motion, motion.d, motion.theta, scene);
    });
  }
}

}  // namespace plane_motion
}  // namespace

void place_planes(const PlaneMotion& motion, const Vec3& d, double theta, Scene& scene) {
  const Mat3 R = Eigen::AngleAxisd(theta, motion.axis).toRotationMatrix();
  for (std::size_t k = 0; k < motion.planes.size(); ++k) {
    Plane& plane = scene.planes[motion.planes[k]];
    plane.point = motion.point[k] + d;
    if (!motion.turns) continue;
    plane.point = motion.centre + R * (motion.point[k] - motion.centre) + d;
    plane.normal = R * motion.normal[k];
  }
}

void choose_motion(PlaneMotion& motion, Scene& scene, const Step& step) {
  const double next = step.t + step.dt;
  motion.d_next = motion.d;
  motion.theta_next = motion.theta;
  if (motion.by_place) {
    motion.d_next = value_at(motion.shift, next) - value_at(motion.shift, 0);
  } else {
    for (int c = 0; c < 3; ++c) {
      const Function& v = motion.shift.component[static_cast<std::size_t>(c)];
      motion.d_next[c] += step.dt * mean_over(v, step.t, next);
    }
  }
  if (motion.by_angle) {
    motion.theta_next = value_at(motion.turn, next) - value_at(motion.turn, 0);
  } else if (motion.turns) {
    motion.theta_next += step.dt * mean_over(motion.turn, step.t, next);
  }
  const Vec3 spin = motion.axis * ((motion.theta_next - motion.theta) / step.dt);
  const Mat3 R_next = Eigen::AngleAxisd(motion.theta_next, motion.axis).toRotationMatrix();
  for (std::size_t k = 0; k < motion.planes.size(); ++k) {
    Plane& plane = scene.planes[motion.planes[k]];
    plane.velocity_old = plane.velocity;
    plane.spin_old = plane.spin;
    plane.velocity = (motion.d_next - motion.d) / step.dt;
    if (!motion.turns) continue;
    const Vec3 then = motion.centre + R_next * (motion.point[k] - motion.centre) + motion.d_next;
    plane.velocity = (then - plane.point) / step.dt;
    plane.spin = spin;
  }
}

Effect plane_motion_effect() {
  return {.name = "plane motion",
          .schema = plane_motion::schema,
          .state = plane_motion::state,
          .operations = plane_motion::operations};
}

}  // namespace gannet
