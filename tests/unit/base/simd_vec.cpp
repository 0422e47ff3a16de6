// Vectors of one register and lines of memory in them. The AVX2 form is tested here; elements of
// both instruction sets are held against scalar laws in unit/fe.
#define GANNET_ISA_NS avx2_tested
#include "base/simd_vec.hpp"
//
#include <catch2/catch.hpp>

namespace {

constexpr std::int32_t index_of_lane[8] = {2, 0, 3, 2, 1, 0, 3, 1};

/// Line k holds 10 k + 0, 1, 2, 3.
struct FourLines {
  alignas(64) double at[16];
  FourLines() {
    for (int k = 0; k < 16; ++k) at[k] = 10 * (k / 4) + k % 4;
  }
};

double lane(const gannet::avx2_tested::Vec& a, int k) {
  alignas(64) double t[8];
  a.store(t);
  return t[k];
}

}  // namespace

TEST_CASE("simd: lines that are transposed late are those of gather_lines()", "[base]") {
  using namespace gannet::avx2_tested;
  const FourLines lines;
  Vec line[line_vecs];
  for (int k = 0; k < line_vecs; ++k) {
    line[k] = load_lines(lines.at, place_of_lines(index_of_lane + k));
  }
  Vec late[3];
  components_of(line, late);
  Vec whole[4];
  gather_lines(lines.at, index_of_lane, 1, whole);
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < vec_lanes; ++k) {
      CHECK(lane(late[c], k) == 10 * index_of_lane[k] + c);
      CHECK(lane(whole[c], k) == lane(late[c], k));
    }
  }
}

TEST_CASE("simd: lines take what is added, twice where two lanes name one", "[base]") {
  using namespace gannet::avx2_tested;
  FourLines lines;
  Vec part[3] = {Vec(0.25), Vec(0.5), Vec(0.75)};
  Vec line[line_vecs];
  lines_of(part, line);
  for (int k = 0; k < line_vecs; ++k)
    add_lines(lines.at, place_of_lines(index_of_lane + k), line[k]);
  int named[4] = {};
  for (int k = 0; k < vec_lanes; ++k) ++named[index_of_lane[k]];
  REQUIRE(named[2] == 2);
  for (int k = 0; k < 16; ++k) {
    const double added = k % 4 < 3 ? 0.25 * (k % 4 + 1) * named[k / 4] : 0;
    CHECK(lines.at[k] == 10 * (k / 4) + k % 4 + added);
  }
}

TEST_CASE("simd: masks tell whether a lane is left out", "[base]") {
  using namespace gannet::avx2_tested;
  alignas(64) double t[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  CHECK(!leaves_out(less(Vec(0.0), Vec::load(t))));
  t[vec_lanes - 1] = -1;
  const VecMask m = less(Vec(0.0), Vec::load(t));
  CHECK(leaves_out(m));
  CHECK(sum(select(m, Vec::load(t), Vec(0.0))) == vec_lanes - 1);
}

TEST_CASE("simd: eight lanes move by one, across the halves too", "[base]") {
  using namespace gannet::avx2_tested;
  alignas(64) double at[8];
  for (int k = 0; k < 8; ++k) at[k] = k;
  alignas(64) double up[8];
  alignas(64) double down[8];
  lanes_up(Vec8::load(at), -1).store(up);
  lanes_down(Vec8::load(at), 8).store(down);
  for (int k = 0; k < 8; ++k) {
    CHECK(up[k] == k - 1);
    CHECK(down[k] == k + 1);
  }
}
