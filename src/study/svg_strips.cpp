// How results are distributed, as SVG text: a strip of dots and a box a column.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/svg_plot.hpp"

namespace gannet {

namespace {

constexpr double strips_left = 96;
constexpr double strips_top = 56;
constexpr double strips_bottom = 352;
constexpr double column_width = 84;

/// An even axis upwards, between round numbers.
struct EvenAxis {
  double low = 0;
  double step = 1;
  int n = 1;  ///< steps
  [[nodiscard]] double at(double value) const {
    return strips_bottom - (strips_bottom - strips_top) * (value - low) / (step * n);
  }
};

EvenAxis axis_of(const std::vector<StripColumn>& columns) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const StripColumn& column : columns) {
    for (const double x : column.values) {
      if (!std::isfinite(x)) continue;
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  if (!(low <= high)) return {};
  const double range = std::max({high - low, 1e-6 * std::abs(high), 1e-300});
  const double unit = std::pow(10.0, std::floor(std::log10(range / 4)));
  double step = 10 * unit;
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (step == 10 * unit && range / (digit * unit) <= 6) step = digit * unit;
  }
  const double first = std::floor(low / step - 0.1);
  return {first * step, step, static_cast<int>(std::ceil(high / step + 0.1) - first)};
}

std::string line(double x1, double y1, double x2, double y2, const char* more) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1,
                     x2, y2, more);
}

std::string box_of(const StripColumn& column, const EvenAxis& axis, double x) {
  const std::vector<double>& p = column.percentiles;
  if (p.size() != 5 || !std::isfinite(p.front()) || column.values.size() < 2) return "";
  constexpr const char* thin = "stroke=\"#444\"";
  std::string out = line(x, axis.at(p[0]), x, axis.at(p[1]), thin) +
                    line(x, axis.at(p[3]), x, axis.at(p[4]), thin);
  for (const double y : {p[0], p[4]}) out += line(x - 9, axis.at(y), x + 9, axis.at(y), thin);
  out += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"36\" height=\"{:.1f}\" fill=\"#dbe9f4\" "
      "stroke=\"#444\"/>\n",
      x - 18, axis.at(p[3]), std::max(axis.at(p[1]) - axis.at(p[3]), 0.5));
  return out +
         line(x - 18, axis.at(p[2]), x + 18, axis.at(p[2]), "stroke=\"#222\" stroke-width=\"2.5\"");
}

/// Dots beside each other in a fixed pattern, so that those of the same height are seen.
std::string dots_of(const StripColumn& column, const EvenAxis& axis, double x) {
  std::string out;
  int k = 0;
  for (const double value : column.values) {
    const double aside = 4.0 * (k++ % 5 - 2);
    if (!std::isfinite(value)) continue;
    out += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"#0072b2\" fill-opacity=\"0.7\">"
        "<title>{}</title></circle>\n",
        x + aside, axis.at(value), xml_text(fmt::format("{}: {:.5g}", column.label, value)));
  }
  return out;
}

}  // namespace

std::string strip_plot(const std::string& title, const std::string& y_label,
                       const std::vector<StripColumn>& columns) {
  const double right = strips_left + column_width * static_cast<double>(columns.size());
  const double width = std::max(right + 28, 420.0);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} 430\" width=\"{0}\" "
      "height=\"430\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" "
      "fill=\"#222\">\n<rect width=\"{0}\" height=\"430\" fill=\"#fff\"/>\n"
      "<text x=\"20\" y=\"26\" font-size=\"16\" font-weight=\"bold\">{1}</text>\n"
      "<text x=\"20\" y=\"44\" fill=\"#666\">dots: repeats; box: 25 to 75 %; line: median; "
      "whiskers: "
      "10 and 90 %</text>\n"
      "<text x=\"20\" y=\"{2}\" text-anchor=\"middle\" transform=\"rotate(-90 20 "
      "{2})\">{3}</text>\n",
      width, xml_text(title), (strips_top + strips_bottom) / 2, xml_text(y_label));
  const EvenAxis axis = axis_of(columns);
  for (int k = 0; k <= axis.n; ++k) {
    const double value = axis.low + axis.step * k;
    const double shown = std::abs(value) < 1e-9 * axis.step ? 0 : value;
    out += line(strips_left, axis.at(value), right, axis.at(value), "stroke=\"#ddd\"");
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.5g}</text>\n",
                       strips_left - 8, axis.at(value) + 4, shown);
  }
  double x = strips_left + column_width / 2;
  for (const StripColumn& column : columns) {
    out += box_of(column, axis, x) + dots_of(column, axis, x);
    out += fmt::format(
        "<text x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"end\" font-size=\"11\" "
        "transform=\"rotate(-25 {0:.1f} {1:.1f})\">{2}</text>\n",
        x + 6, strips_bottom + 18, xml_text(column.label));
    x += column_width;
  }
  return out + "</svg>\n";
}

}  // namespace gannet
