// Out of the lanes of a vector, each with the block that its number is of: the extreme one and its
// element. For *.isa.cpp files only.
#pragma once

#include "base/simd_vec.hpp"

namespace gannet::GANNET_ISA_NS {

/// The largest number of the lanes where one is above `value`, else nothing changes; the first of
/// equal ones. first: lane of a block that the vector begins with. element: 8 block + lane.
template <class V>
GANNET_INLINE void take_largest(V numbers, V blocks, int first, double& value,
                                std::int32_t& element) {
  constexpr int n = sizeof(V) / sizeof(double);
  alignas(64) double number[n];
  alignas(64) double block[n];
  numbers.store(number);
  blocks.store(block);
  for (int lane = 0; lane < n; ++lane) {
    if (!(number[lane] > value)) continue;
    value = number[lane];
    element = 8 * static_cast<std::int32_t>(block[lane]) + first + lane;
  }
}

/// The same of the smallest, where one is below `value`.
template <class V>
GANNET_INLINE void take_smallest(V numbers, V blocks, int first, double& value,
                                 std::int32_t& element) {
  double negative = -value;
  take_largest(-numbers, blocks, first, negative, element);
  value = -negative;
}

}  // namespace gannet::GANNET_ISA_NS
