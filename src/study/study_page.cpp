// study.html: one page that needs no other file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/study_pictures.hpp"
#include "study/study_report.hpp"
#include "study/svg_plot.hpp"

namespace gannet {

namespace {

constexpr const char* style = R"(
body { font: 16px/1.5 Helvetica, Arial, sans-serif; color: #222; background: #f5f6f7; margin: 0; }
main { max-width: 1420px; margin: 0 auto; padding: 24px 32px 60px; }
h1 { margin: 8px 0 4px; font-size: 28px; } h2 { margin: 40px 0 8px; font-size: 21px; }
.quiet { color: #666; } .box { background: #fff; border: 1px solid #ddd; border-radius: 8px;
padding: 12px 20px; margin: 14px 0; } .box p { margin: 6px 0; } .prices { border-left: 5px solid #0072b2; }
.pictures { display: flex; flex-wrap: wrap; gap: 18px; } .pictures svg { background: #fff;
border: 1px solid #ddd; border-radius: 8px; max-width: 100%; height: auto; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; background: #fff; font-size: 14px;
font-variant-numeric: tabular-nums; } th, td { padding: 5px 12px; border-bottom: 1px solid #e4e4e4;
text-align: right; white-space: nowrap; } th { background: #eef1f3; } th:first-child,
td:first-child { text-align: left; } td.why { white-space: normal; text-align: left; }
tr.reference td { background: #f3f8fc; } tr.front td { font-weight: bold; }
)";

std::string cell(const std::string& text) { return "<td>" + xml_text(text) + "</td>"; }

std::string number_cell(double x, const char* format = "{:.4g}") {
  return cell(std::isfinite(x) ? fmt::format(fmt::runtime(format), x) : "");
}

std::string head_of(const std::vector<std::string>& names) {
  std::string out = "<tr>";
  for (const std::string& name : names) out += "<th>" + xml_text(name) + "</th>";
  return out + "</tr>\n";
}

std::string values_table(const StudyResult& result, const MeasureResult& m) {
  std::vector<std::string> names = {"setting",
                                    m.measure.name + " [" + (m.unit.empty() ? "1" : m.unit) + "]"};
  const bool repeats = result.spec.repeats > 1;
  if (repeats) names.insert(names.end(), {"smallest", "largest"});
  for (const int percent : spread_percents) {
    if (repeats && percent != 50) names.push_back(fmt::format("{} % below", percent));
  }
  names.insert(names.end(), {"error [%]", "wall time [s]"});
  std::string out = "<div class=\"scroll\"><table>\n" + head_of(names);
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const StudyPoint& point = result.points[i];
    if (!point.done()) continue;
    const bool front = std::find(m.pareto.begin(), m.pareto.end(), i) != m.pareto.end();
    const StudyValue& v = m.values[i];
    out += fmt::format("<tr{}>", i == m.reference_point ? " class=\"reference\""
                                 : front                ? " class=\"front\""
                                                        : "");
    out += cell(setting_text(result.spec.axes, point.choices) +
                (i == m.reference_point ? " (the reference)" : ""));
    out += number_cell(v.value, "{:.6g}");
    if (repeats) out += number_cell(v.low, "{:.6g}") + number_cell(v.high, "{:.6g}");
    for (const int percent : spread_percents) {
      if (!repeats || percent == 50) continue;
      out += number_cell(quantile_of(v.of_runs, 0.01 * percent), "{:.6g}");
    }
    out += number_cell(100 * v.error, "{:.3g}") + number_cell(point.wall, "{:.3g}") + "</tr>\n";
  }
  return out + "</table></div>\n";
}

std::string convergence_lines(const MeasureResult& m) {
  std::string out;
  for (const StudySeries& s : m.series) {
    const std::string label = s.label.empty() ? "" : "<b>" + xml_text(s.label) + "</b>: ";
    out += "<p>" + label + xml_text(convergence_text(m, s)) + "</p>\n";
  }
  return out;
}

std::string measure_section(const StudyResult& result, const MeasureResult& m) {
  std::string out =
      "<h2>" + xml_text(m.measure.name) + "</h2>\n<p class=\"quiet\">" +
      xml_text(fmt::format("{} of {}{}; errors are against {}.", m.measure.kind, m.measure.history,
                           m.measure.column.empty() ? "" : " " + m.measure.column,
                           m.reference_text.empty() ? "nothing" : m.reference_text)) +
      "</p>\n<div class=\"box prices\">\n";
  for (const std::string& sentence : m.sentences) out += "<p>" + xml_text(sentence) + "</p>\n";
  out += "</div>\n<div class=\"pictures\">\n" + work_picture(result, m) +
         convergence_picture(result, m) + changes_picture(m) + spread_picture(result, m) +
         "</div>\n";
  const std::string lines = convergence_lines(m);
  if (!lines.empty()) out += "<div class=\"box\">" + lines + "</div>\n";
  return out + values_table(result, m);
}

std::string runs_table(const StudyResult& result) {
  std::string out =
      "<h2>Runs</h2>\n<div class=\"scroll\"><table>\n" +
      head_of({"setting", "run", "state", "predicted [s]", "wall [s]", "CPU [s]", "particles",
               "elements", "steps", "particle steps/s", "element steps/s", "memory [MiB]",
               "energy error", "lost particles", "deepest penetration [m]", "version"});
  for (const StudyRun& run : result.runs) {
    const std::string repeat = result.spec.repeats > 1 ? fmt::format(" #{}", run.repeat + 1) : "";
    out += "<tr>" + cell(setting_text(result.spec.axes, run.choices) + repeat) + cell(run.hash);
    if (run.state != StudyState::done) {
      out +=
          fmt::format("<td class=\"why\" colspan=\"14\">{}</td></tr>\n",
                      xml_text((run.state == StudyState::failed ? "failed: " : "") + run.reason));
      continue;
    }
    out += cell(run.was_there ? "done before" : "done") + number_cell(run.predicted, "{:.3g}") +
           number_cell(run.wall, "{:.3g}") + number_cell(run.cpu, "{:.3g}") +
           number_cell(run.size.particles, "{:.0f}") + number_cell(run.size.elements, "{:.0f}") +
           number_cell(run.steps, "{:.0f}") + number_cell(run.particle_rate, "{:.3g}") +
           number_cell(run.element_rate, "{:.3g}") +
           number_cell(run.memory / (1024 * 1024), "{:.1f}") +
           number_cell(run.energy_error, "{:.2g}") + number_cell(run.lost_particles, "{:.0f}") +
           number_cell(run.deepest_penetration, "{:.2g}") + cell(run.version) + "</tr>\n";
  }
  return out + "</table></div>\n";
}

}  // namespace

std::string study_html(const StudyResult& result) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n<title>Study: "
      "{0}</title>\n"
      "<style>{1}</style></head>\n<body><main>\n<h1>{0}</h1>\n<p class=\"quiet\">A study of {2}; "
      "gannet {3}; this study took {4}.</p>\n",
      xml_text(result.title), style, xml_text(result.spec.case_file), xml_text(result.version),
      wall_text(result.outcome.wall));
  if (result.outcome.out_of_budget) {
    out += fmt::format(
        "<div class=\"box\"><p>The budget of {} ended the study before all runs were made; what is "
        "left is in the table of runs.</p></div>\n",
        wall_text(result.spec.budget));
  }
  for (const MeasureResult& m : result.measures) out += measure_section(result, m);
  return out + runs_table(result) + "</main></body></html>\n";
}

}  // namespace gannet
