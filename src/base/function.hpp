// Numbers that a case gives as functions of time and place: constants, formulas, tables. Formulas
// are read by the room input; all others see a function object.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/math.hpp"
#include "base/time_table.hpp"

namespace gannet {

/// One number as a function of time t [s] and place x [m], in SI. Any number of threads may
/// ask it at the same time.
struct Function {
  std::string text = "0";  ///< as a case would give it
  double factor = 0;       ///< of a constant: its value; of a table: multiplies it
  TimeTable table;         ///< where it has points
  std::function<double(double t, const Vec3& x)> formula;
  bool of_place = false;  ///< the formula asks for x, y or z

  Function() = default;
  explicit Function(double constant);
  explicit Function(TimeTable points, double times = 1);
  [[nodiscard]] bool constant() const { return !formula && table.t.empty(); }
  /// The same constant, or the same text.
  friend bool operator==(const Function& a, const Function& b) {
    return a.constant() && b.constant() ? a.factor == b.factor : a.text == b.text;
  }
};

/// The function at time t [s] and place x [m].
double value_at(const Function& f, double t, const Vec3& x = Vec3::Zero());

/// Mean over [from, to], from < to [s]: of a table exact, of a formula by three Gauss points, so
/// exact for polynomials up to the fifth power. A velocity that is this mean over each step moves
/// its node along the integral of the function.
double mean_over(const Function& f, double from, double to);

/// a(t, x) b(t, x).
Function product(const Function& a, const Function& b);

/// Three functions as the components of a vector.
struct VectorFunction {
  std::array<Function, 3> component;

  VectorFunction() = default;
  VectorFunction(const Vec3& constant);  // NOLINT: a vector is a function that does not change
  VectorFunction(double x, double y, double z) : VectorFunction(Vec3(x, y, z)) {}
  [[nodiscard]] bool constant() const;
};

/// The vector at time t [s] and place x [m].
Vec3 value_at(const VectorFunction& f, double t, const Vec3& x = Vec3::Zero());

/// Makes of a formula's text a function of the numbers that are named, given in that order; names
/// under `let` and curves keep their meaning. Throws std::invalid_argument that says what was not
/// understood and lists the names.
using FormulaMaker =
    std::function<std::function<double(const double*)>(const std::vector<std::string>& names)>;

}  // namespace gannet
