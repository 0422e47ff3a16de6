// Shells as a case asks for them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/math.hpp"
#include "fe/effects.hpp"
#include "fe/shell.hpp"
#include "input/case.hpp"
#include "scene/draft.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

const std::string head = "gannet: 1\nmaterials:\n  skin: ";
const std::string aluminium = "{density: 2700, young: 70 GPa, poisson: 0.3, yield_stress: 276 MPa}";
const std::string panel =
    "\nparts:\n  panel:\n    shell: {material: skin, thickness: 3 mm}\n"
    "    shape: {plate: {size: [600 mm, 400 mm], elements: [6, 5]}}\n"
    "    initial_velocity: [0, 0, -2 m/s]\n";

struct Built {
  std::unique_ptr<Case> source;
  Scene scene;
  Models models;
};

std::unique_ptr<Built> build(const std::string& text) {
  auto built = std::make_unique<Built>();
  const Effect shell = shell_effect();
  built->source = read_case_text(text, "case.yaml", shell.schema());
  const Keys root = built->source->keys();
  Draft draft;
  shell.parts(root, draft);
  built->source->mistakes.throw_if_any();
  assemble(draft, built->scene);
  shell.state(root, built->scene);
  built->source->mistakes.throw_if_any();
  finish_masses(built->scene);
  Model& model = built->models.list.emplace_back();
  model.ranges = {{0, built->scene.nodes.n_owned}};
  add_leapfrog(built->scene, model, built->models.ledger);
  shell.operations(root, built->scene, built->models);
  return built;
}

std::string mistakes_of(const std::string& text) {
  try {
    build(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("shell effect: a plate becomes nodes, masses, fields and one operation", "[fe]") {
  const auto b = build(head + aluminium + panel);
  const Scene& scene = b->scene;
  CHECK(scene.nodes.n_owned == 42);
  CHECK(scene.nodes.rotating == Range{0, 42});
  double mass = 0;
  for (const Line& x : scene.nodes.x) mass += x.w;
  CHECK(mass == Approx(2700 * 0.003 * 0.24).epsilon(1e-13));
  const ShellBlock& block = b->scene.store.get<ShellBlocks>().list.front();
  CHECK(block.n_elements == 30);
  CHECK(block.section.points == 5);
  for (const char* name :
       {"panel.state", "panel.thickness", "panel.stress", "panel.plastic_strain"}) {
    CAPTURE(name);
    const Field* field = scene.field(name);
    REQUIRE(field != nullptr);
    CHECK(field->count() == 30);
    CHECK(field->checkpoint == (std::string(name) == "panel.state"));
  }
  const Field* thickness = scene.field("panel.thickness");
  CHECK(*reinterpret_cast<const double*>(thickness->at(29)) == 0.003);
  CHECK(scene.field("panel.state")->components == block.layout.n_values());
}

TEST_CASE("shell effect: free flight strains nothing, and who limits the step is named", "[fe]") {
  const auto b = build(head + aluminium + panel);
  Scene& scene = b->scene;
  Model& model = b->models.list.front();
  Model* const level[] = {&model};
  for (int k = 0; k < 20; ++k) step(level);
  CHECK(b->models.ledger.entry("internal", "panel").value == Approx(0).margin(1e-20));
  CHECK(scene.nodes.v[7].z == Approx(-2).epsilon(1e-14));
  CHECK(model.vote.limited_by().find("panel: element") == 0);
  // An elastic wave of 6.1 km/s, sqrt(E/((1 - nu) rho)), and elements of 80 mm: 13 us times 0.9.
  CHECK(model.step.dt == Approx(0.9 * 0.08 / std::sqrt(70e9 / (0.7 * 2700))).epsilon(0.02));
}

TEST_CASE("shell effect: a ringing panel keeps momentum and, to order 2, energy",
          "[fe][convergence]") {
  const auto error = [&](double dt_factor) {
    const auto b = build(head + aluminium + panel);
    Scene& scene = b->scene;
    b->scene.store.get<ShellBlocks>().list.front().section.dt_factor = dt_factor;
    for (std::size_t i = 0; i < scene.nodes.v.size(); ++i) {
      scene.nodes.v[i].z += 20 * scene.nodes.x[i].x * scene.nodes.x[i].y;
    }
    const auto momentum = [&] {
      Vec3 p = Vec3::Zero();
      for (std::size_t i = 0; i < scene.nodes.v.size(); ++i) {
        p += scene.nodes.x[i].w * xyz(scene.nodes.v[i]);
      }
      return p;
    };
    const Vec3 before = momentum();
    Model& model = b->models.list.front();
    Model* const level[] = {&model};
    step(level);
    const double start = b->models.ledger.held();
    double worst = 0;
    double most_internal = 0;
    while (model.step.t < 0.02) {
      step(level);
      worst = std::max(worst, std::abs(b->models.ledger.held() - start));
      most_internal = std::max(most_internal, b->models.ledger.entry("internal", "panel").value);
    }
    CHECK(most_internal > 0.1);
    CHECK((momentum() - before).norm() < 1e-12 * before.norm());
    const Field* stress = scene.field("panel.stress");
    REQUIRE(stress->prepare);
    stress->prepare();
    CHECK(std::abs(*reinterpret_cast<const double*>(stress->at(14, 3))) > 1);
    return worst / most_internal;
  };
  // The leapfrog keeps E - sum m a^2 dt^2/8: what the ledger shows swings by that and stays.
  const double coarse = error(0.8);
  const double fine = error(0.4);
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.05);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.3));
}

TEST_CASE("shell effect: elastic shells take three points unless told", "[fe]") {
  const std::string elastic = head + "{density: 2700, young: 70 GPa, poisson: 0.3}" + panel;
  auto b = build(elastic);
  CHECK(b->scene.store.get<ShellBlocks>().list.front().section.points == 3);
  CHECK(b->scene.field("panel.plastic_strain") == nullptr);
  CHECK(b->scene.store.get<ShellBlocks>().list.front().layout.per_point == 3);
}

TEST_CASE("shell effect: a mesh of quadrilaterals and triangles is one part", "[fe]") {
  const auto file = std::filesystem::temp_directory_path() / "gannet_mixed.msh";
  std::ofstream(file) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n"
                         "3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n$Elements\n3\n"
                         "1 2 2 1 1 2 3 6\n2 3 2 1 1 1 2 5 4\n3 2 2 1 1 2 6 5\n$EndElements\n";
  const auto b = build(head + aluminium +
                       "\nparts:\n  panel:\n    shell: {material: skin, thickness: 3 mm, "
                       "section_forces: yes}\n    mesh: {file: " +
                       file.string() + "}\n    map: [\"0.1*x\", \"0.1*y\", \"0.01*x^2\"]\n");
  std::filesystem::remove(file);
  Scene& scene = b->scene;
  const auto& blocks = scene.store.get<ShellBlocks>().list;
  REQUIRE(blocks.size() == 2);
  CHECK(blocks[0].n_elements == 1);
  CHECK(blocks[1].n_elements == 2);
  CHECK(scene.field("panel.state")->count() == 1);
  CHECK(scene.field("panel.triangles.state")->count() == 2);
  CHECK(scene.field("panel.stress")->count() == 3);
  CHECK(scene.field("panel.membrane_force")->components == 6);
  // Each triangle gives a third of its mass to a corner: 2.7 kg/dm^3, 3 mm, half a square of 0.1 m
  // that rises by 0.01 (1 and 4 - 1 times).
  const Part& part = scene.parts.front();
  double mass = 0;
  for (const Line& x : scene.nodes.x) mass += x.w;
  const double flat = std::sqrt(0.01 + 0.0001);
  const double steep = std::sqrt(0.01 + 0.0009);
  CHECK(mass == Approx(2700 * 0.003 * 0.1 * (flat + steep)).epsilon(1e-12));
  // Stretch along y: every cell shows the stress of uniaxial strain.
  for (Line& v : scene.nodes.v) v = {0, 0, 0, v.w};
  for (std::size_t i = 0; i < scene.nodes.x.size(); ++i) {
    scene.nodes.v[i].y = 10 * scene.nodes.x[i].y;
  }
  Model& model = b->models.list.front();
  Model* const level[] = {&model};
  step(level);
  step(level);
  const Field* stress = scene.field("panel.stress");
  stress->prepare();
  const double first = *reinterpret_cast<const double*>(stress->at(0, 1));
  CHECK(first > 1e5);
  for (Index c = 0; c < part.n_cells(); ++c) {
    CHECK(*reinterpret_cast<const double*>(stress->at(c, 1)) == Approx(first).epsilon(1e-9));
  }
  CHECK(model.vote.limited_by().find("panel: element") == 0);
}

TEST_CASE("shell effect: a plate may be cut into triangles", "[fe]") {
  std::string cut = panel;
  cut.insert(cut.find("[6, 5]") + 6, ", triangles: yes");
  const auto b = build(head + aluminium + cut);
  const auto& blocks = b->scene.store.get<ShellBlocks>().list;
  REQUIRE(blocks.size() == 1);
  CHECK(blocks.front().section.kind == ShellKind::triangle);
  CHECK(blocks.front().n_elements == 60);
  double mass = 0;
  for (const Line& x : b->scene.nodes.x) mass += x.w;
  CHECK(mass == Approx(2700 * 0.003 * 0.24).epsilon(1e-13));
}

TEST_CASE("shell effect: points of a part may be moved by formulas", "[fe][errors]") {
  CHECK(mistakes_of(head + aluminium + panel + "    map: [x, y, \"1/(x - x)\"]\n")
            .find("parts.panel.map: is not finite at") != std::string::npos);
}

TEST_CASE("shell effect: the material cards give their numbers", "[fe][material]") {
  auto b = build(head + "{card: al_6061_t6}" + panel);
  const ElasticPlastic al = b->scene.store.get<ShellBlocks>().list.front().material;
  CHECK(al.rho == 2700);
  CHECK(al.E == Approx(68.9e9));
  CHECK(al.nu == 0.33);
  CHECK(al.sigma_y == Approx(276e6));
  CHECK(al.H == 0);
  b = build(head + "{card: steel}" + panel);
  const ElasticPlastic steel = b->scene.store.get<ShellBlocks>().list.front().material;
  CHECK(steel.rho == 7800);
  CHECK(steel.E == Approx(210e9));
  CHECK(steel.nu == 0.3);
  CHECK_FALSE(steel.plastic());
}

TEST_CASE("shell effect: what a solid lacks is named", "[fe][errors]") {
  const std::string none = mistakes_of(head + "{density: 2700, hardening_modulus: 1 GPa}" + panel);
  CHECK(none.find("materials.skin.young: missing; a solid needs Young's modulus") !=
        std::string::npos);
  CHECK(none.find("materials.skin.poisson: missing") != std::string::npos);
  CHECK(none.find("materials.skin.hardening_modulus: has no meaning without yield_stress") !=
        std::string::npos);
}
