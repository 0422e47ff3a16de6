#include "study/study_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/units.hpp"
#include "study/study_history.hpp"
#include "study/study_prices.hpp"

namespace gannet {

double quantile_of(std::vector<double> x, double q) {
  std::erase_if(x, [](double value) { return !std::isfinite(value); });
  if (x.empty()) return unknown;
  std::sort(x.begin(), x.end());
  const double place = q * static_cast<double>(x.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, x.size() - 1);
  return std::lerp(x[below], x[above], place - static_cast<double>(below));
}

double median_of(std::vector<double> x) { return quantile_of(std::move(x), 0.5); }

std::vector<std::size_t> pareto_front(const std::vector<double>& time,
                                      const std::vector<double>& error, std::size_t leave_out) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (i != leave_out && time[i] > 0 && std::isfinite(error[i])) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return time[a] != time[b] ? time[a] < time[b] : error[a] < error[b];
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || error[i] < error[front.back()]) front.push_back(i);
  }
  return front;
}

std::string label_without_refined(const StudySpec& spec, const std::vector<std::string>& choices) {
  std::vector<StudyAxis> axes;
  std::vector<std::string> others;
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    if (spec.axes[i].key == spec.refine) continue;
    axes.push_back(spec.axes[i]);
    others.push_back(choices[i]);
  }
  return axes.empty() ? "" : setting_text(axes, others);
}

namespace {

std::vector<StudyPoint> points_of(const std::vector<StudyRun>& runs) {
  std::vector<StudyPoint> points;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const StudyRun& run = runs[i];
    auto it = std::find_if(points.begin(), points.end(),
                           [&](const StudyPoint& p) { return p.choices == run.choices; });
    if (it == points.end()) it = points.insert(points.end(), StudyPoint{run.choices, run.h});
    it->work = run.size.work();
    if (run.state == StudyState::done) it->runs.push_back(i);
  }
  for (StudyPoint& point : points) {
    std::vector<double> wall;
    for (const std::size_t i : point.runs) wall.push_back(runs[i].wall);
    point.wall = median_of(wall);
  }
  return points;
}

bool is_baseline(const StudySpec& spec, const std::vector<std::string>& choices) {
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    if (spec.axes[i].key != spec.refine && choices[i] != spec.axes[i].values.front()) return false;
  }
  return true;
}

/// The finest setting that is done, all else as in the first one.
std::size_t finest_point(const StudyResult& result) {
  std::size_t finest = no_point;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const StudyPoint& point = result.points[i];
    if (!point.done() ||
        (!result.spec.refine.empty() && !is_baseline(result.spec, point.choices))) {
      continue;
    }
    if (finest == no_point) finest = i;
    const StudyPoint& best = result.points[finest];
    if (result.spec.refine.empty() ? point.work > best.work : point.h < best.h) finest = i;
  }
  return finest;
}

std::vector<StudySeries> series_of(const StudyResult& result) {
  std::vector<StudySeries> all;
  if (result.spec.refine.empty()) return all;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (!result.points[i].done()) continue;
    const std::string label = label_without_refined(result.spec, result.points[i].choices);
    auto it = std::find_if(all.begin(), all.end(),
                           [&](const StudySeries& s) { return s.label == label; });
    if (it == all.end()) it = all.insert(all.end(), StudySeries{label});
    it->points.push_back(i);
  }
  for (StudySeries& series : all) {
    std::sort(series.points.begin(), series.points.end(), [&](std::size_t a, std::size_t b) {
      return result.points[a].h > result.points[b].h;
    });
  }
  return all;
}

TimeSeries history_of(const StudyResult& result, const StudyMeasure& measure, std::size_t run) {
  return read_time_series(result.runs[run].folder + "/history/" + measure.history + ".csv",
                          measure.column);
}

/// The history of a file, in SI where its header names a unit.
TimeSeries reference_file(const StudyReference& reference) {
  TimeSeries series = read_time_series(reference.file, reference.column);
  try {
    const double unit = parse_quantity("1 " + series.unit).value;
    for (double& y : series.y) y *= unit;
  } catch (const std::invalid_argument&) {
    return series;  // no unit that is known here: numbers as they stand
  }
  return series;
}

/// The history of a file, or of a formula or number at the times of `run`, a history of the study.
TimeSeries reference_history(const StudyReference& reference, const TimeSeries& run) {
  if (reference.kind == StudyReference::Kind::csv) return reference_file(reference);
  TimeSeries series = run;
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    series.y[i] = reference.kind == StudyReference::Kind::formula ? reference.formula(&series.t[i])
                                                                  : reference.value;
    if (!std::isfinite(series.y[i])) {
      throw std::runtime_error(fmt::format("the reference '{}' is not finite at t = {:.6g} s",
                                           reference.text, series.t[i]));
    }
  }
  return series;
}

std::string reference_name(const StudyReference& reference, const std::string& unit) {
  if (reference.kind == StudyReference::Kind::csv) return reference.file;
  if (reference.kind == StudyReference::Kind::formula) return reference.text;
  return fmt::format("{:.5g} {}", reference.value, unit);
}

bool is_known(const StudyReference& reference) {
  return reference.kind != StudyReference::Kind::finest &&
         reference.kind != StudyReference::Kind::richardson;
}

const StudyReference& reference_for(const StudyResult& result, const MeasureResult& m) {
  return m.measure.reference ? *m.measure.reference : result.spec.reference;
}

/// Values of all points; distances are against `against`, the others against nothing.
void take_values(const StudyResult& result, const TimeSeries* against, MeasureResult& m) {
  m.values.resize(result.points.size());
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    std::vector<double> values;
    for (const std::size_t run : result.points[i].runs) {
      const TimeSeries series = history_of(result, m.measure, run);
      m.unit = unit_of(m.measure, series.unit);
      if (against == nullptr) {
        values.push_back(evaluate(m.measure, series));
        continue;
      }
      const TimeSeries window = window_of(*against, m.measure.from, m.measure.until);
      values.push_back(distance_of(series, window, m.measure.max_shift).rms);
    }
    if (values.empty()) continue;
    StudyValue& value = m.values[i];
    value.value = median_of(values);
    value.low = *std::min_element(values.begin(), values.end());
    value.high = *std::max_element(values.begin(), values.end());
    value.of_runs = values;
  }
}

std::string finest_text(const StudyResult& result, std::size_t point) {
  return fmt::format("the finest run ({})",
                     setting_text(result.spec.axes, result.points[point].choices));
}

/// The history of the finest run that is done, and its point.
TimeSeries finest_history(const StudyResult& result, const StudyMeasure& measure,
                          std::size_t& point) {
  point = finest_point(result);
  if (point == no_point) throw std::runtime_error("no run is done");
  return history_of(result, measure, result.points[point].runs.front());
}

/// Histories against a history: the finest run's, or that of a file, a formula or a number.
void measure_distance(const StudyResult& result, MeasureResult& m) {
  const StudyReference& reference = reference_for(result, m);
  std::size_t point = no_point;
  TimeSeries against = finest_history(result, m.measure, point);
  if (is_known(reference)) {
    m.reference_text = reference_name(reference, against.unit);
    against = reference_history(reference, against);
  } else {
    m.reference_point = point;
    m.reference_text = finest_text(result, point);
  }
  take_values(result, &against, m);
  m.reference = 0;
  const TimeSeries window = window_of(against, m.measure.from, m.measure.until);
  const double range = distance_of(window, window, 0).range;
  const double scale = m.measure.scale > 0 ? m.measure.scale : range;
  for (StudyValue& v : m.values) {
    v.error = v.value / scale;
    for (const double value : v.of_runs) v.errors_of_runs.push_back(value / scale);
  }
}

double extrapolated(const StudyResult& result, const MeasureResult& m) {
  for (const StudySeries& series : series_of(result)) {
    if (series.points.empty() ||
        !is_baseline(result.spec, result.points[series.points.front()].choices)) {
      continue;
    }
    std::vector<double> h;
    std::vector<double> phi;
    for (const std::size_t i : series.points) {
      h.push_back(result.points[i].h);
      phi.push_back(m.values[i].value);
    }
    const LimitFit fit = fit_limit(h, phi);
    if (!fit.valid) throw std::runtime_error("no Richardson extrapolation: " + fit.reason);
    return fit.limit;
  }
  throw std::runtime_error("no Richardson extrapolation: no key is refined");
}

/// Numbers against a number.
void measure_number(const StudyResult& result, MeasureResult& m) {
  take_values(result, nullptr, m);
  const StudyReference& reference = reference_for(result, m);
  switch (reference.kind) {
    case StudyReference::Kind::finest:
      m.reference_point = finest_point(result);
      if (m.reference_point == no_point) throw std::runtime_error("no run is done");
      m.reference = m.values[m.reference_point].value;
      m.reference_text = finest_text(result, m.reference_point);
      break;
    case StudyReference::Kind::number:
      m.reference = reference.value;
      m.reference_text = reference_name(reference, m.unit);
      break;
    case StudyReference::Kind::csv:
    case StudyReference::Kind::formula: {
      std::size_t point = no_point;
      const TimeSeries run = finest_history(result, m.measure, point);
      m.reference = evaluate(m.measure, reference_history(reference, run));
      m.reference_text = reference_name(reference, m.unit);
      break;
    }
    case StudyReference::Kind::richardson:
      m.reference = extrapolated(result, m);
      m.reference_text = fmt::format("{:.5g} {} (extrapolated)", m.reference, m.unit);
      break;
  }
  const double scale = m.measure.scale > 0 ? m.measure.scale : std::abs(m.reference);
  if (scale == 0) throw std::runtime_error("the reference is 0: no relative error without a scale");
  const auto error = [&](double x) { return std::abs(x - m.reference) / scale; };
  for (StudyValue& v : m.values) {
    v.error = error(v.value);
    for (const double value : v.of_runs) v.errors_of_runs.push_back(error(value));
  }
}

void fit_series(const StudyResult& result, MeasureResult& m) {
  m.series = series_of(result);
  const bool from_run = m.reference_point != no_point;
  for (StudySeries& series : m.series) {
    std::vector<double> h;
    std::vector<double> phi;
    std::vector<double> error;
    std::vector<double> wall;
    for (const std::size_t i : series.points) {
      h.push_back(result.points[i].h);
      phi.push_back(m.values[i].value);
      error.push_back(m.values[i].error);
      wall.push_back(result.points[i].wall);
    }
    series.cost = fit_power(h, wall, 2);
    const bool own = from_run && std::find(series.points.begin(), series.points.end(),
                                           m.reference_point) != series.points.end();
    if (from_run && !own) {
      series.order.reason = "its limit is not that of the reference run";
    } else {
      series.order = fit_order(h, error, from_run ? result.points[m.reference_point].h : 0);
    }
    if (m.measure.kind != "distance") {
      series.limit = fit_limit(h, phi);
    } else {
      series.limit.reason = "a distance has no limit of its own";
    }
  }
}

/// The finest done point with the given choices but for the refined key, or no_point.
std::size_t finest_with(const StudyResult& result, const std::vector<std::string>& choices,
                        double at_h) {
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const StudyPoint& p = result.points[i];
    const bool same_h = result.spec.refine.empty() || p.h == at_h;
    if (p.done() && same_h &&
        label_without_refined(result.spec, p.choices) ==
            label_without_refined(result.spec, choices)) {
      return i;
    }
  }
  return no_point;
}

/// One change of one key, at the finest level where both are done.
StudyChange change_of(const StudyResult& result, const MeasureResult& m, std::size_t axis,
                      const std::string& to) {
  const StudySpec& spec = result.spec;
  StudyChange change{spec.axes[axis].key, spec.axes[axis].values.front(), to};
  double finest = std::numeric_limits<double>::infinity();
  for (const StudyPoint& p : result.points) {
    if (!is_baseline(spec, p.choices) || !p.done()) continue;
    std::vector<std::string> other = p.choices;
    other[axis] = to;
    const std::size_t a = finest_with(result, p.choices, p.h);
    const std::size_t b = finest_with(result, other, p.h);
    if (b == no_point || (!spec.refine.empty() && p.h > finest)) continue;
    finest = p.h;
    for (std::size_t i = 0; i < spec.axes.size(); ++i) {
      if (spec.axes[i].key == spec.refine)
        change.at = short_key(spec.axes, spec.refine) + " = " + p.choices[i];
    }
    const double before = m.values[a].value;
    const double after = m.values[b].value;
    change.value = m.measure.kind == "distance" ? m.values[b].error - m.values[a].error
                                                : (after - before) / std::abs(before);
    change.time = result.points[b].wall / result.points[a].wall - 1;
  }
  return change;
}

void find_changes(const StudyResult& result, MeasureResult& m) {
  for (std::size_t axis = 0; axis < result.spec.axes.size(); ++axis) {
    const StudyAxis& a = result.spec.axes[axis];
    if (a.key == result.spec.refine) continue;
    for (std::size_t k = 1; k < a.values.size(); ++k) {
      m.changes.push_back(change_of(result, m, axis, a.values[k]));
    }
  }
}

MeasureResult analyse_measure(const StudyResult& result, const StudyMeasure& measure) {
  MeasureResult m;
  m.measure = measure;
  try {
    if (measure.kind == "distance") {
      measure_distance(result, m);
    } else {
      measure_number(result, m);
    }
  } catch (const std::runtime_error& e) {
    m.problem = e.what();
    m.values.resize(result.points.size());
  }
  fit_series(result, m);
  std::vector<double> time;
  std::vector<double> error;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    time.push_back(result.points[i].wall);
    error.push_back(m.values[i].error);
  }
  m.pareto = pareto_front(time, error, m.reference_point);
  find_changes(result, m);
  m.sentences = price_sentences(result, m);
  return m;
}

}  // namespace

void analyse(StudyResult& result) {
  result.points = points_of(result.runs);
  result.measures.clear();
  for (const StudyMeasure& measure : result.spec.measures) {
    result.measures.push_back(analyse_measure(result, measure));
  }
}

}  // namespace gannet
