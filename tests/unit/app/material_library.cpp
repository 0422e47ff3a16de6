// The cards of materials/: each reads, names its source, and its curve is sane.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>

#include "app/effects.hpp"
#include "fe/material_curve.hpp"
#include "input/case.hpp"

using namespace gannet;

namespace {

std::unique_ptr<Case> read_card(const std::string& name) {
  return read_case_text(
      "gannet: 1\nmaterials: {" + name + ": {card: " + name + "}}\noutput: {until: 1 s}\n",
      "case.yaml", whole_schema());
}

std::set<std::string> cards() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("materials")) {
    if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
  }
  return names;
}

double slope_at_start(const std::vector<CurvePoint>& curve) {
  return curve[1].stress / curve[1].strain;
}

}  // namespace

TEST_CASE("material library: every card reads and says where its numbers are from", "[app]") {
  const std::set<std::string> names = cards();
  for (const char* wanted :
       {"structural_steel", "ah36", "s355", "al_6061_t6", "al_2024_t3", "al_5083", "copper_ofhc",
        "gate_rubber", "wire_rope", "studless_chain", "r3_mooring_steel"}) {
    CHECK(names.count(wanted) == 1);
  }
  for (const std::string& name : names) {
    INFO(name);
    const auto source = read_card(name);
    const Keys card = source->keys().map("materials").map(name);
    CHECK(card.word("name").size() > 3);
    const std::string from = card.word("source");
    // A year or an address, or the words that there is none.
    const bool cited =
        from.find("19") != std::string::npos || from.find("20") != std::string::npos ||
        from.find("github") != std::string::npos || from.find("MoorPy") != std::string::npos ||
        from.find("card '") != std::string::npos || from.find("that paper") != std::string::npos;
    CHECK((cited || from.find("Without a verifiable source") == 0));
  }
}

TEST_CASE("material library: the curve of every solid is sane", "[app]") {
  for (const std::string& name : cards()) {
    const auto source = read_card(name);
    const Keys card = source->keys().map("materials").map(name);
    if (card.has("eos")) continue;
    INFO(name);
    const ElasticPlastic m = read_elastic_plastic(card);
    CHECK(source->mistakes.empty());
    CHECK((m.rho > 500 && m.rho < 20000));
    for (const bool shell : {false, true}) {
      if (shell && m.hyperelastic()) continue;
      const auto tension =
          material_curve(m, {.to = {0.1}, .rate = 1, .steps = 1000, .shell = shell});
      CHECK(slope_at_start(tension) == Approx(m.E).epsilon(1e-3));
      bool yields = false;
      for (std::size_t k = 1; k < tension.size(); ++k) {
        REQUIRE(std::isfinite(tension[k].stress));
        CHECK(tension[k].stress > tension[k - 1].stress * (1 - 1e-6));
        CHECK(tension[k].plastic_strain >= tension[k - 1].plastic_strain);
        CHECK(tension[k].heating >= tension[k - 1].heating);
        yields = yields || tension[k].plastic_strain > 0;
      }
      CHECK(yields == m.plastic());
      // Metals of ships and aeroplanes: between 100 MPa and 1.5 GPa at 10 %.
      if (m.plastic()) CHECK((tension.back().stress > 1e8 && tension.back().stress < 1.5e9));
      const auto push = material_curve(m, {.to = {-0.05}, .rate = 1, .steps = 500, .shell = shell});
      CHECK(push.back().stress < 0);
      // A rate may only strengthen.
      const auto fast =
          material_curve(m, {.to = {0.05}, .rate = 1e3, .steps = 500, .shell = shell});
      CHECK(fast.back().stress > tension[500].stress * (1 - 1e-2));
    }
  }
}
