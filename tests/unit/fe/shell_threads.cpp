// The same bits for any number of threads, for elements wherever they stand in a block, and nearly
// the same numbers for both instruction sets.
#include <catch2/catch.hpp>
#include <cstring>

#include "base/parallel.hpp"
#include "shell_testing.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

const ElasticPlastic yielding_steel{.rho = 7800, .E = 210e9, .nu = 0.3, .sigma_y = 250e6, .H = 1e9};

struct Result {
  Array<Line> f, torque;
  Array<double> state;
  ElementWork work;
  double omega2 = 0;
};

Result run(int nx, int ny, int threads, Isa set, ShellKind kind, Index chunk = 64) {
  set_threads(threads);
  Sheet s = crumpled(nx, ny, 11, 0.01);
  ShellBlock block = block_of(s, yielding_steel, {.kind = kind, .thickness = 0.01}, chunk);
  random_motion(s, 12, 2, 20);
  Result r;
  const double dt = 5e-6;
  for (int k = 0; k < 10; ++k) {
    for (std::size_t i = 0; i < s.size(); ++i) add_xyz(s.nodes.x[i], dt * xyz(s.nodes.v[i]));
    clear_forces(s.nodes);
    const ElementWork w = shell_pass(block, s.nodes, dt, set);
    r.work.internal += w.internal;
    r.work.plastic += w.plastic;
    r.work.hourglass += w.hourglass;
  }
  set_threads(0);
  r.f = s.nodes.f;
  r.torque = s.nodes.torque;
  r.state = block.state;
  r.omega2 = block.omega2;
  return r;
}

template <class T>
bool same_bits(const Array<T>& a, const Array<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

}  // namespace

TEST_CASE("shell: the same bits on 1, 2, 3 and 5 threads", "[fe][threads]") {
  const ShellKind kind = GENERATE(ShellKind::one_point, ShellKind::quad, ShellKind::triangle);
  for (const Isa set : sets()) {
    const Result one = run(37, 29, 1, set, kind);
    CHECK(one.work.plastic > 0);
    for (const int threads : {2, 3, 5}) {
      const Result many = run(37, 29, threads, set, kind);
      CHECK(same_bits(one.f, many.f));
      CHECK(same_bits(one.torque, many.torque));
      CHECK(same_bits(one.state, many.state));
      CHECK(one.work.internal == many.work.internal);
      CHECK(one.work.plastic == many.work.plastic);
      CHECK(one.work.hourglass == many.work.hourglass);
      CHECK(one.omega2 == many.omega2);
    }
  }
}

TEST_CASE("shell: blocks that are not full add nothing of their own", "[fe]") {
  // A strip of n elements, n = 1..17, in one go against the same strip element by element.
  const ShellKind kind = GENERATE(ShellKind::one_point, ShellKind::quad);
  for (const Isa set : sets()) {
    for (int n = 1; n <= 17; ++n) {
      Sheet s = crumpled(n, 1, 21, 0.01);
      random_motion(s, 22, 2, 20);
      const double dt = 5e-6;
      ShellBlock all = block_of(s, yielding_steel, {.kind = kind, .thickness = 0.01});
      const ElementWork together = shell_pass(all, s.nodes, dt, set);
      const Array<Line> f = s.nodes.f;
      clear_forces(s.nodes);
      double internal = 0;
      double omega2 = 0;
      for (int e = 0; e < n; ++e) {
        const std::vector<Index> quad(s.quads.begin() + 4 * e, s.quads.begin() + 4 * e + 4);
        ShellBlock single =
            make_shell_block(quad, s.nodes.x, yielding_steel, {.kind = kind, .thickness = 0.01});
        internal += shell_pass(single, s.nodes, dt, set).internal;
        omega2 = std::max(omega2, single.omega2);
        for (int k = 0; k < all.layout.n_values(); ++k) {
          CHECK(single.value(0, k) == all.value(e, k));
        }
      }
      CHECK(omega2 == all.omega2);
      CHECK(internal == Approx(together.internal).epsilon(1e-14));
      for (std::size_t i = 0; i < f.size(); ++i) {
        CHECK((xyz(f[i]) - xyz(s.nodes.f[i])).norm() <= 1e-14 * xyz(f[i]).norm());
      }
    }
  }
}

TEST_CASE("shell: AVX2 and AVX-512 agree to rounding", "[fe]") {
  if (sets().size() < 2) return;
  const ShellKind kind = GENERATE(ShellKind::one_point, ShellKind::quad, ShellKind::triangle);
  const Result a = run(21, 13, 1, Isa::avx2, kind);
  const Result b = run(21, 13, 1, Isa::avx512, kind);
  double scale = 0;
  double worst = 0;
  for (std::size_t i = 0; i < a.f.size(); ++i) {
    scale = std::max(scale, xyz(a.f[i]).norm());
    worst = std::max(worst, (xyz(a.f[i]) - xyz(b.f[i])).norm());
  }
  CHECK(worst < 1e-12 * scale);
  CHECK(a.work.internal == Approx(b.work.internal).epsilon(1e-12));
  CHECK(a.work.plastic == Approx(b.work.plastic).epsilon(1e-12));
  CHECK(a.omega2 == Approx(b.omega2).epsilon(1e-12));
}

TEST_CASE("shell: chunks of one colour share no node", "[fe]") {
  const Sheet s = crumpled(30, 20, 1);
  const ChunkColours c = colour_chunks(s.quads, 4, 16);
  Index seen = 0;
  for (const auto& colour : c.colours) {
    std::vector<Index> owner(s.size(), -1);
    for (const Index chunk : colour) {
      ++seen;
      const auto end =
          std::min<std::size_t>(s.quads.size(), 64 * static_cast<std::size_t>(chunk + 1));
      for (std::size_t k = 64 * static_cast<std::size_t>(chunk); k < end; ++k) {
        Index& o = owner[static_cast<std::size_t>(s.quads[k])];
        CHECK((o == -1 || o == chunk));
        o = chunk;
      }
    }
  }
  CHECK(seen == c.n_chunks);
  CHECK(c.n_chunks == 38);  // 600 elements in chunks of 16
}
