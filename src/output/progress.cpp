#include "output/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/report.hpp"
#include "time/guards.hpp"

namespace gannet {

namespace {

constexpr double seconds_between_bars = 0.2;
constexpr double seconds_between_lines = 5;
constexpr int bar_width = 20;

std::size_t terminal_width(std::FILE* out) {
  winsize size{};
  if (ioctl(fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

/// Fraction of the time from the start of this process to the end that is done.
double fraction(const RunRecord& record, double t, double from) {
  const double until = record.plan.until;
  if (!std::isfinite(until) || !(until > from)) return 0;
  return std::clamp((t - from) / (until - from), 0.0, 1.0);
}

}  // namespace

std::string progress_line(const ProgressValues& v) {
  std::string line = fmt::format("{:3.0f} %  t {}  step {}  dt {}", std::floor(100 * v.done),
                                 time_text(v.t), v.step, time_text(v.dt));
  if (!v.who.empty()) line += " (" + v.who + ")";
  line += fmt::format("  energy error {:.2g} %", 100 * v.energy_error);
  if (v.particle_steps_per_second > 0) {
    line += "  " + count_text(v.particle_steps_per_second) + " particles/s";
  } else if (v.element_steps_per_second > 0) {
    line += "  " + count_text(v.element_steps_per_second) + " elements/s";
  }
  return line + "  ETA " + duration_text(v.seconds_left);
}

Progress::Progress(std::FILE* out) : out_(out), terminal_(isatty(fileno(out)) != 0) {}

ProgressValues Progress::values(Scene& scene, const Models& models, const RunRecord& record) {
  const Step& slow = models.list.front().step;
  const Model& fast = models.list.back();
  const double wall = wall_time(record);
  const StepsDone done = steps_done(scene, models, record);
  const double seconds = std::max(wall - last_wall_, 1e-9);
  const double here = fraction(record, slow.t, record.start_t);

  ProgressValues v;
  v.done = fraction(record, slow.t, 0);
  v.t = slow.t;
  v.step = fast.step.n;
  v.dt = fast.step.dt;
  v.who = fast.vote.limited_by();
  v.energy_error = scene.store.get<GuardState>().balance.error();
  v.particle_steps_per_second = (done.particle_steps - last_done_.particle_steps) / seconds;
  v.element_steps_per_second = (done.element_steps - last_done_.element_steps) / seconds;
  v.seconds_left = here > 0 ? wall * (1 - here) / here : std::numeric_limits<double>::infinity();
  last_wall_ = wall;
  last_done_ = done;
  return v;
}

void Progress::update(Scene& scene, const Models& models, const RunRecord& record) {
  const double since = wall_time(record) - last_wall_;
  const double done = fraction(record, models.list.front().step.t, 0);
  const int tenths = static_cast<int>(std::floor(10 * done));
  const bool line_due = since >= seconds_between_lines || tenths > tenths_;
  if (terminal_ ? since < seconds_between_bars && tenths < 10 : !line_due) return;
  if (terminal_ && tenths == 10 && tenths_ == 10) return;
  tenths_ = tenths;
  show(values(scene, models, record));
}

void Progress::show(const ProgressValues& v) {
  std::string line = progress_line(v);
  if (!terminal_) {
    fmt::print(out_, "{}\n", line);
    std::fflush(out_);
    return;
  }
  const int full = static_cast<int>(bar_width * v.done);
  line = "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(bar_width - full), '-') + "] " + line;
  line.resize(std::min(line.size(), terminal_width(out_) - 1));
  fmt::print(out_, "\r{}\x1b[K", line);
  std::fflush(out_);
  drawn_ = true;
}

void Progress::finish() {
  if (drawn_) fmt::print(out_, "\n");
  std::fflush(out_);
  drawn_ = false;
}

}  // namespace gannet
