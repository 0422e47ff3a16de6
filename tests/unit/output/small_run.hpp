// The small scene with the effects guards and output, and the loop of a run.
#pragma once

#include "case_values.hpp"
#include "output/checkpoint.hpp"
#include "output/output.hpp"
#include "small_scene.hpp"

namespace gannet::test {

using Texts = std::vector<std::pair<std::string, std::string>>;

/// A run as a case asks for it: `output: {until: ..., texts...}`.
struct Run {
  SmallScene small;
  Value root;
  Mistakes mistakes;
  Run(const std::string& folder, double until, const Texts& texts, double dt = 1.3e-4)
      : root(output_case(until, texts)) {
    small.dt = dt;
    RunRecord& record = small.record();
    record.folder = folder;
    record.name = "small";
    record.case_hash = "1a2b";
    const Keys keys(root, mistakes);
    guards_effect().state(keys, small.scene);
    small.scene.store.get<GuardState>().limits = {1e9, 0, 0, 1e9};
    guards_effect().operations(keys, small.scene, small.models);
    output_effect().operations(keys, small.scene, small.models);
  }
  RunRecord& record() { return small.record(); }
  /// The loop of a run, until it is done or has made n steps.
  void go(int n = 1000000) {
    begin_run(record(), small.models);
    for (int k = 0; k < n && !record().output.finished; ++k) {
      if (checkpoint_due(small.models, record())) {
        write_next_checkpoint(small.scene, small.models, record());
      }
      advance(small.models);
    }
  }
};

}  // namespace gannet::test
