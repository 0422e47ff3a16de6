#include "study/study_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output/files.hpp"
#include "study/study_pictures.hpp"
#include "study/study_prices.hpp"

namespace gannet {

namespace {

using Json = nlohmann::ordered_json;

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string csv_number(double x) { return std::isfinite(x) ? fmt::format("{}", x) : ""; }

const char* state_text(StudyState state) {
  switch (state) {
    case StudyState::done:
      return "done";
    case StudyState::failed:
      return "failed";
    case StudyState::not_run:
      return "not run";
    case StudyState::waiting:
      break;
  }
  return "waiting";
}

/// Value and error of one run, both unknown where it has none.
std::pair<double, double> value_of_run(const StudyResult& result, const MeasureResult& m,
                                       const StudyRun& run) {
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const std::vector<std::size_t>& runs = result.points[i].runs;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (&result.runs[runs[k]] != &run || k >= m.values[i].errors_of_runs.size()) continue;
      return {m.values[i].of_runs[k], m.values[i].errors_of_runs[k]};
    }
  }
  return {unknown, unknown};
}

}  // namespace

std::string study_csv(const StudyResult& result) {
  std::string out = "run,repeat";
  for (const StudyAxis& axis : result.spec.axes) out += "," + csv_cell(axis.key);
  out +=
      ",state,reason,predicted_wall [s],wall [s],cpu [s],particles,elements,steps,"
      "particle_steps_per_second,element_steps_per_second,peak_memory "
      "[B],energy_error,lost_particles,deepest_penetration [m],version";
  for (const MeasureResult& m : result.measures) {
    out += "," + csv_cell(fmt::format("{} [{}]", m.measure.name, m.unit.empty() ? "1" : m.unit));
    out += "," + csv_cell(m.measure.name + " error");
  }
  out += "\n";
  for (const StudyRun& run : result.runs) {
    out += fmt::format("{},{}", run.hash, run.repeat + 1);
    for (const std::string& choice : run.choices) out += "," + csv_cell(choice);
    out += fmt::format(",{},{}", state_text(run.state), csv_cell(run.reason));
    for (const double x : {run.predicted, run.wall, run.cpu, run.size.particles, run.size.elements,
                           run.steps, run.particle_rate, run.element_rate, run.memory,
                           run.energy_error, run.lost_particles, run.deepest_penetration}) {
      out += "," + csv_number(x);
    }
    out += "," + csv_cell(run.version);
    for (const MeasureResult& m : result.measures) {
      const auto [value, error] = value_of_run(result, m, run);
      out += "," + csv_number(value) + "," + csv_number(error);
    }
    out += "\n";
  }
  return out;
}

namespace {

/// JSON has no NaN: null in its place.
Json number_json(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json choices_json(const StudySpec& spec, const std::vector<std::string>& choices) {
  Json json = Json::object();
  for (std::size_t i = 0; i < spec.axes.size(); ++i) json[spec.axes[i].key] = choices[i];
  return json;
}

Json run_json(const StudyResult& result, const StudyRun& run) {
  return {{"hash", run.hash},
          {"settings", choices_json(result.spec, run.choices)},
          {"repeat", run.repeat + 1},
          {"state", state_text(run.state)},
          {"reason", run.reason},
          {"particles", run.size.particles},
          {"elements", run.size.elements},
          {"predicted_wall", number_json(run.predicted)},
          {"wall", number_json(run.wall)},
          {"cpu", number_json(run.cpu)},
          {"steps", number_json(run.steps)},
          {"particle_steps_per_second", number_json(run.particle_rate)},
          {"element_steps_per_second", number_json(run.element_rate)},
          {"peak_memory_bytes", number_json(run.memory)},
          {"energy_error", number_json(run.energy_error)},
          {"lost_particles", number_json(run.lost_particles)},
          {"deepest_penetration", number_json(run.deepest_penetration)},
          {"version", run.version}};
}

Json series_json(const StudySeries& series) {
  Json json = {{"setting", series.label}, {"points", series.points}};
  json["order"] = {{"value", number_json(series.order.order)},
                   {"low_95", number_json(series.order.low)},
                   {"high_95", number_json(series.order.high)},
                   {"refused", series.order.reason}};
  json["limit"] = {{"value", number_json(series.limit.limit)},
                   {"order", number_json(series.limit.order)},
                   {"grid_convergence_index", number_json(series.limit.gci)},
                   {"refused", series.limit.reason}};
  json["cost_exponent"] = number_json(series.cost.exponent);
  return json;
}

Json price_json(const StudyResult& result, const MeasureResult& m, double target) {
  const StudyPrice price = price_of(result, m, target);
  Json json = {{"within", target}, {"wall", number_json(price.wall)}, {"why_not", price.why}};
  json["from"] = price.from == StudyPrice::From::measured ? "measured"
                 : price.from == StudyPrice::From::fitted ? "fitted"
                                                          : "nothing";
  if (price.point != no_point) {
    json["settings"] = choices_json(result.spec, result.points[price.point].choices);
  }
  return json;
}

Json measure_json(const StudyResult& result, const MeasureResult& m) {
  Json json = {{"name", m.measure.name},
               {"kind", m.measure.kind},
               {"history", m.measure.history},
               {"unit", m.unit},
               {"problem", m.problem},
               {"reference", number_json(m.reference)},
               {"reference_is", m.reference_text},
               {"pareto_front", m.pareto},
               {"sentences", m.sentences}};
  for (const StudyValue& v : m.values) {
    json["values"].push_back({{"median", number_json(v.value)},
                              {"smallest", number_json(v.low)},
                              {"largest", number_json(v.high)},
                              {"error", number_json(v.error)}});
    Json& json_of_value = json["values"].back();
    if (v.of_runs.size() < 2) continue;
    json_of_value["of_repeats"] = v.of_runs;
    for (const int percent : spread_percents) {
      json_of_value["percentiles"][std::to_string(percent)] =
          number_json(quantile_of(v.of_runs, 0.01 * percent));
    }
  }
  json["series"] = Json::array();
  for (const StudySeries& s : m.series) json["series"].push_back(series_json(s));
  json["changes"] = Json::array();
  for (const StudyChange& c : m.changes) {
    json["changes"].push_back({{"key", c.key},
                               {"from", c.from},
                               {"to", c.to},
                               {"at", c.at},
                               {"value", number_json(c.value)},
                               {"wall", number_json(c.time)}});
  }
  for (const double target : {0.05, 0.02, 0.01}) {
    json["prices"].push_back(price_json(result, m, target));
  }
  return json;
}

}  // namespace

std::string study_json(const StudyResult& result) {
  Json json = {{"case", result.spec.case_file},
               {"title", result.title},
               {"version", result.version},
               {"refined", result.spec.refine},
               {"wall_time_of_this_study", result.outcome.wall}};
  json["runs"] = Json::array();
  for (const StudyRun& run : result.runs) json["runs"].push_back(run_json(result, run));
  json["points"] = Json::array();
  for (const StudyPoint& p : result.points) {
    json["points"].push_back({{"settings", choices_json(result.spec, p.choices)},
                              {"size", number_json(p.h)},
                              {"repeats_done", p.runs.size()},
                              {"wall", number_json(p.wall)}});
  }
  json["measures"] = Json::array();
  for (const MeasureResult& m : result.measures)
    json["measures"].push_back(measure_json(result, m));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string convergence_text(const MeasureResult& m, const StudySeries& series) {
  std::string text = "no order: " + series.order.reason;
  if (series.order.valid) {
    text = fmt::format("order {:.2f}", series.order.order);
    text += std::isfinite(series.order.low) ? fmt::format(" (95 % interval {:.2f} to {:.2f})",
                                                          series.order.low, series.order.high)
                                            : " (two levels, no interval)";
  }
  if (series.limit.valid) {
    return text + fmt::format("; limit {:.5g} {} by order {:.2f}; grid convergence index {:.2g} %",
                              series.limit.limit, m.unit, series.limit.order,
                              100 * series.limit.gci);
  }
  return text + "; no grid convergence index: " + series.limit.reason;
}

std::string study_text(const StudyResult& result) {
  std::string out;
  for (const MeasureResult& m : result.measures) {
    out += fmt::format("\n{} ({} of {}{}), against {}\n", m.measure.name, m.measure.kind,
                       m.measure.history, m.measure.column.empty() ? "" : " " + m.measure.column,
                       m.reference_text.empty() ? "nothing" : m.reference_text);
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      if (!result.points[i].done()) continue;
      out +=
          fmt::format("  {:<48} {:>12.5g} {:<4} error {:>8.3g} %   {}\n",
                      setting_text(result.spec.axes, result.points[i].choices), m.values[i].value,
                      m.unit, 100 * m.values[i].error, wall_text(result.points[i].wall));
    }
    for (const StudySeries& s : m.series) {
      out += fmt::format("  {}{}\n", s.label.empty() ? "" : s.label + ": ", convergence_text(m, s));
    }
    for (const std::string& sentence : m.sentences) out += sentence + "\n";
  }
  return out;
}

void write_study(const StudyResult& result) {
  const std::string& out = result.spec.out;
  write_whole_file(out + "/study.csv", study_csv(result));
  write_whole_file(out + "/study.json", study_json(result));
  write_whole_file(out + "/study.html", study_html(result));
  for (const MeasureResult& m : result.measures) {
    const std::string name = file_name_of(m.measure.name) + ".svg";
    const std::string convergence = convergence_picture(result, m);
    if (!convergence.empty()) write_whole_file(out + "/convergence_" + name, convergence);
    write_whole_file(out + "/work_" + name, work_picture(result, m));
    const std::string changes = changes_picture(m);
    if (!changes.empty()) write_whole_file(out + "/changes_" + name, changes);
    const std::string spread = spread_picture(result, m);
    if (!spread.empty()) write_whole_file(out + "/spread_" + name, spread);
  }
}

}  // namespace gannet
