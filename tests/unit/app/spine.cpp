// A free rigid body hung on a stiff truss, with a soft slow spring below it: two models at ratio 8
// through the same clock, plan, ledger and checkpoint as everything else.
//
//   anchor o
//          |  8 truss elements        fast model: truss, body
//        [body]
//          |  soft spring             slow model: spring, weight
//          o weight
#include <catch2/catch.hpp>
#include <cmath>

#include "body/rigid_body.hpp"
#include "fe/truss.hpp"
#include "output/checkpoint.hpp"
#include "plan/link.hpp"
#include "scene/draft.hpp"
#include "support/temporary_folder.hpp"
#include "time/energy_balance.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

constexpr Index centre = 0;
constexpr Index top = 1;
constexpr Index bottom = 2;
constexpr Index n_elements = 8;
constexpr Index anchor = bottom + n_elements;
constexpr Index weight = anchor + 1;

PartDraft nodes_of(const char* name, bool rotations, std::vector<Vec3> points) {
  PartDraft part;
  part.name = name;
  part.kind = "nodes";
  part.rotations = rotations;
  part.cell = Cell::line;
  part.points = std::move(points);
  return part;
}

/// Adds gravity to the nodes of a model, with its work.
void add_weight(Scene& scene, Model& model, Ledger& ledger) {
  const Vec3 g{0, 0, -9.81};
  const Range r = model.ranges.front();
  LedgerEntry& entry = ledger.entry("gravity", model.name);
  entry.external = true;
  model.plan.add({.name = "gravity", .stage = Stage::force, .run = [&scene, r, g](const Step&) {
                    for (Index i = r.begin; i < r.end; ++i) {
                      add_xyz(scene.nodes.f[i], scene.nodes.x[i].w * g);
                    }
                  }});
  model.plan.add({.name = "work of gravity",
                  .stage = Stage::look,
                  .run = [&scene, &entry, r, g](const Step& s) {
                    Work work = Work::Zero();
                    for (Index i = r.begin; i < r.end; ++i) {
                      work += scene.nodes.x[i].w * work_along(work_path(scene.nodes, i, s), g);
                    }
                    entry.add_work(work);
                  }});
}

struct HungBody {
  Scene scene;
  Models models;
  TrussBlock truss;
  TrussBlock spring;
  Link link;
  EnergyBalance balance;
  double largest_error = 0;
  double largest_total = 0;

  HungBody() {
    place_nodes();
    make_truss();
    finish_masses(scene);
    scene.nodes.v[anchor].w = 0;  // held
    scene.nodes.v[centre] = {0.3, 0.1, 0, scene.nodes.v[centre].w};
    make_rigid_body(scene, {.name = "body",
                            .node = centre,
                            .members = {top, bottom},
                            .mass = 50,
                            .inertia = Vec3(2, 3, 4).asDiagonal(),
                            .omega = {0.2, 0.1, 0.5}});
    make_models();
  }

  void place_nodes() {
    // The body is 0.4 m high and hangs 2 m below the anchor; the weight hangs 1 m below it.
    Draft draft;
    draft.parts = {nodes_of("body", true, {{0, 0, 0}}), nodes_of("rest", false, {})};
    auto& points = draft.parts[1].points;
    points = {{0, 0, 0.2}, {0, 0, -0.2}};
    for (Index k = 1; k <= n_elements; ++k) points.push_back({0, 0, 0.2 + 0.25 * k});
    points.push_back({0.05, 0, -1.2});
    assemble(draft, scene);
    // assemble() orders nodes along a curve; the test wants them as listed.
    for (std::size_t k = 0; k < points.size(); ++k) set_xyz(scene.nodes.x[1 + k], points[k]);
  }

  void make_truss() {
    truss = {.name = "truss", .EA = 2e6, .mu = 4.0, .dt_factor = 0.8};
    for (Index k = 1; k <= n_elements; ++k) {
      const Index last = k == 1 ? top : bottom + k - 1;
      truss.ends.insert(truss.ends.end(), {last, bottom + k});
    }
    rest_at_present_length(truss, scene.nodes);
    add_truss_masses(truss, scene.nodes);
    spring = {.name = "spring", .EA = 1500, .mu = 0.05, .ends = {bottom, weight}};
    rest_at_present_length(spring, scene.nodes);
    scene.nodes.x[weight].w = 5;
  }

  void make_models() {
    Model& slow = models.list.emplace_back();
    slow.name = "slow";
    slow.ranges = {{weight, weight + 1}};
    Model& fast = models.list.emplace_back();
    fast.name = "fast";
    fast.ranges = {{0, weight}};
    for (Model& m : models.list) add_leapfrog(scene, m, models.ledger);

    link = {.name = "body and spring", .slow = &slow, .fast = &fast, .nodes = {bottom}};
    open_link(scene, link);
    add_truss_operations(scene, slow, models.ledger, spring);
    close_link(scene, link, models.ledger);
    add_truss_operations(scene, fast, models.ledger, truss);
    for (Model& m : models.list) add_weight(scene, m, models.ledger);
    // The slow step is eight fast ones: l0/c = 0.25 / sqrt(EA/mu), times the factor 0.8.
    const double fast_dt = 0.8 * 0.25 / std::sqrt(truss.EA / truss.mu);
    slow.plan.add({.name = "ratio 8",
                   .stage = Stage::force,
                   .run = [](const Step&) {},
                   .stable_dt = [fast_dt] { return 7.99 * fast_dt; }});
    add_rigid_body_operations(scene, fast, models.ledger,
                              scene.store.get<RigidBodies>().list.front());
    fast.plan.add({.name = "balance", .stage = Stage::look, .run = [this](const Step& s) {
                     if (!s.coincides) return;
                     balance.update(models.ledger);
                     largest_error = std::max(largest_error, std::abs(balance.imbalance));
                     largest_total = std::max(largest_total, models.ledger.held());
                   }});
  }
};

}  // namespace

TEST_CASE("spine: two models at ratio 8 keep their levels, look and momentum", "[app][models]") {
  HungBody world;
  for (int k = 0; k < 100; ++k) advance(world.models);
  CHECK(world.models.list[0].step.n == 100);
  CHECK(world.models.list[1].step.n == 800);
  CHECK(world.models.list[0].step.t == world.models.list[1].step.t);
  // The body never deforms: its members keep their distance.
  const Vec3 across = xyz(world.scene.nodes.x[top]) - xyz(world.scene.nodes.x[bottom]);
  CHECK(across.norm() == Approx(0.4).epsilon(1e-14));
}

TEST_CASE("spine: energy of the hung body stays bounded over 10^5 coarse steps", "[app][models]") {
  HungBody world;
  double early = 0;
  for (int k = 0; k < 100000; ++k) {
    advance(world.models);
    if (k == 10000) early = world.largest_error;
  }
  WARN("largest imbalance " << world.largest_error << " J of " << world.largest_total
                            << " J held at most; after a tenth of the time " << early << " J; link "
                            << world.models.ledger.entry("link", "body and spring").value << " J");
  CHECK(world.largest_error < 0.01 * world.largest_total);
  // Bounded: ten times the time does not bring ten times the error.
  CHECK(world.largest_error < 2 * early);
}

TEST_CASE("spine: a checkpoint of two models goes on with the same bits", "[app][models]") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/checkpoint.h5";
  HungBody whole;
  for (int k = 0; k < 300; ++k) advance(whole.models);
  RunRecord record;
  write_checkpoint(path, whole.scene, whole.models, record);
  for (int k = 0; k < 300; ++k) advance(whole.models);

  HungBody resumed;
  RunRecord again;
  read_checkpoint(path, resumed.scene, resumed.models, again);
  for (int k = 0; k < 300; ++k) advance(resumed.models);
  for (Index i = 0; i < whole.scene.nodes.n_owned; ++i) {
    CHECK(xyz(whole.scene.nodes.x[i]) == xyz(resumed.scene.nodes.x[i]));
    CHECK(xyz(whole.scene.nodes.v[i]) == xyz(resumed.scene.nodes.v[i]));
  }
  CHECK(whole.models.ledger.held() == resumed.models.ledger.held());
  CHECK(whole.models.ledger.external() == resumed.models.ledger.external());
}
