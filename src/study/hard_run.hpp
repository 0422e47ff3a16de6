// Running hard cases: a case and its variants against its limits, without writing a file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "study/hard_watch.hpp"

namespace gannet {

/// A scene with its plans, ready for its first step, and the case it was built from.
struct HardSubject {
  std::shared_ptr<void> owner;  ///< keeps the rest alive
  Scene* scene = nullptr;
  Models* models = nullptr;
  Keys root;
};

/// Builds the case with overrides ("key.path=value"). Throws InputError.
using HardBuilder = std::function<HardSubject(const std::vector<std::string>& overrides)>;

/// What came of one run.
struct HardResult {
  std::string variant;  ///< "" for the case as written
  bool stable = false;  ///< all limits were kept to the end
  bool must_fail = false;
  bool passed = false;  ///< stable, or broken where and as it must
  std::string broken;   ///< the limit that was broken first: a name of limit_names()
  std::string why;      ///< in words
  std::vector<LimitState> limits;
  std::int64_t steps = 0;
  double t = 0;        ///< simulated [s]
  double seconds = 0;  ///< wall time
};

/// One run: steps until the end or the first broken limit (a guard that trips is one).
/// steps: overrides the end of the case where above 0.
HardResult run_hard(const HardBuilder& build, const std::vector<std::string>& overrides,
                    bool long_form, std::int64_t steps = 0);

/// Judges a run of a variant: one that must fail passes when it broke one of the limits it names.
void judge(const HardVariant& variant, HardResult& result);

/// The case as written and all its variants; `told` is called with each result as it comes.
void run_hard_case(const HardBuilder& build, bool long_form,
                   const std::function<void(const HardResult&)>& told);

/// One line: variant, result, the margin of each limit, steps and seconds.
std::string result_line(const std::string& case_name, const HardResult& result);

}  // namespace gannet
