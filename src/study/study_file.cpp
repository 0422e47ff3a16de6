#include "study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "base/units.hpp"
#include "input/formula.hpp"
#include "input/nearest.hpp"
#include "input/text_tree.hpp"
#include "study/study_axes.hpp"
#include "study/study_history.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

bool is_kind(const std::string& word) {
  const auto& kinds = measure_kinds();
  return std::find(kinds.begin(), kinds.end(), word) != kinds.end();
}

std::string unknown_kind(const std::string& word) {
  return fmt::format("'{}' is no kind of measure{}; known: {}", word,
                     did_you_mean(word, measure_kinds()), comma_list(measure_kinds()));
}

}  // namespace

Schema study_schema() {
  const auto add = [](Key key) { return SchemaEntry{"study", std::move(key)}; };
  return {add({.name = "case", .kind = Kind::path, .text = "the case that is run"}),
          add({.name = "vary",
               .kind = Kind::map,
               .text = "keys of the case and the values that each takes",
               .keys = {{.name = "*",
                         .kind = Kind::any,
                         .text = "a list of values, or variants by name"}}}),
          add({.name = "set",
               .kind = Kind::map,
               .text = "keys of the case and the one value that each has in all runs",
               .keys = {{.name = "*", .kind = Kind::any, .text = "a value"}}}),
          add({.name = "measure",
               .kind = Kind::map,
               .text = "numbers taken from histories",
               .keys = {{.name = "*", .kind = Kind::any, .text = "{peak: PROBE}"}}}),
          add({.name = "reference",
               .kind = Kind::any,
               .text = "finest, richardson, a number, {formula: \"...\"} or {csv: FILE}"}),
          add({.name = "refine", .kind = Kind::text, .text = "the key along which it converges"}),
          add({.name = "budget",
               .unit = dim::time,
               .text = "wall time of the study",
               .limits = positive()}),
          add({.name = "repeats",
               .kind = Kind::integer,
               .text = "runs of each setting; medians are shown",
               .limits = between(1, 1000)}),
          add({.name = "jitter",
               .kind = Kind::any,
               .text = "{part: NAME, amount: 0.05}: particles start another way in each repeat"}),
          add({.name = "parallel",
               .kind = Kind::integer,
               .text = "runs side by side",
               .limits = between(1, 1024)}),
          add({.name = "threads",
               .kind = Kind::integer,
               .text = "threads of each run",
               .limits = between(1, 1024)})};
}

Effect study_effect() { return {.name = "study", .schema = study_schema}; }

bool is_study_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return false;
  std::ostringstream text;
  text << stream.rdbuf();
  Mistakes ignored;  // reading the file in earnest notes them again
  const TextNode root = read_yaml(text.str(), file, ignored);
  const TextNode* study = find(root, "study");
  return study != nullptr && find(*study, "case") != nullptr;
}

namespace {

/// A value as it would stand on the command line: "20 mm", "[8, 8]".
std::string value_text(const Value& v) {
  if (!v.is_list) return v.text;
  std::string text;
  for (const Value& item : v.children) text += (text.empty() ? "" : ", ") + value_text(item);
  return "[" + text + "]";
}

const Value* child_of(const Value& map, const std::string& name) {
  for (const Value& child : map.children) {
    if (child.name == name) return &child;
  }
  return nullptr;
}

std::string beside(const std::string& file, const std::string& folder) {
  return fs::path(file).is_absolute() ? file
                                      : (fs::path(folder) / file).lexically_normal().string();
}

/// A history that is known in closed form: "h*cos(omega*t)", t in s, the result in SI.
StudyReference formula_reference(const Value& formula, const Keys& keys) {
  StudyReference reference{.kind = StudyReference::Kind::formula, .text = formula.text};
  try {
    if (!formula.formula) throw std::invalid_argument("a formula of t in quotes is wanted");
    reference.formula = formula.formula({"t"});
  } catch (const std::invalid_argument& error) {
    keys.complain(formula, error.what());
  }
  return reference;
}

StudyReference reference_of(const Value& v, const Keys& keys, const std::string& folder) {
  StudyReference reference;
  const Value* csv = child_of(v, "csv");
  const Value* formula = child_of(v, "formula");
  const Value& number = formula != nullptr ? *formula : v;
  if (csv != nullptr) {
    reference.kind = StudyReference::Kind::csv;
    reference.file = beside(csv->text, folder);
    if (const Value* column = child_of(v, "column")) reference.column = column->text;
    if (!fs::exists(reference.file)) keys.complain(*csv, "no such file");
  } else if (!number.numbers.empty()) {
    reference.kind = StudyReference::Kind::number;
    reference.value = number.numbers.front();
  } else if (formula != nullptr) {
    reference = formula_reference(*formula, keys);
  } else if (v.text == "richardson") {
    reference.kind = StudyReference::Kind::richardson;
  } else if (v.text != "finest") {
    keys.complain(number,
                  "finest, richardson, a number, {formula: \"...\"} or {csv: FILE} is wanted");
  }
  return reference;
}

constexpr const char* options = "width, period, level, percent, shift, scale, reference";

/// What a kind of measure cannot do without; nullptr where nothing is missing.
const char* missing_option(const StudyMeasure& m) {
  if (m.kind.ends_with("largest_mean") && !(m.width > 0)) {
    return "the width of the windows is missing: width: 20 ms";
  }
  const bool sine = m.kind == "amplitude" || m.kind == "phase" || m.kind == "midline";
  if (sine && !(m.period > 0)) return "the period of the sine is missing: period: 2 s";
  return nullptr;
}

/// One option of a measure. Returns false where there is no such option.
bool set_option(const Value& option, const Keys& keys, const std::string& folder,
                StudyMeasure& measure) {
  const std::string& name = option.name;
  const auto number = [&](const Dimension& d) { return keys.quantity(option, d); };
  if (name == "column") {
    measure.column = option.text;
  } else if (name == "from") {
    measure.from = number(dim::time);
  } else if (name == "until") {
    measure.until = number(dim::time);
  } else if (name == "shift") {
    measure.max_shift = number(dim::time);
  } else if (name == "width") {
    measure.width = number(dim::time);
  } else if (name == "period") {
    measure.period = number(dim::time);
  } else if (name == "level") {
    measure.level = option.numbers.empty() ? number(dim::none) : option.numbers.front();
  } else if (name == "percent") {
    measure.percent = number(dim::none);
  } else if (name == "scale") {
    measure.scale = option.numbers.empty() ? number(dim::none) : option.numbers.front();
  } else if (name == "reference") {
    measure.reference = reference_of(option, keys, folder);
  } else {
    return false;
  }
  return true;
}

StudyMeasure measure_of(const Value& v, const Keys& keys, const std::string& folder) {
  StudyMeasure measure;
  measure.name = v.name;
  if (!v.is_map) {  // measure: {peak: slam_force}
    measure.kind = v.name;
    measure.history = v.text;
    measure.name += "_" + v.text;
    if (!is_kind(v.name)) keys.complain(v, unknown_kind(v.name));
    return measure;
  }
  for (const Value& option : v.children) {
    if (is_kind(option.name)) {
      measure.kind = option.name;
      measure.history = option.text;
    } else if (!set_option(option, keys, folder, measure)) {
      keys.complain(option, unknown_kind(option.name) + "; options: column, from, until, " +
                                std::string(options));
    }
  }
  if (measure.kind.empty()) {
    keys.complain(
        v, "what is measured is missing: {peak: PROBE}; known: " + comma_list(measure_kinds()));
  }
  if (const char* missing = missing_option(measure)) keys.complain(v, missing);
  return measure;
}

void read_jitter(const Value& v, const Keys& keys, StudySpec& spec) {
  const Value* part = child_of(v, "part");
  const Value* amount = child_of(v, "amount");
  if (part == nullptr || amount == nullptr || amount->numbers.empty()) {
    keys.complain(v, "{part: NAME, amount: 0.05} is wanted, the amount in spacings");
    return;
  }
  spec.jitter_part = part->text;
  spec.jitter = keys.quantity(*amount, dim::none);
}

/// Variants by name, each a map of keys and values.
StudyAxis variants_of(const Value& v, const Keys& keys) {
  StudyAxis axis{v.name, {}};
  for (const Value& variant : v.children) {
    const bool as_it_is = variant.text == "on" || (variant.is_map && variant.children.empty());
    if (!variant.is_map && !as_it_is) {
      keys.complain(variant, "a map of keys and values is wanted, or 'on' for the case as it is");
    }
    axis.values.push_back(variant.name);
    auto& set = axis.sets.emplace_back();
    for (const Value& key : variant.children) set.push_back(key.name + "=" + value_text(key));
  }
  return axis;
}

StudyAxis axis_of(const Value& v, const Keys& keys) {
  StudyAxis axis{v.name, {}};
  if (v.is_map) return variants_of(v, keys);
  if (!v.is_list || v.children.empty()) keys.complain(v, "a list of values is wanted");
  for (const Value& item : v.children) axis.values.push_back(value_text(item));
  return axis;
}

}  // namespace

StudySpec study_of(Case& read) {
  StudySpec spec;
  const Keys keys = read.keys().map("study");
  spec.case_file = keys.has("case") ? keys.word("case") : read.file;
  for (const std::string& name : keys.map("vary").names()) {
    spec.axes.push_back(axis_of(keys.map("vary").value(name), keys));
  }
  for (const std::string& name : keys.map("set").names()) {
    spec.set.push_back(name + "=" + value_text(keys.map("set").value(name)));
  }
  for (const std::string& name : keys.map("measure").names()) {
    spec.measures.push_back(measure_of(keys.map("measure").value(name), keys, read.folder));
  }
  if (keys.has("reference")) {
    spec.reference = reference_of(keys.value("reference"), keys, read.folder);
  }
  spec.refine = keys.word("refine");
  spec.budget = keys.number_or("budget", spec.budget);
  if (keys.has("repeats")) spec.repeats = keys.integer("repeats");
  if (keys.has("parallel")) spec.parallel = keys.integer("parallel");
  if (keys.has("threads")) spec.threads = keys.integer("threads");
  if (keys.has("jitter")) read_jitter(keys.value("jitter"), keys, spec);
  return spec;
}

namespace {

double quantity_of(const std::string& text, const Dimension& wanted, bool any = false) {
  const Quantity q = parse_quantity(text);
  if (!any && !q.bare && q.dimension != wanted) {
    throw std::invalid_argument(fmt::format("'{}': {}", text, wanted_text(wanted)));
  }
  return q.value;
}

void set_option(const std::string& name, const std::string& text, StudyMeasure& measure) {
  if (name == "from") {
    measure.from = quantity_of(text, dim::time);
  } else if (name == "until") {
    measure.until = quantity_of(text, dim::time);
  } else if (name == "shift") {
    measure.max_shift = quantity_of(text, dim::time);
  } else if (name == "width") {
    measure.width = quantity_of(text, dim::time);
  } else if (name == "period") {
    measure.period = quantity_of(text, dim::time);
  } else if (name == "level") {
    measure.level = quantity_of(text, dim::none, true);
  } else if (name == "percent") {
    measure.percent = quantity_of(text, dim::none, true);
  } else if (name == "scale") {
    measure.scale = quantity_of(text, dim::none, true);
  } else if (name == "name") {
    measure.name = text;
  } else if (name == "reference") {
    measure.reference = parse_reference(text);
  } else {
    throw std::invalid_argument(
        fmt::format("unknown option '{}'; known: from, until, name, {}", name, options));
  }
}

}  // namespace

StudyMeasure parse_measure(const std::string& text) {
  const std::string wanted = "KIND:HISTORY is wanted, such as peak:slam_force or peak:slam_force:z";
  std::istringstream pieces(text);
  std::string head;
  std::getline(pieces, head, ',');
  const std::size_t colon = head.find(':');
  if (colon == std::string::npos) throw std::invalid_argument(wanted);
  StudyMeasure measure;
  measure.kind = head.substr(0, colon);
  if (!is_kind(measure.kind)) throw std::invalid_argument(unknown_kind(measure.kind));
  measure.history = head.substr(colon + 1);
  if (const std::size_t second = measure.history.find(':'); second != std::string::npos) {
    measure.column = measure.history.substr(second + 1);
    measure.history.resize(second);
  }
  if (measure.history.empty()) throw std::invalid_argument(wanted);
  measure.name = measure.kind + "_" + measure.history;
  if (!measure.column.empty()) measure.name += "_" + measure.column;
  for (std::string option; std::getline(pieces, option, ',');) {
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos) throw std::invalid_argument("'" + option + "': " + wanted);
    set_option(option.substr(0, equals), option.substr(equals + 1), measure);
  }
  if (const char* missing = missing_option(measure)) throw std::invalid_argument(missing);
  return measure;
}

StudyReference parse_reference(const std::string& text) {
  StudyReference reference;
  if (text == "finest") return reference;
  if (text == "richardson") {
    reference.kind = StudyReference::Kind::richardson;
    return reference;
  }
  if (text.ends_with(".csv")) {
    if (!fs::exists(text)) throw std::invalid_argument(text + ": no such file");
    reference.kind = StudyReference::Kind::csv;
    reference.file = fs::absolute(text).lexically_normal().string();
    return reference;
  }
  try {
    reference.value = parse_quantity(text).value;
    reference.kind = StudyReference::Kind::number;
  } catch (const std::invalid_argument&) {
    reference.formula = Formulas{}.compile(text, {"t"});
    reference.kind = StudyReference::Kind::formula;
    reference.text = text;
  }
  return reference;
}

}  // namespace gannet
