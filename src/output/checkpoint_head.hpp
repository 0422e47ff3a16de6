// What a checkpoint says about itself: everything but the fields' numbers, as plain values and as
// JSON text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "plan/plan.hpp"
#include "scene/field.hpp"

namespace gannet {

struct CheckpointHead {
  /// Grows when older programs could misread a file.
  static constexpr int format_now = 1;
  int format = format_now;
  std::string version;
  std::string revision;
  std::string case_file;
  std::string case_hash;
  std::string instruction_set;
  double wall_time = 0;  ///< of all runs up to here [s]
  double cpu_time = 0;   ///< of all runs up to here [s]
  Index n_owned = 0;
  Index n_ghosts = 0;

  struct FieldShape {
    std::string name;
    std::string part;  ///< for cell fields; else empty
    Type type = Type::f64;
    int components = 1;
    std::int64_t count = 0;
    bool stored = true;  ///< false: only its size is known
    /// Name of its table in the file.
    [[nodiscard]] std::string table() const {
      return part.empty() ? "fields/" + name : "cells/" + part + "/" + name;
    }
  };
  std::vector<FieldShape> fields;

  struct ListSize {
    std::string name;
    std::int64_t size = 0;
  };
  std::vector<ListSize> lists;  ///< index lists, in the order of scene.index_lists

  struct ModelState {
    std::string name;
    Step step;
    Vote vote;
    double target = 0;
    int substeps_left = 0;
    std::vector<Range> ranges{};  ///< of the node table
  };
  std::vector<ModelState> models;
  std::vector<LedgerEntry> ledger;
  double last_look = 0;
  StrayParticles strays;
  std::vector<Frame> frames;
};

/// JSON; numbers with a fraction are texts that read back to the same bits (also inf and nan).
std::string to_text(const CheckpointHead& head);

/// Reads to_text() back. Throws DamagedFile where it is not understood.
CheckpointHead head_from_text(const std::string& text);

}  // namespace gannet
