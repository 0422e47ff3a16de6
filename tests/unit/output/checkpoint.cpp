#include <catch2/catch.hpp>
#include <cstring>

#include "base/error.hpp"
#include "output/checkpoint.hpp"
#include "output/checkpoint_head.hpp"
#include "output/folder.hpp"
#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

void describe(RunRecord& record, const std::string& folder) {
  record.case_file = "case.yaml";
  record.case_hash = "1a2b";
  record.version = "0.1.0";
  record.revision = "abc";
  record.instruction_set = "avx2";
  record.folder = folder;
}

/// A scene after some steps, and a checkpoint of it.
struct Saved {
  EmptyFolder folder;
  SmallScene small;
  std::string path;
  explicit Saved(const std::string& name) : folder(name), path(checkpoint_path(folder.path, 1)) {
    describe(small.record(), folder.path);
    for (int k = 0; k < 7; ++k) advance(small.models);
    small.marked = {7, 0, 2};
    small.scene.nodes.v[3].y = -0.0;
    small.scene.nodes.v[4].y = std::numeric_limits<double>::denorm_min();
    small.models.ledger.entry("late", "made in a step").value = 1e-17;
    small.record().output.last_look = 0.3;
    small.record().output.frames = {{4, 1.0 / 3, {{"panel", "vtk/panel_000004.vtu"}}}};
    write_checkpoint(path, small.scene, small.models, small.record());
  }
  /// Reads the file, as `record` describes the run, into a fresh scene.
  std::vector<std::string> read(SmallScene& into, bool force = false) const {
    return read_checkpoint(path, into.scene, into.models, into.record(), force);
  }
};

std::vector<std::byte> packed(const Field& f) {
  std::vector<std::byte> bytes;
  for (Index e = 0; e < f.count(); ++e) {
    for (int c = 0; c < f.components; ++c) {
      const std::byte* at = f.at(e, c);
      bytes.insert(bytes.end(), at, at + size_of(f.type));
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("checkpoint: every field comes back bit for bit, also resized ones", "[output]") {
  const Saved saved("round");
  SmallScene fresh;
  describe(fresh.record(), saved.folder.path);
  REQUIRE(fresh.pairs.size() == 2);
  REQUIRE(saved.small.pairs.size() == 9);
  CHECK(saved.read(fresh).empty());
  REQUIRE(fresh.scene.fields.size() == saved.small.scene.fields.size());
  for (std::size_t k = 0; k < fresh.scene.fields.size(); ++k) {
    INFO(fresh.scene.fields[k].name);
    CHECK(packed(fresh.scene.fields[k]) == packed(saved.small.scene.fields[k]));
  }
  CHECK(fresh.marked == saved.small.marked);
  CHECK(fresh.rebuilt == 1);
  const Step& a = saved.small.models.list.front().step;
  const Step& b = fresh.models.list.front().step;
  CHECK(b.n == 7);
  CHECK(b.t == a.t);
  CHECK(b.dt_old == a.dt_old);
  CHECK(fresh.models.list.front().vote.limited_by() == "springs: node 3");
  CHECK(fresh.models.ledger.entry("late", "made in a step").value == 1e-17);
  CHECK(fresh.models.ledger.held() == saved.small.models.ledger.held());
  CHECK(fresh.record().output.last_look == 0.3);
  REQUIRE(fresh.record().output.frames.size() == 1);
  CHECK(fresh.record().output.frames[0].t == 1.0 / 3);
  CHECK(fresh.record().output.frames[0].files[0].path == "vtk/panel_000004.vtu");
}

TEST_CASE("checkpoint: ghosts come back with room in all node fields", "[output]") {
  Saved saved("ghosts");
  Nodes& nodes = saved.small.scene.nodes;
  nodes.n_ghosts = 2;
  const auto n = static_cast<Index>(nodes.x.size()) + 2;
  for (const Field& f : saved.small.scene.fields) {
    if (f.over == Over::nodes) f.resize(n);
  }
  nodes.x[static_cast<std::size_t>(n) - 1].y = 0.7;
  write_checkpoint(saved.path, saved.small.scene, saved.small.models, saved.small.record());
  SmallScene fresh;
  describe(fresh.record(), saved.folder.path);
  saved.read(fresh);
  CHECK(fresh.scene.nodes.n_ghosts == 2);
  REQUIRE(fresh.scene.nodes.x.size() == static_cast<std::size_t>(n));
  CHECK(fresh.scene.nodes.f.size() == static_cast<std::size_t>(n));
  CHECK(fresh.scene.nodes.x.back().y == 0.7);
}

TEST_CASE("checkpoint: a run that goes on from one has the same bits", "[output]") {
  const Saved saved("goes_on");
  SmallScene unbroken;
  for (int k = 0; k < 7; ++k) advance(unbroken.models);
  unbroken.scene.nodes.v[3].y = -0.0;
  unbroken.scene.nodes.v[4].y = std::numeric_limits<double>::denorm_min();
  SmallScene resumed;
  describe(resumed.record(), saved.folder.path);
  saved.read(resumed);
  for (int k = 0; k < 50; ++k) {
    advance(unbroken.models);
    advance(resumed.models);
  }
  for (std::size_t k = 0; k < resumed.scene.fields.size(); ++k) {
    INFO(resumed.scene.fields[k].name);
    CHECK(packed(resumed.scene.fields[k]) == packed(unbroken.scene.fields[k]));
  }
  CHECK(resumed.models.list.front().step.t == unbroken.models.list.front().step.t);
}

TEST_CASE("checkpoint: what is cut off or damaged anywhere is one clear error", "[output]") {
  const Saved saved("damaged");
  const std::string bytes = read_file(saved.path);
  const std::string other = saved.folder.path + "/checkpoint_000000.h5";
  write_file(other, bytes);
  const auto message = [&](const std::string& damaged) {
    write_file(saved.path, damaged);
    SmallScene fresh;
    describe(fresh.record(), saved.folder.path);
    try {
      saved.read(fresh);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const double part : {0.0, 0.01, 0.3, 0.7, 0.999}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
    const std::string text = message(bytes.substr(0, length));
    CHECK_THAT(text, Catch::StartsWith(saved.path + ": the checkpoint is damaged or cut off"));
    CHECK_THAT(text, Catch::EndsWith(other + " is there too"));
  }
  // One wrong byte in the middle of the numbers of x.
  const double* x = &saved.small.scene.nodes.x[4].x;
  std::string wrong = bytes;
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(x), 24));
  REQUIRE(at != std::string::npos);
  wrong[at + 3] = static_cast<char>(wrong[at + 3] ^ 4);
  CHECK_THAT(message(wrong), Catch::Contains("'fields/x' cannot be read or fails its checksum"));
  CHECK_THAT(message("this is no HDF5 file"), Catch::Contains("no whole HDF5 file"));
  CHECK(message(bytes).empty());
}

TEST_CASE("checkpoint: another case or version is refused unless forced", "[output]") {
  const Saved saved("origin");
  SmallScene fresh;
  describe(fresh.record(), saved.folder.path);
  fresh.record().case_hash = "ffff";
  CHECK_THROWS_WITH(saved.read(fresh),
                    saved.path +
                        ": the checkpoint belongs to another case: it holds case.yaml with hash "
                        "1a2b, this is case.yaml with hash ffff; give --force to use it all the "
                        "same");
  CHECK(fresh.models.list.front().step.n == 0);
  const auto warnings = saved.read(fresh, true);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::EndsWith("used all the same (--force)"));
  CHECK(fresh.models.list.front().step.n == 7);

  describe(fresh.record(), saved.folder.path);
  fresh.record().version = "0.2.0";
  CHECK_THROWS_WITH(saved.read(fresh),
                    Catch::Contains("was written by gannet 0.1.0, this is gannet 0.2.0"));
}

TEST_CASE("checkpoint: another instruction set or revision is a warning", "[output]") {
  const Saved saved("isa");
  SmallScene fresh;
  describe(fresh.record(), saved.folder.path);
  fresh.record().instruction_set = "avx512";
  fresh.record().revision = "def";
  const auto warnings = saved.read(fresh);
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0], Catch::Contains("revision abc, this is def"));
  CHECK_THAT(warnings[1], Catch::Contains("instruction set avx2, this run uses avx512"));
}

TEST_CASE("checkpoint: one that does not fit the scene is refused, also by force", "[output]") {
  const Saved saved("fit");
  const auto message = [&](SmallScene& fresh) {
    describe(fresh.record(), saved.folder.path);
    try {
      saved.read(fresh, true);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  SmallScene missing;
  missing.scene.fields.erase(missing.scene.fields.begin());
  CHECK_THAT(message(missing), Catch::EndsWith("does not fit this case: it has a field 'x' that "
                                               "the case does not make"));
  SmallScene more;
  Array<double> heat(8);
  more.scene.fields.push_back(plain_field("T", "K", "", Over::particles, heat, 1, GhostRule::none));
  CHECK_THAT(message(more), Catch::EndsWith("does not fit this case: it has no field 'T'"));
  SmallScene cells;
  cells.stress.resize(18);
  CHECK_THAT(message(cells),
             Catch::EndsWith("its field 'panel.stress' of part 'panel' has 4 entries of 6 numbers, "
                             "the case makes 3 of 6"));
  SmallScene nodes;
  nodes.scene.nodes.n_owned -= 1;
  CHECK_THAT(message(nodes), Catch::Contains("it has 20 nodes, the case makes 19"));
  SmallScene lists;
  lists.scene.index_lists.clear();
  CHECK_THAT(message(lists), Catch::Contains("other lists of particles"));
}

TEST_CASE("checkpoint: a missing file is named", "[output]") {
  SmallScene fresh;
  CHECK_THROWS_WITH(read_checkpoint("no/such.h5", fresh.scene, fresh.models, fresh.record()),
                    "no/such.h5: there is no such checkpoint");
}

TEST_CASE("checkpoint: the last two stay, later ones of a run that was redone go", "[output]") {
  const EmptyFolder folder("two");
  SmallScene small;
  describe(small.record(), folder.path);
  write_file(checkpoint_path(folder.path, 900), "from a run that was redone");
  for (int k = 1; k <= 4; ++k) {
    advance(small.models);
    CHECK(write_next_checkpoint(small.scene, small.models, small.record()) ==
          checkpoint_path(folder.path, k));
  }
  CHECK(checkpoints_in(folder.path) == std::vector<long long>{3, 4});
  CHECK(all_files(folder.path, "checkpoint").empty());  // no temporary stays
}

TEST_CASE("checkpoint: due in wall time or in simulated time", "[output]") {
  SmallScene small;
  RunRecord& record = small.record();
  record.folder = "somewhere";
  begin_run(record, small.models);
  Step& step = small.models.list.front().step;
  CHECK_FALSE(checkpoint_due(small.models, record));  // never
  record.plan.checkpoint = {0.5, 0};
  CHECK_FALSE(checkpoint_due(small.models, record));
  step.t = 0.5;
  CHECK(checkpoint_due(small.models, record));
  record.last_checkpoint_t = 0.5;
  CHECK_FALSE(checkpoint_due(small.models, record));
  record.plan.checkpoint = {0, 60};
  CHECK_FALSE(checkpoint_due(small.models, record));
  record.last_checkpoint -= std::chrono::seconds(61);
  CHECK(checkpoint_due(small.models, record));
  record.folder.clear();
  CHECK_FALSE(checkpoint_due(small.models, record));
}

TEST_CASE("checkpoint: numbers of its head read back to the same bits", "[output]") {
  CheckpointHead head;
  head.models = {
      {"main", {.n = 3, .t = 0.1 + 0.2}, {std::numeric_limits<double>::infinity(), "w"}}};
  LedgerEntry e;
  e.name = "kinetic";
  e.value = -1.0 / 3;
  e.pending = 5e-324;
  head.ledger = {e};
  head.last_look = -std::numeric_limits<double>::infinity();
  const CheckpointHead back = head_from_text(to_text(head));
  REQUIRE(back.models.size() == 1);
  CHECK(back.models[0].step.t == 0.1 + 0.2);
  CHECK(back.models[0].vote.dt == std::numeric_limits<double>::infinity());
  REQUIRE(back.ledger.size() == 1);
  CHECK(back.ledger[0].value == -1.0 / 3);
  CHECK(back.ledger[0].pending == 5e-324);
  CHECK(back.last_look == -std::numeric_limits<double>::infinity());
}
