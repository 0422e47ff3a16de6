#include "fe/catenary.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "fe/line_at_rest.hpp"

using namespace gannet;

namespace {

/// Lines whose end forces were computed to rounding from the closed forms of Irvine 1981 (Cable
/// Structures) and Jonkman 2007 (NREL/TP-500-41958, eqs. 2-35 to 2-38), checked by integration.
struct Known {
  const char* what;
  double X, Z, L, EA, w, CB, H, V, anchor, on_bed;
};

const Known known[] = {{"slack steel line", 900, 310, 1000, 1335962276, 422.8177465, 0, 240212.923,
                        283070.8255, 240212.923, 330.5133764},
                       {"nearly lifted", 930, 310, 1000, 1335962276, 422.8177465, 0, 525232.6962,
                        393436.6528, 525232.6962, 69.48879022},
                       {"taut, longer than its length", 955, 310, 1000, 1335962276, 422.8177465, 0,
                        5415509.01, 1970126.815, 5632220.095, 0},
                       {"chain in 200 m", 700, 200, 760, 1674000000, 3323.249867, 0, 1406150.292,
                        1519243.353, 1406150.292, 302.8440793},
                       {"chain in 50 m", 400, 50, 410, 1674000000, 3323.249867, 0, 835593.7931,
                        552373.1446, 835593.7931, 243.7852504},
                       {"line of OC3-Hywind", 848.67, 250, 902.2, 384243000, 698.3330095, 0,
                        737173.2979, 535905.0313, 737173.2979, 134.7938714},
                       {"taut polyester", 1200, 900, 1480, 60000000, 245.25, 0, 809204.0216,
                        794734.7127, 917186.9579, 0},
                       {"friction on the bed", 930, 310, 1000, 1335962276, 422.8177465, 0.5,
                        525238.735, 393438.6627, 510549.1931, 69.48403655}};

CatenaryLine line_of(const Known& k) { return {k.L, k.w, k.EA, k.CB, true}; }

}  // namespace

TEST_CASE("catenary: end forces of elastic lines with and without a part on the bed", "[fe]") {
  for (const Known& k : known) {
    INFO(k.what);
    const auto c = catenary_between(line_of(k), k.X, k.Z);
    REQUIRE(c);
    CHECK(c->H == Approx(k.H).epsilon(1e-8));
    CHECK(c->V == Approx(k.V).epsilon(1e-8));
    CHECK(c->on_bed() == Approx(k.on_bed).epsilon(1e-8));
    CHECK(point_at(*c, 0).tension == Approx(k.anchor).epsilon(1e-8));
    CHECK(point_at(*c, k.L).tension == Approx(std::hypot(k.H, k.V)).epsilon(1e-8));
    CHECK(point_at(*c, k.L).x == Approx(k.X).epsilon(1e-12));
    CHECK(point_at(*c, k.L).z == Approx(k.Z).epsilon(1e-12));
    CHECK(std::abs(point_at(*c, 0).x) < 1e-9);
  }
}

TEST_CASE("catenary: without a bed it sags below its anchor", "[fe]") {
  // Both ends at one height: V = w L/2, and the middle hangs below both.
  const auto c = catenary_between({.length = 110, .weight = 10, .EA = 1e9}, 100, 0);
  REQUIRE(c);
  CHECK(c->V == Approx(550).epsilon(1e-9));
  CHECK(point_at(*c, 55).x == Approx(50).epsilon(1e-9));
  CHECK(point_at(*c, 55).z < -15);
  // sinh(w X/(2 H)) = w L/(2 H) where the line hardly stretches
  CHECK(std::sinh(500 / c->H) == Approx(550 / c->H).epsilon(1e-5));
}

TEST_CASE("catenary: none where the line hangs down and lies slack", "[fe]") {
  CHECK_FALSE(catenary_between({.length = 1300, .weight = 400, .EA = 1e9, .bed = true}, 900, 310));
  CHECK_FALSE(catenary_between({.length = 100, .weight = 0, .EA = 1e9, .bed = true}, 90, 10));
}

namespace {

/// A chain of n elements at rest from a straight line as the guess; the forces at its upper end.
Vec3 end_force_at_rest(const Known& k, int n, std::vector<Vec3>& x) {
  const double l0 = k.L / n;
  ChainAtRest chain;
  chain.l0 = l0;
  chain.law = [&](double strain) -> AxialAnswer {
    if (strain < 0) return {0, strain > -1e-5 ? k.EA : 0, 0};
    return {k.EA * strain, k.EA, 0.5 * k.EA * strain * strain};
  };
  for (int i = 0; i <= n; ++i) {
    const double share = i == 0 || i == n ? 0.5 : 1;
    x.push_back(Vec3(k.X, 0, k.Z) * i / n);
    chain.load.emplace_back(0, 0, -share * k.w * l0);
    chain.bed_stiffness.push_back(share * 1e4 * k.w * l0);
  }
  chain.bed = true;
  chain.bed_level = 1e-4;  // where the weight of a node on the bed is carried at height 0
  const RestResult rest = bring_to_rest(chain, x);
  INFO(rest.iterations << " iterations, " << rest.largest << " N left");
  CHECK(rest.found);
  const auto end = static_cast<std::size_t>(n);
  const Vec3 r = x[end] - x[end - 1];
  return chain.law(r.norm() / l0 - 1).force * r.normalized() - chain.load[end];
}

}  // namespace

TEST_CASE("line at rest: from a straight line to the catenary", "[fe]") {
  for (const Known& k : known) {
    if (k.CB > 0) continue;
    INFO(k.what);
    std::vector<Vec3> x;
    const Vec3 f = end_force_at_rest(k, 80, x);
    CHECK(f.norm() == Approx(std::hypot(k.H, k.V)).epsilon(2e-4));
    const auto c = catenary_between(line_of(k), k.X, k.Z);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const CatenaryPoint p = point_at(*c, k.L * static_cast<double>(i) / 80);
      CHECK((x[i] - Vec3(p.x, 0, p.z)).norm() < 1e-3 * k.L);
    }
  }
}

TEST_CASE("line at rest: end force by the square of the element length", "[fe][convergence]") {
  double error[2];
  for (int k = 0; k < 2; ++k) {
    std::vector<Vec3> x;
    const double f = end_force_at_rest(known[2], 20 << k, x).norm();
    error[k] = std::abs(f - std::hypot(known[2].H, known[2].V));
  }
  CHECK(error[0] / error[1] == Approx(4).epsilon(0.1));
}
