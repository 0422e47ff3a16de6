// Mooring lines of a case: drafts at rest, state, operations, measures.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fe/cable_part.hpp"
#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "fe/mooring_keys.hpp"
#include "fe/mooring_start.hpp"
#include "fe/mooring_types.hpp"
#include "plan/model_of_part.hpp"
#include "scene/bonds.hpp"
#include "scene/tracked_values.hpp"

namespace gannet {

namespace {
namespace mooring {

/// Notes a mistake of a line at the length that the case gives it, or where its file is named.
void complain(const Keys& root, const MooringLine& line, const std::string& text) {
  const Keys moorings = root.map("moorings");
  if (moorings.has(line.name)) {
    moorings.map(line.name).complain("length", text);
  } else {
    moorings.complain("file", line.name + ": " + text);
  }
}

PartDraft draft_of(const MooringLine& line, std::vector<Vec3> points) {
  PartDraft part;
  part.name = line.name;
  part.kind = "cable";
  part.material = line.material;
  part.where = line.where;
  part.cell = Cell::line;
  part.points = std::move(points);
  for (Index k = 0; k < line.n; ++k) {
    part.connectivity.insert(part.connectivity.end(), {k, k + 1});
  }
  return part;
}

void add_parts(const Keys& root, Draft& draft) {
  for (const MooringLine& line : read_moorings(root)) {
    LineStart start = start_of(line, gravity_of(root));
    if (root.has("parts") && root.map("parts").has(line.name)) {
      start.trouble = "'" + line.name + "' is the name of a part too";
    }
    if (start.trouble.empty()) {
      draft.parts.push_back(draft_of(line, std::move(start.x)));
    } else {
      complain(root, line, start.trouble);
    }
  }
}

/// The nodes of a part in the order of its draft.
std::vector<Index> nodes_in_order(const Scene& scene, const Part& part) {
  std::vector<Index> nodes(static_cast<std::size_t>(part.nodes.size()));
  for (Index i = part.nodes.begin; i < part.nodes.end; ++i) {
    nodes[static_cast<std::size_t>(scene.nodes.id[static_cast<std::size_t>(i)] - 1 -
                                   part.nodes.begin)] = i;
  }
  return nodes;
}

/// Where friction holds the nodes: displaced from them by what it carries at the start.
void stick(MooringLine& line, const LineStart& start) {
  const std::size_t all = line.stuck.size() / 2;
  for (std::size_t lane = 0; lane < all; ++lane) {
    const std::size_t k = std::min(lane, start.x.size() - 1);
    const double l = line.state[place_in_blocks(static_cast<Index>(k), line_length, line_values)];
    const double stiffness = line.bed.stiffness * line.diameter * l;
    const Vec3 at = start.x[k] + start.friction[k] / stiffness;
    line.stuck[lane] = at.x();
    line.stuck[all + lane] = at.y();
  }
}

void track_line(Scene& scene, MooringLine& line) {
  track_cable(scene, line.block, "moorings");
  const auto values = [&](const char* name, const char* unit, int n, double* at) {
    track_values(scene, "moorings", line.name + "." + name, unit, n, [at] { return at; });
  };
  values("extremes", "N", 4, line.extremes.data());
  values("begun", "", 1, &line.begun);
  if (line.bed.friction > 0) {
    values("stuck", "m", static_cast<int>(line.stuck.size()), line.stuck.data());
  }
}

void add_measures(Scene& scene, const MooringLine& line) {
  add_cable_measures(scene, line.block);
  const std::string name = "mooring." + line.name;
  scene.measures.push_back({name + ".tension", "N", {"from", "to"}, [&line](double* out) {
                              for (std::size_t e = 0; e < 2; ++e)
                                out[e] = line.ends[1 - e].force.norm();
                            }});
  scene.measures.push_back({name + ".force",
                            "N",
                            {"from x", "from y", "from z", "to x", "to y", "to z"},
                            [&line](double* out) {
                              for (std::size_t e = 0; e < 2; ++e) {
                                for (int c = 0; c < 3; ++c) *out++ = line.ends[1 - e].force[c];
                              }
                            }});
  scene.measures.push_back(
      {.name = name + ".extremes",
       .unit = "N",
       .components = {"from largest", "from smallest", "to largest", "to smallest"},
       .sample =
           [&line](double* out) {
             const auto& e = line.extremes;
             const double values[] = {e[2], e[3], e[0], e[1]};
             std::copy(std::begin(values), std::end(values), out);
           },
       .at_end = true});
}

/// At the line, or at the file that it is from.
void complain_of(const Keys& root, const MooringLine& line, const std::string& text) {
  const Keys moorings = root.map("moorings");
  if (moorings.has(line.name)) {
    moorings.map(line.name).complain("", text);
  } else {
    moorings.complain("file", line.name + ": " + text);
  }
}

/// An end that is held does not hang on a body too.
void check_ends(const Keys& root, const Scene& scene, const MooringLine& line) {
  for (std::size_t e = 0; e < 2; ++e) {
    const LineEnd& end = line.ends[e];
    for (const PartGroup& group : scene.groups) {
      const bool tied = std::ranges::find(group.nodes, end.node) != group.nodes.end();
      if (!end.held || !tied) continue;
      complain_of(root, line,
                  fmt::format("its end '{0}' is held, and tied to '{1}': say free: [{0}]",
                              e == 0 ? "to" : "from", group.name));
    }
    const Bonds* bonds = scene.store.find<Bonds>();
    if (bonds == nullptr) continue;
    for (const Bond& bond : bonds->list) {
      if (!end.held || std::ranges::find(bond.nodes, end.node) == bond.nodes.end()) continue;
      complain_of(root, line,
                  fmt::format("its end '{0}' is held, and tied by '{1}': say free: [{0}]",
                              e == 0 ? "to" : "from", bond.name));
    }
  }
}

void make_state(const Keys& root, MooringLine made, Scene& scene) {
  const int number = scene.part_number(made.name);
  if (number < 0) return;
  MooringLine& line = scene.store.get<MooringLines>().list.emplace_back(std::move(made));
  const Part& part = scene.parts[static_cast<std::size_t>(number)];
  line.block.name = part.name;
  line.block.part = number;
  line.block.ends = part.connectivity;
  try {
    rest_at_present_length(line.block, scene.nodes);
  } catch (const std::invalid_argument& e) {
    complain_of(root, line,
                fmt::format("{}: where the line lies in folds its start is not found; "
                            "shorten it, or move its ends apart",
                            e.what()));
    return;
  }
  add_truss_masses(line.block, scene.nodes);
  set_line_nodes(line, nodes_in_order(scene, part));
  if (line.bed.friction > 0) stick(line, start_of(line, gravity_of(root)));
  track_line(scene, line);
  add_measures(scene, line);
}

void state(const Keys& root, Scene& scene) {
  for (MooringLine& line : read_moorings(root)) make_state(root, std::move(line), scene);
}

/// The entries of the ledger that a line has; nullptr where it has none.
struct Entries {
  LedgerEntry* buoyancy = nullptr;
  LedgerEntry* drag = nullptr;
  LedgerEntry* current = nullptr;
  LedgerEntry* added = nullptr;
  LedgerEntry* bed = nullptr;
  LedgerEntry* friction = nullptr;
  LedgerEntry* ends = nullptr;
};

Entries entries_of(Ledger& ledger, const MooringLine& line) {
  Entries e;
  const auto entry = [&](const char* name, bool external) {
    LedgerEntry& made = ledger.entry(name, line.name);
    made.external = external;
    return &made;
  };
  if (line.water.density > 0) {
    e.buoyancy = entry("buoyancy", true);
    e.drag = entry("drag", false);
    e.added = entry("added mass", false);
    if (line.water.flows) e.current = entry("current", true);
  }
  if (line.bed.there) {
    e.bed = entry("bed", false);
    if (line.bed.friction > 0) e.friction = entry("friction", false);
  }
  if (line.ends[0].held || line.ends[1].held) e.ends = entry("ends", true);
  return e;
}

Work work_of(const double halves[2]) { return {halves[0], halves[1]}; }

void look(MooringLine& line, Scene& scene, const Step& step, const Entries& to) {
  const LineSums sums = line_work(line, scene.nodes, scene.gravity, step);
  if (to.buoyancy != nullptr) {
    to.buoyancy->add_work(work_of(sums.buoyancy));
    to.drag->add_work(work_of(sums.current) - work_of(sums.drag));
    to.added->add_work(-work_of(sums.added));
  }
  if (to.current != nullptr) to.current->add_work(work_of(sums.current));
  if (to.bed != nullptr) to.bed->add_work(-work_of(sums.bed));
  if (to.friction != nullptr) to.friction->add_work(-work_of(sums.friction));
  if (to.ends == nullptr) return;
  Work work = Work::Zero();
  for (const LineEnd& end : line.ends) {
    if (end.held) work += work_along(work_path(scene.nodes, end.node, step), end.reaction);
  }
  to.ends->add_work(work);
}

void add_line(const Keys& root, Scene& scene, Models& models, MooringLine& line) {
  const std::string reason = asked_for_at(line.where);
  Model& model = model_of_part(scene, models, line.block.part);
  add_cable_operation(root, scene, models, line.block, reason);
  const Entries entries = entries_of(models.ledger, line);
  model.plan.add(
      {.name = "water and bed of " + line.name,
       .reason = reason,
       .stage = Stage::accelerate,
       .reads = {"x", "v"},
       .writes = {"f"},
       .run = [&scene,
               &line](const Step& step) { line_forces(line, scene.nodes, scene.gravity, step); },
       .stable_dt = [&line] { return bed_step(line); },
       .limited_by = [&line] { return line.name + ": the bed"; }});
  if (line.ends[0].held || line.ends[1].held) {
    model.plan.add(
        {.name = "ends of " + line.name,
         .reason = reason,
         .stage = Stage::kick,
         .writes = {"v", "f"},
         .run = [&scene, &line](const Step& step) { hold_ends(line, scene.nodes, step); }});
  }
  model.plan.add(
      {.name = "work on " + line.name,
       .reason = reason,
       .stage = Stage::look,
       .reads = {"v", "f"},
       .run = [&scene, &line, entries](const Step& step) { look(line, scene, step, entries); }});
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<MooringLines>()) return;
  for (MooringLine& line : scene.store.get<MooringLines>().list) {
    check_ends(root, scene, line);
    add_line(root, scene, models, line);
  }
}

/// What follows from the type and size of a line.
void add_choices_of_type(const Keys& keys, const MooringLine& line, std::vector<Choice>& list) {
  const MooringType* type = type_of_line(keys);
  if (type == nullptr) return;
  const double d = keys.number("nominal");
  const std::string rule = fmt::format("{} of {:g} mm, which breaks at {:.4g} N at least",
                                       type->name, 1e3 * d, breaking_load(*type, d));
  const auto add = [&](const char* key, double value, const char* unit) {
    list.push_back({keys.path() + "." + key, fmt::format("{:.4g} {}", value, unit), rule});
  };
  add("EA", line.block.EA, "N");
  add("mass_per_length", line.block.mu, "kg/m");
  add("diameter", line.diameter, "m");
}

std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (!scene.store.has<MooringLines>()) return list;
  for (const MooringLine& line : scene.store.get<MooringLines>().list) {
    if (root.map("moorings").has(line.name)) {
      add_choices_of_type(root.map("moorings").map(line.name), line, list);
    }
    if (!line.bed.there || !root.map("moorings").has(line.name)) continue;
    const Keys bed = root.map("moorings").map(line.name).map("bed");
    if (!bed.given("stiffness")) {
      list.push_back({bed.path() + ".stiffness", fmt::format("{:.4g} Pa/m", line.bed.stiffness),
                      "a line at rest sinks in by a tenth of its diameter"});
    }
    if (!bed.given("damping")) {
      list.push_back({bed.path() + ".damping", fmt::format("{:.4g} Pa*s/m", line.bed.damping),
                      "critical for a line that bounces on the bed"});
    }
  }
  return list;
}

}  // namespace mooring
}  // namespace

Effect moorings_effect() {
  return {.name = "moorings",
          .schema = mooring_schema,
          .parts = mooring::add_parts,
          .state = mooring::state,
          .operations = mooring::operations,
          .choices = mooring::choices};
}

}  // namespace gannet
