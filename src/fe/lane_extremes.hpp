// Out of eight lanes, each with the block that its number is of: the extreme one and its element.
// For *.isa.cpp files only.
#pragma once

#include "base/simd.hpp"

namespace gannet::GANNET_ISA_NS {

/// The largest of eight numbers where one is above `value`, else nothing changes; the first of
/// equal ones. element: 8 block + lane.
GANNET_INLINE void take_largest(Vec8 numbers, Vec8 blocks, double& value, std::int32_t& element) {
  alignas(64) double number[8];
  alignas(64) double block[8];
  numbers.store(number);
  blocks.store(block);
  for (int lane = 0; lane < 8; ++lane) {
    if (!(number[lane] > value)) continue;
    value = number[lane];
    element = 8 * static_cast<std::int32_t>(block[lane]) + lane;
  }
}

/// The same of the smallest, where one is below `value`.
GANNET_INLINE void take_smallest(Vec8 numbers, Vec8 blocks, double& value, std::int32_t& element) {
  double negative = -value;
  take_largest(-numbers, blocks, negative, element);
  value = -negative;
}

}  // namespace gannet::GANNET_ISA_NS
