// The gravity of the tests.
#pragma once

namespace gannet::test {

inline constexpr double g = 9.81;  // [m/s^2]

}  // namespace gannet::test
