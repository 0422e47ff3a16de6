#include "study/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gannet {

namespace {

// Okabe and Ito's colours, told apart by the colour-blind too.
constexpr std::array<const char*, 7> palette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#8c6bb1"};

constexpr double width = 680;
constexpr double height = 430;
constexpr double left = 78;
constexpr double right = 652;
constexpr double top = 66;
constexpr double bottom = 372;

const char* colour_of(int number) {
  return number < 0 ? "#444" : palette[static_cast<std::size_t>(number) % palette.size()];
}

std::string start_of(double w, double h) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" "
      "fill=\"#222\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      w, h);
}

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}{}>{}</text>\n", x, y,
                     more.empty() ? "" : " ", more, xml_text(text));
}

std::string line_between(double x1, double y1, double x2, double y2, const std::string& more) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1,
                     x2, y2, more);
}

std::string tick_text(double x) {
  const double size = std::abs(x);
  if (size < 1e-12) return "0";
  return size >= 1e5 || size < 1e-4 ? fmt::format("{:.0e}", x) : fmt::format("{:g}", x);
}

/// A logarithmic axis, or an even one, between two places of the picture.
struct Axis {
  double lo = 1;
  double hi = 10;
  double at_lo = 0;
  double at_hi = 1;
  bool even = false;
  [[nodiscard]] double at(double value) const {
    const double share = even ? (value - lo) / (hi - lo) : std::log(value / lo) / std::log(hi / lo);
    return at_lo + (at_hi - at_lo) * share;
  }
  /// Whole multiples of 1, 2 or 5 times a power of ten, about six of them.
  [[nodiscard]] std::vector<double> even_ticks() const {
    const double rough = (hi - lo) / 6;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double digit : {5.0, 2.0, 1.0}) {
      if (digit * power >= rough) step = digit * power;
    }
    std::vector<double> ticks;
    for (double k = std::ceil(lo / step); k * step <= hi; ++k) ticks.push_back(k * step);
    return ticks;
  }
  /// Round numbers, fewer of them over a long range, more over a short one.
  [[nodiscard]] std::vector<double> ticks() const {
    if (even) return even_ticks();
    const double decades = std::log10(hi / lo);
    std::vector<double> digits = {1};
    if (decades < 3) digits = {1, 2, 5};
    if (decades < 0.9) digits = {1, 1.5, 2, 3, 4, 5, 6, 8};
    std::vector<double> ticks;
    const int every = decades > 10 ? 2 : 1;
    for (int e = static_cast<int>(std::floor(std::log10(lo))); e <= std::log10(hi); e += every) {
      for (const double digit : digits) {
        const double value = digit * std::pow(10.0, e);
        if (value >= lo * 0.999 && value <= hi * 1.001) ticks.push_back(value);
      }
    }
    return ticks;
  }
};

bool can_stand(double x, double y, const Axis& axis) {
  return std::isfinite(x) && std::isfinite(y) && (axis.even || (x > 0 && y > 0));
}

/// Axes that hold all points, with a margin of a tenth and at least a factor of two.
bool axes_of(const Plot& plot, Axis& x, Axis& y) {
  const double inf = std::numeric_limits<double>::infinity();
  x = {inf, x.even ? -inf : 0, left, right, x.even};
  y = {inf, y.even ? -inf : 0, bottom, top, y.even};
  for (const PlotSeries& s : plot.series) {
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!can_stand(s.x[i], s.y[i], x)) continue;
      x.lo = std::min(x.lo, s.x[i]);
      x.hi = std::max(x.hi, s.x[i]);
      y.lo = std::min(y.lo, s.y[i]);
      y.hi = std::max(y.hi, s.y[i]);
    }
  }
  if (!(x.hi >= x.lo)) return false;
  for (Axis* axis : {&x, &y}) {
    if (axis->even) {
      const double margin = axis->hi > axis->lo ? 0.04 * (axis->hi - axis->lo) : 1;
      axis->lo -= margin;
      axis->hi += margin;
      continue;
    }
    const double margin =
        std::max(std::pow(axis->hi / axis->lo, 0.1), std::sqrt(2 * axis->lo / axis->hi));
    axis->lo /= std::max(margin, 1.05);
    axis->hi *= std::max(margin, 1.05);
  }
  return true;
}

std::string frame_of(const Plot& plot, const Axis& x, const Axis& y) {
  std::string out;
  for (const double tick : x.ticks()) {
    out += line_between(x.at(tick), top, x.at(tick), bottom, "stroke=\"#e4e4e4\"");
    out += text_at(x.at(tick), bottom + 18, tick_text(tick), "text-anchor=\"middle\"");
  }
  for (const double tick : y.ticks()) {
    out += line_between(left, y.at(tick), right, y.at(tick), "stroke=\"#e4e4e4\"");
    out += text_at(left - 8, y.at(tick) + 4, tick_text(tick), "text-anchor=\"end\"");
  }
  out += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n", left,
      top, right - left, bottom - top);
  out += text_at((left + right) / 2, bottom + 42, plot.x_label, "text-anchor=\"middle\"");
  out += text_at(0, 0, plot.y_label,
                 fmt::format("text-anchor=\"middle\" transform=\"translate(22 {}) rotate(-90)\"",
                             (top + bottom) / 2));
  return out;
}

std::string marker(double x, double y, const PlotSeries& s, const std::string& tip) {
  const char* colour = colour_of(s.colour);
  const std::string title = tip.empty() ? "" : fmt::format("<title>{}</title>", xml_text(tip));
  return fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" "
      "stroke-width=\"{}\">{}</circle>\n",
      x, y, s.ring ? 8 : 4.5, s.ring ? "none" : colour, s.ring ? colour : "#fff", s.ring ? 1.5 : 1,
      title);
}

/// Right of the points and a little above; left of those that are near the right edge.
std::string labels_of(const PlotSeries& s, const Axis& x, const Axis& y) {
  std::string out;
  for (std::size_t i = 0; i < s.labels.size(); ++i) {
    if (!can_stand(s.x[i], s.y[i], x)) continue;
    const double at = x.at(s.x[i]);
    const bool at_edge = at + 14 + 6.3 * static_cast<double>(s.labels[i].size()) > right;
    out += text_at(at_edge ? at - 9 : at + 9, y.at(s.y[i]) - 7, s.labels[i],
                   fmt::format("font-size=\"11\" fill=\"#555\" text-anchor=\"{}\"",
                               at_edge ? "end" : "start"));
  }
  return out;
}

std::string drawn(const PlotSeries& s, const Axis& x, const Axis& y) {
  std::string path;
  std::string markers;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!can_stand(s.x[i], s.y[i], x)) continue;
    path += fmt::format("{:.1f},{:.1f} ", x.at(s.x[i]), y.at(s.y[i]));
    if (s.markers)
      markers += marker(x.at(s.x[i]), y.at(s.y[i]), s, i < s.tips.size() ? s.tips[i] : "");
  }
  std::string out;
  if (s.line && !path.empty()) {
    path.pop_back();
    out = fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", path,
        colour_of(s.colour), s.dashed ? 1.4 : 2, s.dashed ? " stroke-dasharray=\"6 4\"" : "");
  }
  return out + markers + labels_of(s, x, y);
}

/// Above the frame's corner that has the fewest points: upper right or lower left.
std::string legend(const Plot& plot, const Axis& x, const Axis& y) {
  std::vector<const PlotSeries*> shown;
  std::size_t longest = 0;
  for (const PlotSeries& s : plot.series) {
    if (s.label.empty()) continue;
    shown.push_back(&s);
    longest = std::max(longest, s.label.size());
  }
  if (shown.empty()) return "";
  const double w = 48 + 7.4 * static_cast<double>(longest);
  const double h = 10 + 19 * static_cast<double>(shown.size());
  const std::array<std::array<double, 2>, 4> corners = {{{right - w - 8, top + 8},
                                                         {left + 8, bottom - h - 8},
                                                         {left + 8, top + 8},
                                                         {right - w - 8, bottom - h - 8}}};
  std::array<double, 2> best = corners[0];
  int fewest = std::numeric_limits<int>::max();
  for (const auto& corner : corners) {
    int inside = 0;
    for (const PlotSeries& s : plot.series) {
      for (std::size_t i = 0; i < s.x.size(); ++i) {
        if (!can_stand(s.x[i], s.y[i], x)) continue;
        const double px = x.at(s.x[i]) - corner[0];
        const double py = y.at(s.y[i]) - corner[1];
        if (px > -8 && px < w + 8 && py > -8 && py < h + 8) ++inside;
      }
    }
    if (inside < fewest) best = corner;
    fewest = std::min(fewest, inside);
  }
  std::string out = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"4\" fill=\"#fff\" "
      "fill-opacity=\"0.88\" stroke=\"#ccc\"/>\n",
      best[0], best[1], w, h);
  double row = best[1] + 17;
  for (const PlotSeries* s : shown) {
    const double mid = best[0] + 20;
    if (s->line) {
      out += line_between(mid - 13, row - 4, mid + 13, row - 4,
                          fmt::format("stroke=\"{}\" stroke-width=\"2\"{}", colour_of(s->colour),
                                      s->dashed ? " stroke-dasharray=\"6 4\"" : ""));
    }
    if (s->markers) out += marker(mid, row - 4, *s, "");
    out += text_at(best[0] + 39, row, s->label);
    row += 19;
  }
  return out;
}

std::string heading(const std::string& title, const std::string& subtitle) {
  return text_at(left, 26, title, "font-size=\"16\" font-weight=\"bold\"") +
         text_at(left, 48, subtitle, "fill=\"#555\"");
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) out += c;
    }
  }
  return out;
}

namespace {

std::string plot_of(const Plot& plot, bool even) {
  std::string out = start_of(width, height) + heading(plot.title, plot.subtitle);
  Axis x{.even = even};
  Axis y{.even = even};
  if (!axes_of(plot, x, y)) {
    return out + text_at(left, (top + bottom) / 2, "There is nothing to show.") + "</svg>\n";
  }
  out += frame_of(plot, x, y);
  for (const PlotSeries& s : plot.series) out += drawn(s, x, y);
  return out + legend(plot, x, y) + "</svg>\n";
}

}  // namespace

std::string log_plot(const Plot& plot) { return plot_of(plot, false); }

std::string even_plot(const Plot& plot) { return plot_of(plot, true); }

namespace {

/// One bar about the zero line of its panel.
std::string bar(double value, double largest, double x0, double half, double y) {
  if (!std::isfinite(value)) return text_at(x0, y + 13, "not known", "text-anchor=\"middle\"");
  const double length = largest > 0 ? half * std::abs(value) / largest : 0;
  const double x = value < 0 ? x0 - length : x0;
  std::string out = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"18\" rx=\"2\" fill=\"{}\"/>\n", x,
      y, length, colour_of(value < 0 ? 0 : 1));
  const std::string anchor = value < 0 ? "text-anchor=\"end\"" : "text-anchor=\"start\"";
  const double end = value < 0 ? x0 - length - 6 : x0 + length + 6;
  return out + text_at(end, y + 13, fmt::format("{:+.3g} %", 100 * value), anchor);
}

}  // namespace

std::string bar_plot(const std::string& title, const std::vector<std::string>& columns,
                     const std::vector<BarRow>& rows) {
  const double h = 84 + 48 * static_cast<double>(rows.size());
  std::string out =
      start_of(width, h) + text_at(24, 28, title, "font-size=\"16\" font-weight=\"bold\"");
  const double panel = (width - 48) / static_cast<double>(std::max<std::size_t>(columns.size(), 1));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const double x0 = 24 + panel * (static_cast<double>(c) + 0.5);
    double largest = 0;
    for (const BarRow& row : rows) {
      if (std::isfinite(row.values[c])) largest = std::max(largest, std::abs(row.values[c]));
    }
    out += text_at(x0, 58, columns[c], "text-anchor=\"middle\" fill=\"#555\"");
    double y = 92;
    for (const BarRow& row : rows) {
      out += bar(row.values[c], largest, x0, panel / 2 - 78, y);
      out += line_between(x0, y - 5, x0, y + 23, "stroke=\"#888\"");
      y += 48;
    }
  }
  double y = 86;
  for (const BarRow& row : rows) {
    out += text_at(24, y, row.label, "font-weight=\"bold\" font-size=\"12\"");
    y += 48;
  }
  return out + "</svg>\n";
}

}  // namespace gannet
