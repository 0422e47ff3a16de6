#include "study/study_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/svg_plot.hpp"

namespace gannet {

namespace {

std::string order_text(const OrderFit& order) {
  if (!order.valid) return "no order: " + order.reason;
  if (!std::isfinite(order.low)) return fmt::format("order {:.2f} (two levels)", order.order);
  return fmt::format("order {:.2f}, 95 % interval {:.2f} to {:.2f}", order.order, order.low,
                     order.high);
}

std::string tip_of(const StudyResult& result, const MeasureResult& m, std::size_t point) {
  return fmt::format("{}: error {:.3g} %, {}",
                     setting_text(result.spec.axes, result.points[point].choices),
                     100 * m.values[point].error, wall_text(result.points[point].wall));
}

/// Size on the axis of the picture: elements a side grow to the right, lengths are in mm.
double shown_size(const StudySpec& spec, double h) { return spec.refine_counts ? 1 / h : 1e3 * h; }

PlotSeries law_of(const StudySpec& spec, const OrderFit& order, double h_lo, double h_hi,
                  int colour) {
  PlotSeries law{.colour = colour, .dashed = true, .markers = false};
  const int n = 40;
  for (int k = 0; k <= n; ++k) {
    const double h = h_lo * std::pow(h_hi / h_lo, static_cast<double>(k) / n);
    law.x.push_back(shown_size(spec, h));
    law.y.push_back(100 * order.error_at(h));
  }
  return law;
}

}  // namespace

std::string convergence_picture(const StudyResult& result, const MeasureResult& m) {
  if (result.spec.refine.empty()) return "";
  Plot plot{
      m.measure.name + ": convergence",
      m.series.size() == 1 ? order_text(m.series.front().order)
                           : "error against " + m.reference_text,
      short_key(result.spec.axes, result.spec.refine) + (result.spec.refine_counts ? "" : " [mm]"),
      "error [%]",
      {}};
  int colour = 0;
  for (const StudySeries& series : m.series) {
    PlotSeries shown{.label = series.label.empty() ? "measured" : series.label,
                     .colour = colour,
                     .line = !series.order.valid};
    double h_lo = std::numeric_limits<double>::infinity();
    double h_hi = 0;
    for (const std::size_t i : series.points) {
      const double h = result.points[i].h;
      if (i == m.reference_point) continue;
      shown.x.push_back(shown_size(result.spec, h));
      shown.y.push_back(100 * m.values[i].error);
      shown.tips.push_back(tip_of(result, m, i));
      if (!(m.values[i].error > 0)) continue;
      h_lo = std::min(h_lo, h);
      h_hi = std::max(h_hi, h);
    }
    plot.series.push_back(shown);
    if (series.order.valid && h_hi > h_lo) {
      plot.series.push_back(law_of(result.spec, series.order, h_lo, h_hi, colour));
      plot.series.back().label =
          m.series.size() == 1 ? "fit" : fmt::format("order {:.2f}", series.order.order);
    }
    ++colour;
  }
  return log_plot(plot);
}

std::string work_picture(const StudyResult& result, const MeasureResult& m) {
  Plot plot{m.measure.name + ": what accuracy costs",
            "error against " + m.reference_text,
            "wall time [s]",
            "error [%]",
            {}};
  PlotSeries front{.label = "Pareto front", .colour = -1, .dashed = true, .markers = false};
  for (const std::size_t i : m.pareto) {
    front.x.push_back(result.points[i].wall);
    front.y.push_back(100 * m.values[i].error);
    front.labels.push_back(fmt::format("{}", fmt::join(result.points[i].choices, ", ")));
  }
  plot.series.push_back(front);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (!result.points[i].done() || i == m.reference_point) continue;
    const std::string label = label_without_refined(result.spec, result.points[i].choices);
    const auto it = std::find(labels.begin(), labels.end(), label);
    const auto number = static_cast<std::size_t>(it - labels.begin());
    if (it == labels.end()) {
      labels.push_back(label);
      plot.series.push_back({.label = label.empty() ? "runs" : label,
                             .colour = static_cast<int>(number),
                             .line = false});
    }
    PlotSeries& series = plot.series[number + 1];
    series.x.push_back(result.points[i].wall);
    series.y.push_back(100 * m.values[i].error);
    series.tips.push_back(tip_of(result, m, i));
  }
  return log_plot(plot);
}

std::string spread_picture(const StudyResult& result, const MeasureResult& m) {
  std::vector<StripColumn> columns;
  bool repeated = false;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const std::vector<double>& values = m.values[i].of_runs;
    if (values.empty()) continue;
    repeated = repeated || values.size() > 1;
    StripColumn column{fmt::format("{}", fmt::join(result.points[i].choices, ", ")), values, {}};
    for (const int percent : spread_percents) {
      column.percentiles.push_back(quantile_of(values, 0.01 * percent));
    }
    columns.push_back(column);
  }
  if (!repeated) return "";
  return strip_plot(m.measure.name + ": spread over repeats",
                    m.measure.name + " [" + (m.unit.empty() ? "1" : m.unit) + "]", columns);
}

std::string changes_picture(const MeasureResult& m) {
  std::vector<BarRow> rows;
  for (const StudyChange& change : m.changes) {
    rows.push_back({fmt::format("{}: {} instead of {}{}", short_key({}, change.key), change.to,
                                change.from, change.at.empty() ? "" : ", at " + change.at),
                    {change.value, change.time}});
  }
  if (rows.empty()) return "";
  const std::string what =
      m.measure.kind == "distance" ? "change of the error" : "change of " + m.measure.name;
  return bar_plot(m.measure.name + ": what settings change", {what, "change of the wall time"},
                  rows);
}

}  // namespace gannet
