#include "base/units.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <system_error>

namespace gannet {

namespace {

constexpr double pi = std::numbers::pi;
constexpr Dimension volume{{3, 0, 0, 0, 0}};
constexpr Dimension power{{2, 1, -3, 0, 0}};
constexpr Dimension stiffness{{0, 1, -2, 0, 0}};

/// A unit as SI: times / divided_by. Two whole numbers rather than one fraction, so that 9 mm
/// becomes 9/1000, correctly rounded, and not 9*0.001 = 0.009000000000000001.
struct Unit {
  double times = 1;
  double divided_by = 1;
  Dimension dimension{};
};

struct NamedUnit {
  std::string_view name;
  Unit unit;
  bool takes_prefix;
};

constexpr NamedUnit named_units[] = {
    {"m", {1, 1, dim::length}, true},
    {"g", {1, 1000, dim::mass}, true},
    {"s", {1, 1, dim::time}, true},
    {"K", {1, 1, dim::temperature}, true},
    {"rad", {1, 1, dim::angle}, true},
    {"N", {1, 1, dim::force}, true},
    {"Nm", {1, 1, dim::moment}, true},
    {"Pa", {1, 1, dim::pressure}, true},
    {"bar", {1e5, 1, dim::pressure}, true},
    {"J", {1, 1, dim::energy}, true},
    {"W", {1, 1, power}, true},
    {"Hz", {1, 1, dim::frequency}, true},
    {"L", {1, 1000, volume}, true},
    {"l", {1, 1000, volume}, true},
    {"min", {60, 1, dim::time}, false},
    {"h", {3600, 1, dim::time}, false},
    {"t", {1000, 1, dim::mass}, false},
    {"ft", {3048, 10000, dim::length}, false},
    {"in", {254, 10000, dim::length}, false},
    {"mi", {1609344, 1000, dim::length}, false},
    {"nmi", {1852, 1, dim::length}, false},
    {"lb", {45359237, 1e8, dim::mass}, false},
    {"psi", {6894.757293168361, 1, dim::pressure}, false},
    {"kn", {1852, 3600, dim::velocity}, false},
    {"deg", {pi, 180, dim::angle}, false},
    {"rpm", {pi, 30, dim::angular_velocity}, false},
    {"%", {1, 100, dim::none}, false},
    {"-", {1, 1, dim::none}, false},
    {"1", {1, 1, dim::none}, false},
};

struct Prefix {
  char letter;
  double times;
  double divided_by;
};

constexpr Prefix prefixes[] = {{'n', 1, 1e9}, {'u', 1, 1e6}, {'m', 1, 1e3}, {'c', 1, 1e2},
                               {'d', 1, 10},  {'h', 1e2, 1}, {'k', 1e3, 1}, {'M', 1e6, 1},
                               {'G', 1e9, 1}, {'T', 1e12, 1}};

struct NamedDimension {
  Dimension dimension;
  std::string_view name;
  std::string_view si_unit;
  std::string_view examples;
};

constexpr NamedDimension named_dimensions[] = {
    {dim::none, "plain number", "-", "0.5, 2 %"},
    {dim::length, "length", "m", "m, mm, ft"},
    {dim::area, "area", "m^2", "m^2, mm^2"},
    {volume, "volume", "m^3", "m^3, L"},
    {dim::mass, "mass", "kg", "kg, g, t"},
    {dim::time, "time", "s", "s, ms, us"},
    {dim::temperature, "temperature", "K", "K"},
    {dim::angle, "angle", "rad", "deg, rad"},
    {dim::velocity, "velocity", "m/s", "m/s, km/h, kn"},
    {dim::acceleration, "acceleration", "m/s^2", "m/s^2"},
    {dim::angular_velocity, "angular velocity", "rad/s", "rad/s, deg/s, rpm"},
    {dim::force, "force", "N", "N, kN, MN"},
    {dim::energy, "energy or moment", "N*m", "J, kJ, N*m"},
    {dim::pressure, "pressure", "Pa", "Pa, MPa, bar"},
    {dim::density, "density", "kg/m^3", "kg/m^3, g/cm^3"},
    {dim::frequency, "frequency or rate", "1/s", "Hz, 1/s"},
    {dim::inertia, "moment of inertia", "kg*m^2", "kg*m^2, t*m^2"},
    {dim::kinematic_viscosity, "kinematic viscosity", "m^2/s", "m^2/s, mm^2/s"},
    {dim::dynamic_viscosity, "dynamic viscosity", "Pa*s", "Pa*s, mPa*s"},
    {stiffness, "stiffness", "N/m", "N/m, kN/mm"},
    {power, "power", "W", "W, kW"},
};

const NamedDimension* find_name(const Dimension& dimension) {
  for (const NamedDimension& d : named_dimensions) {
    if (d.dimension == dimension) return &d;
  }
  return nullptr;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Unit signs that are no ASCII, as ASCII: µ, °, ², ³ and the middle dot.
std::string plain_letters(std::string_view text) {
  std::string plain(text);
  replace_all(plain, "\u00b5", "u");
  replace_all(plain, "\u03bc", "u");
  replace_all(plain, "\u00b0", "deg");
  replace_all(plain, "\u00b2", "^2");
  replace_all(plain, "\u00b3", "^3");
  replace_all(plain, "\u00b7", "*");
  return plain;
}

bool find_unit(std::string_view name, Unit& unit) {
  for (const NamedUnit& u : named_units) {
    if (u.name == name) return unit = u.unit, true;
  }
  if (name.size() < 2) return false;
  for (const Prefix& p : prefixes) {
    if (p.letter != name.front()) continue;
    for (const NamedUnit& u : named_units) {
      if (!u.takes_prefix || u.name != name.substr(1)) continue;
      unit = {u.unit.times * p.times, u.unit.divided_by * p.divided_by, u.unit.dimension};
      return true;
    }
  }
  return false;
}

Unit product(const Unit& a, const Unit& b) {
  return {a.times * b.times, a.divided_by * b.divided_by, a.dimension * b.dimension};
}

Unit inverse(const Unit& a) { return {a.divided_by, a.times, dim::none / a.dimension}; }

/// Reads "kg*m^2/s": factors from left to right, brackets, whole powers.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : text_(text) {}

  Unit read() {
    const Unit unit = read_product(0);
    if (at_ < text_.size()) fail();
    return unit;
  }

 private:
  static constexpr int deepest = 8;

  Unit read_product(int depth) {
    if (depth > deepest) fail();
    Unit unit = read_factor(depth);
    while (next_is('*') || next_is('/')) {
      const bool divide = text_[at_++] == '/';
      const Unit factor = read_factor(depth);
      unit = product(unit, divide ? inverse(factor) : factor);
    }
    return unit;
  }

  Unit read_factor(int depth) {
    Unit unit;
    if (next_is('(')) {
      ++at_;
      unit = read_product(depth + 1);
      if (!next_is(')')) fail();
      ++at_;
    } else {
      unit = read_name();
    }
    return next_is('^') ? raised(unit, read_power()) : unit;
  }

  Unit read_name() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view("*/^() \t").find(text_[at_]) == text_.npos) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    Unit unit;
    if (name.empty()) fail();
    if (!find_unit(name, unit)) throw std::invalid_argument(fmt::format("unknown unit '{}'", name));
    return unit;
  }

  int read_power() {
    ++at_;
    int power_read = 0;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + at_, end, power_read);
    if (error != std::errc() || std::abs(power_read) > 9) fail();
    at_ = static_cast<std::size_t>(stop - text_.data());
    return power_read;
  }

  static Unit raised(const Unit& unit, int exponent) {
    Unit result;
    for (int k = 0; k < std::abs(exponent); ++k) result = product(result, unit);
    return exponent < 0 ? inverse(result) : result;
  }

  bool next_is(char c) {
    skip_space();
    return at_ < text_.size() && text_[at_] == c;
  }
  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  [[noreturn]] void fail() const {
    throw std::invalid_argument(fmt::format("unknown unit '{}'", text_));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

double in_si(double value, const Unit& unit) {
  if (unit.times >= unit.divided_by) return value * (unit.times / unit.divided_by);
  if (unit.times == 1) return value / unit.divided_by;
  return value * unit.times / unit.divided_by;
}

/// Splits "6 m/s" into the number and the text behind it. Throws std::invalid_argument.
double read_number(std::string_view text, std::string_view& rest) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const std::size_t digit = text.find_first_not_of("-.");
  const bool numeric = digit <= 2 && text[digit] >= '0' && text[digit] <= '9';
  if (!numeric) throw std::invalid_argument("not a number");
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) throw std::invalid_argument("out of reach");
  if (error != std::errc()) throw std::invalid_argument("not a number");
  rest = trimmed(text.substr(static_cast<std::size_t>(stop - text.data())));
  return value;
}

std::string join_powers(const Dimension& dimension) {
  constexpr std::string_view base[] = {"m", "kg", "s", "K", "rad"};
  std::string above;
  std::string below;
  for (std::size_t k = 0; k < dimension.power.size(); ++k) {
    const int p = dimension.power[k];
    if (p == 0) continue;
    std::string& side = p > 0 ? above : below;
    if (!side.empty() && p > 0) side += '*';
    if (p < 0) side += '/';
    side += base[k];
    if (std::abs(p) > 1) side += fmt::format("^{}", std::abs(p));
  }
  return (above.empty() ? "1" : above) + below;
}

}  // namespace

Dimension operator*(const Dimension& a, const Dimension& b) {
  Dimension c;
  for (std::size_t k = 0; k < c.power.size(); ++k) c.power[k] = a.power[k] + b.power[k];
  return c;
}

Dimension operator/(const Dimension& a, const Dimension& b) {
  Dimension c;
  for (std::size_t k = 0; k < c.power.size(); ++k) c.power[k] = a.power[k] - b.power[k];
  return c;
}

Quantity parse_quantity(std::string_view text) {
  constexpr std::string_view every = "every ";
  constexpr std::string_view of_wall_time = " of wall time";
  text = trimmed(text);
  if (text.starts_with(every)) text = trimmed(text.substr(every.size()));
  if (text.ends_with(of_wall_time)) text.remove_suffix(of_wall_time.size());
  std::string_view rest;
  const double value = read_number(text, rest);
  if (rest.empty()) return {value, dim::none, true};
  const std::string plain = plain_letters(rest);
  const Unit unit = UnitReader(plain).read();
  const double si = in_si(value, unit);
  if (!std::isfinite(si)) throw std::invalid_argument("out of reach");
  return {si, unit.dimension, false};
}

std::string name_of(const Dimension& dimension) {
  if (const NamedDimension* d = find_name(dimension)) return std::string(d->name);
  return "quantity in " + join_powers(dimension);
}

std::string si_unit_of(const Dimension& dimension) {
  if (const NamedDimension* d = find_name(dimension)) return std::string(d->si_unit);
  return join_powers(dimension);
}

std::string example_units_of(const Dimension& dimension) {
  if (const NamedDimension* d = find_name(dimension)) return std::string(d->examples);
  return join_powers(dimension);
}

std::string with_article(const std::string& name) {
  const bool vowel = !name.empty() && std::string_view("aeiou").find(name[0]) != name.npos;
  return (vowel ? "an " : "a ") + name;
}

std::string wanted_text(const Dimension& wanted) {
  return fmt::format("{} is wanted ({}, ...)", with_article(name_of(wanted)),
                     example_units_of(wanted));
}

}  // namespace gannet
