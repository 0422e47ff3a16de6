#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "contact/effects.hpp"
#include "contact/node_to_segment.hpp"
#include "input/case.hpp"
#include "scene/particle_material.hpp"
#include "scene/surface_data.hpp"
#include "scenes.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A plate (t = 4 mm, E = 70 GPa) and water (dx = 10 mm, c0 = 50 m/s), a floor, and what a case
/// says of contacts.
struct Contacted {
  std::unique_ptr<Case> input;
  Scene scene;
  std::unique_ptr<Run> run;

  explicit Contacted(const std::string& contacts) {
    input = read_case_text("gannet: 1\ncontacts:\n  slam: " + contacts + "\n", "case.yaml",
                           contacts_effect().schema());
    Builder b;
    b.particles = {{0.5, 0.5, 0.5}};
    b.particle_mass = 1e-3;
    b.fill(scene);
    scene.planes.push_back({"tank.z_min", {0, 0, -1}, {0, 0, 1}, {}});
    scene.store.get<ParticleMaterials>().of_part = {{}, {0.01, 1000, 50}};
    scene.store.get<SurfaceData>().of_part = {{0.004, 70e9}};
    contacts_effect().state(input->keys(), scene);
    run = std::make_unique<Run>(scene, nullptr, 1e-6);
    contacts_effect().operations(input->keys(), scene, run->models);
  }
  NodeToSegment& first() { return scene.store.get<NodeToSegments>().list.at(0); }
  /// The one mistake, as its user sees it.
  std::string mistake() const {
    const auto all = input->mistakes.messages();
    return all.size() == 1 ? all[0] : std::to_string(all.size()) + " mistakes";
  }
};

bool has(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("contacts: defaults follow from the two parts, in either order", "[contact]") {
  for (const char* between : {"{between: [water, plate]}", "{between: [plate, water]}"}) {
    Contacted c(between);
    REQUIRE(c.input->mistakes.empty());
    CHECK(c.first().range.contact == Approx(0.007));       // 4 mm/2 + 10 mm/2
    CHECK(c.first().law.rate2 == Approx(25e6));            // (50/0.01)^2
    CHECK(c.first().law.stiffness(1e-3) == Approx(25e3));  // rho0 c0^2 dx
    CHECK(c.first().law.stiffest == Approx(0.1 * 280e6));  // 0.1 E t
    CHECK(c.first().law.friction == 0);
    CHECK(c.scene.field("contact.slam.tangential") == nullptr);
    for (const LedgerEntry& e : c.run->models.ledger.entries()) CHECK(e.name != "friction");
  }
}

TEST_CASE("contacts: keys override", "[contact]") {
  Contacted c(
      "{between: [water, plate], thickness: 3 mm, stiffness: 0.5, friction: 0.2, damping: 0.1}");
  REQUIRE(c.input->mistakes.empty());
  CHECK(c.first().range.contact == Approx(0.003));
  CHECK(c.first().law.rate2 == Approx(12.5e6));
  CHECK(c.first().law.friction == 0.2);
  CHECK(c.first().law.damping == 0.1);
  CHECK(c.scene.field("contact.slam.tangential") != nullptr);
}

TEST_CASE("contacts: mistakes name the parts there are", "[contact]") {
  CHECK(has(Contacted("{between: [water, hull]}").mistake(),
            "no part 'hull'; parts are: plate, water"));
  CHECK(has(Contacted("{between: [water]}").mistake(), "1 names; two are wanted"));
  CHECK(has(Contacted("{between: [water, tank]}").mistake(), "particles meet all planes"));
  CHECK(has(Contacted("{between: [water, water]}").mistake(), "are not a part of particles"));
  CHECK(Contacted("{between: [plate, tank], friction: 0.1}").input->mistakes.empty());
  CHECK_THROWS_AS(Contacted("{between: [water, plate], friction: -1}"), InputError);
}

TEST_CASE("contacts: without contacts there is nothing", "[contact]") {
  auto input = read_case_text("gannet: 1\n", "case.yaml", contacts_effect().schema());
  Scene scene;
  Builder b;
  b.particles = {{0.5, 0.5, 0.5}};
  b.fill(scene);
  contacts_effect().state(input->keys(), scene);
  Run run(scene, nullptr, 1e-6);
  const auto n = run.model().plan.at(Stage::force).size();
  contacts_effect().operations(input->keys(), scene, run.models);
  CHECK(run.model().plan.at(Stage::force).size() == n);
  CHECK(scene.fields.empty());
  CHECK(scene.measures.empty());
}
