// The checked values of a case file, as the rest of the program reads them: a view of one map.
// Numbers are SI, defaults are filled in, references exist, and each value knows its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/function.hpp"
#include "base/math.hpp"
#include "base/schema.hpp"

namespace gannet {

/// One value of a case after checking. Maps keep the order of the file.
struct Value {
  std::string name;  ///< last part of the key path
  std::string path;  ///< whole key path: "parts.panel.shell.thickness"
  Location where;
  Kind kind = Kind::any;
  bool is_map = false;
  bool is_list = false;         ///< written with brackets or dashes
  bool given = true;            ///< written by the user, not a default
  std::string text;             ///< scalar as written
  std::vector<double> numbers;  ///< number, integer, flag (0/1), vector, numbers
  /// text, choice, names, reference, path (absolute); for a scalar of Kind::any always the text,
  /// also where it is a number.
  std::vector<std::string> words;
  std::vector<Value> children;  ///< map entries, or list items for Kind::any
  Dimension dimension;          ///< of numbers
  bool bare = true;             ///< Kind::any: a number without a unit or a formula, taken in SI
  std::string trouble;          ///< Kind::any: why the scalar is no number
  /// function: one; vector_function: three, and `words` then holds "" or a word for each.
  std::vector<Function> functions;
  FormulaMaker formula;  ///< formula, and a scalar of Kind::any: its owner names the variables
};

/// Collects the mistakes of a whole case, so that the user sees all of them at once.
class Mistakes {
 public:
  void add(const Location& where, const std::string& message);
  [[nodiscard]] bool empty() const { return messages_.empty(); }
  /// Throws InputError with all messages, in file order, if there are any.
  void throw_if_any() const;
  /// All messages, each "file:line:column: message", in file order, without repetitions.
  [[nodiscard]] std::vector<std::string> messages() const;

 private:
  struct Entry {
    Location where;
    std::string text;
  };
  std::vector<Entry> messages_;
};

/// A read-only view of one map of the case. Cheap to copy; valid as long as the case is.
/// Asking for a key that has no value throws InputError with the place of the map; a key that its
/// table does not require is asked for with has() first.
class Keys {
 public:
  Keys(const Value& map, Mistakes& mistakes) : map_(&map), mistakes_(&mistakes) {}

  /// True where the key has a value, given or by default.
  [[nodiscard]] bool has(std::string_view key) const;
  /// True where the user wrote the key.
  [[nodiscard]] bool given(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  /// The number, or `otherwise` where the key is absent or a word ("auto").
  [[nodiscard]] double number_or(std::string_view key, double otherwise) const;
  [[nodiscard]] int integer(std::string_view key) const;
  [[nodiscard]] bool flag(std::string_view key) const;
  [[nodiscard]] Vec3 vector(std::string_view key) const;
  /// A function of time and place; of a plain number, the constant.
  [[nodiscard]] const Function& function(std::string_view key) const;
  [[nodiscard]] VectorFunction vector_function(std::string_view key) const;
  [[nodiscard]] const std::vector<double>& numbers(std::string_view key) const;
  /// Text, choice, reference or path; for a number that may be a word ("auto"), that word or "";
  /// "" where the key is absent.
  [[nodiscard]] std::string word(std::string_view key) const;
  [[nodiscard]] const std::vector<std::string>& words(std::string_view key) const;
  /// The map under the key; an empty one where the key is absent.
  [[nodiscard]] Keys map(std::string_view key) const;
  [[nodiscard]] const Value& value(std::string_view key) const;
  /// Names of the entries, in file order.
  [[nodiscard]] std::vector<std::string> names() const;

  [[nodiscard]] const std::string& name() const { return map_->name; }
  [[nodiscard]] const std::string& path() const { return map_->path; }
  /// Where the key stands; the map itself where the key is absent.
  [[nodiscard]] Location where(std::string_view key) const;
  [[nodiscard]] Location where() const { return map_->where; }

  /// Notes a mistake "file:line:column: path.key: message" and goes on. An empty key means the map.
  void complain(std::string_view key, const std::string& message) const;
  /// Notes a mistake at one value, say an item of a mixed list.
  void complain(const Value& value, const std::string& message) const;
  /// The number of a scalar of Kind::any [SI of `wanted`]. Notes a mistake and returns 0 where it
  /// is no number or has another dimension.
  [[nodiscard]] double quantity(const Value& item, const Dimension& wanted) const;
  [[nodiscard]] Mistakes& mistakes() const { return *mistakes_; }

 private:
  [[nodiscard]] const Value* find(std::string_view key) const;
  const Value* map_;
  Mistakes* mistakes_;
};

}  // namespace gannet
