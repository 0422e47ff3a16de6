#include "body/rigid_phase.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "base/free_rotation.hpp"
#include "plan/effect.hpp"

namespace gannet {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Quaternion orientation(const RigidPhase& p) { return {p.q[3], p.q[0], p.q[1], p.q[2]}; }

Vec3 momentum(const RigidPhase& p) { return {p.L[0], p.L[1], p.L[2]}; }

Vec3 arm(const RigidPhase& p, std::size_t k) {
  return {p.arms[3 * k], p.arms[3 * k + 1], p.arms[3 * k + 2]};
}

Mat3 inertia_of(const RigidPhase& p) {
  Mat3 I;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) I(r, c) = p.inertia[at(3 * r + c)];
  }
  return I;
}

void set(Array<double>& to, const Vec3& v) {
  for (int d = 0; d < 3; ++d) to[at(d)] = v[d];
}

/// Moment of all forces about the centre, f as the kicks of this step left it.
Vec3 moment_about(const Nodes& nodes, const std::vector<Index>& list, const Vec3& centre) {
  Vec3 T = Vec3::Zero();
  for (const Index i : list) {
    T += (xyz(nodes.x[at(i)]) - centre).cross(xyz(nodes.f[at(i)]));
    if (nodes.rotating.contains(i)) T += xyz(nodes.torque[at(i)]);
  }
  return T;
}

/// Gives node k a velocity and an angular velocity in place of those of the free kick; notes the
/// force and the couple that this takes.
void redirect(RigidPhase& p, Nodes& nodes, std::size_t k, const Vec3& v, const Vec3& omega,
              double dt) {
  const auto i = at(p.nodes[k]);
  p.force[k] = nodes.x[i].w / dt * (v - xyz(nodes.v[i]));
  add_xyz(nodes.f[i], p.force[k]);
  set_xyz(nodes.v[i], v);
  if (!nodes.rotating.contains(p.nodes[k])) return;
  p.couple[k] = nodes.torque[i].w / dt * (omega - xyz(nodes.omega[i]));
  add_xyz(nodes.torque[i], p.couple[k]);
  set_xyz(nodes.omega[i], omega);
}

/// Projects the velocities of the free kick onto rigid motion.
void move_as_one(RigidPhase& p, Nodes& nodes, const Step& step) {
  const double dt = 0.5 * (step.dt_old + step.dt);
  const MassCentre centre = mass_centre(nodes, p.nodes);
  const Vec3 L = momentum(p) + dt * moment_about(nodes, p.nodes, centre.x);
  set(p.L, L);
  const Quaternion q = orientation(p);
  const FreeRotation turn = rotate_freely(q, L, inertia_of(p).inverse(), step.dt);
  if (!turn.settled) {
    throw RunError({"the rotation of parts that are rigid for a time could not be found", p.name,
                    fmt::format("at t = {:.6g} s, step {}", step.t, step.n),
                    "look for forces that grow without bound on its nodes"});
  }
  const Mat3 turned = (turn.q.toRotationMatrix() - q.toRotationMatrix()) / step.dt;
  Vec3 mean = Vec3::Zero();  // of the rotation alone: roundings, which would add up over steps
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    mean += nodes.x[at(p.nodes[k])].w / centre.m * (turned * arm(p, k));
  }
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    redirect(p, nodes, k, centre.v + turned * arm(p, k) - mean, turn.omega, dt);
  }
  for (int d = 0; d < 4; ++d) p.q[at(d)] = turn.q.coeffs()[d];
}

/// Velocities of the nodes before the kick of this step: of what lock() and release() ask.
struct BeforeKick {
  Nodes& nodes;
  const std::vector<Index>& list;
  double dt;
  BeforeKick(Nodes& n, const std::vector<Index>& l, double step) : nodes(n), list(l), dt(step) {
    shift(-dt);
  }
  ~BeforeKick() { shift(dt); }
  BeforeKick(const BeforeKick&) = delete;
  BeforeKick& operator=(const BeforeKick&) = delete;
  void shift(double by) {
    for (const Index i : list) {
      add_xyz(nodes.v[at(i)], by * nodes.v[at(i)].w * xyz(nodes.f[at(i)]));
      if (!nodes.rotating.contains(i)) continue;
      add_xyz(nodes.omega[at(i)], by * nodes.omega[at(i)].w * xyz(nodes.torque[at(i)]));
    }
  }
};

/// Lets the nodes go on by themselves, with the angular momentum of the body.
void release(RigidPhase& p, Nodes& nodes, double dt) {
  p.phase[0] = 1;
  p.switched = true;
  Vec3 missing;
  {
    const BeforeKick before(nodes, p.nodes, dt);
    missing = momentum(p) - spin_about(nodes, p.nodes, mass_centre(nodes, p.nodes));
  }
  const Vec3 c = mass_centre(nodes, p.nodes).x;
  const Vec3 spin = inertia_about(nodes, p.nodes, c).inverse() * missing;
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    const auto i = at(p.nodes[k]);
    const bool turns = nodes.rotating.contains(p.nodes[k]);
    const Vec3 omega = turns ? Vec3(xyz(nodes.omega[i]) + spin) : Vec3(Vec3::Zero());
    redirect(p, nodes, k, xyz(nodes.v[i]) + spin.cross(xyz(nodes.x[i]) - c), omega, dt);
  }
}

bool touched(const Scene& scene, const RigidPhase& p) {
  return std::ranges::any_of(scene.measures, [&](const Measure& m) {
    const bool meant = std::ranges::any_of(p.contacts, [&](const std::string& contact) {
      return m.name == "contact." + contact + ".active";
    });
    double active = 0;
    if (meant) m.sample(&active);
    return active > 0;
  });
}

/// Touch sets nothing free once they would be rigid again.
bool ends(const Scene& scene, const RigidPhase& p, double t) {
  if (t >= p.times.until) return true;
  return p.times.until_contact && t < p.times.again_from && touched(scene, p);
}

void after_kick(Scene& scene, RigidPhase& p, const Step& step) {
  Nodes& nodes = scene.nodes;
  const double dt = 0.5 * (step.dt_old + step.dt);
  std::ranges::fill(p.force, Vec3::Zero());
  std::ranges::fill(p.couple, Vec3::Zero());
  p.switched = false;
  if (p.phase[0] == 0 && ends(scene, p, step.t)) return release(p, nodes, dt);
  if (p.phase[0] == 1 && step.t >= p.times.again_from) {
    p.phase[0] = 2;
    p.switched = true;
    const BeforeKick before(nodes, p.nodes, dt);
    lock(p, nodes);
  }
  if (p.is_rigid()) move_as_one(p, nodes, step);
}

/// Takes roundings of the way out of the places.
void place(RigidPhase& p, Nodes& nodes) {
  if (!p.is_rigid()) return;
  const Vec3 c = mass_centre(nodes, p.nodes).x;
  const Mat3 R = orientation(p).toRotationMatrix();
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    set_xyz(nodes.x[at(p.nodes[k])], c + R * arm(p, k));
  }
}

/// What an impulse g dt beside a force f leaves out of the kinetic energy at its level and not out
/// of that of the next, (|f + g|^2 - |f|^2) dt^2/(8 m) [J].
double half_of_impulse(const Line& total, const Vec3& impulse, double inverse_mass, double dt) {
  const Vec3 f = xyz(total);
  return 0.125 * dt * dt * inverse_mass * (f.squaredNorm() - (f - impulse).squaredNorm());
}

/// The sum of it over the nodes.
double left_out_at_level(const RigidPhase& p, const Nodes& nodes, double dt) {
  double sum = 0;
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    const auto i = at(p.nodes[k]);
    sum += half_of_impulse(nodes.f[i], p.force[k], nodes.v[i].w, dt);
    if (!nodes.rotating.contains(p.nodes[k])) continue;
    sum += half_of_impulse(nodes.torque[i], p.couple[k], nodes.omega[i].w, dt);
  }
  return sum;
}

/// Work of the projection along the paths of the nodes.
Work work_of_locking(const RigidPhase& p, const Nodes& nodes, const Step& step) {
  Work work = Work::Zero();
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    const auto i = at(p.nodes[k]);
    work += work_along(work_path(nodes, p.nodes[k], step), p.force[k]);
    if (!nodes.rotating.contains(p.nodes[k])) continue;
    const Vec3 omega = xyz(nodes.omega[i]);
    const Vec3 before =
        omega - 0.5 * (step.dt_old + step.dt) * nodes.omega[i].w * xyz(nodes.torque[i]);
    work +=
        Work(0.5 * step.dt_old * before.dot(p.couple[k]), 0.5 * step.dt * omega.dot(p.couple[k]));
  }
  return work;
}

}  // namespace

MassCentre mass_centre(const Nodes& nodes, const std::vector<Index>& list) {
  MassCentre c;
  for (const Index i : list) {
    const double m = nodes.x[at(i)].w;
    c.m += m;
    c.x += m * xyz(nodes.x[at(i)]);
    c.v += m * xyz(nodes.v[at(i)]);
  }
  c.x /= c.m;
  c.v /= c.m;
  return c;
}

Vec3 spin_about(const Nodes& nodes, const std::vector<Index>& list, const MassCentre& centre) {
  Vec3 L = Vec3::Zero();
  for (const Index i : list) {
    const Vec3 r = xyz(nodes.x[at(i)]) - centre.x;
    L += nodes.x[at(i)].w * r.cross(xyz(nodes.v[at(i)]) - centre.v);
    if (nodes.rotating.contains(i)) L += nodes.torque[at(i)].w * xyz(nodes.omega[at(i)]);
  }
  return L;
}

Mat3 inertia_about(const Nodes& nodes, const std::vector<Index>& list, const Vec3& centre) {
  Mat3 I = Mat3::Zero();
  for (const Index i : list) {
    const Vec3 r = xyz(nodes.x[at(i)]) - centre;
    I += nodes.x[at(i)].w * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    if (nodes.rotating.contains(i)) I += nodes.torque[at(i)].w * Mat3::Identity();
  }
  return I;
}

void lock(RigidPhase& p, const Nodes& nodes) {
  const MassCentre centre = mass_centre(nodes, p.nodes);
  const Mat3 I = inertia_about(nodes, p.nodes, centre.x);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) p.inertia[at(3 * r + c)] = I(r, c);
  }
  p.q = {0, 0, 0, 1};
  set(p.L, spin_about(nodes, p.nodes, centre));
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    const Vec3 r = xyz(nodes.x[at(p.nodes[k])]) - centre.x;
    for (std::size_t d = 0; d < 3; ++d) p.arms[3 * k + d] = r[static_cast<Eigen::Index>(d)];
  }
}

void make_rigid_phase(Scene& scene, RigidPhase& p) {
  p.phase = {0};
  p.q = {0, 0, 0, 1};
  p.L.assign(3, 0);
  p.inertia.assign(9, 0);
  p.arms.assign(3 * p.nodes.size(), 0);
  p.force.assign(p.nodes.size(), Vec3::Zero());
  p.couple.assign(p.nodes.size(), Vec3::Zero());
  lock(p, scene.nodes);
  const auto track = [&](const char* name, const char* unit, Array<double>& values) {
    Field f = plain_field("rigid." + p.name + "." + name, unit, "", Over::scene, values, 1,
                          GhostRule::none);
    f.owner = "rigid for a time";
    scene.fields.push_back(std::move(f));
  };
  track("phase", "1", p.phase);
  track("q", "1", p.q);
  track("L", "kg m^2/s", p.L);
  track("inertia", "kg m^2", p.inertia);
  track("arms", "m", p.arms);
}

void add_rigid_phase(Scene& scene, RigidPhase& p, Model& model, Ledger& ledger) {
  const std::string reason = asked_for_at(p.where);
  model.plan.add({.name = p.name + ": rigid for a time",
                  .reason = reason,
                  .stage = Stage::kick,
                  .reads = {"x", "v", "f"},
                  .writes = {"v", "omega", "f", "torque"},
                  .run = [&scene, &p](const Step& step) { after_kick(scene, p, step); }});
  LedgerEntry& entry = ledger.entry("locking", p.name);
  model.plan.add({.name = p.name + ": work of locking",
                  .reason = reason,
                  .stage = Stage::look,
                  .reads = {"v", "f"},
                  .run = [&scene, &p, &entry](const Step& step) {
                    Work work = -work_of_locking(p, scene.nodes, step);
                    if (p.switched) {
                      const double late = left_out_at_level(p, scene.nodes, step.dt);
                      work += Work(-late, late);
                    }
                    entry.add_work(work);
                  }});
  model.plan.add({.name = p.name + ": places of a rigid body",
                  .reason = reason,
                  .stage = Stage::drift,
                  .writes = {"x"},
                  .run = [&scene, &p](const Step&) { place(p, scene.nodes); }});
}

}  // namespace gannet
