#include "input/text_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <string_view>

namespace gannet {

namespace {

/// Byte offset of a place that counts from 0.
std::size_t offset_of(const std::string& text, const YAML::Mark& mark) {
  std::size_t at = 0;
  for (int line = 0; line < mark.line && at < text.size(); ++line) {
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  return at + static_cast<std::size_t>(mark.column);
}

/// True unless a quoted scalar starts at the mark and its quote never closes: yaml-cpp takes the
/// rest of the file for its text then, and says nothing.
bool quote_closes(const std::string& text, const YAML::Mark& mark) {
  std::size_t at = offset_of(text, mark);
  if (at >= text.size() || (text[at] != '"' && text[at] != '\'')) return true;
  const char quote = text[at];
  for (++at; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (text[at] == quote) {
      // A single quote within single quotes is written twice.
      const bool twice = quote == '\'' && at + 1 < text.size() && text[at + 1] == quote;
      if (!twice) return true;
      ++at;
    }
  }
  return false;
}

/// Builds the tree from the events of the parser. yaml-cpp's own nodes would drop what must be
/// checked: a second key of the same name, the place of a key, that a scalar was quoted.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const Location& place, Mistakes& mistakes)
      : text_(text), place_(place), mistakes_(mistakes) {}

  TextNode take() { return std::move(root_); }

  /// yaml-cpp counts from 0; a place without a line stands for a text that is in no file.
  [[nodiscard]] Location at(const YAML::Mark& mark) const {
    if (place_.line == 0 || mark.is_null()) return place_;
    return {place_.file, mark.line + 1, mark.column + 1};
  }

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    TextNode node;
    node.where = at(mark);
    add(std::move(node));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    mistakes_.add(at(mark), "aliases (*name) are not read; write the value out, or use 'let'");
    OnNull(mark, YAML::NullAnchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                const std::string& value) override {
    TextNode node;
    node.quoted = tag == "!";
    node.form = value == "~" && !node.quoted ? TextNode::Form::nothing : TextNode::Form::scalar;
    node.where = at(mark);
    node.text = value;
    if (node.quoted && !quote_closes(text_, mark)) {
      throw YAML::ParserException(mark, "the quote that starts here is not closed");
    }
    add(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/,
                       YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value /*style*/) override {
    open(mark, TextNode::Form::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, TextNode::Form::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    TextNode node;
    bool has_key = false;
    TextNode key;
  };

  void open(const YAML::Mark& mark, TextNode::Form form) {
    Level level;
    level.node.form = form;
    level.node.where = at(mark);
    levels_.push_back(std::move(level));
  }

  void close() {
    TextNode node = std::move(levels_.back().node);
    levels_.pop_back();
    add(std::move(node));
  }

  void add(TextNode node) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& level = levels_.back();
    if (level.node.form == TextNode::Form::list) {
      level.node.items.push_back(std::move(node));
    } else if (!level.has_key) {
      level.has_key = true;
      level.key = std::move(node);
    } else {
      level.has_key = false;
      add_entry(level, std::move(node));
    }
  }

  void add_entry(Level& level, TextNode node) {
    const TextNode& key = level.key;
    if (key.form != TextNode::Form::scalar || key.text.empty()) {
      mistakes_.add(key.where, "a key must be a word");
      return;
    }
    if (key.text == "<<") {
      mistakes_.add(key.where, "merge keys (<<) are not read; write the keys out");
      return;
    }
    node.key = key.text;
    node.key_where = key.where;
    // The parser places an absent value at whatever comes next.
    if (node.form == TextNode::Form::nothing) node.where = key.where;
    level.node.items.push_back(std::move(node));
  }

  const std::string& text_;
  Location place_;
  Mistakes& mistakes_;
  TextNode root_;
  std::vector<Level> levels_;
};

TextNode read(const std::string& text, const Location& place, Mistakes& mistakes) {
  std::istringstream stream(text);
  TreeBuilder builder(text, place, mistakes);
  try {
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    TextNode root = builder.take();
    TreeBuilder second(text, place, mistakes);
    if (parser.HandleNextDocument(second)) {
      mistakes.add(second.take().where, "a second YAML document (---) is not read");
    }
    return root;
  } catch (const YAML::ParserException& error) {
    mistakes.add(builder.at(error.mark), fmt::format("this is not YAML: {}", error.msg));
  }
  TextNode root;
  root.where = place;
  root.broken = true;
  return root;
}

}  // namespace

const TextNode* find(const TextNode& map, const std::string& key) {
  if (map.form != TextNode::Form::map) return nullptr;
  for (const TextNode& item : map.items) {
    if (item.key == key) return &item;
  }
  return nullptr;
}

TextNode* find(TextNode& map, const std::string& key) {
  return const_cast<TextNode*>(find(static_cast<const TextNode&>(map), key));
}

TextNode read_yaml(const std::string& text, const std::string& file, Mistakes& mistakes) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  const bool marked = text.starts_with(byte_order_mark);
  TextNode root = read(marked ? text.substr(byte_order_mark.size()) : text, {file, 1, 1}, mistakes);
  root.where = {file, 1, 1};
  return root;
}

TextNode read_yaml_piece(const std::string& text, const Location& where, Mistakes& mistakes) {
  Location place = where;
  place.line = 0;  // marks within the piece mean nothing in the file
  Mistakes inner;
  TextNode root = read(text, place, inner);
  const auto relocate = [&where](auto&& self, TextNode& node) -> void {
    node.where = node.key_where = where;
    for (TextNode& item : node.items) self(self, item);
  };
  relocate(relocate, root);
  for (const std::string& message : inner.messages()) {
    mistakes.add(where, message.substr(message.find(place.text()) + place.text().size() + 2));
  }
  return root;
}

}  // namespace gannet
