// "Did you mean": the known word nearest to a mistyped one, and how lists of words are written.
#pragma once

#include <string>
#include <vector>

namespace gannet {

/// Number of letters to insert, delete, replace or swap with their neighbour that turns a into b
/// (optimal string alignment distance).
int edit_distance(const std::string& a, const std::string& b);

/// The known word that is nearest to `word`, or "" where none is near: at most a third of the
/// letters may differ, two in short words, and at least one letter must agree.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// "; did you mean 'thickness'?", or "" where no known word is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

/// "a, b, c", or "none".
std::string comma_list(const std::vector<std::string>& words);

}  // namespace gannet
