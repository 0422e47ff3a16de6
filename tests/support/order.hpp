// The order that two errors show.
#pragma once

#include <cmath>

namespace gannet::test {

/// Order p of errors of spacings dx and dx/2: log2 |coarse/fine|.
inline double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

}  // namespace gannet::test
