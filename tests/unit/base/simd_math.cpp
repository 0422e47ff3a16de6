// The logarithm and the exponential of vectors against those of long double. The AVX2 form is
// tested here; elements of both instruction sets are held against scalar laws in unit/fe.
#define GANNET_ISA_NS avx2_tested
#include "base/simd_math.hpp"
//
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

TEST_CASE("simd math: logarithm and exponential to the last bit but one", "[base]") {
  using namespace gannet::avx2_tested;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> wide(-690, 690);
  std::uniform_real_distribution<double> narrow(-1, 1);
  double log_error = 0;
  double exp_error = 0;
  for (int i = 0; i < 40000; ++i) {
    alignas(64) double a[8];
    alignas(64) double out[8];
    for (double& x : a) x = i % 2 == 0 ? wide(random) : narrow(random);
    exp_of(Vec8::load(a)).store(out);
    for (int k = 0; k < 8; ++k) {
      const long double exact = std::exp(static_cast<long double>(a[k]));
      exp_error = std::max(exp_error, static_cast<double>(std::abs(out[k] / exact - 1)));
    }
    for (double& x : a) x = std::exp(x);
    log_of(Vec8::load(a)).store(out);
    for (int k = 0; k < 8; ++k) {
      const long double exact = std::log(static_cast<long double>(a[k]));
      log_error = std::max(log_error, static_cast<double>(std::abs(out[k] / exact - 1)));
    }
  }
  CAPTURE(log_error, exp_error);
  CHECK(log_error < 2.3e-16);  // 1.6e-16 reached: half a unit in the last place is 1.1e-16
  CHECK(exp_error < 2.3e-16);  // 1.7e-16
  alignas(64) double one[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  alignas(64) double out[8];
  log_of(Vec8::load(one)).store(out);
  CHECK(out[3] == 0);
  exp_of(Vec8(0.0)).store(out);
  CHECK(out[3] == 1);
}
