// The instruction set, chosen once at start from what the processor has. Kernels that gain from
// wide vectors are compiled once per set, from files named *.isa.cpp, into namespaces avx2 and
// avx512; such files include no Eigen and no standard containers, and take plain pointers, so that
// no inline function compiled for one set can be linked into the other.
#pragma once

#include <string_view>

namespace gannet {

enum class Isa { avx2, avx512 };

/// The instruction set in use: the widest that the processor has, or what GANNET_ISA forces.
/// Throws std::runtime_error where GANNET_ISA names a set that is unknown or missing here.
Isa isa();

std::string_view name_of(Isa set);

/// Calls KERNEL(...) in the namespace of the instruction set in use.
#define GANNET_DISPATCH(KERNEL, ...)                                      \
  (::gannet::isa() == ::gannet::Isa::avx512 ? avx512::KERNEL(__VA_ARGS__) \
                                            : avx2::KERNEL(__VA_ARGS__))

}  // namespace gannet
