#include "output/schedule.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "base/units.hpp"

namespace gannet {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

double parse_time(std::string_view text, const std::string& whole) {
  const std::string allowed = "; allowed: 'every 0.25 ms', 'never'";
  Quantity q;
  try {
    q = parse_quantity(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("'" + whole + "': " + error.what() + allowed);
  }
  if (!q.bare && q.dimension != dim::time) {
    throw std::invalid_argument("'" + whole + "' is " + name_of(q.dimension) +
                                ", a time is wanted" + allowed);
  }
  if (!(q.value > 0) || !std::isfinite(q.value)) {
    throw std::invalid_argument("'" + whole + "' must be above 0" + allowed);
  }
  return q.value;
}

}  // namespace

double intervals_until(double interval, double t) {
  if (t < 0) return -1;
  double k = std::floor(t / interval);
  // The quotient is rounded; the products decide, because they are the due times.
  while ((k + 1) * interval <= t) ++k;
  while (k * interval > t) --k;
  return k;
}

bool due(const Every& every, double last, double t) {
  if (!(every.interval > 0) || !(t >= 0)) return false;
  return intervals_until(every.interval, t) > intervals_until(every.interval, last);
}

Every parse_every(const std::string& text) {
  std::string_view rest = trimmed(text);
  if (rest == "never") return {};
  if (rest.starts_with("every ")) rest = trimmed(rest.substr(6));
  return {parse_time(rest, text)};
}

CheckpointEvery parse_checkpoint_every(const std::string& text) {
  constexpr std::string_view wall = " of wall time";
  std::string_view rest = trimmed(text);
  if (!rest.ends_with(wall)) return {parse_every(text).interval, 0};
  rest = trimmed(rest.substr(0, rest.size() - wall.size()));
  if (rest.starts_with("every ")) rest = trimmed(rest.substr(6));
  return {0, parse_time(rest, text)};
}

}  // namespace gannet
