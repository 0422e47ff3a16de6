// The case of the repository itself, with no key changed, 1000 steps past first contact.
// CTest runs this once per instruction set (GANNET_ISA).
#include <fmt/format.h>

#include "../support/same_bits.hpp"
#include "../support/temporary_folder.hpp"
#include "base/parallel.hpp"
#include "output/checkpoint.hpp"
#include "same_bits_cases.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

constexpr std::int64_t n_past_contact = 1000;

std::unique_ptr<WatchedRun> start() {
  auto r = std::make_unique<WatchedRun>(panel_slam, std::vector<std::string>{});
  r->measures_every = 100;
  return r;
}

/// Runs to 1000 steps past first contact.
std::unique_ptr<WatchedRun> whole_run(int n_threads) {
  set_threads(n_threads);
  auto r = start();
  r->until_above_zero("contact.slam.active");
  r->steps(n_past_contact);
  return r;
}

/// Writes a checkpoint and reads it into a simulation made anew.
std::unique_ptr<WatchedRun> resumed(const WatchedRun& r, const std::string& folder) {
  const std::string path = folder + "/checkpoint_1.h5";
  write_checkpoint(path, r.s->scene, r.s->models, r.s->scene.store.get<RunRecord>());
  auto next = start();
  Simulation& s = *next->s;
  read_checkpoint(path, s.scene, s.models, s.scene.store.get<RunRecord>());
  return next;
}

/// The same run, cut 400 and 700 steps past first contact.
std::unique_ptr<WatchedRun> cut_run(const WatchedRun& whole) {
  const TemporaryFolder folder;
  set_threads(2);
  auto r = start();
  const std::int64_t contact = r->until_above_zero("contact.slam.active");
  CHECK(contact == whole.at().n - n_past_contact);
  r->steps(400);
  r = resumed(*r, folder.path());
  set_threads(3);
  r->steps(300);
  r = resumed(*r, folder.path());
  r->steps(n_past_contact - 700);
  return r;
}

}  // namespace

TEST_CASE(
    "same bits: panel_slam, 1, 2, 3 and 5 threads and a run cut twice, 1000 steps past first "
    "contact",
    "[bits][long]") {
  const auto one = whole_run(1);
  const Bits bits = bits_of(*one->s);
  WARN(fmt::format("{} steps, {} entries of {} bytes, {} x {} numbers of histories", one->at().n,
                   bits.size(), n_bytes(bits), one->history.size(),
                   one->history.begin()->second.size()));
  for (const int n : {2, 3, 5}) {
    INFO(n << " threads");
    const auto other = whole_run(n);
    CHECK(other->history.size() == one->history.size());
    check_same(bits, bits_of(*other->s));
    check_same_history(*one, *other);
  }
  const auto cut = cut_run(*one);
  CHECK(cut->history.size() == 300);
  check_same(bits, bits_of(*cut->s));
  check_same_history(*one, *cut);
}
