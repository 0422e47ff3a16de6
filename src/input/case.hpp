// A case file, read and checked: plain values in SI that know where they were written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"

namespace gannet {

struct Case {
  Value root;
  Mistakes mistakes;       ///< for what effects find later; the case is without mistakes when read
  std::string file;        ///< as given
  std::string folder;      ///< of the file, "." where the name has none
  std::string title;       ///< the case's, or the name of the file without its ending
  std::uint64_t hash = 0;  ///< of `resolved`: the same for the same values, whatever the comments
  std::string resolved;    ///< the whole case, defaults and cards written out, as YAML
  /// A view of the top; valid as long as the case is.
  Keys keys() { return {root, mistakes}; }
};

/// Reads a case file in the language of `schema`. Overrides ("let.dx=8mm") replace what the file
/// says. Returns a pointer because views point into the case.
/// Throws InputError with every mistake of the file at once, each
/// "file:line:column: key.path: message"; std::logic_error where tables contradict each other.
std::unique_ptr<Case> read_case(const std::string& file, const Schema& schema,
                                const std::vector<std::string>& overrides = {});

/// As read_case, of a text in place of a file of that name (which gives places and the folder).
std::unique_ptr<Case> read_case_text(const std::string& text, const std::string& file,
                                     const Schema& schema,
                                     const std::vector<std::string>& overrides = {});

}  // namespace gannet
