#include "study/study_short_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "base/error.hpp"

namespace gannet {

namespace {

bool ends_with_name(const std::string& path, const std::string& name) {
  return path.size() > name.size() + 1 && path.ends_with("." + name);
}

/// Paths below a value that end with the name; only such as the user wrote, or all.
void find_values(const Value& at, const std::string& path, const std::string& name, bool given,
                 std::vector<std::string>& found) {
  for (const Value& child : at.children) {
    if (child.name.empty() || (path.empty() && (child.name == "study" || child.name == "hard"))) {
      continue;
    }
    const std::string whole = path.empty() ? child.name : path + "." + child.name;
    if (ends_with_name(whole, name) && (child.given || !given)) found.push_back(whole);
    if (child.is_map) find_values(child, whole, name, given, found);
  }
}

const Value* child_of(const Value* map, const std::string& name) {
  if (map == nullptr) return nullptr;
  for (const Value& child : map->children) {
    if (child.name == name) return &child;
  }
  return nullptr;
}

/// Paths that the language knows at the places that the case has: names of the user's are those of
/// the case.
void find_keys(const Key& at, const Value* value, const std::string& path, const std::string& name,
               std::vector<std::string>& found) {
  for (const Key& key : at.keys) {
    if (path.empty() && (key.name == "study" || key.name == "hard")) continue;
    std::vector<std::string> names{key.name};
    if (key.name == "*") {
      names.clear();
      if (value != nullptr) {
        for (const Value& child : value->children) names.push_back(child.name);
      }
    }
    for (const std::string& one : names) {
      const std::string whole = path.empty() ? one : path + "." + one;
      if (ends_with_name(whole, name)) found.push_back(whole);
      find_keys(key, child_of(value, one), whole, name, found);
    }
  }
}

}  // namespace

std::string whole_key(const std::string& name, const Key& language, const Value& root) {
  const std::string first = name.substr(0, name.find('.'));
  const auto is_first = [&](const auto& key) { return key.name == first; };
  if (std::any_of(language.keys.begin(), language.keys.end(), is_first)) return name;
  std::vector<std::string> found;
  find_values(root, "", name, true, found);
  if (found.empty()) find_values(root, "", name, false, found);
  if (found.empty()) find_keys(language, &root, "", name, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  if (found.empty()) return name;
  if (found.size() == 1) return found.front();
  throw std::invalid_argument(fmt::format("'{}' may be {}; write more of the one that is meant",
                                          name, fmt::join(found, " or ")));
}

void complete_keys(const Key& language, const Value& root, StudySpec& spec) {
  std::vector<std::string> mistakes;
  const auto complete = [&](const std::string& key) {
    try {
      return whole_key(key, language, root);
    } catch (const std::invalid_argument& e) {
      mistakes.push_back(fmt::format("study: {}", e.what()));
      return key;
    }
  };
  const auto complete_setting = [&](std::string& text) {
    const std::size_t equals = std::min(text.find('='), text.size());
    text = complete(text.substr(0, equals)) + text.substr(equals);
  };
  for (StudyAxis& axis : spec.axes) {
    if (axis.sets.empty()) axis.key = complete(axis.key);
    for (auto& set : axis.sets) std::ranges::for_each(set, complete_setting);
  }
  for (std::string& text : spec.set) complete_setting(text);
  if (!spec.refine.empty()) spec.refine = complete(spec.refine);
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (spec.axes[k].key != spec.axes[i].key) continue;
      mistakes.push_back(fmt::format("study: {} is varied twice", spec.axes[i].key));
    }
  }
  if (!mistakes.empty()) throw InputError(mistakes);
}

}  // namespace gannet
