#include "study/study_prices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gannet {

namespace {

StudyPrice measured_price(const StudyResult& result, const MeasureResult& m, double target) {
  StudyPrice price;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const double wall = result.points[i].wall;
    if (i == m.reference_point || !(m.values[i].error <= target) || !(wall > 0)) continue;
    if (price.point != no_point && wall >= price.wall) continue;
    price.from = StudyPrice::From::measured;
    price.point = i;
    price.wall = wall;
  }
  return price;
}

/// "" where the fit of a series can be believed.
std::string why_no_prediction(const StudySeries& series) {
  if (!series.order.valid) return series.order.reason;
  if (!std::isfinite(series.order.low)) return "two levels give an order, but no interval for it";
  if (series.order.low <= 0) {
    return fmt::format("the order is uncertain, {:.2g} with a 95 % interval from {:.2g} to {:.2g}",
                       series.order.order, series.order.low, series.order.high);
  }
  if (!(series.cost.exponent < 0)) return "the wall time does not grow with the resolution";
  return "";
}

/// The size that the fit asks for, no coarser than what missed the target.
double predicted_size(const StudyResult& result, const MeasureResult& m, const StudySeries& series,
                      double target) {
  double h = series.order.size_for(target);
  for (const std::size_t i : series.points) {
    if (i != m.reference_point && m.values[i].error > target) h = std::min(h, result.points[i].h);
  }
  return h;
}

}  // namespace

StudyPrice price_of(const StudyResult& result, const MeasureResult& m, double target) {
  StudyPrice best = measured_price(result, m, target);
  if (best.from == StudyPrice::From::measured) return best;
  best.why = result.spec.refine.empty() ? "no key is refined" : "no runs to fit";
  for (std::size_t k = 0; k < m.series.size(); ++k) {
    const StudySeries& series = m.series[k];
    const std::string why = why_no_prediction(series);
    if (!why.empty()) {
      if (k == 0) best.why = why;  // of the settings that the others are compared with
      continue;
    }
    const double h = predicted_size(result, m, series, target);
    const double wall = series.cost.at(h);
    if (best.from == StudyPrice::From::fitted && wall >= best.wall) continue;
    best.from = StudyPrice::From::fitted;
    best.wall = wall;
    best.h = h;
    best.series = k;
  }
  return best;
}

namespace {

/// True where a finer run of the same series misses the target.
bool may_be_luck(const StudyResult& result, const MeasureResult& m, std::size_t point,
                 double target) {
  for (const StudySeries& series : m.series) {
    const auto& points = series.points;
    if (std::find(points.begin(), points.end(), point) == points.end()) continue;
    return std::any_of(points.begin(), points.end(), [&](std::size_t i) {
      return result.points[i].h < result.points[point].h && m.values[i].error > target;
    });
  }
  return false;
}

std::string measured_sentence(const StudyResult& result, const MeasureResult& m,
                              const StudyPrice& price, int percent) {
  const bool luck = may_be_luck(result, m, price.point, 0.01 * percent);
  return fmt::format(
      "the cheapest setting within {} % of {} takes {}: {} (measured, error {:.2g} %{})", percent,
      m.reference_text, wall_text(price.wall),
      setting_text(result.spec.axes, result.points[price.point].choices),
      100 * m.values[price.point].error,
      luck ? "; a finer run of these settings misses it, so this one may be luck" : "");
}

std::string fitted_sentence(const StudyResult& result, const MeasureResult& m,
                            const StudyPrice& price, const std::string& percent) {
  const StudySeries& series = m.series[price.series];
  const std::string others = series.label.empty() ? "" : ", " + series.label;
  return fmt::format(
      "{} was not reached by a run; it would take about {}: {} = {}{} (not measured: from the "
      "fitted "
      "order {:.2g}, 95 % interval {:.2g} to {:.2g})",
      percent, wall_text(price.wall), short_key(result.spec.axes, result.spec.refine),
      size_text(result.spec, price.h), others, series.order.order, series.order.low,
      series.order.high);
}

}  // namespace

std::vector<std::string> price_sentences(const StudyResult& result, const MeasureResult& m) {
  if (!m.problem.empty()) return {fmt::format("{}: no result: {}", m.measure.name, m.problem)};
  std::vector<std::string> sentences;
  for (const int percent : {5, 2, 1}) {
    const StudyPrice price = price_of(result, m, 0.01 * percent);
    const std::string words = fmt::format("{} %", percent);
    std::string text = fmt::format("{} was not reached, and nothing can be said of its cost: {}",
                                   words, price.why);
    if (price.from == StudyPrice::From::measured) {
      text = measured_sentence(result, m, price, percent);
    } else if (price.from == StudyPrice::From::fitted) {
      text = fitted_sentence(result, m, price, words);
    }
    sentences.push_back(fmt::format("{}: {}.", m.measure.name, text));
  }
  return sentences;
}

}  // namespace gannet
