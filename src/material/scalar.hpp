// What a constitutive law needs of a number besides + - * /, for one double. Laws are templates
// over the number; the vector of eight doubles brings its own functions of the same names.
// For files compiled per instruction set: no includes, every function inlined.
#pragma once

namespace gannet {

__attribute__((always_inline)) inline bool less(double a, double b) { return a < b; }
__attribute__((always_inline)) inline double select(bool m, double yes, double no) {
  return m ? yes : no;
}
__attribute__((always_inline)) inline bool any(bool m) { return m; }
__attribute__((always_inline)) inline double rsqrt(double a) { return 1.0 / __builtin_sqrt(a); }
__attribute__((always_inline)) inline double reciprocal(double a) { return 1.0 / a; }
__attribute__((always_inline)) inline double log_of(double a) { return __builtin_log(a); }
__attribute__((always_inline)) inline double exp_of(double a) { return __builtin_exp(a); }

}  // namespace gannet
