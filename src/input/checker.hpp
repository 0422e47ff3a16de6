// From text to checked values: every node of the text against its key.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "input/formula.hpp"
#include "input/text_tree.hpp"

namespace gannet {

/// A name that must exist under a top-level map; looked up when the whole case is read.
struct ReferenceToCheck {
  Location where;
  std::string path;
  std::string name;
  std::string refers_to;
};

/// What checking a node needs beside the node and its key.
struct CheckContext {
  Formulas formulas;
  Mistakes* mistakes = nullptr;
  std::string file;    ///< the case file as given
  std::string folder;  ///< of the case file
  std::vector<ReferenceToCheck> references;

  /// Notes "file:line:column: path: message".
  void complain(const Location& where, const std::string& path, const std::string& message) const;
};

/// The value of a node at `path`, checked against its key; mistakes are noted in the context and
/// the value is then incomplete.
Value check(const TextNode& node, const Key& key, const std::string& path, CheckContext& context);

/// A scalar, vector or list of numbers, words or names (all kinds but map and any).
void check_simple(const TextNode& node, const Key& key, Value& value, CheckContext& context);

/// Makes the formula of a text with the names of a case, once its variables are known.
FormulaMaker maker_of(const std::string& text, const Formulas& formulas);

/// The names under `let`, in order; each may use those before it. Fills context.formulas.
Value check_let(const TextNode& let, CheckContext& context);

/// Notes a mistake for each reference whose name is not in the case.
void check_references(const TextNode& root, const CheckContext& context);

/// "panel" under "parts" -> "parts.panel"
std::string join_path(const std::string& path, const std::string& key);

}  // namespace gannet
