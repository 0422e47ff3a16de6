// Units as a person writes them: "6 m/s", "2.5 mm", "70 GPa", "20 ms", "25 deg". Inside, all is SI.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace gannet {

/// Exponents of m, kg, s, K and rad. Angle is kept apart so that a message can say "an angle".
struct Dimension {
  std::array<int, 5> power{};
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);

namespace dim {
inline constexpr Dimension none{};
inline constexpr Dimension length{{1, 0, 0, 0, 0}};
inline constexpr Dimension area{{2, 0, 0, 0, 0}};
inline constexpr Dimension mass{{0, 1, 0, 0, 0}};
inline constexpr Dimension time{{0, 0, 1, 0, 0}};
inline constexpr Dimension temperature{{0, 0, 0, 1, 0}};
inline constexpr Dimension angle{{0, 0, 0, 0, 1}};
inline constexpr Dimension velocity{{1, 0, -1, 0, 0}};
inline constexpr Dimension acceleration{{1, 0, -2, 0, 0}};
inline constexpr Dimension angular_velocity{{0, 0, -1, 0, 1}};
inline constexpr Dimension force{{1, 1, -2, 0, 0}};
inline constexpr Dimension moment{{2, 1, -2, 0, 0}};
inline constexpr Dimension pressure{{-1, 1, -2, 0, 0}};
inline constexpr Dimension density{{-3, 1, 0, 0, 0}};
inline constexpr Dimension energy{{2, 1, -2, 0, 0}};
inline constexpr Dimension frequency{{0, 0, -1, 0, 0}};
inline constexpr Dimension inertia{{2, 1, 0, 0, 0}};
inline constexpr Dimension kinematic_viscosity{{2, 0, -1, 0, 0}};
inline constexpr Dimension dynamic_viscosity{{-1, 1, -1, 0, 0}};
}  // namespace dim

/// A number with its dimension, in SI.
struct Quantity {
  double value = 0;
  Dimension dimension;
  bool bare = false;  ///< written without a unit
};

/// Reads "6 m/s" into {6, velocity}; a bare number is SI of whatever is wanted. A leading "every"
/// and a closing "of wall time" are allowed, so that "every 5 min of wall time" reads well.
/// Units: SI with prefixes, engineering units (ft, in, lb, psi, bar, kn, rpm, deg, %), with
/// products, quotients, brackets and whole powers: "kg/m^3", "N*m", "W/(m*K)", "1/s".
/// Throws std::invalid_argument that says what was not understood ("unknown unit 'mss'").
Quantity parse_quantity(std::string_view text);

/// The name of a dimension, for messages: "length"; "quantity in kg/s^3" where it has no name.
std::string name_of(const Dimension& dimension);
/// The SI unit, readable by parse_quantity: "m", "Pa", "kg/m^3"; "-" for plain numbers.
std::string si_unit_of(const Dimension& dimension);
/// Units one may write it in: "m, mm, ft".
std::string example_units_of(const Dimension& dimension);
/// "a length is wanted (m, mm, ft, ...)"
std::string wanted_text(const Dimension& wanted);
/// "a time", "an angle"
std::string with_article(const std::string& name);

}  // namespace gannet
