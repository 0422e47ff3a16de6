#include "input/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "input/language.hpp"
#include "input/nearest.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;
using Form = TextNode::Form;

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A number of a table; nothing and a mistake where it is none or has another dimension.
std::optional<Quantity> table_number(const TextNode& node, const std::string& path,
                                     const Dimension* wanted, CheckContext& context) {
  const std::string want = wanted == nullptr ? "a number is wanted" : wanted_text(*wanted);
  if (node.form != Form::scalar) {
    context.complain(node.where, path, "a single number is wanted; " + want);
    return std::nullopt;
  }
  try {
    const Quantity q = context.formulas.read(node.text);
    if (wanted == nullptr || q.bare || q.dimension == *wanted) return q;
    context.complain(
        node.where, path,
        fmt::format("'{}' is {}; {}", node.text, with_article(name_of(q.dimension)), want));
  } catch (const std::invalid_argument& error) {
    const std::string why = error.what();
    if (!why.empty()) context.complain(node.where, path, why + "; " + want);
  }
  return std::nullopt;
}

/// One pair [time, value] more; false after a mistake.
bool add_pair(const TextNode& pair, const std::string& path, const Dimension* wanted, Curve& curve,
              CheckContext& context) {
  if (pair.form != Form::list || pair.items.size() != 2) {
    context.complain(pair.where, path,
                     "a table is a list of pairs: [[time, value], [time, value], ...]");
    return false;
  }
  const auto t = table_number(pair.items[0], path, &dim::time, context);
  // The first unit of a table of any dimension is that of all.
  const Dimension* known = wanted == nullptr && !curve.bare ? &curve.dimension : wanted;
  const auto y = table_number(pair.items[1], path, known, context);
  if (!t || !y) return false;
  std::vector<double>& times = curve.table.t;
  if (!times.empty() && t->value <= times.back()) {
    context.complain(pair.items[0].where, path,
                     fmt::format("times must rise: {} s comes after {} s", t->value, times.back()));
    return false;
  }
  times.push_back(t->value);
  curve.table.y.push_back(y->value);
  if (!y->bare) {
    curve.dimension = y->dimension;
    curve.bare = false;
  }
  return true;
}

std::optional<Curve> read_pairs(const TextNode& list, const std::string& path,
                                const Dimension* wanted, CheckContext& context) {
  Curve curve;
  if (list.form != Form::list || list.items.empty()) {
    context.complain(list.where, path,
                     "a table is a list of pairs: [[time, value], [time, value], ...]");
    return std::nullopt;
  }
  for (const TextNode& pair : list.items) {
    if (!add_pair(pair, path, wanted, curve, context)) return std::nullopt;
  }
  return curve;
}

std::optional<Curve> read_csv(const TextNode& map, const std::string& path, const Dimension* wanted,
                              CheckContext& context) {
  const TextNode& csv = *find(map, "csv");
  const TextNode* column = find(map, "column");
  // As paths elsewhere: from the folder of the file that names it.
  const fs::path folder =
      csv.where.line > 0 ? fs::path(csv.where.file).parent_path() : fs::path(context.folder);
  const std::string file = (folder / csv.text).lexically_normal().string();
  if (!fs::is_regular_file(file)) {
    context.complain(csv.where, join_path(path, "csv"),
                     fmt::format("no file '{}' (looked for {})", csv.text, file));
    return std::nullopt;
  }
  try {
    Curve curve = read_csv_curve(file, column == nullptr ? "" : column->text);
    if (wanted == nullptr || curve.bare || curve.dimension == *wanted) return curve;
    context.complain(csv.where, join_path(path, "csv"),
                     fmt::format("the column is {}; {}", with_article(name_of(curve.dimension)),
                                 wanted_text(*wanted)));
  } catch (const std::invalid_argument& error) {
    context.complain(csv.where, join_path(path, "csv"), error.what());
  }
  return std::nullopt;
}

/// False, and mistakes noted, where a map is none of a table.
bool keys_fit(const TextNode& map, const std::string& path, CheckContext& context) {
  const std::vector<std::string> known{"table", "csv", "column", "factor"};
  bool fit = true;
  for (const TextNode& entry : map.items) {
    if (contains(known, entry.key)) continue;
    context.complain(entry.key_where, join_path(path, entry.key),
                     fmt::format("unknown key{}; a table has table or csv, column and factor",
                                 did_you_mean(entry.key, known)));
    fit = false;
  }
  const bool one = (find(map, "table") == nullptr) != (find(map, "csv") == nullptr);
  if (fit && !one) context.complain(map.where, path, "a table is given by one of table and csv");
  const TextNode* column = find(map, "column");
  if (fit && one && column != nullptr && find(map, "csv") == nullptr) {
    context.complain(column->where, join_path(path, "column"), "goes with csv");
    return false;
  }
  return fit && one;
}

/// The variables of a place, in the order in which compiled formulas get them.
const std::vector<std::string>& all_variables() {
  static const std::vector<std::string> names{"t", "x", "y", "z"};
  return names;
}

/// A formula of variables. Curves are functions of time, so they too want t to be allowed.
std::optional<Function> read_formula(const TextNode& node, const Key& key, const std::string& path,
                                     CheckContext& context) {
  Function f;
  f.text = node.text;
  try {
    const auto formula = context.formulas.compile(node.text, key.variables);
    std::vector<std::size_t> picked;
    for (const std::string& name : key.variables) {
      const auto& all = all_variables();
      picked.push_back(
          static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin()));
    }
    f.formula = [formula, picked](double t, const Vec3& x) {
      const std::array<double, 4> all{t, x[0], x[1], x[2]};
      std::array<double, 4> given{};
      for (std::size_t k = 0; k < picked.size(); ++k) given[k] = all[picked[k]];
      return formula(given.data());
    };
  } catch (const std::invalid_argument& error) {
    const std::string why = error.what();
    if (!why.empty()) context.complain(node.where, path, why);
    return std::nullopt;
  }
  const std::vector<std::string> used = context.formulas.variables_in(node.text, {"x", "y", "z"});
  f.of_place =
      std::any_of(used.begin(), used.end(), [](const auto& name) { return !name.empty(); });
  const double start = f.formula(0, Vec3::Zero());
  if (!f.of_place && !std::isfinite(start)) {
    context.complain(node.where, path,
                     fmt::format("'{}' gives {} at t = 0, not a finite number", node.text, start));
    return std::nullopt;
  }
  return f;
}

/// A lone name of a curve keeps its dimension, and is checked.
std::optional<Function> lone_curve(const TextNode& node, const Key& key, const std::string& path,
                                   const Curve& curve, CheckContext& context) {
  if (!curve.bare && curve.dimension != key.unit) {
    context.complain(node.where, path,
                     fmt::format("the curve '{}' is {}; {}", node.text,
                                 with_article(name_of(curve.dimension)), wanted_text(key.unit)));
    return std::nullopt;
  }
  return Function(curve.table);
}

/// True where a text is no quantity and, without variables, no formula that can be worked out: as a
/// formula of variables its mistake is told better.
bool fails_as_formula(const std::string& text, const Formulas& formulas) {
  try {
    return !std::isfinite(formulas.read(text).value);
  } catch (const FormulaError&) {
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

std::optional<Function> read_function(const TextNode& node, const Key& key, const std::string& path,
                                      CheckContext& context) {
  const bool timed = contains(key.variables, "t");
  if (timed && (node.form == Form::list || node.form == Form::map)) {
    const auto curve = read_curve(node, path, &key.unit, context);
    if (!curve) return std::nullopt;
    return Function(curve->table);
  }
  if (node.form == Form::scalar && !node.text.empty()) {
    if (const auto curve = context.formulas.curve(node.text); timed && curve != nullptr) {
      return lone_curve(node, key, path, *curve, context);
    }
    if (!context.formulas.variables_in(node.text, key.variables).empty() ||
        fails_as_formula(node.text, context.formulas)) {
      return read_formula(node, key, path, context);
    }
  }
  Key number = key;
  number.kind = Kind::number;
  Value one;
  one.path = path;
  check_simple(node, number, one, context);
  if (one.numbers.empty()) return std::nullopt;
  Function f(one.numbers.front());
  if (key.unit != dim::none) f.text += " " + si_unit_of(key.unit);
  return f;
}

}  // namespace

std::optional<Curve> read_curve(const TextNode& node, const std::string& path,
                                const Dimension* wanted, CheckContext& context) {
  if (node.form != Form::map) return read_pairs(node, path, wanted, context);
  if (!keys_fit(node, path, context)) return std::nullopt;
  const TextNode* table = find(node, "table");
  auto curve = table != nullptr ? read_pairs(*table, join_path(path, "table"), wanted, context)
                                : read_csv(node, path, wanted, context);
  if (const TextNode* factor = find(node, "factor"); curve && factor != nullptr) {
    const auto times = table_number(*factor, join_path(path, "factor"), &dim::none, context);
    if (!times) return std::nullopt;
    for (double& y : curve->table.y) y *= times->value;
  }
  return curve;
}

FormulaMaker maker_of(const std::string& text, const Formulas& formulas) {
  return [text, shared = std::make_shared<const Formulas>(formulas)](
             const std::vector<std::string>& names) { return shared->compile(text, names); };
}

void check_function(const TextNode& node, const Key& key, Value& value, CheckContext& context) {
  if (node.form == Form::scalar && contains(key.choices, node.text)) {
    value.words = {node.text};
    return;
  }
  const auto f = read_function(node, key, value.path, context);
  if (!f) return;
  value.functions = {*f};
  if (f->constant()) value.numbers = {f->factor};
}

void check_vector_function(const TextNode& node, const Key& key, Value& value,
                           CheckContext& context) {
  if (node.form != Form::list) {
    const bool empty = node.form != Form::scalar || node.text.empty();
    context.complain(
        node.where, value.path,
        fmt::format("{}; {}", empty ? "no list" : "'" + node.text + "'", wanted_text(key)));
    return;
  }
  if (node.items.size() != 3) {
    context.complain(
        node.where, value.path,
        fmt::format("{} numbers stand here; three are wanted: [x, y, z]", node.items.size()));
    return;
  }
  for (const TextNode& item : node.items) {
    const bool word = item.form == Form::scalar && contains(key.choices, item.text);
    value.words.push_back(word ? item.text : "");
    const auto f = word ? Function(0.0) : read_function(item, key, value.path, context);
    if (f) value.functions.push_back(*f);
    if (f && f->constant() && !word) value.numbers.push_back(f->factor);
  }
}

void check_curves(const TextNode& curves, CheckContext& context) {
  for (const TextNode& entry : curves.items) {
    const std::string path = join_path("curves", entry.key);
    const auto curve = read_curve(entry, path, nullptr, context);
    try {
      if (curve) context.formulas.define_curve(entry.key, *curve);
    } catch (const std::invalid_argument& error) {
      context.complain(entry.key_where, path, error.what());
    }
  }
}

}  // namespace gannet
