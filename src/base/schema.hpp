// What a key of a case file may be. Every effect, material and shape brings its own table of keys;
// the reader merges the tables and knows none of them by name.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/units.hpp"

namespace gannet {

enum class Kind {
  number,    ///< a quantity of `unit`, or a formula of let-names in quotes
  integer,   ///< a whole number
  flag,      ///< yes/no
  text,      ///< free text
  choice,    ///< one of `choices`
  vector,    ///< three numbers of `unit` ([x, y, z])
  function,  ///< a number of `unit`, or a formula of `variables`; a table where one of them is t
  vector_function,  ///< three of them, each alone may also be a word out of `choices`
  formula,          ///< a formula whose names its owner supplies
  numbers,          ///< any number of numbers of `unit` (a single one may stand without brackets)
  names,            ///< a list of names or of a few words out of `choices` (one may stand alone)
  path,             ///< a file, relative to the case file; must exist
  reference,        ///< the user's name of a thing under the top-level map `refers_to`
  map,              ///< a map of `keys`
  any               ///< kept as written; the effect that owns it checks it (a mixed list, say)
};

/// Allowed range of a number; both ends belong to it unless marked open.
struct Limits {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_open = false;
  bool highest_open = false;
};

inline Limits positive() { return {0, std::numeric_limits<double>::infinity(), true, false}; }
inline Limits at_least(double lowest) { return {lowest}; }
inline Limits between(double lowest, double highest) { return {lowest, highest}; }

/// One key of a map in a case file.
struct Key {
  std::string name{};  ///< "*" stands for names that the user chooses
  Kind kind = Kind::number;
  Dimension unit = dim::none;
  std::string text;  ///< one line for the manual and for messages
  bool required = false;
  std::string fallback{};  ///< the default, written as a user would; empty: absent stays absent
  Limits limits{};
  std::vector<std::string>
      choices{};            ///< for choice and names; also words that a number may be ("auto")
  std::string refers_to{};  ///< for reference: "materials", "parts", ...
  std::vector<Key> keys{};  ///< for map
  std::vector<std::string> variables{};  ///< for functions: of t, x, y, z what formulas may use
};

/// Keys that an effect adds to the case language, at a path from the top: "parts.*", "effects",
/// "" for the top itself. Maps of the same name from several tables are merged.
struct SchemaEntry {
  std::string path;
  Key key;
};

using Schema = std::vector<SchemaEntry>;

}  // namespace gannet
