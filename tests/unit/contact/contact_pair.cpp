#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>
#include <random>

#include "base/parallel.hpp"
#include "contact/node_to_segment.hpp"
#include "scenes.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A waved plate of 10 x 8 quads and 600 particles close to it on both sides, at random.
Builder crowd() {
  Builder b;
  b.nx = 10;
  b.ny = 8;
  b.node_mass = 4;
  b.particle_mass = 1.5;
  b.shape = [](double x, double y) { return Vec3(x, y, 0.3 * std::sin(0.7 * x + 0.4 * y)); };
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 600; ++i) {
    const double x = -0.3 + 10.6 * u(random);
    const double y = -0.3 + 8.6 * u(random);
    const double z = 0.3 * std::sin(0.7 * x + 0.4 * y) + (u(random) - 0.5);
    b.particles.emplace_back(x, y, z);
  }
  return b;
}

Vec3 sum_of_forces(const Scene& s) {
  Vec3 sum = Vec3::Zero();
  for (const Line& f : s.nodes.f) sum += xyz(f);
  return sum;
}

Vec3 sum_of_moments(const Scene& s) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
    sum += xyz(s.nodes.x[i]).cross(xyz(s.nodes.f[i]));
  }
  return sum;
}

double sum_of_sizes(const Scene& s) {
  double sum = 0;
  for (const Line& f : s.nodes.f) sum += xyz(f).norm();
  return sum;
}

bool same_bits(const Array<Line>& a, const Array<Line>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Line)) == 0;
}

/// A particle above one quad, flying at it; k/m = 1e6, so a touch lasts about pi ms.
Builder bouncer(double node_mass, const Vec3& x, const Vec3& v) {
  Builder b;
  b.node_mass = node_mass;
  b.particles = {x};
  b.particle_velocity = v;
  return b;
}

double contact_energy(const Run& run) {
  for (const LedgerEntry& e : run.models.ledger.entries()) {
    if (e.name == "contact") return e.value;
  }
  return 0;
}

struct Bounce {
  double restitution;  ///< relative normal speed after over before
  double energy;       ///< largest imbalance over the kinetic energy, on the way
};

Bounce bounce(Builder b, double dt, double damping = 0) {
  Scene scene;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1e6, 0, damping);
  Run run(scene, &c, dt);
  const double before = kinetic(scene);
  const Vec3 p = momentum(scene);
  const double v0 = b.particle_velocity.z();
  const auto steps = static_cast<int>(std::lround(0.1 / dt));
  for (int i = 0; i < steps; ++i) run.step();
  CHECK((momentum(scene) - p).norm() < 1e-12 * b.particle_mass * std::abs(v0));
  Vec3 plate = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) plate += 0.25 * xyz(scene.nodes.v[i]);
  const double v = xyz(scene.nodes.v[4]).z();
  // The balance counts kinetic energy and the work of the contact's normal force alone.
  return {-(v - plate.z()) / v0, std::abs(kinetic(scene) + contact_energy(run) - before) / before};
}

/// A plate of 2 x 2 quads whose nodes are free, members of a rigid body, or held, at random, and
/// twelve particles close to it; the body turns about the held node 4 in its middle.
void fill_mixed(Scene& scene, std::mt19937& random) {
  std::uniform_real_distribution<double> u(0, 1);
  Builder b;
  b.nx = b.ny = 2;
  b.node_mass = 0.3 + u(random);
  b.particle_mass = 0.5 + 50 * u(random);
  b.shape = [](double x, double y) { return Vec3(x, y, 0.2 * std::sin(2 * x + y)); };
  for (int i = 0; i < 12; ++i) {
    const double x = 0.05 + 1.9 * u(random);
    const double y = 0.05 + 1.9 * u(random);
    b.particles.emplace_back(x, y, b.shape(x, y).z() + 0.06);
  }
  b.fill(scene);
  auto& followers = scene.store.get<Followers>();
  followers.leader.assign(scene.nodes.x.size(), -1);
  followers.inverse_mass.assign(scene.nodes.x.size(), 0);
  for (std::size_t i = 0; i < 9; ++i) {
    if (i != 4 && u(random) < 0.5) followers.leader[i] = 4;
    if (i == 4 || followers.leader[i] == 4) scene.nodes.v[i].w = 0;
  }
  Carrier& body = scene.store.get<Carriers>().list.emplace_back();
  body.node = 4;
  body.inverse_mass = 2 * u(random);
  body.inverse_inertia = Vec3(u(random), 3 * u(random), 5 * u(random)).asDiagonal();
}

/// The largest eigenvalue of M^-1 K, K = sum k g g^T over all rows, in the 3 numbers of each node
/// and the 6 of the body; with friction in three directions a row.
double true_omega2(Scene& scene, const NodeToSegment& c) {
  const Carrier& body = scene.store.get<Carriers>().list.front();
  const auto& followers = scene.store.get<Followers>();
  const auto n = static_cast<Eigen::Index>(3 * scene.nodes.x.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + 6, n + 6);
  const Mat3 root = body.inverse_inertia.cwiseSqrt();  // diagonal, not turned
  const Vec3 centre = xyz(scene.nodes.x[static_cast<std::size_t>(body.node)]);
  for (std::size_t r = 0; r < c.gaps.size(); ++r) {
    const Gap& gap = c.gaps[r];
    if (gap.segment < 0) continue;
    const Index p = scene.particles.begin + c.candidates.point[r];
    const double m = scene.nodes.x[static_cast<std::size_t>(p)].w;
    for (Eigen::Index d = 0; d < (c.law.friction > 0 ? 3 : 1); ++d) {
      const Vec3 along = c.law.friction > 0 ? Vec3(Vec3::Unit(d)) : gap.normal;
      Eigen::VectorXd g = Eigen::VectorXd::Zero(n + 6);
      g.segment<3>(3 * p) = along / std::sqrt(m);
      const Segment& s = c.surface.segments[static_cast<std::size_t>(gap.segment)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(s.n_corners); ++k) {
        const Index node = c.surface.node[static_cast<std::size_t>(s.corner[k])];
        const auto i = static_cast<std::size_t>(node);
        g.segment<3>(3 * node) -= gap.N[k] * std::sqrt(scene.nodes.v[i].w) * along;
        if (followers.leader_of(node) != body.node) continue;
        const Vec3 arm = xyz(scene.nodes.x[i]) - centre;
        g.segment<3>(n) -= gap.N[k] * std::sqrt(body.inverse_mass) * along;
        g.segment<3>(n + 3) -= gap.N[k] * root * arm.cross(along);
      }
      K += c.law.stiffness(m) * g * g.transpose();
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues().maxCoeff();
}

}  // namespace

TEST_CASE("contact: forces of one pair by hand", "[contact]") {
  Scene scene;
  Builder b = bouncer(2, {0.25, 0.5, 0.06}, {0, 0, 0});
  b.particle_mass = 0.5;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1000);
  apply_contact(scene, c, {}, search(scene, c, {}));
  // p = 0.04 is there from the start: no force, reported.
  CHECK(xyz(scene.nodes.f[4]).norm() == 0);
  CHECK(c.search_numbers[1] == 1);
  CHECK(c.search_numbers[2] == Approx(0.04));
  scene.nodes.x[4].z = 0.12;  // moves out: the offset is gone
  apply_contact(scene, c, {}, search(scene, c, {}));
  scene.nodes.x[4].z = 0.06;
  apply_contact(scene, c, {}, search(scene, c, {}));
  // k = 1000 * 0.5, f = 500 * 0.04 = 20; N = 3/8, 1/8, 1/8, 3/8 (corners 0, 1, 3, 2 by node)
  CHECK(scene.nodes.f[4].z == Approx(20));
  CHECK(scene.nodes.f[0].z == Approx(-7.5));
  CHECK(scene.nodes.f[1].z == Approx(-2.5));
  CHECK(scene.nodes.f[2].z == Approx(-7.5));
  CHECK(scene.nodes.f[3].z == Approx(-2.5));
  CHECK(c.scattered.active == 1);
  CHECK(c.scattered.on_surface.z() == Approx(-20));
  // 2 k/m of the particle 2000, of nodes at most 2 * 500 * 3/8 / 2 = 187.5
  CHECK(c.rate.node == 4);
  CHECK(c.rate.omega2 == Approx(2000));
  CHECK(contact_step(c.rate.omega2, 0) == Approx(0.8 / std::sqrt(2000.0)));
}

TEST_CASE("contact: the limit of stiffness holds", "[contact]") {
  const ContactLaw law{1000, 300, 0, 0};
  CHECK(law.stiffness(0.2) == 200);
  CHECK(law.stiffness(0.5) == 300);
}

TEST_CASE("contact: forces and moments sum to zero", "[contact]") {
  for (const double damping : {0.0, 0.2}) {
    Scene scene;
    const Builder b = crowd();
    b.fill(scene);
    NodeToSegment& c = add_contact(scene, 0.3, 1e4, 0, damping);
    (void)search(scene, c, {});
    for (std::size_t i = 0; i < scene.nodes.v.size(); ++i) {
      scene.nodes.v[i].z = std::sin(static_cast<double>(i));
    }
    apply_contact(scene, c, {}, false);
    CHECK(c.scattered.active > 200);
    const double scale = sum_of_sizes(scene);
    CHECK(sum_of_forces(scene).norm() < 1e-14 * scale);
    CHECK(sum_of_moments(scene).norm() < 1e-13 * scale * 10);  // lever arms are up to 10
    CHECK((c.scattered.on_surface).norm() > 0);
  }
}

TEST_CASE("contact: same bits for any number of threads", "[contact]") {
  Array<Line> first;
  for (const int n : {1, 2, 3, 5}) {
    set_threads(n);
    Scene scene;
    crowd().fill(scene);
    NodeToSegment& c = add_contact(scene, 0.3, 1e4, 0.3, 0.1);
    Run run(scene, &c, 1e-3);
    for (int i = 0; i < 50; ++i) run.step();
    if (n == 1) first = scene.nodes.x;
    CHECK(same_bits(first, scene.nodes.x));
  }
  set_threads(0);
}

TEST_CASE("contact: bits do not depend on when lists were made", "[contact]") {
  // A free flight of a crowd through a plate with the usual lists, against one that looks at all
  // pairs in every step.
  Scene lists;
  Scene pairs;
  Builder b = crowd();
  b.particle_velocity = {0.3, 0, -2};
  b.fill(lists);
  b.fill(pairs);
  NodeToSegment& a = add_contact(lists, 0.3, 1e4);
  NodeToSegment& c = add_contact(pairs, 0.3, 1e4);
  Run with_lists(lists, &a, 1e-3);
  Run with_pairs(pairs, &c, 1e-3);
  int made = 0;
  double built_at = 0;
  for (int i = 0; i < 200; ++i) {
    with_lists.step();
    if (i > 0) c.search_numbers[0] = 0;  // forces a new list at the next step
    with_pairs.step();
    made += a.x_search[0].z != built_at ? 1 : 0;
    built_at = a.x_search[0].z;
    REQUIRE(same_bits(lists.nodes.x, pairs.nodes.x));
  }
  CHECK(made > 2);  // 2 m/s for 0.2 s crosses the skin of 0.1 m a few times
  CHECK(made < 10);
}

TEST_CASE("contact: a restart makes the same list, a sort only renames particles", "[contact]") {
  Scene scene;
  crowd().fill(scene);
  NodeToSegment& c = add_contact(scene, 0.3, 1e4);
  Run run(scene, &c, 1e-3);
  for (int i = 0; i < 20; ++i) run.step();
  const SegmentCandidates before = c.candidates;
  c.candidates = {};
  for (const auto& rebuild : scene.after_restart) rebuild();
  CHECK(c.candidates.point == before.point);
  CHECK(c.candidates.segment == before.segment);
  CHECK(c.gaps.size() == before.point.size());
  const std::vector<std::string> tracked{"contact.c.x_search", "contact.c.side", "contact.c.offset",
                                         "contact.c.node_x_search", "contact.c.search_numbers"};
  for (const std::string& name : tracked) CHECK(scene.field(name) != nullptr);
  CHECK(scene.field("contact.c.tangential") == nullptr);  // no friction, no field
  CHECK(scene.index_lists.size() == 1);
}

TEST_CASE("contact: nodes that follow a body vote with what a force on them moves", "[contact]") {
  Scene scene;
  Builder b = bouncer(0, {0.25, 0.5, 0.06}, {0, 0, 0});
  b.particle_mass = 0.5;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1000);
  apply_contact(scene, c, {}, search(scene, c, {}));
  CHECK(c.rate.omega2 == Approx(2000));  // of the particle; nodes without mass alone do not count
  auto& followers = scene.store.get<Followers>();
  followers.leader = {3, 3, 3, -1, -1};
  followers.inverse_mass = {10, 20, 30, 0, 0};
  apply_contact(scene, c, {}, search(scene, c, {}));
  // 2 k sum N w = 2 * 500 * (3/8 10 + 1/8 20 + 3/8 30)
  CHECK(c.rate.node == 3);
  CHECK(c.rate.omega2 == Approx(17500));
}

TEST_CASE("contact: a rigid body votes with its mass and inertia", "[contact]") {
  Scene scene;
  Builder b = bouncer(0, {0.25, 0.5, 0.06}, {0, 0, 0});
  b.particle_mass = 0.5;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1000);
  auto& followers = scene.store.get<Followers>();
  followers.leader = {5, 5, 5, 5, -1, -1};
  followers.inverse_mass = {10, 20, 30, 40, 0, 0};
  b.add_node(scene, {1, 1, 0}, Vec3::Zero(), 0);
  scene.nodes.n_owned = 6;
  Carrier& body = scene.store.get<Carriers>().list.emplace_back();
  body.node = 5;
  body.inverse_mass = 4;
  body.inverse_inertia = Vec3(1, 2, 3).asDiagonal();
  // One row: 2 k (1/M + (r x n) I^-1 (r x n)), r from the centre in the plane of the segment.
  apply_contact(scene, c, {}, search(scene, c, {}));
  const Vec3 r = Vec3(0.25, 0.5, 0) - xyz(scene.nodes.x[5]);
  CHECK(c.rate.node == 5);
  CHECK(c.rate.omega2 == Approx(2 * 500 * (4 + r.y() * r.y() + 2 * r.x() * r.x())));
  // Turned by a quarter about z, the axes have changed places.
  body.q = Quaternion(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ()));
  apply_contact(scene, c, {}, search(scene, c, {}));
  CHECK(c.rate.omega2 == Approx(2 * 500 * (4 + 2 * r.y() * r.y() + r.x() * r.x())));
}

TEST_CASE("contact: a body in the plane votes with its one moment of inertia", "[contact]") {
  Scene scene;
  Builder b = bouncer(0, {0.25, 0.06, 0.5}, {0, 0, 0});
  b.shape = [](double x, double z) { return Vec3(x, 0, z); };
  b.particle_mass = 0.5;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1000);
  auto& followers = scene.store.get<Followers>();
  followers.leader = {5, 5, 5, 5, -1, -1};
  followers.inverse_mass.assign(6, 0);
  b.add_node(scene, {1, 0, 1}, Vec3::Zero(), 0);
  scene.nodes.n_owned = 6;
  Carrier& body = scene.store.get<Carriers>().list.emplace_back();
  body.node = 5;
  body.inverse_mass = 4;
  body.inverse_inertia = Vec3(0, 0, 3).asDiagonal();
  apply_contact(scene, c, {}, search(scene, c, {}));
  // The arm in the plane is -0.75 along x; that along z, -0.5, would turn it out of the plane.
  CHECK(c.rate.node == 5);
  CHECK(c.rate.omega2 == Approx(2 * 500 * (4 + 3 * 0.75 * 0.75)));
}

TEST_CASE("contact: two rows at both arms of a body add up to an eigenvalue, not a trace",
          "[contact]") {
  // Two quads in a row, the body's centre in their middle: rows at x = 0.5 and 1.5.
  for (const double friction : {0.0, 0.3}) {
    Scene scene;
    Builder b;
    b.nx = 2;
    b.node_mass = 0;
    b.particle_mass = 0.5;
    b.particles = {{0.5, 0.5, 0.06}, {1.5, 0.5, 0.06}};
    b.fill(scene);
    NodeToSegment& c = add_contact(scene, 0.1, 1000, friction);
    auto& followers = scene.store.get<Followers>();
    followers.inverse_mass.assign(9, 0);
    b.add_node(scene, {1, 0.5, 0}, Vec3::Zero(), 0);
    followers.leader = {8, 8, 8, 8, 8, 8, -1, -1, -1};
    scene.nodes.n_owned = 9;
    Carrier& body = scene.store.get<Carriers>().list.emplace_back();
    body.node = 8;
    body.inverse_mass = 4;
    body.inverse_inertia = Vec3(1, 20, 12).asDiagonal();
    apply_contact(scene, c, {}, search(scene, c, {}));
    // k = 500: heave 2 k/M = 4000, pitch 2 k 0.5^2 20 = 5000, yaw with friction 3000. The trace is
    // 9000, with friction 4000 x 3 + 5000 + 3000. The vote is twice the largest.
    CHECK(c.rate.node == 8);
    CHECK(c.rate.omega2 == Approx(10000));
  }
}

TEST_CASE("contact: a segment that belongs to a body in part votes with that part", "[contact]") {
  Scene scene;
  Builder b = bouncer(1e9, {0.25, 0.5, 0.06}, {0, 0, 0});
  b.particle_mass = 0.5;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1000);
  auto& followers = scene.store.get<Followers>();
  // Nodes 1 and 2, N = 1/8 and 3/8, so a share of 1/2 whose foot is at (0.25, 0.75); the first
  // corner is free.
  followers.leader = {-1, 3, 3, -1, -1};
  followers.inverse_mass.assign(5, 0);
  for (const std::size_t i : {1, 2, 3}) scene.nodes.v[i].w = 0;
  Carrier& body = scene.store.get<Carriers>().list.emplace_back();
  body.node = 3;
  body.inverse_mass = 4;
  body.inverse_inertia = Vec3(1, 2, 3).asDiagonal();
  apply_contact(scene, c, {}, search(scene, c, {}));
  CHECK(c.rate.node == 3);
  CHECK(c.rate.omega2 == Approx(2 * 500 * 0.5 * (4 + 0.25 * 0.25 + 2 * 0.75 * 0.75)));
}

TEST_CASE("contact: the vote bounds the true rate of segments of bodies and free nodes",
          "[contact]") {
  std::mt19937 random(5);
  int of_body = 0;
  double closest = 0;
  for (int i = 0; i < 200; ++i) {
    Scene scene;
    fill_mixed(scene, random);
    NodeToSegment& c = add_contact(scene, 0.1, 1000, i % 2 == 0 ? 0.0 : 0.3);
    apply_contact(scene, c, {}, search(scene, c, {}));
    const double exact = true_omega2(scene, c);
    CHECK(exact <= c.rate.omega2 * (1 + 1e-12));
    closest = std::max(closest, exact / c.rate.omega2);
    of_body += c.rate.node == 4 ? 1 : 0;
  }
  CHECK(of_body > 50);
  CHECK(closest > 0.5);
}

TEST_CASE("contact: particles far away make no pairs and no vote", "[contact]") {
  Scene scene;
  bouncer(1, {0.5, 0.5, 5}, {0, 0, 0}).fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1e6);
  apply_contact(scene, c, {}, search(scene, c, {}));
  CHECK(c.candidates.n_rows() == 0);
  CHECK(c.scattered.active == 0);
  CHECK(contact_step(c.rate.omega2, 0) == std::numeric_limits<double>::infinity());
}

TEST_CASE("contact: elastic bounce on a free plate, restitution 1 and energy of order 2",
          "[contact][convergence]") {
  // Central, so that the plate does not turn; then the exit speed follows from both balances.
  const Builder b = bouncer(1, {0.5, 0.5, 0.15}, {0, 0, -10});
  const Bounce coarse = bounce(b, 1e-4);
  const Bounce fine = bounce(b, 5e-5);
  const Bounce finest = bounce(b, 1e-5);
  CHECK(std::abs(coarse.restitution - 1) < 2e-2);
  CHECK(std::abs(fine.restitution - 1) < 5e-3);
  CHECK(std::abs(finest.restitution - 1) < 1e-3);
  // Work along work_path() is what changes the kinetic energy, to rounding.
  for (const Bounce& r : {coarse, fine, finest}) CHECK(r.energy < 1e-12);
}

TEST_CASE("contact: bounce off either side, an edge, a corner, all at restitution 1", "[contact]") {
  for (const double side : {1.0, -1.0}) {
    for (const Vec3& at : {Vec3(1, 1, 0), Vec3(1, 0.5, 0), Vec3(0.5, 0.5, 0), Vec3(0.3, 0.3, 0)}) {
      Builder b = bouncer(1e9, at + Vec3(0, 0, side * 0.15), {0, 0, -10 * side});
      b.nx = b.ny = 2;
      Scene scene;
      b.fill(scene);
      NodeToSegment& c = add_contact(scene, 0.1, 1e6);
      Run run(scene, &c, 1e-5);
      for (int i = 0; i < 3000; ++i) run.step();
      CHECK(scene.nodes.v[9].z / (10 * side) == Approx(1).margin(1e-3));
      CHECK(std::abs(scene.nodes.v[9].x) + std::abs(scene.nodes.v[9].y) < 1e-6);
    }
  }
}

TEST_CASE("contact: a particle that crosses the mid-surface comes back", "[contact]") {
  // v/omega = 0.15 m is more than d = 0.1 m, so it passes the mid-surface by 0.05.
  Builder b = bouncer(1e9, {0.4, 0.6, 0.11}, {0, 0, -150});
  Scene scene;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1e6);
  Run run(scene, &c, 1e-5);
  double lowest = 1;
  for (int i = 0; i < 1000; ++i) {
    run.step();
    lowest = std::min(lowest, scene.nodes.x[4].z);
  }
  CHECK(lowest == Approx(-0.05).margin(1e-3));
  CHECK(scene.nodes.v[4].z == Approx(150).epsilon(1e-3));
}

TEST_CASE("contact: friction and damping only take energy, and it is all in the ledger",
          "[contact]") {
  Builder b = bouncer(1, {0.45, 0.5, 0.15}, {3, 0, -10});
  Scene scene;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1e6, 0.2, 0.1);
  Run run(scene, &c, 1e-5);
  const double before = kinetic(scene);
  for (int i = 0; i < 3000; ++i) run.step();
  double held = 0;
  for (const LedgerEntry& e : run.models.ledger.entries()) {
    if (e.name == "friction" || e.name == "contact_damping") CHECK(e.value > 1e-3 * before);
    if (e.name != "kinetic") held += e.value;
  }
  CHECK(kinetic(scene) < before);
  CHECK(std::abs(kinetic(scene) + held - before) < 1e-11 * before);
}

TEST_CASE("contact: sliding friction is mu f_n", "[contact]") {
  // Steady: a weight pressed on a heavy plate slows down at mu g.
  Builder b = bouncer(1e12, {0.2, 0.5, 0.1}, {0.5, 0, 0});
  Scene scene;
  b.fill(scene);
  NodeToSegment& c = add_contact(scene, 0.1, 1e6, 0.3);
  Run run(scene, &c, 1e-4);
  Operation weight;
  weight.name = "weight";
  weight.run = [&scene](const Step&) { scene.nodes.f[4].z -= 10 * scene.nodes.x[4].w; };
  run.model().plan.add(std::move(weight));
  for (int i = 0; i < 1000; ++i) run.step();
  // 0.5 - 0.3 * 10 * 0.1 s; the load comes on at once, so f_n swings about its mean by as much
  CHECK(scene.nodes.v[4].x == Approx(0.2).margin(2e-3));
}

TEST_CASE("contact: the step beside elements, by hand", "[contact]") {
  // Elements at 0.9 of their limit: A + B = 0.81 0.672 + 0.9 0.328 = 0.8395; omega d = 1 adds
  // (1/1.9)^2 = 0.277 and more than 1 is left: the root of 0.8214 s^2 + 0.2951 s = 1, s = t/d.
  CHECK(step_beside(2, 0.25, 0) == Approx(2 * 0.938259).epsilon(1e-5));
  CHECK(step_beside(2, 0, 0) == 2);
  CHECK(step_beside(2, 1e-6, 0) == 2);           // never above that of all else
  CHECK(step_beside(2, 25, 0) == Approx(0.25));  // 1.25/omega
  CHECK(step_beside(std::numeric_limits<double>::infinity(), 4, 0) == Approx(0.625));
  CHECK(step_beside(2, 0.25, 0.5) < step_beside(2, 0.25, 0));
}
