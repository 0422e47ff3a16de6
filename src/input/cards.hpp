// Material cards: `materials.water: {card: water}` reads materials/water.yaml, whose keys act as if
// they stood in the case; keys given beside `card` win.
#pragma once

#include <string>
#include <vector>

#include "base/keys.hpp"
#include "input/text_tree.hpp"

namespace gannet {

/// Folders that may hold cards, nearest first: the case's own, `materials/` in it and in every
/// folder above it, $GANNET_MATERIALS, and the library that came with the program.
std::vector<std::string> card_folders(const std::string& case_folder);

/// Writes the keys of its card into every material of the case that names one. Notes unknown
/// cards (listing those that exist), files that are no cards, and syntax errors.
void merge_cards(TextNode& root, const std::string& case_folder, Mistakes& mistakes);

}  // namespace gannet
