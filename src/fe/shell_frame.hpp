// The frame of a shell element, for what is done with it outside of the kernels.
#pragma once

#include <span>

#include "base/math.hpp"
#include "fe/shell.hpp"

namespace gannet {

/// e1, e2, e3 as columns, and the area [m^2]: the same frame as in the kernels.
struct ElementFrame {
  Mat3 axes;
  double area = 0;
};

/// Of element e at positions x [m]. Where it has no area the axes are no numbers. Throws nothing.
ElementFrame frame_of(const ShellBlock& block, Index e, std::span<const Line> x);

}  // namespace gannet
