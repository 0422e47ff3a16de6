// Short names of keys: the end of a path stands for the whole where only one key has it.
#pragma once

#include <string>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "study/study.hpp"

namespace gannet {

/// "let.dx" for "dx", "effects.xsph" for "xsph": the one key whose path ends so. Keys that the case
/// gives come first, then those that it leaves at their defaults. A name that begins at the top of
/// the language, or that nothing ends with, stays as it is.
/// language: the whole language as one map; root: the case read. Throws std::invalid_argument that
/// lists the keys where there are several.
std::string whole_key(const std::string& name, const Key& language, const Value& root);

/// Puts whole keys in the place of short ones: axes, settings and the refined key. Throws
/// InputError with what was asked for.
void complete_keys(const Key& language, const Value& root, StudySpec& spec);

}  // namespace gannet
