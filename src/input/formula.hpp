// Names that a case defines under `let`, and the formulas that use them: "V*pi/(2*tan(beta))".
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/time_table.hpp"
#include "base/units.hpp"

namespace gannet {

/// A text that was meant as a formula and cannot be worked out. An empty message: the fault is that
/// of a name under let, noted there already.
class FormulaError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A table in time under `curves`; in formulas a function of one argument.
struct Curve {
  TimeTable table;
  Dimension dimension;
  bool bare = true;  ///< no value has a unit
};

/// The names under `let` and `curves` and what they stand for.
class Formulas {
 public:
  /// Adds a name. Throws std::invalid_argument where it cannot stand in a formula: not a word of
  /// letters, digits and '_', or the name of a function or of pi.
  void define(const std::string& name, const Quantity& value);
  /// Adds a name whose value could not be read; formulas that use it fail with an empty message.
  void define_broken(const std::string& name);

  /// Reads a quantity ("6 m/s"), or works out a formula of names, numbers, pi and the usual
  /// functions; names count in SI, angles in rad. A formula's result is bare, except that a lone
  /// name or its negative keeps its dimension.
  /// Throws FormulaError, or std::invalid_argument where the text is no formula either; both say
  /// what was not understood, with the text in quotes.
  [[nodiscard]] Quantity read(const std::string& text) const;

  /// Adds a curve. Throws std::invalid_argument where its name means something already.
  void define_curve(const std::string& name, const Curve& curve);
  /// The curve of that name, or nullptr.
  [[nodiscard]] std::shared_ptr<const Curve> curve(const std::string& name) const;

  /// Those of `variables` that stand in a text as names, or "" as one more where a curve does.
  [[nodiscard]] std::vector<std::string> variables_in(
      const std::string& text, const std::vector<std::string>& variables) const;
  /// The formula as a function of the variables' values, in their order [SI]. The function lives as
  /// long as it is kept; each thread that asks it has storage of its own.
  /// Throws FormulaError as read() does, and where a variable is also a name under let.
  [[nodiscard]] std::function<double(const double*)> compile(
      const std::string& text, const std::vector<std::string>& variables) const;

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  [[nodiscard]] double evaluate(const std::string& text) const;
  void check_names(const std::string& text, const std::vector<std::string>& variables) const;
  void check_name(const std::string& text, const std::string& name, bool called,
                  const std::vector<std::string>& variables) const;
  std::vector<std::string> names_;
  std::map<std::string, Quantity> values_;
  std::map<std::string, std::shared_ptr<const Curve>> curves_;
};

}  // namespace gannet
