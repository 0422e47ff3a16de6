#include "body/rigid_body.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cassert>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "plan/effect.hpp"
#include "scene/followers.hpp"

namespace gannet {

namespace {

Quaternion quaternion_of(const Eigen::Vector4d& q) { return {q[3], q[0], q[1], q[2]}; }

Vec3 torque_on_member(const Nodes& nodes, std::size_t i, const Vec3& centre) {
  Vec3 torque = (xyz(nodes.x[i]) - centre).cross(xyz(nodes.f[i]));
  if (nodes.rotating.contains(static_cast<Index>(i))) torque += xyz(nodes.torque[i]);
  return torque;
}

/// Gathers what acts on the members to the centre, in their order, and what it carries.
void gather(RigidBody& body, Nodes& nodes) {
  body.omega_old = xyz(nodes.omega[static_cast<std::size_t>(body.node)]);
  const auto c = static_cast<std::size_t>(body.node);
  const Vec3 centre = xyz(nodes.x[c]);
  Vec3 force = xyz(nodes.f[c]) + body.carrier->force;
  Vec3 torque = xyz(nodes.torque[c]) + body.carrier->moment;
  for (const Index member : body.members) {
    const auto i = static_cast<std::size_t>(member);
    force += xyz(nodes.f[i]);
    torque += torque_on_member(nodes, i, centre);
  }
  set_xyz(nodes.f[c], force);
  set_xyz(nodes.torque[c], torque);
  body.force = force;
  body.moment = torque;
}

[[noreturn]] void fail(const RigidBody& body, const Step& step) {
  throw RunError(
      {"the rotation of a rigid body could not be found", body.name,
       fmt::format("at t = {:.6g} s, step {}: angular momentum {:.6g} kg m^2/s, step {:.6g} s",
                   step.t, step.n, body.L.norm(), step.dt),
       "look for forces that grow without bound on its nodes"});
}

/// Mean of component d of the given motion over a step.
double given_rate(const RigidBody& body, int d, const Step& step) {
  if (step.t < body.motion.held_until) return 0;
  return mean_over(body.motion.rate[static_cast<std::size_t>(d)], step.t, step.t + step.dt);
}

/// Gives the centre what is given of its velocity, after the free kick.
void guide_centre(RigidBody& body, Nodes& nodes, const Step& step) {
  const auto c = static_cast<std::size_t>(body.node);
  body.reaction.setZero();
  for (int d = 0; d < 3; ++d) {
    if ((body.given >> d & 1u) == 0) continue;
    Vec3 v = xyz(nodes.v[c]);
    const double wanted = given_rate(body, d, step);
    body.reaction[d] = (wanted - v[d]) / (nodes.v[c].w * body.dt_kick);
    v[d] = wanted;
    set_xyz(nodes.v[c], v);
  }
  add_xyz(nodes.f[c], body.reaction);
}

/// Rotation over the step to come, after L received the moment of the forces.
FreeRotation turn_body(RigidBody& body, const Quaternion& q, const Step& step) {
  body.couple.setZero();
  const unsigned mask = body.given >> 3;
  if (mask == 0) return rotate_freely(q, body.L, body.inverse_inertia, step.dt);
  Vec3 wanted = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    if ((mask >> d & 1u) == 0) continue;
    wanted[d] = given_rate(body, d + 3, step);
  }
  const Vec3 free = body.L;
  const FreeRotation result = rotate_guided(q, body.inertia, mask, wanted, step.dt, body.L);
  body.couple = (body.L - free) / body.dt_kick;
  return result;
}

void kick(RigidBody& body, Nodes& nodes, const Step& step) {
  const auto c = static_cast<std::size_t>(body.node);
  body.dt_kick = 0.5 * (step.dt_old + step.dt);
  body.given = step.t < body.motion.held_until ? 63u : body.motion.mask;
  guide_centre(body, nodes, step);
  body.L += body.dt_kick * body.moment;
  const Quaternion q = quaternion_of(body.q);
  const FreeRotation turn = turn_body(body, q, step);
  if (!turn.settled) fail(body, step);
  body.torque = body.moment + body.couple;
  body.q_next = turn.q;
  body.carrier->q = q;
  body.carrier->q_next = turn.q;
  set_xyz(nodes.omega[c], turn.omega);
  const Vec3 v_centre = xyz(nodes.v[c]);
  const Mat3 R = q.toRotationMatrix();
  const Mat3 R_next = turn.q.toRotationMatrix();
  for (std::size_t k = 0; k < body.members.size(); ++k) {
    const auto i = static_cast<std::size_t>(body.members[k]);
    const Vec3 v = v_centre + (R_next * body.arms[k] - R * body.arms[k]) / step.dt;
    const Vec3 a = (v - xyz(nodes.v[i])) / body.dt_kick;
    nodes.v[i] = {v.x(), v.y(), v.z(), 1};
    set_xyz(nodes.f[i], a);
    if (nodes.rotating.contains(body.members[k])) set_xyz(nodes.omega[i], turn.omega);
  }
}

void release_members(const RigidBody& body, Nodes& nodes) {
  for (const Index member : body.members) nodes.v[static_cast<std::size_t>(member)].w = 0;
}

void place_members(RigidBody& body, Nodes& nodes) {
  body.q = body.q_next.coeffs();
  body.carrier->q = body.q_next;
  const Mat3 R = body.q_next.toRotationMatrix();
  const Vec3 centre = xyz(nodes.x[static_cast<std::size_t>(body.node)]);
  for (std::size_t k = 0; k < body.members.size(); ++k) {
    set_xyz(nodes.x[static_cast<std::size_t>(body.members[k])], centre + R * body.arms[k]);
  }
}

/// Makes members follow: no mass of their own, the velocity of the body.
void enlist_members(RigidBody& body, Nodes& nodes, const Vec3& omega) {
  const auto c = static_cast<std::size_t>(body.node);
  const Quaternion q = quaternion_of(body.q);
  for (const Index member : body.members) {
    const auto i = static_cast<std::size_t>(member);
    const Vec3 r = xyz(nodes.x[i]) - xyz(nodes.x[c]);
    body.arms.emplace_back(q.conjugate() * r);
    const Vec3 v = xyz(nodes.v[c]) + omega.cross(r);
    nodes.x[i].w = 0;
    nodes.v[i] = {v.x(), v.y(), v.z(), 0};
    if (!nodes.rotating.contains(member)) continue;
    nodes.omega[i] = {omega.x(), omega.y(), omega.z(), 0};
    nodes.torque[i].w = 0;
  }
}

/// The least principal moment of inertia of a body.
double softest(const RigidBody& body) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(body.inertia).eigenvalues()[0];
}

/// Notes whom the members follow, and how easily they are moved.
void note_followers(Scene& scene, const RigidBody& body, double mass) {
  auto& followers = scene.store.get<Followers>();
  const auto n = static_cast<std::size_t>(scene.nodes.n_owned);
  followers.leader.resize(n, -1);
  followers.inverse_mass.resize(n, 0);
  const double least = softest(body);
  for (std::size_t k = 0; k < body.members.size(); ++k) {
    const auto i = static_cast<std::size_t>(body.members[k]);
    followers.leader[i] = body.node;
    followers.inverse_mass[i] = 1 / mass + body.arms[k].squaredNorm() / least;
  }
}

/// Lets others see the body.
void note_carrier(Scene& scene, RigidBody& body, double mass) {
  body.carrier = &scene.store.get<Carriers>().list.emplace_back(Carrier{.name = body.name});
  Carrier& c = *body.carrier;
  c.node = body.node;
  c.q = c.q_next = quaternion_of(body.q);
  c.inverse_mass = 1 / mass;
  c.softest = softest(body);
  c.inverse_inertia = body.inverse_inertia;
  scene.after_restart.emplace_back([&body] { body.carrier->q = quaternion_of(body.q); });
}

void track(Scene& scene, const std::string& body, const std::string& name, const std::string& unit,
           double* values, int components) {
  Field f;
  f.name = body + "." + name;
  f.unit = unit;
  f.over = Over::scene;
  f.components = components;
  const auto size = static_cast<std::ptrdiff_t>(sizeof(double));
  f.layout = {components * size, components * size, size, 1};
  f.owner = "rigid body";
  f.base = [values] { return reinterpret_cast<std::byte*>(values); };
  f.count = [] { return Index{1}; };
  scene.fields.push_back(std::move(f));
}

}  // namespace

FreeRotation rotate_guided(const Quaternion& q, const Mat3& inertia, unsigned mask,
                           const Vec3& wanted, double dt, Vec3& L) {
  const Mat3 A = q.toRotationMatrix();
  const double angle = 0.5 * dt * wanted.norm();
  const Vec3 target = angle > 0 ? Vec3(wanted * (std::tan(angle) / angle)) : wanted;
  Vec3 Omega = A.transpose() * target;
  const auto momentum = [&](const Vec3& w) -> Vec3 {
    const Vec3 Pi = inertia * w;
    return A * (Pi - 0.5 * dt * Pi.cross(w));
  };
  double last = std::numeric_limits<double>::infinity();
  for (int round = 1; round <= 30; ++round) {
    const Mat3 turned = cross_matrix(inertia * Omega) - cross_matrix(Omega) * inertia;
    Mat3 slope = A * (inertia - 0.5 * dt * turned);
    Vec3 residual = momentum(Omega) - L;
    for (int d = 0; d < 3; ++d) {
      if ((mask >> d & 1u) == 0) continue;
      slope.row(d) = A.row(d);
      residual[d] = A.row(d).dot(Omega) - target[d];
    }
    const Vec3 change = slope.inverse() * residual;
    const double size = change.norm();
    Omega -= change;
    const double scale = Omega.norm();
    if (size <= 1e-15 * scale || (size <= 1e-13 * scale && size >= last)) {
      const Vec3 result = momentum(Omega);
      for (int d = 0; d < 3; ++d) {
        if ((mask >> d & 1u) != 0) L[d] = result[d];
      }
      const Vec3 half = 0.5 * dt * Omega;
      return {(q * Quaternion(1, half.x(), half.y(), half.z())).normalized(), A * Omega, round,
              true};
    }
    last = size;
  }
  return {q, Vec3::Zero(), 30, false};
}

RigidBody& make_rigid_body(Scene& scene, const RigidBodyInput& input) {
  Nodes& nodes = scene.nodes;
  assert(nodes.rotating.contains(input.node) && input.mass > 0);
  RigidBody& body = scene.store.get<RigidBodies>().list.emplace_back();
  body.name = input.name;
  body.where = input.where;
  body.node = input.node;
  body.members = input.members;
  body.inertia = input.inertia;
  body.motion = input.motion;
  body.inverse_inertia = input.inertia.inverse();
  const Quaternion q = input.q.normalized();
  body.q = q.coeffs();
  body.q_next = q;
  body.L = q * (body.inertia * (q.conjugate() * input.omega));
  const auto c = static_cast<std::size_t>(body.node);
  nodes.x[c].w = input.mass;
  nodes.v[c].w = 1 / input.mass;
  // Neither the kick nor the energy of the leapfrog knows a body's rotation.
  nodes.omega[c] = {input.omega.x(), input.omega.y(), input.omega.z(), 0};
  nodes.torque[c].w = 0;
  enlist_members(body, nodes, input.omega);
  note_followers(scene, body, input.mass);
  note_carrier(scene, body, input.mass);
  track(scene, body.name, "q", "", body.q.data(), 4);
  track(scene, body.name, "L", "kg m^2/s", body.L.data(), 3);
  return body;
}

double rotation_energy(const RigidBody& body, double dt) {
  const Vec3 L = body.L - 0.5 * dt * body.torque;
  const Vec3 Pi = quaternion_of(body.q).conjugate() * L;
  return 0.5 * Pi.dot(body.inverse_inertia * Pi);
}

Vec3 angular_velocity_at_level(const RigidBody& body, double dt) {
  const Quaternion q = quaternion_of(body.q);
  const Vec3 L = body.L - 0.5 * dt * body.torque;
  return q * (body.inverse_inertia * (q.conjugate() * L));
}

namespace {

/// Work of what the given motion takes at level n.
Work work_of_motion(const RigidBody& body, const Nodes& nodes, const Step& step) {
  WorkPath turned;
  turned.col(0) = 0.5 * step.dt_old * body.omega_old;
  turned.col(1) = 0.5 * step.dt * xyz(nodes.omega[static_cast<std::size_t>(body.node)]);
  return work_along(work_path(nodes, body.node, step), body.reaction) +
         work_along(turned, body.couple);
}

}  // namespace

void add_rigid_body_operations(Scene& scene, Model& model, Ledger& ledger, RigidBody& body) {
  Nodes& nodes = scene.nodes;
  const std::string reason = asked_for_at(body.where);
  const auto add = [&](const char* what, Stage stage, std::function<void(const Step&)> run) {
    return &model.plan.add(
        {.name = body.name + ": " + what, .reason = reason, .stage = stage, .run = std::move(run)});
  };
  Operation* gathering =
      add("gather forces", Stage::accelerate, [&](const Step&) { gather(body, nodes); });
  gathering->stable_dt = [&body] {
    const Vec3 Pi = quaternion_of(body.q).conjugate() * body.L;
    const double omega = (body.inverse_inertia * Pi).norm();
    return omega > 0 ? 0.2 / omega : std::numeric_limits<double>::infinity();
  };
  gathering->limited_by = [&body] { return body.name + ": its rotation"; };
  add("rotate", Stage::kick, [&](const Step& step) { kick(body, nodes, step); });
  LedgerEntry& energy = ledger.entry("kinetic of rotation", body.name);
  add("energy of rotation", Stage::look,
      [&](const Step& step) { energy.value = rotation_energy(body, step.dt); });
  if (body.motion.any()) {
    LedgerEntry& work = ledger.entry("prescribed motion", body.name);
    work.external = true;
    add("work of the given motion", Stage::look,
        [&](const Step& step) { work.add_work(work_of_motion(body, nodes, step)); });
  }
  add("release members", Stage::half_drift, [&](const Step&) { release_members(body, nodes); });
  add("place members", Stage::drift, [&](const Step&) { place_members(body, nodes); });
}

}  // namespace gannet
