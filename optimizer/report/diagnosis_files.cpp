// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/diagnosis_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/units.h"
#include "base/write_file.h"
#include "diagnose/model_with_effect.h"
#include "report/diagnosis_pictures.h"
#include "report/html.h"

namespace bondlab::diagnose {

namespace {

using nlohmann::json;

// A uniform guess within the range has 0.29 of it.
constexpr double unidentified = 0.25;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

std::string shown(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::string sentence(const StudyDiagnosis &d) {
  switch (d.diagnosis.verdict) {
    case Verdict::one:
      return "One effect is missing.";
    case Verdict::set:
      return "An effect is missing; these data can't separate the following.";
    case Verdict::two:
      return "Two effects are missing.";
    case Verdict::not_in_catalogue:
      return "Something is missing that is not in the catalogue.";
    case Verdict::nothing:
      return "Nothing is missing that these data could show.";
  }
  return "";
}

std::string effect_line(const StudyDiagnosis &d, const NamedEffect &e) {
  const auto &entry = d.catalogue[e.effect];
  const auto size = [&](double v) { return format_quantity(v, entry.unit, 3); };
  return fmt::format("{} ({}): {} {}, 95 % from {} to {}, p {:.2g}, margin {} in chi squared",
                     entry.name, entry.title, entry.size_name, size(e.size), size(e.low),
                     size(e.high), e.p, shown(e.margin));
}

std::vector<SizedEffect> switched_on(const StudyDiagnosis &d) {
  std::vector<SizedEffect> out;
  const auto v = d.diagnosis.verdict;
  if (v == Verdict::nothing || v == Verdict::not_in_catalogue) return out;
  for (std::size_t k = 0; k < d.sizes.size(); ++k)
    if (d.sizes[k] != 0) out.push_back({d.effects[k], d.sizes[k]});
  return out;
}

std::string residual_rows(const StudyDiagnosis &d) {
  HtmlTable table("Whitened residual by part of the curve",
                  {"series", "part", "quantity", ">before", ">after"});
  for (std::size_t i = 0; i < d.rows.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const auto &r = d.rows[i];
    const auto cell = [&](const Eigen::VectorXd &v) {
      return html_number(v(k), fmt::format("{:+.1f}", v(k)));
    };
    table.row({html_text(r.series), to_string(r.part), html_text(r.quantity),
               cell(d.diagnosis.before.residual), cell(d.diagnosis.after.residual)});
  }
  return table.html();
}

// What was tried, best first: an effect or a pair, and how far it is behind.
std::vector<std::string> tried_lines(const StudyDiagnosis &d) {
  auto tried = d.diagnosis.tried;
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Tried &a, const Tried &b) { return a.behind < b.behind; });
  std::vector<std::string> out;
  for (const auto &one : tried) {
    std::string names;
    for (std::size_t i = 0; i < one.effects.size(); ++i) {
      const auto &entry = d.catalogue[one.effects[i]];
      names += fmt::format("{}{} {}", i > 0 ? ", " : "", entry.name,
                           format_quantity(one.amplitudes[i] * entry.switch_on, entry.unit, 3));
    }
    const std::string line = fmt::format("{:>8.1f}  {}", one.behind, names);
    if (std::find(out.begin(), out.end(), line) == out.end()) out.push_back(line);
  }
  if (out.size() > 12) out.resize(12);
  return out;
}

}  // namespace

std::string diagnosis_json(const Study &study, const StudyDiagnosis &d) {
  json out;
  out["verdict"] = to_string(d.diagnosis.verdict);
  out["effects"] = json::array();
  for (const auto &e : d.diagnosis.effects)
    out["effects"].push_back({{"name", d.catalogue[e.effect].name},
                              {"size", number(e.size)},
                              {"interval", {number(e.low), number(e.high)}},
                              {"p", number(e.p)},
                              {"margin", number(e.margin)}});
  out["where"] = json::array();
  for (const auto &spot : d.diagnosis.where)
    out["where"].push_back({{"name", spot.name}, {"score", number(spot.score)}});
  out["advice"] = d.advice;
  out["gap"] = {{"before", number(d.gap.before)},
                {"after", number(d.gap.after)},
                {"holdout_before", number(d.gap.holdout_before)},
                {"holdout_after", number(d.gap.holdout_after)},
                {"placebo_after", number(d.gap.placebo_after)},
                {"noise_floor", number(d.gap.noise_floor)}};
  out["parameters"] = json::array();
  for (std::size_t i = 0; i < study.parameters.size(); ++i)
    out["parameters"].push_back({{"name", study.parameters[i].name},
                                 {"unit", "SI"},
                                 {"before", number(d.parameters_before[i])},
                                 {"sd_before", number(d.sd_before[i])},
                                 {"after", number(d.parameters_after[i])},
                                 {"sd_after", number(d.sd_after[i])}});
  if (d.cross.before > 0)
    out["held_out_in_turn"] = {{"before", number(d.cross.before)},
                               {"after", number(d.cross.after)},
                               {"placebo", number(d.cross.placebo)},
                               {"floor", number(d.cross.floor)}};
  return out.dump(2) + "\n";
}

std::string diagnosis_text(const Study &study, const StudyDiagnosis &d) {
  const auto &g = d.diagnosis;
  std::string out = fmt::format("{}: {}\n\nverdict: {}\n{}\n", study.name, study.title,
                                to_string(g.verdict), sentence(d));
  for (const auto &e : g.effects) out += "  " + effect_line(d, e) + "\n";
  out += fmt::format(
      "  alarm set to {:.0f} % false; p of the whole {:.2g}, of the best trace {:.2g}; margin to "
      "the best not named {}\n",
      100 * g.false_alarm, g.p_omnibus, g.p_trace, shown(g.margin));
  out += "\nwhere it shows:\n";
  if (g.where.empty()) out += "  nowhere beyond chance\n";
  for (std::size_t i = 0; i < std::min<std::size_t>(g.where.size(), 8); ++i)
    out += fmt::format("  {:<48} {:5.1f}\n", g.where[i].name, g.where[i].score);
  if (const auto *worst = d.scatter.worst())
    out += fmt::format(
        "  scatter of strengths, specimens' over packings' sd: {:.2f} in the most unlikely block "
        "({}), p of it among all {:.2g}\n",
        std::sqrt(worst->ratio), worst->name, d.scatter.p);
  const auto tried = tried_lines(d);
  if (!tried.empty()) out += "\nexplanations refitted, chi squared behind the best:\n";
  for (const auto &line : tried) out += "  " + line + "\n";
  out += "\ngap, noise units a row                before   after\n";
  for (const auto &s : d.by_series)
    out += fmt::format("  {:<34} {:>7}  {:>7}{}\n", s.name, shown(s.before), shown(s.after),
                       s.held_out ? "  held out; a placebo: " + shown(d.gap.placebo_after) : "");
  out += fmt::format("  {:<34} {:>7}  {:>7}  floor {}{}\n", "all that was fitted",
                     shown(d.gap.before), shown(d.gap.after), shown(d.gap.noise_floor),
                     d.holdout.empty() ? "; a placebo: " + shown(d.gap.placebo_after) : "");
  out += fmt::format("  gain in chi squared: {} predicted, {} realised, {} by the engine itself\n",
                     shown(g.predicted_gain), shown(g.realised_gain), shown(d.confirmed_gain));
  if (d.cross.before > d.cross.floor && d.cross.floor > 0)
    out += fmt::format(
        "  every series held out in turn: {:.0f} % of the way to the noise floor "
        "closed, by a placebo {}\n",
        100 * d.cross.closed(),
        std::isfinite(d.cross.placebo) ? fmt::format("{:.0f} %", 100 * d.cross.closed_by_placebo())
                                       : "none: one row alone shows the effect");
  out += "\nparameters                      before                     after\n";
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    const auto &p = study.parameters[i];
    const auto quantity = [&](double v, double sd) {
      return format_quantity(v, p.unit) + " sd " + format_quantity(sd, p.unit, 2);
    };
    out += fmt::format("  {:<14} {:<30} {}\n", p.name,
                       quantity(d.parameters_before[i], d.sd_before[i]),
                       quantity(d.parameters_after[i], d.sd_after[i]));
  }
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    const auto &p = study.parameters[i];
    const double sd = d.sd_after[i], range = p.upper - p.lower;
    if (!std::isfinite(sd) || sd > unidentified * range)
      out += fmt::format(
          "  {}: these data can't identify it (its sd is {} of its range)\n", p.name,
          std::isfinite(sd) ? fmt::format("{:.0f} %", 100 * sd / range) : "more than all");
  }
  out += "\ncan't be told apart well (at the fitted point, from no residual; ten noise units)\n";
  if (d.isolability.empty()) out += "  none\n";
  for (const auto &line : isolability_lines(d.isolability)) out += "  " + line + "\n";
  for (const auto &name : d.hidden) out += "  " + name + ": not seen by these tests\n";
  out +=
      "  what only widens the scatter between specimens is told apart by no row: see scatter "
      "above\n";
  out += "\nsmallest size that would have been seen (90 %)\n";
  for (std::size_t k = 0; k < g.smallest_size.size(); ++k)
    out += fmt::format("  {:<26} {}\n", d.catalogue[k].name,
                       std::isfinite(g.smallest_size[k])
                           ? format_quantity(g.smallest_size[k], d.catalogue[k].unit, 2)
                           : "none");
  for (const auto &note : g.noise.notes) out += "\nnoise: " + note + "\n";
  for (const auto &line : d.advice) out += "\nadvice: " + line + "\n";
  out += fmt::format("\nruns asked for: {}\n", d.runs);
  return out;
}

std::string diagnosis_page(const Study &study, const StudyDiagnosis &d) {
  std::string body = fmt::format("<h1>{}: what is missing?</h1>", html_text(study.title));
  body += html_paragraph(sentence(d));
  std::vector<std::string> lines;
  for (const auto &e : d.diagnosis.effects) lines.push_back(effect_line(d, e));
  if (!lines.empty()) body += html_list(lines);
  const auto where = where_picture(d);
  if (!where.empty())
    body += "<h2>Where it shows</h2>" +
            html_paragraph(
                "Residual of each part of each curve in noise units; red: measured "
                "above the model, blue: below. Beyond 3 or so is not chance.") +
            where;
  for (const auto &s : d.shown) {
    const auto picture = curve_picture(s);
    if (picture.empty()) continue;
    body += "<h2>" + html_text(s.name) + (s.name == d.holdout ? " (held out)" : "") + "</h2>" +
            html_paragraph("Grey: measured. Red, dashed: best fit before. Blue: after.") + picture;
  }
  body += residual_rows(d);
  body += "<h2>All figures</h2><pre>" + html_text(diagnosis_text(study, d)) + "</pre>";
  return "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\"><head><meta "
         "charset=\"utf-8\"/><title>" +
         html_text(study.title) +
         "</title><style>body{font:15px sans-serif;max-width:60em;margin:2em auto}"
         "table{border-collapse:collapse}td,th{padding:2px 10px;border-bottom:1px solid "
         "#ddd}</style></head><body>" +
         body + "</body></html>\n";
}

std::filesystem::path write_diagnosis(const Study &study, const StudyDiagnosis &d,
                                      const std::filesystem::path &out) {
  make_folder(out);
  write_file(out / "diagnosis.json", diagnosis_json(study, d));
  write_file(out / "diagnosis.txt", diagnosis_text(study, d));
  write_file(out / "diagnosis.html", diagnosis_page(study, d));
  const auto effects = switched_on(d);
  if (effects.empty()) return {};
  const auto changed = study_with_effects(study, effects, d.parameters_after);
  write_file(out / "model.diff", readable_diff(study.source_text, changed));
  const auto file = out / "model_with_effect.toml";
  write_file(file, moved_study(changed, study.file, out));
  return file;
}

}  // namespace bondlab::diagnose
