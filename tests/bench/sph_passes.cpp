// How long the pair passes, the list build and the sort take:
//   bench_sph_passes [particles ...]
// on a jittered lattice in 3D, h = 1.3 dx, skin 0.26 dx, one thread. GANNET_ISA chooses the set.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "base/isa.hpp"
#include "base/parallel.hpp"
#include "search/spatial_sort.hpp"
#include "sph/pair_pass.hpp"

namespace gannet {

namespace {

/// Seconds of one call: the median of repeated calls, and the shortest.
struct Time {
  double median = 0;
  double shortest = 0;
};

/// Processor time of this thread [s], which what else runs on the machine does not stretch.
double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Time time_of(const std::function<void()>& call) {
  call();
  std::vector<double> seconds;
  const double begin = cpu_seconds();
  while (seconds.size() < 7 || cpu_seconds() < begin + 0.5) {
    const double start = cpu_seconds();
    call();
    seconds.push_back(cpu_seconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front()};
}

struct Water {
  Array<Line> x, v, f, f_viscous, X;
  Array<double> rho, p, drho_dt;
};

Water jittered_cube(int n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  Water w;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        w.x.push_back({i + 0.15 * u(random), j + 0.15 * u(random), k + 0.15 * u(random), 1000});
        w.v.push_back({u(random), u(random), u(random), 0.001});
        w.rho.push_back(1000 + 2 * u(random));
        w.p.push_back(1e4 * u(random));
      }
    }
  }
  std::shuffle(w.x.begin(), w.x.end(), random);
  return w;
}

}  // namespace

/// Prints the rates of all passes for about n particles.
void time_pair_passes(int n) {
  const int side = static_cast<int>(std::lround(std::cbrt(n)));
  Water w = jittered_cube(side);
  const auto size = static_cast<Index>(w.x.size());
  Array<Index> order;
  auto sort = [&] {
    spatial_order(w.x, 1.0, order);
    Array<Line> x(w.x.size());
    for (Index k = 0; k < size; ++k) x[k] = w.x[order[k]];
    w.x.swap(x);
  };
  sort();
  for (Array<Line>* lines : {&w.f, &w.f_viscous, &w.X}) lines->resize(w.x.size());
  w.drho_dt.resize(w.x.size());

  PairParameters k{
      .dimension = 3, .h = 1.3, .m = 1000, .c0 = 30, .alpha = 0.05, .beta = 0.1, .epsilon = 0.5};
  ClusterList list;
  build_cluster_list(w.x, size, 2.6 + 0.26, list);
  Packed packed;
  Packed single;
  single.single = true;
  const ParticleView view{w.x.data(), w.v.data(), w.rho.data(), w.p.data(), size};
  pack_particles(view, 2.6, packed);
  pack_particles(view, 2.6, single);
  const RatesOut rates{w.drho_dt.data(), nullptr};
  const RatesOut rates_xsph{w.drho_dt.data(), w.X.data()};
  const ForceOut force{w.f.data(), nullptr};
  const ForceOut force_viscous{w.f.data(), w.f_viscous.data()};

  fmt::print("{} particles, {}, {:.1f} entries a particle\n", size, name_of(isa()),
             static_cast<double>(list.offset.back()) / size);
  auto report = [&](const std::string& name, const Time& t) {
    fmt::print("  {:28} {:8.2f} M/s (best {:6.2f}) {:9.3f} ms\n", name, 1e-6 * size / t.median,
               1e-6 * size / t.shortest, 1e3 * t.median);
  };
  report("rates", time_of([&] { pair_rates(list, packed, k, rates); }));
  report("rates with XSPH", time_of([&] { pair_rates(list, packed, k, rates_xsph); }));
  report("force", time_of([&] { pair_force(list, packed, k, force); }));
  report("force with viscosity", time_of([&] { pair_force(list, packed, k, force_viscous); }));
  report("fused", time_of([&] { pair_fused(list, packed, k, rates, force_viscous); }));
  report("rates, single", time_of([&] { pair_rates(list, single, k, rates); }));
  report("rates with XSPH, single", time_of([&] { pair_rates(list, single, k, rates_xsph); }));
  report("force, single", time_of([&] { pair_force(list, single, k, force); }));
  report("force with viscosity, single",
         time_of([&] { pair_force(list, single, k, force_viscous); }));
  report("fused, single", time_of([&] { pair_fused(list, single, k, rates, force_viscous); }));
  for (const auto& [name, type] : {std::pair{"Wendland C2", KernelType::wendland_c2},
                                   std::pair{"Wendland C4", KernelType::wendland_c4}}) {
    k.kernel = type;
    report(fmt::format("rates, {}", name), time_of([&] { pair_rates(list, packed, k, rates); }));
    report(fmt::format("force with viscosity, {}", name),
           time_of([&] { pair_force(list, packed, k, force_viscous); }));
  }
  report("pack", time_of([&] { pack_particles(view, 2.6, packed); }));
  report("pack, single", time_of([&] { pack_particles(view, 2.6, single); }));
  report("list build", time_of([&] { build_cluster_list(w.x, size, 2.6 + 0.26, list); }));
  report("order of sorted particles", time_of([&] { spatial_order(w.x, 1.0, order); }));
}

}  // namespace gannet

int main(int n_arguments, char** arguments) {
  gannet::set_threads(1);
  std::vector<int> sizes;
  for (int k = 1; k < n_arguments; ++k) sizes.push_back(std::stoi(arguments[k]));
  if (sizes.empty()) sizes = {100000, 1000000};
  for (const int n : sizes) gannet::time_pair_passes(n);
}
