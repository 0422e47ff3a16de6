// gannet material: stress over strain of a material card.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/commands.hpp"
#include "app/effects.hpp"
#include "base/error.hpp"
#include "base/units.hpp"
#include "fe/material_curve.hpp"
#include "input/case.hpp"
#include "output/files.hpp"
#include "study/svg_plot.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

/// One curve and what it is called in the picture.
struct NamedCurve {
  std::string name;
  std::vector<CurvePoint> points;
};

/// A case of one material, read from the card: a name in the library, or a file.
std::unique_ptr<Case> case_of_card(const MaterialOptions& options, std::string& name) {
  const fs::path file(options.card);
  const bool is_file = file.extension() == ".yaml";
  if (is_file && !fs::is_regular_file(file)) {
    throw InputError(fmt::format("there is no card {}", options.card));
  }
  name = is_file ? file.stem().string() : options.card;
  const std::string text =
      fmt::format("gannet: 1\nmaterials: {{{0}: {{card: {0}}}}}\noutput: {{until: 1 s}}\n", name);
  std::vector<std::string> overrides;
  for (const std::string& o : options.set) overrides.push_back("materials." + name + "." + o);
  return read_case_text(text, (file.parent_path() / "case.yaml").string(), whole_schema(),
                        overrides);
}

double quantity_of(const std::string& text, const Dimension& wanted, const char* option) {
  try {
    const Quantity q = parse_quantity(text);
    if (q.bare || q.dimension == wanted) return q.value;
  } catch (const std::invalid_argument& e) {
    throw InputError(fmt::format("{} {}: {}", option, text, e.what()));
  }
  throw InputError(fmt::format("{} {}: {}", option, text, wanted_text(wanted)));
}

StrainPath path_of(const std::string& word) {
  if (word == "uniaxial") return StrainPath::uniaxial;
  if (word == "biaxial") return StrainPath::biaxial;
  if (word == "plane") return StrainPath::plane;
  if (word == "uniaxial_strain") return StrainPath::uniaxial_strain;
  return StrainPath::shear;
}

CurvePlan plan_of(const MaterialOptions& options) {
  CurvePlan plan;
  plan.path = path_of(options.path);
  plan.steps = options.steps;
  plan.shell = options.element == "shell";
  plan.to.clear();
  for (const std::string& to : options.to) {
    plan.to.push_back(quantity_of(to, dim::none, "--to"));
    if (std::abs(plan.to.back()) > 3) throw InputError("--to: strains from -3 to 3 are wanted");
  }
  return plan;
}

std::string csv_of(const std::vector<NamedCurve>& curves) {
  std::string out;
  for (const NamedCurve& c : curves) {
    out +=
        fmt::format("# {}\nstrain,stress_Pa,nominal_Pa,plastic_strain,heating_K,damage\n", c.name);
    for (const CurvePoint& p : c.points) {
      out += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", p.strain, p.stress,
                         p.nominal, p.plastic_strain, p.heating, p.damage);
    }
  }
  return out;
}

std::string svg_of(const MaterialOptions& options, const std::string& title,
                   const std::vector<NamedCurve>& curves) {
  Plot plot;
  plot.title = title;
  plot.subtitle = fmt::format("{}, of a {}", options.path, options.element);
  plot.x_label = options.path == "shear" ? "shear strain" : "true strain";
  plot.y_label = options.path == "shear" ? "shear stress (MPa)" : "true stress (MPa)";
  int colour = 0;
  for (const NamedCurve& c : curves) {
    PlotSeries& s = plot.series.emplace_back();
    s.label = c.name;
    s.colour = colour++;
    s.markers = false;
    for (const CurvePoint& p : c.points) {
      s.x.push_back(p.strain);
      s.y.push_back(1e-6 * p.stress);
    }
  }
  return even_plot(plot);
}

void print_summary(const NamedCurve& c) {
  const auto top =
      std::max_element(c.points.begin(), c.points.end(),
                       [](const auto& a, const auto& b) { return a.stress < b.stress; });
  const auto yield = std::find_if(c.points.begin(), c.points.end(),
                                  [](const CurvePoint& p) { return p.plastic_strain > 0; });
  fmt::print("{}: largest stress {:.5g} MPa at strain {:.4g}", c.name, 1e-6 * top->stress,
             top->strain);
  if (yield != c.points.end()) fmt::print(", yields at {:.5g} MPa", 1e-6 * yield->stress);
  if (c.points.back().damage >= 1) fmt::print(", fails at strain {:.4g}", c.points.back().strain);
  fmt::print("\n");
}

}  // namespace

int material_command(const MaterialOptions& options) {
  std::string name;
  const std::unique_ptr<Case> source = case_of_card(options, name);
  const Keys card = source->keys().map("materials").map(name);
  const ElasticPlastic material = read_elastic_plastic(card);
  source->mistakes.throw_if_any();
  CurvePlan plan = plan_of(options);
  if (plan.shell && material.hyperelastic()) {
    throw InputError(
        fmt::format("{} is rubber, which only solids are made of: --element solid", name));
  }
  std::vector<NamedCurve> curves;
  for (const std::string& rate : options.rates) {
    plan.rate = quantity_of(rate, dim::frequency, "--rate");
    if (!(plan.rate > 0)) throw InputError("--rate: a rate above 0 is wanted");
    curves.push_back({fmt::format("{:g} 1/s", plan.rate), material_curve(material, plan)});
  }
  const std::string title = card.has("name") ? card.word("name") : name;
  if (!options.csv.empty()) write_whole_file(options.csv, csv_of(curves));
  if (!options.svg.empty()) write_whole_file(options.svg, svg_of(options, title, curves));
  if (options.csv.empty() && options.svg.empty()) {
    fmt::print("{}", csv_of(curves));
    return 0;
  }
  fmt::print("{}: {}, of a {}\n", title, options.path, options.element);
  for (const NamedCurve& c : curves) print_summary(c);
  return 0;
}

}  // namespace gannet
