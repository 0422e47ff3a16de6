#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "output/files.hpp"
#include "output/folder.hpp"
#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

TEST_CASE("files: a whole file replaces the old one and leaves no temporary", "[output]") {
  const EmptyFolder folder("files");
  const std::string path = folder.path + "/a.txt";
  write_whole_file(path, "first");
  write_whole_file(path, std::string(100000, 'x'), Durable::yes);
  CHECK(read_file(path) == std::string(100000, 'x'));
  CHECK_FALSE(fs::exists(temporary_in(folder.path)));
  CHECK_THROWS_WITH(write_whole_file(folder.path + "/none/a.txt", "x"),
                    Catch::Contains("none/a.txt: cannot write: No such file"));
}

TEST_CASE("files: names of parts become names of files", "[output]") {
  CHECK(file_name_of("panel-2_b.x") == "panel-2_b.x");
  CHECK(file_name_of("a b/c") == "a_b_c");
  CHECK(file_name_of("../x") == "_._x");
}

TEST_CASE("folder: named after the case, beside it", "[output]") {
  CHECK(case_name("cases/panel_slam/case.yaml") == "panel_slam");
  CHECK(case_name("cases/drop.yaml") == "drop");
  CHECK(default_output_folder("cases/panel_slam/case.yaml") == "cases/panel_slam/panel_slam.out");
  CHECK(default_output_folder("drop.yaml") == "drop.out");
}

TEST_CASE("folder: results are never overwritten unless asked for", "[output]") {
  const EmptyFolder base("folder");
  const std::string out = base.path + "/run.out";
  prepare_output_folder(out, false, false);
  CHECK(fs::is_directory(out + "/vtk"));
  CHECK(fs::is_directory(out + "/history"));
  for (const char* name : {"/run.pvd", "/vtk/a_000000.vtu", "/history/energy.csv", "/notes.txt",
                           "/checkpoint_000012.h5", "/summary.json"}) {
    write_file(out + name, "x");
  }
  CHECK_THROWS_AS(prepare_output_folder(out, false, false), InputError);
  CHECK_THROWS_WITH(prepare_output_folder(out, false, false),
                    Catch::Contains("run.out: the output folder is not empty; give --force") &&
                        Catch::Contains("--restart " + out + "/checkpoint_000012.h5"));
  CHECK(fs::exists(out + "/run.pvd"));
  prepare_output_folder(out, true, false);
  CHECK_FALSE(fs::exists(out + "/run.pvd"));
  CHECK_FALSE(fs::exists(out + "/vtk/a_000000.vtu"));
  CHECK_FALSE(fs::exists(out + "/history/energy.csv"));
  CHECK_FALSE(fs::exists(out + "/checkpoint_000012.h5"));
  CHECK(fs::exists(out + "/notes.txt"));  // not ours
}

TEST_CASE("folder: a resumed run keeps the results and drops unfinished files", "[output]") {
  const EmptyFolder folder("resume");
  write_file(folder.path + "/run.pvd", "x");
  write_file(temporary_in(folder.path), "half");
  write_file(temporary_in(folder.path + "/vtk"), "half");
  prepare_output_folder(folder.path, false, true);
  CHECK(fs::exists(folder.path + "/run.pvd"));
  CHECK_FALSE(fs::exists(temporary_in(folder.path)));
  CHECK_FALSE(fs::exists(temporary_in(folder.path + "/vtk")));
}

TEST_CASE("folder: the newest checkpoint is the one of the latest step", "[output]") {
  const EmptyFolder folder("newest");
  CHECK(newest_checkpoint(folder.path).empty());
  for (const long long n : {999999LL, 1000000LL, 12LL}) {
    write_file(checkpoint_path(folder.path, n), "x");
  }
  write_file(folder.path + "/checkpoint_x.h5", "x");
  CHECK(newest_checkpoint(folder.path) == folder.path + "/checkpoint_1000000.h5");
  CHECK(checkpoints_in(folder.path) == std::vector<long long>{12, 999999, 1000000});
  write_file(folder.path + "/file", "x");
  CHECK_THROWS_WITH(prepare_output_folder(folder.path + "/file", true, false),
                    Catch::Contains("is a file"));
}
