// The YAML text of a case as a plain tree: every key and scalar with its place, duplicate keys
// kept, nothing interpreted. The only file that knows yaml-cpp is text_tree.cpp.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/keys.hpp"

namespace gannet {

/// One node of the text: nothing (null), a scalar, a list or a map.
struct TextNode {
  enum class Form { nothing, scalar, list, map };
  Form form = Form::nothing;
  Location where;      ///< where the value starts
  std::string key;     ///< its key, where it stands in a map
  Location key_where;  ///< where the key starts
  std::string text;    ///< of a scalar
  bool quoted = false;
  /// A mistake is noted already that would make others appear (an unknown card): what is missing
  /// below is not noted again.
  bool broken = false;
  std::vector<TextNode> items;  ///< list items, or map entries in file order
};

/// The first entry of that key, or nullptr.
const TextNode* find(const TextNode& map, const std::string& key);
TextNode* find(TextNode& map, const std::string& key);

/// Reads YAML. Notes syntax errors, aliases, merge keys, keys that are no words, and second
/// documents as mistakes; after a syntax error `broken` is set. Throws nothing.
TextNode read_yaml(const std::string& text, const std::string& file, Mistakes& mistakes);

/// Reads a short piece of YAML that stands in no file (an override, a default); all places are
/// `where`.
TextNode read_yaml_piece(const std::string& text, const Location& where, Mistakes& mistakes);

}  // namespace gannet
