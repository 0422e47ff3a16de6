// The axes of a study and the settings that they span.
#pragma once

#include <string>
#include <vector>

#include "base/keys.hpp"
#include "study/study.hpp"

namespace gannet {

/// Reads "let.dx=8mm,4mm,2mm". Commas within brackets do not part values: "elements=[8, 8],[16,
/// 16]". Throws std::invalid_argument that says what is wanted.
StudyAxis parse_axis(const std::string& text);

/// All combinations of one value an axis, the last axis running fastest; one empty combination
/// where there are no axes.
std::vector<std::vector<std::string>> combinations(const std::vector<StudyAxis>& axes);

/// "key=value" for each axis, or what the chosen variant sets.
std::vector<std::string> overrides_of(const std::vector<StudyAxis>& axes,
                                      const std::vector<std::string>& choices);

/// The value at a key path of a resolved case, or nullptr.
const Value* value_at(const Value& root, const std::string& path);

/// Sizes along an axis: the numbers themselves, or 1/number where all are whole numbers (elements a
/// side). Empty where some number is not above 0 or two are the same.
std::vector<double> sizes_of(const std::vector<double>& numbers);

/// True where an axis is a resolution by itself: a length, or a key that ends in dx, spacing or
/// elements.
bool is_resolution(const std::string& key, const Dimension& dimension);

}  // namespace gannet
