// The keys of a part of shells, and the section that they ask for.
#pragma once

#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "fe/shell.hpp"

namespace gannet {

/// The keys of the map `shell`.
std::vector<Key> shell_keys();

/// The section that the map asks for. Notes what has no meaning beside what else it says.
ShellSection read_shell_section(const Keys& shell, const ElasticPlastic& material);

}  // namespace gannet
