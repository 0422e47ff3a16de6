// The case language: the tables of keys of all effects, merged into one tree of keys.
#pragma once

#include <string>
#include <vector>

#include "base/schema.hpp"

namespace gannet {

inline constexpr int language_version = 1;  ///< `gannet: 1`
inline constexpr int card_version = 1;      ///< `gannet_card: 1`

/// Top-level keys that are set aside for what gannet is to read.
const std::vector<std::string>& reserved_keys();

/// The whole language as one map: gannet, title, let, the reserved keys (a map without keys where
/// no entry fills one), and every entry of the schema at its place. Maps of the same name are
/// merged; so are the choices of keys of the same name and kind.
/// Throws std::logic_error where two tables give a key two kinds or two units.
Key language(const Schema& schema);

/// The key of that name in a map, or the one for names that the user chooses, or nullptr.
const Key* find_key(const Key& map, const std::string& name);

/// True where the user chooses the names in a map.
bool has_user_names(const Key& map);

/// The names of a map's keys, without the one for names that the user chooses.
std::vector<std::string> key_names(const Key& map);

/// "length, > 0": what a key wants, in short.
std::string summary(const Key& key);
/// "a length is wanted (m, mm, ft, ...)": for a value that is missing or of the wrong kind.
std::string wanted_text(const Key& key);
/// "> 0", "in [0, 1]", "" for no limits; in SI.
std::string text_of(const Limits& limits);

}  // namespace gannet
