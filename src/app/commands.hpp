// The subcommands of the program, one function each. They return the exit code (0, or 130 after a
// signal) and throw InputError (2) or RunError (3).
#pragma once

#include <string>
#include <vector>

#include "study/bench.hpp"

namespace gannet {

struct RunOptions {
  std::string case_file;
  std::string out;      ///< output folder; empty: beside the case
  std::string restart;  ///< checkpoint to go on from; empty: from the start
  bool resume = false;  ///< go on from the newest checkpoint in the output folder, else from the
                        ///< start, over what is there
  std::vector<std::string> set;  ///< "key.path=value"
  int threads = 0;               ///< 0: all cores
  std::string until;             ///< overrides output.until; with unit
  bool force = false;            ///< overwrite results, or accept a checkpoint of a changed case
};

struct RenderOptions {
  std::string folder;            ///< output folder of a run, or its .pvd
  std::string frame = "last";    ///< number in the .pvd from 0, or "last"
  bool all = false;              ///< every frame, numbered
  std::string out;               ///< file (--all: folder); empty: named after the run, here
  std::string colour = "speed";  ///< quantity
  std::string view;              ///< empty: iso; plane scenes: z
  std::string size = "1280x720";
  std::string cut;    ///< "y=0"
  std::string range;  ///< "0:12", SI
  std::string title;  ///< empty: name of the run
  double opacity = 1;
  int threads = 0;  ///< 0: all cores
};

struct MaterialOptions {
  std::string card;                         ///< name in the library, or a file
  std::string path = "uniaxial";            ///< see StrainPath
  std::vector<std::string> to{"0.2"};       ///< strains where the path ends or turns round
  std::vector<std::string> rates{"1 1/s"};  ///< one curve each
  std::vector<std::string> set;             ///< "key=value" of the material
  std::string element = "solid";
  int steps = 400;  ///< between two turns
  std::string csv;
  std::string svg;
};

struct HardOptions {
  std::vector<std::string> names;  ///< files, or names in the folder; none: all of the folder
  std::string folder;              ///< of hard cases; empty: tests/hard here or above
  bool long_form = false;
  std::vector<std::string> maps;  ///< "key=lowest..highest", one or two
  int points = 9;                 ///< of each parameter of a map
  int steps = 0;                  ///< of each run of a map; 0: as the case says
  std::string out;                ///< the SVG; empty: CASE_map.svg here
  int threads = 0;                ///< 0: all cores
};

struct StudyOptions {
  std::string file;                  ///< a study file, or a case
  std::vector<std::string> set;      ///< "key.path=value" in all runs
  std::vector<std::string> vary;     ///< "let.dx=8mm,4mm"
  std::vector<std::string> measure;  ///< "peak:slam_force:z"
  std::string reference;             ///< finest, richardson, a number, FILE.csv
  std::string budget;                ///< wall time, with unit
  std::string refine;                ///< the key along which results converge
  std::string out;                   ///< folder; empty: beside the file
  int repeats = 0;                   ///< 0: as the file says
  int parallel = 0;                  ///< 0: as the file says
  int threads = 0;                   ///< of each run; 0: as the file says
  bool dry = false;                  ///< print the runs only
  bool collect = false;              ///< make no run, show what is there
  std::string slurm;                 ///< write the runs as a job array into this folder
};

/// Runs a case to its end.
int run_command(const RunOptions& options);

/// Reads and checks a case; prints counts, memory and time step; runs nothing.
int check_command(const RunOptions& options);

/// Prints the plan of a case: the operations of a step in order, each with its reason.
int explain_command(const RunOptions& options);

/// Times kernels and whole steps beside the limits of the machine.
int bench_command(const BenchOptions& options);

/// Draws frames of a finished or running run as PNG files; needs no display.
int render_command(const RenderOptions& options);

/// Leads one element of a material along a path of strain: a curve a rate as CSV and SVG; as CSV to
/// the screen where no file is named.
int material_command(const MaterialOptions& options);

/// Runs hard cases and their variants against their limits, or draws a stability map of one.
/// Returns 1 where a limit was broken that had to be kept, or kept that had to be broken.
int hard_command(const HardOptions& options);

/// Runs a case with several settings and shows what accuracy costs: tables, pictures and plain
/// sentences. Runs that are done are not made again.
int study_command(const StudyOptions& options);

}  // namespace gannet
