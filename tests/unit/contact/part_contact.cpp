// Contact between parts of elements: faces, stiffnesses, gaps, all by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "contact/outer_faces.hpp"
#include "contact/part_contact.hpp"
#include "contact/part_search.hpp"

using namespace gannet;

namespace {

/// Nodes of a box of nx x ny x nz hexahedra of the given sizes in x, from `origin` upwards.
Part box(Scene& s, const Vec3& origin, const std::vector<double>& sizes, int ny, int nz, double h) {
  Part p;
  p.kind = "solid";
  p.cell = Cell::hexahedron;
  const auto nx = static_cast<int>(sizes.size());
  const auto first = static_cast<Index>(s.nodes.x.size());
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      double x = origin.x();
      for (int i = 0; i <= nx; ++i) {
        s.nodes.x.push_back({x, origin.y() + j * h, origin.z() + k * h, 1});
        s.nodes.v.push_back({0, 0, 0, 1});
        s.nodes.f.push_back({});
        if (i < nx) x += sizes[static_cast<std::size_t>(i)];
      }
    }
  }
  const auto at = [&](int i, int j, int k) {
    return first + static_cast<Index>((k * (ny + 1) + j) * (nx + 1) + i);
  };
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        for (const Index n :
             {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
              at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)}) {
          p.connectivity.push_back(n);
        }
        p.cell_id.push_back(static_cast<std::int64_t>(p.cell_id.size()) + 1);
      }
    }
  }
  s.nodes.n_owned = static_cast<Index>(s.nodes.x.size());
  p.nodes = {first, s.nodes.n_owned};
  return p;
}

/// A tip of one element on its own above a slab of elements of uneven length, h = 1; the lowest
/// nodes of the tip at height z over the slab, its first at x.
constexpr double kappa = 20.0 / 3;

struct TipOnSlab {
  Scene scene;
  PartContact* contact = nullptr;
  PartMeeting meeting;

  explicit TipOnSlab(double friction = 0) {
    scene.parts.push_back(box(scene, {0, 0, 1}, {0.5}, 1, 1, 0.5));
    scene.parts.push_back(box(scene, {-2, -2, -1}, {1, 1, 2, 0.5}, 4, 1, 1));
    contact = &make_part_contact(scene, "c", {0, 1},
                                 {ShellSurface{.modulus = 10}, ShellSurface{.modulus = 10}}, false,
                                 friction > 0);
    contact->law.friction = friction;
    set_distance(*contact, 0);
    contact->numbers[1] = 1;  // nothing here is an overlap at the start
  }
  void place(double x, double y, double z) {
    const Vec3 corner = xyz(scene.nodes.x[0]);
    for (std::size_t i = 0; i < 8; ++i) add_xyz(scene.nodes.x[i], Vec3(x, y, z) - corner);
    for (Line& f : scene.nodes.f) f = {};
    meeting = {};
    meeting.stiffness.assign(scene.nodes.x.size(), 0);
    part_contact_pass(scene, *contact, {.dt_old = 1e-3, .dt = 1e-3}, meeting);
  }
};

}  // namespace

TEST_CASE("outer faces: of one hexahedron and of two, outwards", "[contact]") {
  Scene s;
  const Part two = box(s, {0, 0, 0}, {1, 2}, 1, 1, 1);
  const OuterFaces outer = outer_faces(two);
  REQUIRE(outer.element.size() == 10);
  CHECK(outer.faces.cell == Cell::quad);
  double volume = 0;  // by the divergence theorem: right if every face points outwards
  for (std::size_t f = 0; f < 10; ++f) {
    Vec3 p[4];
    for (std::size_t a = 0; a < 4; ++a) {
      p[a] = xyz(s.nodes.x[static_cast<std::size_t>(outer.faces.connectivity[4 * f + a])]);
    }
    const Vec3 area = 0.5 * (p[2] - p[0]).cross(p[3] - p[1]);
    volume += area.dot(0.25 * (p[0] + p[1] + p[2] + p[3])) / 3;
  }
  CHECK(volume == Approx(3));
  CHECK(volume_of_cell(two, s.nodes, 0) == Approx(1));
  CHECK(volume_of_cell(two, s.nodes, 1) == Approx(2));
}

TEST_CASE("outer faces: of a tetrahedron and a plane quadrilateral, outwards", "[contact]") {
  Scene s;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    s.nodes.x.push_back({x.x(), x.y(), x.z(), 1});
  }
  Part p;
  p.cell = Cell::tetrahedron;
  p.connectivity = {0, 1, 2, 3};
  p.cell_id = {1};
  const OuterFaces outer = outer_faces(p);
  REQUIRE(outer.element.size() == 4);
  const Vec3 middle(0.25, 0.25, 0.25);
  for (std::size_t f = 0; f < 4; ++f) {
    Vec3 q[3];
    for (std::size_t a = 0; a < 3; ++a) {
      q[a] = xyz(s.nodes.x[static_cast<std::size_t>(outer.faces.connectivity[3 * f + a])]);
    }
    CHECK((q[1] - q[0]).cross(q[2] - q[0]).dot(q[0] - middle) > 0);
  }
  CHECK(volume_of_cell(p, s.nodes, 0) == Approx(1.0 / 6));

  s.nodes.x[3] = {1, 1, 0, 1};
  p.cell = Cell::quad;
  p.connectivity = {0, 1, 3, 2};
  const OuterFaces edges = outer_faces(p);
  REQUIRE(edges.element.size() == 4);
  CHECK(volume_of_cell(p, s.nodes, 0) == Approx(1));
  Part surface = edges.faces;
  const Surface around = make_surface(surface);
  Array<Line> x(s.nodes.x.begin(), s.nodes.x.end());
  for (const Segment& g : around.segments) {
    const Vec3 a =
        xyz(x[static_cast<std::size_t>(around.node[static_cast<std::size_t>(g.corner[0])])]);
    CHECK(area_vector(g, x).dot(a - Vec3(0.5, 0.5, 0)) > 0);
  }
}

TEST_CASE("part contact: force and balance of a tip on a slab, by hand", "[contact]") {
  TipOnSlab t;
  // Tip: kappa = (K + 4/3 G) A/V = 10/0.5 = 20; slab 10/1 = 10 on top of its elements; in a row
  // 20/3. Each of the four lowest nodes bears a quarter of the tip's face, 1/16, p = 0.1.
  t.place(-1.75, -0.75, -0.1);
  const Vec3 down = t.contact->directions[0].scattered.on_surface;
  CHECK(down.z() == Approx(-4 * kappa / 16 * 0.1));
  CHECK(std::abs(down.x()) < 1e-15);
  CHECK(t.contact->directions[0].scattered.active == 4);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < t.scene.nodes.f.size(); ++i) {
    sum += xyz(t.scene.nodes.f[i]);
    moment += xyz(t.scene.nodes.x[i]).cross(xyz(t.scene.nodes.f[i]));
  }
  CHECK(sum.norm() < 1e-15);
  CHECK(moment.norm() < 1e-15);
  // Gershgorin: the tip's nodes, of mass 1, take part in one pair each, 2 k / m; no corner of the
  // slab collects more. Against a slab that nothing moves it is k / m.
  CHECK(rate_of(t.scene.nodes, Followers{}, t.meeting).omega2 == Approx(2 * kappa / 16));
  for (std::size_t i = 8; i < t.scene.nodes.v.size(); ++i) t.scene.nodes.v[i].w = 0;
  t.place(-1.75, -0.75, -0.1);
  CHECK(rate_of(t.scene.nodes, Followers{}, t.meeting).omega2 == Approx(kappa / 16));
  t.place(-1.75, -0.75, 0.01);
  CHECK(t.contact->directions[0].scattered.active == 0);
  CHECK(t.meeting.touched.size() > 0);  // near, and known to the vote before it touches
}

TEST_CASE("part contact: no jump over edges, corners and diagonals", "[contact]") {
  // Uneven elements: kappa and areas change from one to the next.
  const double eps = 1e-9;
  TipOnSlab t;
  const auto force = [&](double x, double y) {
    t.place(x, y, -0.1);
    REQUIRE(t.contact->directions[0].scattered.active == 4);
    return t.contact->directions[0].scattered.on_surface;
  };
  for (const auto& [x, y] :
       {std::pair{-1.0, -0.6}, {0.0, 0.3}, {0.0, 0.0}, {-1.0, -1.0}, {-0.5, 0.5}}) {
    const Vec3 at = force(x, y);
    CHECK(at.z() < 0);
    for (const auto& [dx, dy] : {std::pair{eps, eps}, {-eps, eps}, {eps, -eps}, {-eps, -eps}}) {
      CHECK((force(x + dx, y + dy) - at).norm() < 1e-6 * at.norm());
    }
  }
}

TEST_CASE("part contact: an edge takes the front of the other, not its side", "[contact]") {
  // Two equal bars end to end, their edges in line: every node of the front bears its share, the
  // middle of two elements twice that of the corners, and nothing pushes sideways.
  Scene s;
  s.parts.push_back(box(s, {0, 0, 0}, {1, 1}, 2, 2, 1));
  s.parts.push_back(box(s, {1.99, 0, 0}, {1, 1}, 2, 2, 1));
  PartContact& c = make_part_contact(
      s, "c", {0, 1}, {ShellSurface{.modulus = 10}, ShellSurface{.modulus = 10}}, true, false);
  set_distance(c, 0);
  c.numbers[1] = 1;
  PartMeeting meeting;
  meeting.stiffness.assign(s.nodes.x.size(), 0);
  part_contact_pass(s, c, {.dt_old = 1e-3, .dt = 1e-3}, meeting);
  for (const PartDirection& d : c.directions) {
    CHECK(d.scattered.active == 9);
    // kappa 10 of both in a row, 5, times the whole face, 4, times 0.01.
    CHECK(std::abs(d.scattered.on_surface.x()) == Approx(5 * 4 * 0.01));
    CHECK(std::abs(d.scattered.on_surface.y()) < 1e-12);
  }
  CHECK(xyz(s.nodes.f[2]).x() == Approx(2 * -5 * 0.25 * 0.01));  // a corner, both ways
}

TEST_CASE("part contact: what overlaps at the start is stress-free and reported", "[contact]") {
  TipOnSlab t;
  t.contact->numbers[1] = 0;
  t.place(-1.75, -0.75, -0.1);
  CHECK(t.contact->directions[0].scattered.active == 0);
  CHECK(t.contact->numbers[2] == 4);
  CHECK(t.contact->numbers[3] == Approx(0.1));
  t.place(-1.75, -0.75, -0.15);
  CHECK(t.contact->directions[0].scattered.on_surface.z() == Approx(-4 * kappa / 16 * 0.05));
  t.place(-1.75, -0.75, -0.02);  // moves out: the offset shrinks with it
  t.place(-1.75, -0.75, -0.04);
  CHECK(t.contact->directions[0].scattered.on_surface.z() == Approx(-4 * kappa / 16 * 0.02));
}

TEST_CASE("part contact: parts apart wait, and meet in time", "[contact]") {
  TipOnSlab t;
  auto& wait = t.scene.store.get<PartContacts>().waits[0];
  t.place(-1.75, -0.75, 8);
  CHECK(wait > 50);
  CHECK(t.contact->directions[0].candidates.n_rows() == 0);
  for (std::size_t i = 0; i < 8; ++i) t.scene.nodes.v[i].z = -400;  // four times that a step: 1.6
  t.place(-1.75, -0.75, 8);
  CHECK(wait > 0);
  CHECK(wait <= 8 / 1.6);
}
