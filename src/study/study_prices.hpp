// What accuracy costs, in plain sentences.
#pragma once

#include <string>
#include <vector>

#include "study/study_analysis.hpp"

namespace gannet {

/// What an error of at most `target` costs.
struct StudyPrice {
  enum class From { measured, fitted, nothing };
  From from = From::nothing;
  std::size_t point = no_point;  ///< measured: the cheapest setting
  double wall = unknown;         ///< [s]
  double h = unknown;            ///< fitted: size along the refined key
  std::size_t series = no_point;
  std::string why;  ///< nothing: why not
};

/// The cheapest run within the target, the reference itself left out; where there is none, what
/// the fitted order and the growth of the wall time predict, the cheapest series first. A fit is
/// believed where its 95 % interval lies above 0; a predicted size is never coarser than the finest
/// one that missed the target.
StudyPrice price_of(const StudyResult& result, const MeasureResult& m, double target);

/// What 5 %, 2 % and 1 % cost, a sentence each, in which it is said whether it was measured. Where
/// there is a problem, that alone.
std::vector<std::string> price_sentences(const StudyResult& result, const MeasureResult& m);

}  // namespace gannet
