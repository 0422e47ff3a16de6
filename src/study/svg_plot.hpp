// Small pictures as SVG text: lines and points on logarithmic or even axes, and bars.
#pragma once

#include <string>
#include <vector>

namespace gannet {

/// Points of one colour, joined by a line or not.
struct PlotSeries {
  std::string label;  ///< in the legend; empty: not there
  std::vector<double> x;
  std::vector<double> y;
  std::vector<std::string> tips;      ///< shown when the pointer rests on a point; may be empty
  std::vector<std::string> labels{};  ///< written beside the points; may be empty
  int colour = 0;                     ///< number in the palette; -1: dark grey
  bool line = true;
  bool dashed = false;
  bool markers = true;
  bool ring = false;  ///< markers are rings
};

struct Plot {
  std::string title;
  std::string subtitle;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
};

/// A picture with logarithmic axes. Points that are not finite and above 0 are left out; with none
/// left the picture says so.
std::string log_plot(const Plot& plot);

/// The same with even axes, which also hold what is 0 and below.
std::string even_plot(const Plot& plot);

/// One row of bars: what it is, and a relative change in each column.
struct BarRow {
  std::string label;
  std::vector<double> values;
};

/// Rows of bars about a zero line, a panel a column, in percent.
std::string bar_plot(const std::string& title, const std::vector<std::string>& columns,
                     const std::vector<BarRow>& rows);

/// The values of one setting, and five of their percentiles in rising order.
struct StripColumn {
  std::string label;
  std::vector<double> values;
  std::vector<double> percentiles;
};

/// A strip of dots a column, with a box between the second and fourth percentile, a line at the
/// third and whiskers at the first and fifth, on an even axis. Columns without a finite value stay
/// empty.
std::string strip_plot(const std::string& title, const std::string& y_label,
                       const std::vector<StripColumn>& columns);

/// Text that may stand in XML: & < > and quotes written out, control characters left out.
std::string xml_text(const std::string& text);

}  // namespace gannet
