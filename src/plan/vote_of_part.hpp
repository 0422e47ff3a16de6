// The step that the elements of one part allow.
#pragma once

#include "plan/plan.hpp"

namespace gannet {

/// Whether an operation casts the vote of the elements of a part: it owns "NAME.state", or its name
/// begins with "NAME:".
bool casts_vote_of(const Operation& op, const std::string& part);

/// The smallest such vote [s], as of the last force stage; infinite where there is none.
double vote_of_part(const Plan& plan, const std::string& part);

}  // namespace gannet
