#include "base/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace gannet {

namespace {

const Value& nothing() {
  static const Value empty = [] {
    Value v;
    v.kind = Kind::map;
    v.is_map = true;
    v.given = false;
    return v;
  }();
  return empty;
}

std::string joined(const std::string& path, std::string_view key) {
  if (key.empty()) return path;
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

/// The one mistake that is thrown at once: a value is wanted that is not there.
[[noreturn]] void fail(const Keys& keys, std::string_view key, const std::string& what) {
  const std::string path = joined(keys.path(), key);
  throw InputError(keys.where(key), path.empty() ? what : path + ": " + what);
}

}  // namespace

void Mistakes::add(const Location& where, const std::string& message) {
  messages_.push_back({where, message});
}

std::vector<std::string> Mistakes::messages() const {
  std::vector<Entry> sorted = messages_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.where.file, a.where.line, a.where.column) <
           std::tie(b.where.file, b.where.line, b.where.column);
  });
  std::vector<std::string> lines;
  for (const Entry& e : sorted) {
    std::string line = e.where.text() + ": " + e.text;
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  return lines;
}

void Mistakes::throw_if_any() const {
  if (!empty()) throw InputError(messages());
}

const Value* Keys::find(std::string_view key) const {
  for (const Value& child : map_->children) {
    if (child.name == key) return &child;
  }
  return nullptr;
}

bool Keys::has(std::string_view key) const { return find(key) != nullptr; }

bool Keys::given(std::string_view key) const {
  const Value* v = find(key);
  return v != nullptr && v->given;
}

const Value& Keys::value(std::string_view key) const {
  const Value* v = find(key);
  if (v == nullptr) fail(*this, key, "missing; a value is wanted here");
  return *v;
}

double Keys::number(std::string_view key) const {
  const Value& v = value(key);
  if (v.numbers.empty()) fail(*this, key, fmt::format("'{}' is not a number", v.text));
  return v.numbers.front();
}

double Keys::number_or(std::string_view key, double otherwise) const {
  const Value* v = find(key);
  return v == nullptr || v->numbers.empty() ? otherwise : v->numbers.front();
}

int Keys::integer(std::string_view key) const { return static_cast<int>(number(key)); }

bool Keys::flag(std::string_view key) const { return number(key) != 0; }

Vec3 Keys::vector(std::string_view key) const {
  const std::vector<double>& x = value(key).numbers;
  if (x.size() != 3) fail(*this, key, "three numbers [x, y, z] are wanted");
  return {x[0], x[1], x[2]};
}

const Function& Keys::function(std::string_view key) const {
  const Value& v = value(key);
  if (v.functions.size() != 1) fail(*this, key, fmt::format("'{}' is not a number", v.text));
  return v.functions.front();
}

VectorFunction Keys::vector_function(std::string_view key) const {
  const Value& v = value(key);
  if (v.functions.size() != 3) fail(*this, key, "three items [x, y, z] are wanted");
  VectorFunction f;
  for (std::size_t d = 0; d < 3; ++d) f.component[d] = v.functions[d];
  return f;
}

const std::vector<double>& Keys::numbers(std::string_view key) const { return value(key).numbers; }

std::string Keys::word(std::string_view key) const {
  const Value* v = find(key);
  return v == nullptr || v->words.empty() ? std::string() : v->words.front();
}

const std::vector<std::string>& Keys::words(std::string_view key) const { return value(key).words; }

Keys Keys::map(std::string_view key) const {
  const Value* v = find(key);
  if (v == nullptr) return {nothing(), *mistakes_};
  if (!v->is_map) fail(*this, key, "a map is wanted");
  return {*v, *mistakes_};
}

std::vector<std::string> Keys::names() const {
  std::vector<std::string> list;
  for (const Value& child : map_->children) list.push_back(child.name);
  return list;
}

Location Keys::where(std::string_view key) const {
  const Value* v = find(key);
  return v == nullptr ? map_->where : v->where;
}

void Keys::complain(std::string_view key, const std::string& message) const {
  const std::string path = joined(map_->path, key);
  mistakes_->add(where(key), path.empty() ? message : path + ": " + message);
}

void Keys::complain(const Value& value, const std::string& message) const {
  mistakes_->add(value.where, value.path.empty() ? message : value.path + ": " + message);
}

double Keys::quantity(const Value& item, const Dimension& wanted) const {
  if (item.numbers.size() != 1) {
    const std::string why =
        item.is_map || item.is_list ? "a single number is wanted" : item.trouble;
    complain(item, fmt::format("{}; {}", why, wanted_text(wanted)));
    return 0;
  }
  if (!item.bare && item.dimension != wanted) {
    complain(item, fmt::format("'{}' is {}; {}", item.text, with_article(name_of(item.dimension)),
                               wanted_text(wanted)));
    return 0;
  }
  return item.numbers.front();
}

}  // namespace gannet
