#include "study/hard_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "time/step.hpp"

namespace gannet {

namespace {

std::string number_text(double x) { return std::isinf(x) ? "-" : fmt::format("{:.3g}", x); }

std::string words_of(const LimitState& state) {
  return fmt::format("{} {} is {} {} at step {}", state.name, number_text(state.worst),
                     state.at_least ? "below" : "above", number_text(state.limit), state.step);
}

/// "exact.floor" is one of the limits called "exact".
std::string kind_of(const std::string& limit) { return limit.substr(0, limit.find('.')); }

void note_broken(const LimitState& state, HardResult& result) {
  result.broken = kind_of(state.name);
  result.why = words_of(state);
}

/// Steps until the end or until a limit is broken.
void step_on(HardSubject& subject, HardWatch& watch, const HardEnd& end, HardResult& result) {
  const Step& step = subject.models->list.front().step;
  while (step.n < end.steps && step.t < end.until) {
    advance(*subject.models);
    result.steps = step.n;
    result.t = step.t;
    watch.look();
    if (watch.broken() != nullptr) return;
  }
  watch.finish();
}

void follow(HardSubject& subject, HardWatch& watch, const HardEnd& end, HardResult& result) {
  try {
    step_on(subject, watch, end, result);
  } catch (const RunError& error) {
    result.broken = "guard";
    result.why = error.failure().what;
    return;
  }
  if (const LimitState* state = watch.broken()) {
    note_broken(*state, result);
  } else {
    result.stable = true;
  }
}

}  // namespace

HardResult run_hard(const HardBuilder& build, const std::vector<std::string>& overrides,
                    bool long_form, std::int64_t steps) {
  using Clock = std::chrono::steady_clock;
  HardResult result;
  const auto start = Clock::now();
  HardSubject subject = build(overrides);
  const HardCase hard = read_hard_case(subject.root);
  subject.root.mistakes().throw_if_any();
  HardEnd end = long_form ? hard.long_end : hard.end;
  if (steps > 0) end.steps = steps;
  HardWatch watch(hard, *subject.scene, *subject.models);
  follow(subject, watch, end, result);
  result.limits = watch.limits();
  result.passed = result.stable;
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

void judge(const HardVariant& variant, HardResult& result) {
  result.variant = variant.name;
  result.must_fail = variant.must_fail;
  if (!variant.must_fail) return;
  const bool as_said = variant.by.empty() || std::find(variant.by.begin(), variant.by.end(),
                                                       result.broken) != variant.by.end();
  result.passed = !result.stable && as_said;
  if (result.stable) result.why = "all limits were kept, though one must break";
  if (!result.stable && !as_said) {
    result.why += fmt::format("; one of {} must break", fmt::join(variant.by, ", "));
  }
}

void run_hard_case(const HardBuilder& build, bool long_form,
                   const std::function<void(const HardResult&)>& told) {
  told(run_hard(build, {}, long_form));
  const HardSubject subject = build({});
  for (const HardVariant& variant : read_hard_case(subject.root).variants) {
    HardResult result = run_hard(build, variant.set, long_form);
    judge(variant, result);
    told(result);
  }
}

std::string result_line(const std::string& case_name, const HardResult& result) {
  std::string margins;
  for (const LimitState& state : result.limits) {
    if (state.name == "finite") continue;
    const double margin = state.margin();
    if (!margins.empty()) margins += ", ";
    margins += state.name +
               (std::isinf(margin) || margin > 999 ? " >999" : fmt::format(" {:.3g}", margin));
  }
  std::string word = result.passed ? "ok" : "FAILED";
  if (result.must_fail && result.passed) word = "breaks";
  const bool say_why = !result.stable || !result.passed;
  return fmt::format("{:<22} {:<24} {:<7} {:>8} {:>7.1f}  {}", case_name,
                     result.variant.empty() ? "as written" : result.variant, word, result.steps,
                     result.seconds, say_why ? result.why : margins);
}

}  // namespace gannet
