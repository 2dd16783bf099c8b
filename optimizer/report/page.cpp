// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/page.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "report/number_text.h"
#include "report/page_style.h"
#include "report/verdict.h"

namespace bondlab {
namespace {

constexpr std::size_t most_ledger_rows = 400;  // the page stays light; the store has all

std::string fact(const std::string &name, const std::string &value) {
  return "<div><dt>" + html_text(name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
}

std::string facts(const ReportInput &input) {
  long fitted = 0, fitted_met = 0, predicted = 0, predicted_met = 0, runs = 0, stored = 0;
  double seconds = 0;
  const ReportFit &fit = input.fits.front();
  for (const ReportTarget &target : fit.targets) {
    ++(target.in_fit ? fitted : predicted);
    if (target.met) ++(target.in_fit ? fitted_met : predicted_met);
  }
  for (const ReportFit &each : input.fits) {
    runs += each.forward_runs, stored += each.from_store;
    if (std::isfinite(each.wall_seconds)) seconds += each.wall_seconds;
  }
  const auto of = [](long part, long whole) {
    return count_text(part) + " of " + count_text(whole);
  };
  std::string html = "<dl class=\"facts\">\n" + fact("fitted targets met", of(fitted_met, fitted));
  if (predicted > 0) html += fact("predicted targets met", of(predicted_met, predicted));
  html +=
      fact("parameters identified",
           of(std::count_if(fit.parameters.begin(), fit.parameters.end(),
                            [](const ReportParameter &p) { return p.identifiable && !p.at_bound; }),
              static_cast<long>(fit.parameters.size())));
  html += fact("forward runs", count_text(runs));
  if (stored > 0) html += fact("of them from the store", count_text(stored));
  return html + fact("wall time", duration_text(seconds)) + "</dl>\n";
}

// Green when everything is met, amber when only a prediction is missed, red when a fitted target
// is.
const char *verdict_kind(const ReportInput &input) {
  if (input.fits.empty()) return " bad";
  const char *kind = "";
  for (const ReportTarget &target : input.fits.front().targets)
    if (!target.met) {
      if (target.in_fit) return " bad";
      kind = " warn";
    }
  return kind;
}

std::string page_header(const ReportInput &input) {
  const std::string title = input.study_title.empty() ? input.study_name : input.study_title;
  std::string html =
      "<header class=\"page\">\n<p class=\"kicker\">BondLab \u00b7 identification "
      "report</p>\n<h1>" +
      html_text(title) + "</h1>\n";
  html += std::string("<div class=\"verdict") + verdict_kind(input) + "\">\n" +
          html_paragraph(headline(input), "lead");
  if (input.fits.size() > 1) {
    const ReportFit &tradeoff = input.fits[1];
    html += html_paragraph(
        "Trade-off: " + (tradeoff.verdict.empty() ? targets_sentence(tradeoff) : tradeoff.verdict));
  }
  html += "</div>\n";
  if (!input.fits.empty()) html += facts(input);
  return html;
}

std::string figures_html(const std::vector<Figure> &figures) {
  std::string html = "<div class=\"figures\">\n";
  for (const Figure &figure : figures) html += html_figure(figure);
  return html + "</div>\n";
}

}  // namespace

std::string tests_section(const ReportInput &input, const PageFigures &figures) {
  std::string html = "<section id=\"tests\">\n<h2>Virtual tests</h2>\n";
  if (figures.tests.empty())
    html += html_paragraph("No run of a virtual test stands behind this result.");
  else
    html += figures_html(figures.tests);
  if (input.fits.empty()) return html + "</section>\n";
  std::vector<std::string> quality;
  for (const ReportRunFiles &run : input.fits.front().best_runs)
    for (const auto &item : run.quality)
      quality.push_back(run.test + ", " + item.first + ": " + significant(item.second));
  if (!quality.empty())
    html += "<details><summary>Quality figures of these runs</summary>\n" +
            html_paragraph("In SI units; they judge the run, not the material.") +
            html_list(quality) + "</details>\n";
  return html + "</section>\n";
}

std::string convergence_section(const ReportInput &input, const PageFigures &figures) {
  std::string html = "<section id=\"convergence\">\n<h2>Convergence</h2>\n";
  if (!input.fits.empty()) {
    const ReportFit &fit = input.fits.front();
    html += html_paragraph(
        std::string(fit.converged
                        ? "The fit converged: at the result the gradient is zero within the noise "
                          "of the responses."
                        : "The fit has not converged; the best parameter set found is shown.") +
        (std::isfinite(fit.misfit)
             ? " The misfit at the result is " + significant(fit.misfit, 3) + ", with " +
                   counted(fit.degrees_of_freedom, "degree of freedom", "degrees of freedom") + "."
             : ""));
  }
  if (figures.convergence.empty())
    html += html_paragraph("The fit left no history.");
  else
    html += figures_html(figures.convergence);
  return html + "</section>\n";
}

std::string assumptions_section(const ReportInput &input) {
  std::string html = "<section id=\"assumptions\">\n<h2>Assumptions</h2>\n";
  if (input.assumptions.empty())
    return html + html_paragraph("The study lists no assumptions.") + "</section>\n";
  HtmlTable table("What the study fixes or ties, and on whose word.",
                  {"Assumption", "Kind", "Source"});
  for (const ReportAssumption &assumption : input.assumptions) {
    std::string start = assumption.source.substr(0, 7);
    std::transform(start.begin(), start.end(), start.begin(), [](unsigned char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
    });
    const bool assumed = assumption.source.empty() || start == "assumed";
    table.row({html_text(assumption.text),
               assumed ? html_tag("assumed", "warn") : html_tag("from the source", "plain"),
               html_text(assumption.source.empty() ? "\u2013" : assumption.source)});
  }
  return html + table.html() + "</section>\n";
}

std::string runs_section(const ReportInput &input) {
  std::string html = "<section id=\"runs\">\n<h2>Runs</h2>\n";
  HtmlTable fits("By fit", {"Fit", ">Runs asked for", ">From the store", ">Failed", ">Wall time",
                            ">Sum of the runs"});
  for (const ReportFit &fit : input.fits)
    fits.row({html_text(fit.name), count_text(fit.forward_runs), count_text(fit.from_store),
              count_text(fit.failed_runs),
              html_number(fit.wall_seconds, duration_text(fit.wall_seconds)),
              html_number(fit.run_seconds, duration_text(fit.run_seconds))});
  if (!input.fits.empty()) html += fits.html();

  struct Sum {
    long runs = 0, failed = 0, measured = 0;
    double seconds = 0, steps = 0, particles = 0, bonds = 0, bond_step_ns = 0;
    double mean(double sum) const { return measured ? sum / static_cast<double>(measured) : no_number; }
  };
  std::map<std::string, Sum> tests;
  long failed = 0;
  for (const ReportRun &run : input.ledger) {
    Sum &sum = tests[run.test];
    ++sum.runs;
    sum.failed += !run.ok, failed += !run.ok;
    if (std::isfinite(run.wall_seconds)) sum.seconds += run.wall_seconds;
    if (!std::isfinite(run.bond_step_ns)) continue;
    ++sum.measured;
    sum.steps += run.steps, sum.particles += run.particles, sum.bonds += run.bonds;
    sum.bond_step_ns += run.bond_step_ns;
  }
  if (!tests.empty()) {
    HtmlTable table("By test; particles, bonds, steps and the time of a bond and step (ns) are means over the runs.",
                    {"Test", ">Runs", ">Failed", ">Seconds together", ">Seconds a run", ">Particles",
                     ">Bonds", ">Steps", ">ns"});
    for (const auto &[name, sum] : tests) {
      const double mean = sum.seconds / static_cast<double>(sum.runs);
      table.row({html_text(name), count_text(sum.runs), count_text(sum.failed),
                 html_number(sum.seconds, significant_full(sum.seconds, 3)),
                 html_number(mean, significant_full(mean, 3)),
                 html_number(sum.mean(sum.particles), significant_full(sum.mean(sum.particles), 4)),
                 html_number(sum.mean(sum.bonds), significant_full(sum.mean(sum.bonds), 4)),
                 html_number(sum.mean(sum.steps), significant_full(sum.mean(sum.steps), 4)),
                 html_number(sum.mean(sum.bond_step_ns), significant_full(sum.mean(sum.bond_step_ns), 3))});
    }
    html += table.html();
  }
  if (failed > 0) {
    HtmlTable table(counted(failed, "failed run", "failed runs") + ", each with its cause.",
                    {"Run", "Test", ">Packing", "Cause", "Message"});
    std::size_t shown = 0;
    for (const ReportRun &run : input.ledger)
      if (!run.ok && ++shown <= most_ledger_rows)
        table.row({html_text(run.id), html_text(run.test), count_text(run.packing),
                   html_tag(run.cause, "bad"), html_text(run.message)});
    html += table.html();
  } else if (!input.ledger.empty()) {
    html += html_paragraph("No run failed.");
  }
  if (!input.ledger.empty()) {
    HtmlTable table("", {"Run", "Test", ">Packing", "Outcome", ">Seconds", "Directory"});
    for (std::size_t i = 0; i < std::min(most_ledger_rows, input.ledger.size()); ++i) {
      const ReportRun &run = input.ledger[i];
      table.row({html_text(run.id), html_text(run.test), count_text(run.packing),
                 run.ok ? "ok" : html_tag(run.cause, "bad"),
                 html_number(run.wall_seconds, fixed(run.wall_seconds, 1)),
                 html_text(run.directory)});
    }
    std::string words = "All " + counted(static_cast<long>(input.ledger.size()), "run", "runs");
    if (input.ledger.size() > most_ledger_rows)
      words = "The first " + count_text(most_ledger_rows) + " of " +
              counted(static_cast<long>(input.ledger.size()), "run", "runs") +
              "; result.json has all";
    html +=
        "<details><summary>" + html_text(words) + "</summary>\n" + table.html() + "</details>\n";
  }
  if (input.fits.empty() && input.ledger.empty()) html += html_paragraph("No runs are recorded.");
  return html + "</section>\n";
}

std::string commands_section(const ReportInput &input) {
  std::string html = "<section id=\"commands\">\n<h2>Commands to replay</h2>\n";
  const std::string all = !input.replay.empty() ? input.replay
                          : input.fits.empty()  ? ""
                                                : input.fits.front().replay;
  if (all.empty())
    html += html_paragraph("The command that made this result is not recorded.");
  else
    html += html_paragraph("The whole result:") + html_command(all);
  for (const ReportFit &fit : input.fits) {
    if (!fit.replay.empty() && fit.replay != all)
      html += html_paragraph("The fit \u201c" + fit.name + "\u201d:") + html_command(fit.replay);
    for (const ReportRunFiles &run : fit.best_runs)
      if (!run.replay.empty())
        html += html_paragraph("The run of the test \u201c" + run.test +
                               "\u201d behind the fit \u201c" + fit.name + "\u201d:") +
                html_command(run.replay);
  }
  return html + "</section>\n";
}

std::string page_html(const ReportInput &input, const PageFigures &figures) {
  struct Section {
    const char *id, *name;
    std::string html;
  };
  const std::vector<Section> sections = {
      {"result", "Result", result_section(input, figures)},
      {"tests", "Virtual tests", tests_section(input, figures)},
      {"tradeoff", "Trade-off", tradeoff_section(input, figures)},
      {"convergence", "Convergence", convergence_section(input, figures)},
      {"packings", "Packings and resolution", packings_section(input)},
      {"assumptions", "Assumptions", assumptions_section(input)},
      {"runs", "Runs", runs_section(input)},
      {"commands", "Commands", commands_section(input)},
  };
  const std::string title = input.study_title.empty() ? input.study_name : input.study_title;
  std::string html =
      "<!DOCTYPE html>\n<!-- SPDX-License-Identifier: GPL-2.0-or-later -->\n<html "
      "lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<meta "
      "name=\"color-scheme\" content=\"light dark\"/>\n<title>" +
      html_text(title) + " \u2013 BondLab</title>\n<style>\n" + page_style() +
      "</style>\n</head>\n<body>\n" + page_header(input) + "<nav aria-label=\"Sections\">\n";
  for (const Section &section : sections)
    if (!section.html.empty())
      html += std::string("<a href=\"#") + section.id + "\">" + section.name + "</a>\n";
  html += "</nav>\n</header>\n<main>\n";
  for (const Section &section : sections) html += section.html;
  html += "</main>\n<footer>\n" +
          html_paragraph("Study file: " +
                         (input.study_file.empty() ? std::string("not known") : input.study_file) +
                         ". All numbers with all their digits are in result.json; the pictures as "
                         "files of their own, the plotted data and the plot "
                         "scripts are in the directory pictures, both beside this page.");
  return html + "</footer>\n</body>\n</html>\n";
}

}  // namespace bondlab
