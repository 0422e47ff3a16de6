#include "plan/vote_of_part.hpp"

#include <algorithm>

namespace gannet {

bool casts_vote_of(const Operation& op, const std::string& part) {
  if (!op.stable_dt) return false;
  const bool owned = std::ranges::find(op.owns, part + ".state") != op.owns.end();
  return owned || op.name.starts_with(part + ":");
}

double vote_of_part(const Plan& plan, const std::string& part) {
  double dt = std::numeric_limits<double>::infinity();
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : plan.at(static_cast<Stage>(s))) {
      if (casts_vote_of(op, part)) dt = std::min(dt, op.stable_dt());
    }
  }
  return dt;
}

}  // namespace gannet
