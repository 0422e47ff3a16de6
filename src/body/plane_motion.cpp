#include "body/plane_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "body/effects.hpp"
#include "plan/model_of_part.hpp"
#include "plan/model_planes.hpp"
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

void add_operation(const PlaneMotion& motion, Model& model, const char* what, Stage stage,
                   std::function<void(const Step&)> run) {
  model.plan.add({.name = fmt::format("planes of {}: {}", motion.name, what),
                  .reason = asked_for_at(motion.where),
                  .stage = stage,
                  .writes = {"planes"},
                  .run = std::move(run)});
}

/// The motion of the scene's planes.
void add_motion(PlaneMotion& motion, Scene& scene, Model& model) {
  track_motion(motion, scene);
  add_operation(motion, model, "velocity", Stage::kick,
                [&](const Step& step) { choose_motion(motion, scene.planes, step); });
  add_operation(motion, model, "half way", Stage::half_drift, [&](const Step&) {
    place_planes(motion, 0.5 * (motion.d + motion.d_next), 0.5 * (motion.theta + motion.theta_next),
                 scene.planes);
  });
  add_operation(motion, model, "new place", Stage::drift, [&](const Step&) {
    motion.d = motion.d_next;
    motion.theta = motion.theta_next;
    place_planes(motion, motion.d, motion.theta, scene.planes);
  });
}

/// The same for the planes that another model sees.
void add_seen_motion(SeenMotion& seen, Model& model) {
  add_operation(seen.its, model, "place at the level", Stage::force, [&](const Step& step) {
    follow_motion(*seen.of, seen.time->t, seen.its, *seen.planes, step);
  });
  add_operation(seen.its, model, "velocity", Stage::kick,
                [&](const Step& step) { choose_motion(seen.its, *seen.planes, step); });
}

/// Gives the models of parts that meet planes their own, but for the one that moves the scene's.
void add_own_planes(Scene& scene, Models& models, const Model& mover) {
  auto& motions = scene.store.get<PlaneMotions>();
  auto& all = scene.store.get<ModelPlanes>();
  for (const int part : all.parts) {
    Model& model = model_of_part(scene, models, part);
    if (&model == &mover || all.own.contains(&model)) continue;
    std::vector<Plane>& planes = all.own[&model] = scene.planes;
    for (const PlaneMotion& motion : motions.list) {
      add_seen_motion(motions.seen.emplace_back(SeenMotion{motion, &motion, &mover.step, &planes}),
                      model);
    }
  }
}

void operations(const Keys&, Scene& scene, Models& models) {
  if (!scene.store.has<PlaneMotions>()) return;
  const bool particles = !scene.particles.empty();
  Model& model = particles ? models.of_node(scene.particles.begin) : models.list.back();
  for (PlaneMotion& motion : scene.store.get<PlaneMotions>().list) {
    add_motion(motion, scene, model);
  }
  if (scene.store.has<ModelPlanes>()) add_own_planes(scene, models, model);
}

/// Displacement [m] and angle [rad] of planes.
struct Pose {
  Vec3 d;
  double theta;
};

/// Where planes are that are at `from` at time t, after dt more [s], which may be below 0.
Pose pose_after(const PlaneMotion& motion, const Pose& from, double t, double dt) {
  Pose pose = from;
  if (dt == 0) return pose;
  const double next = t + dt;
  const auto way = [&](const Function& rate) {
    return dt * mean_over(rate, std::min(t, next), std::max(t, next));
  };
  if (motion.by_place) {
    pose.d = value_at(motion.shift, next) - value_at(motion.shift, 0);
  } else {
    for (int c = 0; c < 3; ++c) {
      pose.d[c] += way(motion.shift.component[static_cast<std::size_t>(c)]);
    }
  }
  if (motion.by_angle) {
    pose.theta = value_at(motion.turn, next) - value_at(motion.turn, 0);
  } else if (motion.turns) {
    pose.theta += way(motion.turn);
  }
  return pose;
}

void stand(PlaneMotion& motion, const Pose& pose, std::vector<Plane>& planes) {
  motion.d = pose.d;
  motion.theta = pose.theta;
  place_planes(motion, motion.d, motion.theta, planes);
}

}  // namespace plane_motion
}  // namespace

void place_planes(const PlaneMotion& motion, const Vec3& d, double theta,
                  std::vector<Plane>& planes) {
  const Mat3 R = Eigen::AngleAxisd(theta, motion.axis).toRotationMatrix();
  for (std::size_t k = 0; k < motion.planes.size(); ++k) {
    Plane& plane = planes[motion.planes[k]];
    plane.point = motion.point[k] + d;
    if (!motion.turns) continue;
    plane.point = motion.centre + R * (motion.point[k] - motion.centre) + d;
    plane.normal = R * motion.normal[k];
  }
}

void choose_motion(PlaneMotion& motion, std::vector<Plane>& planes, const Step& step) {
  const auto next = plane_motion::pose_after(motion, {motion.d, motion.theta}, step.t, step.dt);
  motion.d_next = next.d;
  motion.theta_next = next.theta;
  const Vec3 spin = motion.axis * ((motion.theta_next - motion.theta) / step.dt);
  const Mat3 R_next = Eigen::AngleAxisd(motion.theta_next, motion.axis).toRotationMatrix();
  for (std::size_t k = 0; k < motion.planes.size(); ++k) {
    Plane& plane = planes[motion.planes[k]];
    plane.velocity_old = plane.velocity;
    plane.spin_old = plane.spin;
    plane.velocity = (motion.d_next - motion.d) / step.dt;
    if (!motion.turns) continue;
    const Vec3 then = motion.centre + R_next * (motion.point[k] - motion.centre) + motion.d_next;
    plane.velocity = (then - plane.point) / step.dt;
    plane.spin = spin;
  }
}

void follow_motion(const PlaneMotion& of, double T, PlaneMotion& its, std::vector<Plane>& planes,
                   const Step& step) {
  using namespace plane_motion;
  const Pose known{of.d, of.theta};
  if (step.dt_old > 0) {
    const double before = step.t - step.dt_old;
    stand(its, pose_after(of, known, T, before - T), planes);
    choose_motion(its, planes, {.t = before, .dt = step.dt_old});
  }
  stand(its, pose_after(of, known, T, step.t - T), planes);
}

Effect plane_motion_effect() {
  return {.name = "plane motion",
          .schema = plane_motion::schema,
          .state = plane_motion::state,
          .operations = plane_motion::operations};
}

}  // namespace gannet
