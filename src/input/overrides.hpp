// Values from the command line that replace those of the file: `--set let.dx=8mm`.
#pragma once

#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "input/text_tree.hpp"

namespace gannet {

/// Writes each "key.path=value" into the text of a case. The value is YAML, and its place is the
/// option itself ("--set let.dx=8mm"), so that a later complaint names it. Missing maps are made,
/// but not a new thing under a map of the user's names: that is a mistyped name. "off" for a map
/// takes it out of the case ("effects.xsph=off"), "on" keeps it or makes one of defaults. The end
/// of a path stands for the whole where only one key has it: "dx" for "let.dx".
void apply_overrides(TextNode& root, const Key& language, const std::vector<std::string>& overrides,
                     Mistakes& mistakes);

}  // namespace gannet
