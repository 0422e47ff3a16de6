// Whole runs of mooring lines: end forces at rest, a fairlead that moves, what stays as it is.
#include <algorithm>
#include <ctime>
#include <numbers>
#include <numeric>

#include "fe/mooring.hpp"
#include "fe/mooring_start.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Lines at rest and their end forces, from the closed forms of Irvine 1981 (Cable Structures) and
/// Jonkman 2007 (NREL/TP-500-41958, eqs. 2-35 to 2-38).
struct Known {
  double X, Z, L, EA, w, CB, T_fair, T_anchor;
};

const Known known[] = {{900, 310, 1000, 1335962276, 422.8177465, 0, 371256.4351, 240212.923},
                       {930, 310, 1000, 1335962276, 422.8177465, 0, 656248.2647, 525232.6962},
                       {955, 310, 1000, 1335962276, 422.8177465, 0, 5762736.981, 5632220.095},
                       {700, 200, 760, 1674000000, 3323.249867, 0, 2070110.868, 1406150.292},
                       {400, 50, 410, 1674000000, 3323.249867, 0, 1001665.153, 835593.7931},
                       {848.67, 250, 902.2, 384243000, 698.3330095, 0, 911382.8359, 737173.2979},
                       {1200, 900, 1480, 60000000, 245.25, 0, 1134202.104, 917186.9579},
                       {930, 310, 1000, 1335962276, 422.8177465, 0.5, 656254.3029, 510549.1931}};

/// One known line; w as that of a line in water.
std::string case_of(const Known& k, int n, const std::string& more = "") {
  const double g = 9.80665;
  const double d = 0.1;
  const double mass = k.w / g + 1025 * 0.25 * std::numbers::pi * d * d;
  return fmt::format(
      "gannet: 1\n"
      "moorings: {{line: {{from: [{} m, 0, 0], to: [0, 0, {} m], length: {} m, EA: {}, "
      "mass_per_length: {:.15g}, diameter: {}, elements: {}, water: {{}}, bed: {{friction: "
      "{}}}}}}}\n"
      "loads: {{gravity: [0, 0, -{} m/s^2]}}\n"
      "output: {{until: 1 s}}\n{}",
      k.X, -k.Z, k.L, k.EA, mass, d, n, k.CB, g, more);
}

double tension(const Simulation& s, int end) {
  return measured(s.scene, "mooring.line.tension", end);
}

}  // namespace

TEST_CASE("physics: mooring lines start at rest and stay there", "[physics]") {
  for (const Known& k : known) {
    const auto s = make_simulation_of_text(case_of(k, 80));
    advance(s->models);
    const double start = tension(*s, 0);
    WARN(fmt::format("X = {} m: fairlead {:+.4f} %, anchor {:+.4f} %", k.X,
                     100 * (start / k.T_fair - 1), 100 * (tension(*s, 1) / k.T_anchor - 1)));
    CHECK(start == Approx(k.T_fair).epsilon(2e-4));
    // Weight of the half element next to the anchor hangs on the anchor, and its friction holds it.
    CHECK(tension(*s, 1) == Approx(k.T_anchor).epsilon(k.CB > 0 ? 3e-3 : 3e-4));
    for (int n = 0; n < 1000; ++n) advance(s->models);
    CHECK(tension(*s, 0) == Approx(start).epsilon(1e-6));
    CHECK(energy_error(*s) < 1e-8);
  }
}

TEST_CASE("physics: tension at rest does not know the step", "[physics]") {
  double last = 0;
  for (const double scale : {1.0, 0.5, 0.1}) {
    const auto s = make_simulation_of_text(
        case_of(known[0], 80, fmt::format("effects: {{time_step: {{scale: {}}}}}\n", scale)));
    run_until(*s, 5, [] {});
    const double now = tension(*s, 0);
    if (last > 0) CHECK(now == Approx(last).epsilon(1e-7));
    last = now;
  }
}

TEST_CASE("physics: eight lines are in equilibrium at once", "[physics]") {
  std::string text = "gannet: 1\nmoorings:\n";
  for (int k = 0; k < 8; ++k) {
    text += fmt::format(
        "  line_{0}: {{from: [\"20*cos({0}*pi/4)\", \"20*sin({0}*pi/4)\", 0], to: "
        "[\"920*cos({0}*pi/4)\", \"920*sin({0}*pi/4)\", -310 m], length: 1000 m, EA: 1336 MN, "
        "mass_per_length: 49.6, diameter: 90 mm, elements: 80, water: {{}}, bed: {{}}}}\n",
        k);
  }
  text += "loads: {gravity: [0, 0, -9.80665 m/s^2]}\noutput: {until: 1 s}\n";
  const std::clock_t start = std::clock();  // of the processor: others may keep it busy
  const auto s = make_simulation_of_text(text);
  for (int n = 0; n < 10; ++n) advance(s->models);
  const double took = double(std::clock() - start) / CLOCKS_PER_SEC;
  double speed = 0;
  for (const Line& v : s->scene.nodes.v) speed = std::max(speed, xyz(v).norm());
  WARN(fmt::format("eight lines in equilibrium after {:.3f} s, largest speed {:.1e} m/s", took,
                   speed));
  CHECK(speed < 1e-6);
  CHECK(took < 0.5);
}

TEST_CASE("physics: in a current a line starts bent and at rest", "[physics]") {
  Known k = known[0];
  auto text = case_of(k, 40);
  text.replace(text.find("water: {}"), 9, "water: {current: [0, 1.5 m/s, 0], Cdt: 0.05}");
  const auto s = make_simulation_of_text(text);
  advance(s->models);
  const double start = tension(*s, 0);
  CHECK(std::abs(measured(s->scene, "mooring.line.force", 1)) > 1000);
  for (int n = 0; n < 2000; ++n) advance(s->models);
  CHECK(tension(*s, 0) == Approx(start).epsilon(1e-6));
}

namespace {

/// A run of a case of cases/mooring_line against a table of time and tension [N], from t = `from`
/// on; about_mean: after the mean of each is taken from it.
struct Compared {
  double range = 0;
  double mean = 0;     ///< difference of the means over that of the table
  double rms = 0;      ///< over the range
  double largest = 0;  ///< over the range
};

Compared compare(const std::string& file, const std::vector<std::string>& set,
                 const std::vector<std::vector<double>>& table, std::size_t column, double from,
                 double shift, bool last_element, bool about_mean) {
  const auto s = make_simulation(file, set);
  const TrussBlock& block = s->scene.store.get<MooringLines>().list.front().block;
  Curve own;
  const double until = table.back()[0] + shift;
  Index top = 0;  // the element at the upper end
  for (Index e = 0; e < block.n_elements(); ++e) {
    const auto& ids = s->scene.parts[static_cast<std::size_t>(block.part)].cell_id;
    if (ids[static_cast<std::size_t>(e)] > ids[static_cast<std::size_t>(top)]) top = e;
  }
  run_until(*s, until, [&] {
    const double T = last_element ? block.value(top, truss_force)
                                  : measured(s->scene, "mooring.line_1.tension", 0);
    own.add(time_of(*s) - s->models.list.front().step.dt_old, T);
  });
  std::vector<double> off;
  std::vector<double> there;
  for (const auto& row : table) {
    if (row[0] < from) continue;
    there.push_back(row[column]);
    off.push_back(own.at(row[0] + shift) - row[column]);
  }
  const auto mean = [](const std::vector<double>& y) {
    return std::accumulate(y.begin(), y.end(), 0.0) / static_cast<double>(y.size());
  };
  Compared c;
  const auto [low, high] = std::minmax_element(there.begin(), there.end());
  c.range = *high - *low;
  c.mean = mean(off) / mean(there);
  const double shared = about_mean ? mean(off) : 0;
  for (const double d : off) {
    c.rms += (d - shared) * (d - shared) / static_cast<double>(off.size());
    c.largest = std::max(c.largest, std::abs(d - shared) / c.range);
  }
  c.rms = std::sqrt(c.rms) / c.range;
  CHECK(energy_error(*s) < 2e-3);
  return c;
}

}  // namespace

TEST_CASE("physics: a fairlead in surge pulls as in MoorDyn", "[physics]") {
  const std::string folder = "cases/mooring_line/";
  const auto table = read_table(folder + "reference.csv");
  for (const int k : {1, 2}) {
    const std::vector<std::string> set = {fmt::format("let.X={} m", k == 1 ? 930 : 945),
                                          fmt::format("let.A={} m", k == 1 ? 2 : 1)};
    const Compared c =
        compare(folder + "case.yaml", set, table, static_cast<std::size_t>(k), 30, 0, true, false);
    WARN(fmt::format("surge of {} m: off by {:.2f} % of the range at most, rms {:.2f} %", 3 - k,
                     100 * c.largest, 100 * c.rms));
    CHECK(c.largest < 0.02);
  }
}

TEST_CASE("physics: chains under heave pull as in OrcaFlex", "[physics]") {
  const std::string folder = "cases/mooring_line/";
  const auto table = read_table(folder + "chain_reference.csv");
  const std::vector<std::vector<std::string>> set = {
      {"let.X=400 m", "let.Z=50 m", "let.L=410 m", "let.A=2 m"},
      {"let.X=700 m", "let.Z=200 m", "let.L=760 m", "let.A=5 m"}};
  for (std::size_t k = 0; k < 2; ++k) {
    const Compared c = compare(folder + "chain.yaml", set[k], table, k + 1, 0, 10, false, true);
    WARN(fmt::format("chain {}: {:.2f} % of the range at most, rms {:.2f} %, means {:+.2f} %", k,
                     100 * c.largest, 100 * c.rms, 100 * c.mean));
    // The reference starts from 991.6 kN where the closed form has 1001.7 kN.
    CHECK(std::abs(c.mean) < 0.015);
    CHECK(c.largest < 0.05);
    CHECK(c.rms < 0.03);
  }
}

TEST_CASE("moorings: a line of a type has the properties of its size", "[physics]") {
  const auto s = make_simulation_of_text(R"case(gannet: 1
moorings:
  line: {from: [0, 0, 0], to: [700 m, 0, -200 m], length: 750 m, elements: 20, type: chain, nominal: 84 mm, water: {Can: 0.9}, bed: {}}
loads: {gravity: [0, 0, -9.81 m/s^2]}
output: {until: 1 s}
)case");
  const MooringLine& line = s->scene.store.get<MooringLines>().list.front();
  CHECK(line.block.mu == Approx(20e3 * 0.084 * 0.084));
  CHECK(line.block.EA == Approx(85.6e9 * 0.084 * 0.084 - 3.93e7 * std::pow(0.084, 3)));
  CHECK(line.diameter == Approx(1.8 * 0.084));
  CHECK(line.water.Cdn == 1.333);
  CHECK(line.water.Can == 0.9);  // said by the case
  CHECK(line.water.Cat == 0.5);
}
