#include "input/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string_view>

#include "input/nearest.hpp"

namespace gannet {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_word(const std::string& text) {
  return !text.empty() && is_letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    const mu::Parser parser;
    for (const auto& entry : parser.GetFunDef()) list.push_back(entry.first);
    return list;
  }();
  return names;
}

bool is_function(const std::string& name) {
  const auto& all = function_names();
  return std::find(all.begin(), all.end(), name) != all.end();
}

std::string without_spaces(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c != ' ' && c != '\t') result += c;
  }
  return result;
}

/// Behind a number in a formula: "2.5e-3*dx" -> at '*'.
std::size_t skip_number(const std::string& text, std::size_t at) {
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) ++at;
  if (at >= text.size() || (text[at] != 'e' && text[at] != 'E')) return at;
  std::size_t power = at + 1;
  if (power < text.size() && (text[power] == '+' || text[power] == '-')) ++power;
  if (power >= text.size() || !is_digit(text[power])) return at;
  while (power < text.size() && is_digit(text[power])) ++power;
  return power;
}

/// True where a text was meant as a formula: an operator follows the number it starts with, or it
/// starts with none and has an operator or bracket.
bool meant_as_formula(const std::string& text) {
  const std::string t = without_spaces(text);
  constexpr std::string_view operators = "+-*/^()";
  const std::size_t sign = !t.empty() && (t[0] == '-' || t[0] == '+') ? 1 : 0;
  if (sign >= t.size() || !is_digit(t[sign])) return t.find_first_of(operators) != t.npos;
  const std::size_t behind = skip_number(t, sign);
  return behind < t.size() && operators.find(t[behind]) != operators.npos;
}

}  // namespace

void Formulas::define(const std::string& name, const Quantity& value) {
  if (!is_word(name)) {
    throw std::invalid_argument(
        "a name for formulas has letters, digits and '_' only, a letter first");
  }
  if (name == "pi" || is_function(name)) {
    throw std::invalid_argument(
        fmt::format("'{}' means something in formulas already; choose another name", name));
  }
  if (!has(name)) names_.push_back(name);
  values_[name] = value;
}

void Formulas::define_broken(const std::string& name) {
  if (!has(name) && is_word(name)) names_.push_back(name);
  values_.erase(name);
}

void Formulas::define_curve(const std::string& name, const Curve& curve) {
  if (!is_word(name)) {
    throw std::invalid_argument(
        "the name of a curve has letters, digits and '_' only, a letter "
        "first");
  }
  if (name == "pi" || is_function(name) || has(name)) {
    throw std::invalid_argument(
        fmt::format("'{}' means something in formulas already; choose another name", name));
  }
  curves_[name] = std::make_shared<const Curve>(curve);
}

std::shared_ptr<const Curve> Formulas::curve(const std::string& name) const {
  const auto it = curves_.find(name);
  return it == curves_.end() ? nullptr : it->second;
}

void Formulas::check_name(const std::string& text, const std::string& name, bool called,
                          const std::vector<std::string>& variables) const {
  if (called && curve(name) != nullptr) return;
  if (called && !is_function(name)) {
    std::vector<std::string> known = function_names();
    for (const auto& entry : curves_) known.push_back(entry.first);
    throw FormulaError(
        fmt::format("'{}': unknown function '{}'{}", text, name, did_you_mean(name, known)));
  }
  const bool variable = std::find(variables.begin(), variables.end(), name) != variables.end();
  if (variable && has(name)) {
    throw FormulaError(
        fmt::format("'{}': '{}' is a variable here and a name under let; give that "
                    "another name",
                    text, name));
  }
  if (called || variable || name == "pi" || values_.count(name) > 0) return;
  if (has(name)) throw FormulaError("");
  if (curve(name) != nullptr) {
    throw FormulaError(fmt::format("'{0}': the curve '{1}' wants a time: {1}(t)", text, name));
  }
  std::vector<std::string> known = variables;
  known.insert(known.end(), names_.begin(), names_.end());
  const std::string also = variables.empty() ? "" : "variables: " + comma_list(variables) + "; ";
  throw FormulaError(fmt::format("'{}': unknown name '{}'{} ({}names under let: {})", text, name,
                                 did_you_mean(name, known), also, comma_list(names_)));
}

namespace {

/// Calls f(name, called) for each name in a text.
template <class F>
void for_names(const std::string& text, F&& f) {
  for (std::size_t at = 0; at < text.size();) {
    if (is_digit(text[at]) || text[at] == '.') {
      at = std::max(skip_number(text, at), at + 1);
      continue;
    }
    if (!is_letter(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    const std::size_t next = text.find_first_not_of(" \t", end);
    f(text.substr(at, end - at), next != std::string::npos && text[next] == '(');
    at = end;
  }
}

double value_of_curve(void* curve, double t) {
  return value_at(static_cast<const Curve*>(curve)->table, t);
}

}  // namespace

void Formulas::check_names(const std::string& text,
                           const std::vector<std::string>& variables) const {
  for_names(text, [&](const std::string& name, bool called) {
    check_name(text, name, called, variables);
  });
}

std::vector<std::string> Formulas::variables_in(const std::string& text,
                                                const std::vector<std::string>& variables) const {
  std::vector<std::string> found;
  for_names(text, [&](const std::string& name, bool called) {
    const bool known =
        !called && std::find(variables.begin(), variables.end(), name) != variables.end();
    if (known) found.push_back(name);
    if (curve(name) != nullptr) found.emplace_back();
  });
  return found;
}

namespace {

/// A formula ready to be worked out, with storage of its own.
struct Compiled {
  mu::Parser parser;
  std::vector<double> values;  ///< of the variables
};

/// All that a formula is made of.
struct Recipe {
  std::string text;
  std::vector<std::string> variables;
  std::map<std::string, Quantity> constants;
  std::map<std::string, std::shared_ptr<const Curve>> curves;
};

/// Throws mu::ParserError where the text is no formula.
std::unique_ptr<Compiled> made_from(const Recipe& recipe) {
  auto made = std::make_unique<Compiled>();
  made->values.assign(recipe.variables.size(), 0);
  mu::Parser& parser = made->parser;
  parser.ClearConst();
  parser.DefineConst("pi", std::numbers::pi);
  for (const auto& [name, value] : recipe.constants) parser.DefineConst(name, value.value);
  for (const auto& [name, curve] : recipe.curves) {
    parser.DefineFunUserData(name, value_of_curve, const_cast<Curve*>(curve.get()), false);
  }
  for (std::size_t k = 0; k < recipe.variables.size(); ++k) {
    parser.DefineVar(recipe.variables[k], &made->values[k]);
  }
  parser.SetExpr(recipe.text);
  return made;
}

}  // namespace

std::function<double(const double*)> Formulas::compile(
    const std::string& text, const std::vector<std::string>& variables) const {
  struct Shared {
    Recipe recipe;
    tbb::enumerable_thread_specific<std::unique_ptr<Compiled>> of_thread{};
  };
  check_names(text, variables);
  const auto shared = std::make_shared<Shared>(Recipe{text, variables, values_, curves_});
  int n_results = 0;
  try {
    std::unique_ptr<Compiled>& first = shared->of_thread.local();
    first = made_from(shared->recipe);
    first->parser.Eval(n_results);
  } catch (const mu::ParserError& error) {
    std::string what = error.GetMsg();
    while (!what.empty() && (what.back() == '.' || what.back() == ' ')) what.pop_back();
    throw FormulaError(fmt::format("'{}' cannot be worked out: {}", text, what));
  }
  if (n_results != 1) throw FormulaError(fmt::format("'{}' has a comma; write one number", text));
  return [shared](const double* values) {
    std::unique_ptr<Compiled>& mine = shared->of_thread.local();
    if (mine == nullptr) mine = made_from(shared->recipe);
    std::copy(values, values + mine->values.size(), mine->values.begin());
    return mine->parser.Eval();
  };
}

double Formulas::evaluate(const std::string& text) const { return compile(text, {})(nullptr); }

Quantity Formulas::read(const std::string& text) const {
  std::string why_no_quantity;
  try {
    return parse_quantity(text);
  } catch (const std::invalid_argument& error) {
    why_no_quantity = error.what();
  }
  const std::string t = without_spaces(text);
  const bool negative = !t.empty() && t[0] == '-';
  const std::string lone = negative ? t.substr(1) : t;
  if (const auto it = values_.find(lone); it != values_.end()) {
    Quantity q = it->second;
    if (negative) q.value = -q.value;
    return q;
  }
  if (lone != "pi" && !has(lone) && !meant_as_formula(text)) {
    const char* between = why_no_quantity == "not a number" ? " is " : ": ";
    throw std::invalid_argument(fmt::format("'{}'{}{}", text, between, why_no_quantity));
  }
  const double value = evaluate(text);
  if (!std::isfinite(value)) {
    throw FormulaError(fmt::format("'{}' gives {}, not a finite number", text, value));
  }
  return {value, dim::none, true};
}

bool Formulas::has(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

}  // namespace gannet
