// Kernels that reach the limits of the machine, compiled once per instruction set.
#pragma once

namespace gannet {

#define GANNET_MACHINE_KERNELS                                                             \
  /* n rounds of independent fused multiply-adds; returns the operations made. */          \
  double burn_fma_f64(long n, double* sink);                                               \
  double burn_fma_f32(long n, float* sink);                                                \
  /* a = b + s c over n doubles; returns the bytes moved as the loop names them (24 n). */ \
  double triad(double* a, const double* b, const double* c, double s, long n);

namespace avx2 {
GANNET_MACHINE_KERNELS
}
namespace avx512 {
GANNET_MACHINE_KERNELS
}
#undef GANNET_MACHINE_KERNELS

}  // namespace gannet
