#include "output/picture_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gannet {

Rgb colour_at(double t) {
  static constexpr std::array<Rgb, 9> table{{{0x44, 0x01, 0x54},
                                             {0x47, 0x2d, 0x7b},
                                             {0x3b, 0x52, 0x8b},
                                             {0x2c, 0x72, 0x8e},
                                             {0x21, 0x90, 0x8c},
                                             {0x27, 0xad, 0x81},
                                             {0x5d, 0xc8, 0x63},
                                             {0xaa, 0xdc, 0x32},
                                             {0xfd, 0xe7, 0x25}}};
  constexpr int n_pieces = static_cast<int>(table.size()) - 1;
  constexpr double left_out = 0.2;
  const double along = left_out + (1 - left_out) * (std::isnan(t) ? 0 : std::clamp(t, 0.0, 1.0));
  const double s = along * n_pieces;
  const int piece = std::min(static_cast<int>(s), n_pieces - 1);
  return mix(table[static_cast<std::size_t>(piece)], table[static_cast<std::size_t>(piece) + 1],
             s - piece);
}

Span trimmed_span(std::vector<double> values, double tail) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return {};
  const auto last = static_cast<double>(values.size() - 1);
  const auto value_at = [&](double place) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  const double low = value_at(std::floor(tail * last));
  return {low, value_at(std::ceil((1 - tail) * last))};
}

int Ticks::count() const {
  return static_cast<int>(std::lround((span.high - span.low) / step)) + 1;
}

Ticks ticks_of(Span span) {
  const double largest = std::max(std::abs(span.low), std::abs(span.high));
  if (span.high - span.low <= 1e-9 * largest || largest == 0) {
    // Without a spread the colours mean nothing; the one value stands in the lowest piece.
    span.high = span.low + (largest == 0 ? 1 : 1e-6 * largest);
  }
  // Speeds and the like begin at 0, where that costs little of the colours.
  if (span.low > 0 && span.low < 0.2 * span.high) span.low = 0;
  const double raw = (span.high - span.low) / 5;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double digit = raw / power;
  Ticks ticks;
  ticks.step = power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
  ticks.span.low = ticks.step * std::floor(span.low / ticks.step + 1e-9);
  ticks.span.high = ticks.step * std::ceil(span.high / ticks.step - 1e-9);
  return ticks;
}

ShownUnit shown_unit(const std::string& si_unit, Span span) {
  const double largest = std::max(std::abs(span.low), std::abs(span.high));
  static constexpr std::array<std::pair<const char*, double>, 6> prefixes{
      {{"G", 1e9}, {"M", 1e6}, {"k", 1e3}, {"", 1.0}, {"m", 1e-3}, {"u", 1e-6}}};
  const bool takes_prefix = si_unit == "Pa" || si_unit == "N" || si_unit == "m" || si_unit == "s";
  if (!takes_prefix || largest == 0) return {si_unit, 1};
  for (const auto& [prefix, factor] : prefixes) {
    // km says less than m in a scene of metres.
    if (factor > 1 && (si_unit == "m" || si_unit == "s")) continue;
    if (largest >= factor * (1 - 1e-9)) return {prefix + si_unit, factor};
  }
  return {"u" + si_unit, 1e-6};
}

}  // namespace gannet
