#include "input/resolved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace gannet {

namespace {

/// Words that need no quotes; everything else gets them.
bool is_plain(const std::string& word) {
  return !word.empty() && (std::isalpha(static_cast<unsigned char>(word[0])) != 0) &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
         });
}

std::string word_text(const std::string& word) {
  if (is_plain(word)) return word;
  std::string quoted = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n') {
      quoted += "\\n";
    } else if (c == '\t') {
      quoted += "\\t";
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

/// The shortest text that reads back to the same bits, with its SI unit.
std::string number_text(double x, const Dimension& dimension) {
  const std::string number = fmt::format("{}", x == 0 ? 0.0 : x);
  return dimension == dim::none ? number : number + " " + si_unit_of(dimension);
}

std::string text_of_scalar(const Value& v) {
  switch (v.kind) {
    case Kind::flag:
      return v.numbers.at(0) != 0 ? "yes" : "no";
    case Kind::path:
      return word_text(v.text);
    case Kind::any:
      // A word that is also the name of a number stays a word.
      if (v.numbers.empty() || is_plain(v.text)) return word_text(v.text);
      return number_text(v.numbers.front(), v.dimension);
    default:
      break;
  }
  if (!v.words.empty()) return word_text(v.words.front());
  return v.numbers.empty() ? "\"\"" : number_text(v.numbers.front(), v.dimension);
}

std::string inline_text(const Value& v);

std::string list_text(const Value& v) {
  std::vector<std::string> items;
  for (const Value& child : v.children) items.push_back(inline_text(child));
  for (const double x : v.numbers) items.push_back(number_text(x, v.dimension));
  for (const std::string& word : v.words) items.push_back(word_text(word));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

/// A formula as it stands; constants and tables by their numbers.
std::string function_text(const Function& f, const std::string& word) {
  if (!word.empty()) return word_text(word);
  return f.formula ? word_text(f.text) : f.text;
}

std::string functions_text(const Value& v) {
  if (v.kind == Kind::function && v.functions.empty()) return text_of_scalar(v);
  std::vector<std::string> items;
  for (std::size_t k = 0; k < v.functions.size(); ++k) {
    items.push_back(function_text(v.functions[k], k < v.words.size() ? v.words[k] : ""));
  }
  if (v.kind == Kind::function) return items.front();
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string inline_text(const Value& v) {
  if (v.kind == Kind::function || v.kind == Kind::vector_function) return functions_text(v);
  if (v.is_list) return list_text(v);
  if (!v.is_map) return text_of_scalar(v);
  std::vector<std::string> items;
  for (const Value& child : v.children) {
    items.push_back(word_text(child.name) + ": " + inline_text(child));
  }
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}

void write_map(const Value& map, int depth, std::string& out) {
  for (const Value& child : map.children) {
    out += std::string(static_cast<std::size_t>(2 * depth), ' ') + word_text(child.name) + ":";
    if (child.is_map && child.kind == Kind::map && !child.children.empty()) {
      out += "\n";
      write_map(child, depth + 1, out);
    } else {
      out += " " + inline_text(child) + "\n";
    }
  }
}

}  // namespace

std::string resolved_text(const Value& root, const std::vector<std::string>& without) {
  Value kept = root;
  std::erase_if(kept.children, [&](const Value& child) {
    return std::find(without.begin(), without.end(), child.name) != without.end();
  });
  std::string out;
  write_map(kept, 0, out);
  return out;
}

std::uint64_t fnv1a(const std::string& text) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    h ^= static_cast<unsigned char>(c);
    h *= 0x100000001b3ULL;
  }
  return h;
}

}  // namespace gannet
