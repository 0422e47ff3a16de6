#include "search/segment_search.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "base/parallel.hpp"
#include "contact/surface.hpp"
#include "scenes.hpp"

using namespace gannet;

namespace {

struct Cloud {
  Scene scene;
  Surface surface;
  std::vector<Line> points;
  SegmentSearch what;
};

/// An inclined, waved sheet of 12 x 8 quads and 3,000 points around it.
void make_cloud(Cloud& c) {
  test::Builder b;
  b.nx = 12;
  b.ny = 8;
  b.shape = [](double x, double y) {
    return Vec3(0.9 * x, y, 0.4 * x + 0.3 * std::sin(x) * std::cos(y));
  };
  b.fill(c.scene);
  c.surface = make_surface(c.scene.parts[0]);
  update_surface(c.scene.nodes, c.surface);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-3, 13);
  for (int i = 0; i < 3000; ++i) c.points.push_back({u(random), u(random), 0.5 * u(random), 0});
  c.what = {c.points, {}, 0, c.surface.x, c.surface.corners, 0.4};
}

bool same(const SegmentCandidates& a, const SegmentCandidates& b) {
  return a.point == b.point && a.begin == b.begin && a.segment == b.segment;
}

}  // namespace

TEST_CASE("segment search: the list holds every pair within reach", "[search][contact]") {
  Cloud c;
  make_cloud(c);
  SegmentCandidates list;
  find_candidates(c.what, list);
  std::size_t within = 0;
  for (Index i = 0; i < 3000; ++i) {
    const Vec3 x = xyz(c.points[static_cast<std::size_t>(i)]);
    const auto row = std::lower_bound(list.point.begin(), list.point.end(), i);
    for (Index s = 0; s < 96; ++s) {
      if (!(closest_on_segment(c.surface, s, x).distance2 < 0.4 * 0.4)) continue;
      ++within;
      REQUIRE((row != list.point.end() && *row == i));
      const auto r = row - list.point.begin();
      REQUIRE(std::binary_search(&list.segment[list.begin[r]],
                                 list.segment.data() + list.begin[r + 1], s));
    }
  }
  CHECK(within > 100);                      // the scene has pairs at all
  CHECK(list.segment.size() < 3 * within);  // and few of the listed ones are idle
  CHECK(std::is_sorted(list.point.begin(), list.point.end()));
}

TEST_CASE("segment search: points far away make no pairs", "[search][contact]") {
  Cloud c;
  make_cloud(c);
  for (Line& p : c.points) p.z += 100;
  SegmentCandidates list;
  find_candidates(c.what, list);
  CHECK(list.n_rows() == 0);
  CHECK(list.segment.empty());
}

TEST_CASE("segment search: same list for any number of threads", "[search][contact]") {
  Cloud c;
  make_cloud(c);
  SegmentCandidates one;
  set_threads(1);
  find_candidates(c.what, one);
  for (const int n : {2, 3, 5}) {
    SegmentCandidates other;
    set_threads(n);
    find_candidates(c.what, other);
    CHECK(same(one, other));
  }
  set_threads(0);
}

TEST_CASE("segment search: rows put in order equal a new search", "[search][contact]") {
  Cloud c;
  make_cloud(c);
  SegmentCandidates list;
  find_candidates(c.what, list);
  std::vector<Index> place(3000);  // old point i becomes place[i]
  for (std::size_t i = 0; i < 3000; ++i) place[i] = static_cast<Index>((i * 1013) % 3000);
  std::vector<Line> moved(3000);
  for (std::size_t i = 0; i < 3000; ++i) moved[static_cast<std::size_t>(place[i])] = c.points[i];
  for (Index& p : list.point) p = place[static_cast<std::size_t>(p)];
  order_rows(list);
  c.what.points = moved;
  SegmentCandidates fresh;
  find_candidates(c.what, fresh);
  CHECK(same(list, fresh));
}

TEST_CASE("segment search: displacement is relative to the surface", "[search][contact]") {
  std::vector<Line> x0{{0, 0, 0, 0}, {1, 0, 0, 0}};
  std::vector<Line> y0{{0, 0, 1, 0}, {0, 0, 2, 0}};
  std::vector<Line> x = x0;
  std::vector<Line> y = y0;
  for (auto* lines : {&x, &y}) {
    for (Line& l : *lines) l.y += 5;
  }
  CHECK(relative_displacement(x, x0, y, y0) == 0);
  x[1].z += 0.3;
  y[0].x += 0.2;  // mean of the surface moves 0.1, each corner by 0.1 about it
  // points: |(-0.1, 0, 0.3)| is the larger; corners 0.1
  CHECK(relative_displacement(x, x0, y, y0) == Approx(std::hypot(0.1, 0.3) + 0.1));
}

TEST_CASE("segment search: not-a-number corners give an empty list", "[search][contact]") {
  Cloud c;
  make_cloud(c);
  c.surface.x[0].x = std::numeric_limits<double>::quiet_NaN();
  SegmentCandidates list;
  find_candidates(c.what, list);
  CHECK(list.n_rows() == 0);
}

TEST_CASE("segment search: points that repeat are found by their images", "[search][contact]") {
  Cloud c;
  make_cloud(c);
  c.what.periods.length = {7, 0, 5};  // the sheet is 11 m long: a point may have two images near
  for (Line& p : c.points) {
    p.x += 70 - 7 * std::floor(p.x / 7);  // all of them in one period far from the sheet
    p.z -= 20 + 5 * std::floor(p.z / 5);
  }
  SegmentCandidates list;
  find_candidates(c.what, list);
  REQUIRE(list.image.size() == list.segment.size());
  std::size_t within = 0;
  for (Index i = 0; i < 3000; ++i) {
    const auto row = std::lower_bound(list.point.begin(), list.point.end(), i) - list.point.begin();
    for (int kx = -12; kx <= -8; ++kx) {
      for (int kz = 2; kz <= 6; ++kz) {
        const Eigen::Vector3i k(kx, 0, kz);
        const Vec3 x = image_of(c.what.periods, xyz(c.points[static_cast<std::size_t>(i)]), k);
        for (Index s = 0; s < 96; ++s) {
          if (!(closest_on_segment(c.surface, s, x).distance2 < 0.4 * 0.4)) continue;
          ++within;
          REQUIRE((row < list.n_rows() && list.point[row] == i));
          bool found = false;
          for (Index e = list.begin[row]; e < list.begin[row + 1]; ++e) {
            found = found || (list.segment[e] == s && list.image[e] == k);
          }
          REQUIRE(found);
        }
      }
    }
  }
  CHECK(within > 300);
  CHECK(list.segment.size() < 3 * within);
}

TEST_CASE("segment search: a point that is wrapped has not moved", "[search][contact]") {
  const std::vector<Line> x0{{6.9, 0, 0, 0}, {1, 0, 0, 0}};
  const std::vector<Line> x{{0.1, 0, 0, 0}, {1.2, 0, 0, 0}};  // both by 0.2, one across the end
  const std::vector<Line> y0{{0, 0, 1, 0}};
  const std::vector<Line> y{{0.2, 0, 1, 0}};
  CHECK(relative_displacement(x, x0, y, y0, {{7, 0, 0}}) == Approx(0).margin(1e-14));
  CHECK(relative_displacement(x, x0, y, y0) == Approx(7));
}
