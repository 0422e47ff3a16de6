// The whole case as text again: defaults and cards written out, formulas worked out, numbers in SI.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/keys.hpp"

namespace gannet {

/// A map as YAML that reads back into the same values. Comments, white space, units and the places
/// of things do not show in it; the order of keys does. Top-level keys in `without` are left out.
std::string resolved_text(const Value& root, const std::vector<std::string>& without = {});

/// FNV-1a hash (64 bits) of a text: h = (h xor byte) * 0x100000001b3 from 0xcbf29ce484222325.
std::uint64_t fnv1a(const std::string& text);

}  // namespace gannet
