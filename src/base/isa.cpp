#include "base/isa.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace gannet {

namespace {
bool has_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
}

Isa choose() {
  const char* forced = std::getenv("GANNET_ISA");
  const std::string wanted = forced == nullptr ? "" : forced;
  if (wanted.empty()) return has_avx512() ? Isa::avx512 : Isa::avx2;
  if (wanted == "avx2") return Isa::avx2;
  if (wanted == "avx512" && has_avx512()) return Isa::avx512;
  throw std::runtime_error("GANNET_ISA=" + wanted + ": allowed here: avx2" +
                           (has_avx512() ? ", avx512" : ""));
}
}  // namespace

Isa isa() {
  static const Isa set = choose();
  return set;
}

std::string_view name_of(Isa set) { return set == Isa::avx512 ? "avx512" : "avx2"; }

}  // namespace gannet
