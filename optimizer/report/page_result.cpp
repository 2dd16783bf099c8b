// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include "report/html.h"
#include "report/number_text.h"
#include "report/page.h"
#include "report/verdict.h"

namespace bondlab {
namespace {

// Other rooms write clauses; on the page they stand alone. The first letter stays: it may begin a
// name such as sigma_t.
std::string as_sentence(std::string text) {
  if (!text.empty() && std::string(".!?:").find(text.back()) == std::string::npos) text += '.';
  return text;
}

std::string unit_cell(const std::string &unit) { return unit == "1" ? "\u2013" : html_text(unit); }

std::string met_tag(const ReportTarget &target) {
  if (!std::isfinite(target.simulated)) return html_tag("not simulated", "bad");
  return target.met ? html_tag("met", "good") : html_tag("not met", "bad");
}

std::string source_cell(const ReportTarget &target) {
  std::string text = target.source;
  if (!target.sd_source.empty())
    text += (text.empty() ? "" : "; ") + std::string("sd: ") + target.sd_source;
  return html_text(text.empty() ? "\u2013" : text);
}

std::string target_table(const ReportInput &input, const ReportFit &fit) {
  HtmlTable table("Measured against simulated" + (input.tolerance_text.empty()
                                                      ? std::string(".")
                                                      : "; " + as_sentence(input.tolerance_text)),
                  {"Quantity", ">Measured", ">\u00b1 sd", ">Simulated", "Unit", ">Deviation",
                   ">in sd", "Met", "Role", "Source"});
  for (const ReportTarget &t : fit.targets) {
    const double off = deviation(t),
                 in_sd = t.sd > 0 ? (t.simulated - t.measured) / t.sd : no_number;
    const bool noted = !t.why_missing.empty();
    table.row({html_text(t.name), html_number(t.measured, significant(t.measured)),
               html_number(t.sd, significant_full(t.sd, 2)),
               html_number(t.simulated, significant_full(t.simulated)), unit_cell(t.unit),
               html_number(off, signed_percent(off)), html_number(in_sd, fixed(in_sd, 1)),
               met_tag(t), html_tag(t.in_fit ? "fitted" : "predicted", "plain"), source_cell(t)},
              noted ? "more" : "");
    if (noted) table.note(as_sentence(t.why_missing));
  }
  return table.html();
}

// How far a single run can be trusted.
std::string scatter_words(const ReportFit &fit) {
  std::vector<std::string> words;
  for (const ReportTarget &t : fit.targets)
    if (std::isfinite(t.noise_sd) && t.measured != 0)
      words.push_back(t.name + " by " + significant(100 * std::fabs(t.noise_sd / t.measured), 2) +
                      "\u00a0%");
  if (words.empty()) return "";
  return html_paragraph("Under tiny changes of the parameters single runs scatter: " +
                        list_text(words) + " of the measured value (one standard deviation).");
}

std::string yes_no(bool value, bool good) {
  return html_tag(value ? "yes" : "no", value == good ? "good" : "bad");
}

std::string parameter_table(const ReportFit &fit) {
  if (fit.parameters.empty()) return html_paragraph("The study identifies no parameters.");
  HtmlTable table(
      "Identified parameters; sd and 95 % interval come from the fit's linear model at the result.",
      {"Parameter", ">Value", ">\u00b1 sd", "Unit", ">95 % interval", ">Bounds", "At a bound",
       "Identifiable", "Sets in the deck"});
  for (const ReportParameter &p : fit.parameters) {
    const auto range = [](double low, double high, std::string (*shown)(double, int)) {
      if (!std::isfinite(low) || !std::isfinite(high)) return std::string("\u2013");
      return html_number(low, shown(low, 4)) + " to " + html_number(high, shown(high, 4));
    };
    std::string sets;
    for (const std::string &name : p.sets) sets += (sets.empty() ? "" : ", ") + name;
    const bool noted = !p.reason.empty();
    table.row({html_text(p.name), html_number(p.value, significant_full(p.value)),
               html_number(p.sd, significant_full(p.sd, 2)), unit_cell(p.unit),
               range(p.interval_lower, p.interval_upper, significant_full),
               range(p.lower, p.upper, significant), yes_no(p.at_bound, false),
               yes_no(p.identifiable, true), sets.empty() ? "\u2013" : html_text(sets)},
              noted ? "more" : "");
    if (noted) table.note(as_sentence(p.reason));
  }
  return table.html();
}

std::string correlation_words(const ReportFit &fit) {
  const std::size_t n = fit.parameters.size();
  if (fit.correlation.size() != n) return "";
  std::vector<std::string> strong;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n && j < fit.correlation[i].size(); ++j)
      if (std::fabs(fit.correlation[i][j]) >= 0.8)
        strong.push_back(fit.parameters[i].name + " and " + fit.parameters[j].name +
                         " (correlation " + fixed(fit.correlation[i][j], 2) + ")");
  if (strong.empty())
    return n > 1 ? html_paragraph(
                       "No two parameters are strongly correlated (all below 0.8): the data "
                       "separate them.")
                 : "";
  return html_paragraph("The data hardly separate " + list_text(strong) +
                        ": a change of one is made up for by the other.");
}

// What the study asks about comes first; the spans of what was reached are for the record. What the
// verdict says already isn't said again.
std::vector<std::string> finding_texts(const ReportFit &fit, bool for_the_record) {
  std::vector<std::string> texts;
  for (const ReportFinding &finding : fit.findings)
    if ((finding.kind == "reachable") == for_the_record &&
        fit.verdict.find(finding.text) == std::string::npos)
      texts.push_back(as_sentence(finding.text));
  return texts;
}

std::vector<std::string> note_texts(const ReportFit &fit) {
  std::vector<std::string> texts;
  for (const std::string &note : fit.notes) texts.push_back(as_sentence(note));
  return texts;
}

// Long accounts of what was done are folded away on the screen; the page's first view is for the
// result.
std::string notes_html(const ReportFit &fit) {
  std::string html;
  const std::vector<std::string> said = finding_texts(fit, false), spans = finding_texts(fit, true);
  if (!said.empty()) html += "<h3>What the runs say</h3>\n" + html_list(said);
  if (!spans.empty())
    html +=
        "<details><summary>What the runs reached</summary>\n" + html_list(spans) + "</details>\n";
  if (!fit.notes.empty())
    html += "<details><summary>What the fit did, step by step</summary>\n" +
            html_list(note_texts(fit)) + "</details>\n";
  return html;
}

}  // namespace

std::string result_section(const ReportInput &input, const PageFigures &figures) {
  std::string html = "<section id=\"result\">\n<h2>Result</h2>\n";
  if (input.fits.empty())
    return html + html_paragraph("No fit has been finished yet.") + "</section>\n";
  const ReportFit &fit = input.fits.front();
  html += target_table(input, fit) + scatter_words(fit);
  if (!figures.deviations.svg.empty()) html += html_figure(figures.deviations);
  html += "<h3>Identified parameters</h3>\n" + parameter_table(fit) + correlation_words(fit) +
          notes_html(fit);
  return html + "</section>\n";
}

std::string tradeoff_section(const ReportInput &input, const PageFigures &figures) {
  if (input.fits.size() < 2 && figures.conflict.empty()) return "";
  std::string html = "<section id=\"tradeoff\">\n<h2>Trade-off</h2>\n";
  if (input.fits.size() < 2)
    html += html_paragraph(
        "No fit of all targets together has been made; what follows comes from the runs of the fit "
        "above.");
  for (std::size_t i = 1; i < input.fits.size(); ++i) {
    const ReportFit &fit = input.fits[i];
    html += "<h3>Fit \u201c" + html_text(fit.name) + "\u201d</h3>\n";
    html += html_paragraph(fit.verdict.empty() ? targets_sentence(fit) : fit.verdict);
    html += html_paragraph(all_met_sentence(input, fit));
    html += target_table(input, fit) + parameter_table(fit) + notes_html(fit);
  }
  for (const Figure &figure : figures.conflict) html += html_figure(figure);
  return html + "</section>\n";
}

std::string packings_section(const ReportInput &input) {
  std::string html;
  for (const ReportFit &fit : input.fits) {
    if (fit.packings.empty()) continue;
    HtmlTable table("Fit \u201c" + fit.name +
                        "\u201d: the identified parameters on other random packings of the same "
                        "size distribution.",
                    {"Quantity", ">Measured", ">Packing of the fit", ">Others: mean", ">sd", "Unit",
                     ">Mean deviates", ">Packings", "Each"});
    for (const ReportPacking &p : fit.packings) {
      const double off = p.measured != 0 ? p.mean / p.measured - 1 : no_number;
      std::string each;
      for (const double value : p.values)
        each += (each.empty() ? "" : ", ") + html_number(value, significant_full(value));
      if (p.failed > 0)
        each += std::string(each.empty() ? "" : "; ") +
                html_tag(std::to_string(p.failed) + " failed", "bad");
      table.row({html_text(p.name), html_number(p.measured, significant(p.measured)),
                 html_number(p.used, significant_full(p.used)),
                 html_number(p.mean, significant_full(p.mean)),
                 html_number(p.sd, significant_full(p.sd, 2)), unit_cell(p.unit),
                 html_number(off, signed_percent(off)),
                 count_text(static_cast<long>(p.values.size())), each.empty() ? "\u2013" : each});
    }
    html += table.html();
  }
  if (!html.empty())
    html = "<h3>Other packings</h3>\n" + html;
  else
    html = html_paragraph("The result was not repeated on other packings.");
  std::string specimens;
  if (!input.specimens.empty()) {
    HtmlTable table("", {"Specimen", "Shape", "Size", ">Particles", ">Radius (mm)", ">Porosity",
                         ">Coordination", ">Seed"});
    for (const ReportSpecimen &s : input.specimens)
      table.row({html_text(s.name), html_text(s.shape), html_text(s.size),
                 s.particles > 0 ? count_text(s.particles) : "\u2013",
                 html_number(s.r_min, significant_full(1e3 * s.r_min, 3)) + " to " +
                     html_number(s.r_max, significant_full(1e3 * s.r_max, 3)),
                 html_number(s.porosity, significant_full(s.porosity, 3)),
                 html_number(s.coordination, significant_full(s.coordination, 3)),
                 html_text(s.seed.empty() ? "\u2013" : s.seed)});
    specimens = "<h3>Specimens and particle size</h3>\n" + table.html();
  }
  html += specimens + html_paragraph(input.resolution_note);
  if (!input.confirm_command.empty())
    html += html_paragraph("This command repeats the result at the resolution of the source:") +
            html_command(input.confirm_command);
  return "<section id=\"packings\">\n<h2>Packings and resolution</h2>\n" + html + "</section>\n";
}

}  // namespace bondlab
