// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/from_fit.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.h"
#include "report/number_text.h"
#include "report/result_folder.h"

namespace bondlab {
namespace {

double shown(double si, const std::string &unit) {
  return std::isfinite(si) ? from_si(si, unit) : no_number;
}
// A difference: without the offset that a temperature scale has.
double shown_width(double si, const std::string &unit) {
  return std::isfinite(si) ? from_si(si, unit) - from_si(0, unit) : no_number;
}

std::string kind_word(FindingKind kind) {
  switch (kind) {
    case FindingKind::unreachable_target:
      return "unreachable_target";
    case FindingKind::unreachable_ratio:
      return "unreachable_ratio";
    case FindingKind::joint_misfit:
      return "joint_misfit";
    case FindingKind::ridge:
      return "ridge";
    case FindingKind::at_bound:
      return "at_bound";
    case FindingKind::quality:
      return "quality";
    case FindingKind::failure:
      return "failure";
    case FindingKind::reachable:
      return "reachable";
  }
  return "other";
}

std::string function_of(const Study &study, const TargetResult &t) {
  if (!t.envelope.empty()) return "envelope." + t.response;
  const auto &responses = study.test(t.test).definition.responses;
  const auto response = responses.find(t.response);
  if (response == responses.end())
    throw UserError("the test '" + t.test + "' has no response '" + t.response + "'");
  return response->second.function;
}

ReportTarget target_of(const Study &study, const TargetResult &t) {
  ReportTarget r;
  r.name = t.name, r.test = t.test, r.envelope = t.envelope, r.unit = t.unit;
  r.function = function_of(study, t);
  r.measured = shown(t.measured, t.unit), r.simulated = shown(t.simulated, t.unit);
  r.sd = shown_width(t.sd, t.unit), r.tolerance = shown_width(t.tolerance, t.unit);
  r.noise_sd = shown_width(t.noise_sd, t.unit);
  r.met = t.met, r.in_fit = t.in_fit, r.why_missing = t.why_missing;
  r.source = t.source, r.sd_source = t.sd_source;
  return r;
}

ReportParameter parameter_of(const Study &study, const ParameterResult &p) {
  ReportParameter r;
  r.name = p.name, r.unit = p.unit;
  r.value = shown(p.value, p.unit), r.sd = shown_width(p.sd, p.unit);
  r.interval_lower = shown(p.interval_lower, p.unit),
  r.interval_upper = shown(p.interval_upper, p.unit);
  r.lower = shown(p.lower, p.unit), r.upper = shown(p.upper, p.unit);
  r.at_bound = p.at_bound != BoundSide::none, r.identifiable = p.identifiable, r.reason = p.reason;
  const Parameter &parameter = study.parameter(p.name);
  r.logarithmic = parameter.scale == Scale::logarithmic, r.sets = parameter.sets;
  return r;
}

std::vector<double> shown_point(const FitResult &result, const std::vector<double> &si) {
  std::vector<double> values;
  for (std::size_t p = 0; p < si.size(); ++p)
    values.push_back(
        shown(si[p], p < result.parameter_units.size() ? result.parameter_units[p] : "1"));
  return values;
}

ReportRunFiles run_files(const Study &study, const TestOutcome &best,
                         const std::filesystem::path &directory) {
  const TestDefinition &definition = study.test(best.test).definition;
  const ForwardOutcome &outcome = best.outcome;
  ReportRunFiles r;
  r.test = best.test, r.kind = definition.name;
  r.directory =
      path_in_result(outcome.ok ? outcome.run_directory : outcome.failure.run_directory, directory);
  r.curve = definition.curve, r.events = definition.events, r.particles = definition.particles;
  r.variables = outcome.deck_variables, r.quality = best.quality;
  r.ok = outcome.ok, r.run_id = outcome.run_id, r.wall_seconds = outcome.wall_seconds;
  r.replay = outcome.replay_command;
  if (!outcome.ok) r.failure = to_string(outcome.failure.cause) + ": " + outcome.failure.message;
  return r;
}

ReportFit fit_of(const Study &study, const FitResult &result, const SingleFit &fit,
                 const std::filesystem::path &directory) {
  ReportFit r;
  r.name = fit.name, r.converged = fit.converged, r.verdict = fit.verdict, r.misfit = fit.misfit;
  r.degrees_of_freedom = fit.degrees_of_freedom, r.correlation = fit.correlation,
  r.notes = fit.notes;
  for (const TargetResult &target : fit.targets) r.targets.push_back(target_of(study, target));
  for (const ParameterResult &parameter : fit.parameters)
    r.parameters.push_back(parameter_of(study, parameter));
  for (const HistoryEntry &entry : fit.history)
    r.history.push_back({entry.runs, entry.phase, entry.misfit, entry.best_misfit, entry.accepted,
                         shown_point(result, entry.parameters)});
  for (const PackingScatter &row : fit.packings) {
    ReportPacking packing;
    packing.name = row.target, packing.unit = row.unit;
    packing.measured = shown(study.target(row.target).value, row.unit),
    packing.used = shown(row.reference, row.unit);
    packing.mean = shown(row.mean, row.unit), packing.sd = shown_width(row.sd, row.unit);
    for (const double value : row.values) packing.values.push_back(shown(value, row.unit));
    packing.failed = row.failed;
    r.packings.push_back(packing);
  }
  for (const TestOutcome &best : fit.best) r.best_runs.push_back(run_files(study, best, directory));
  for (const StrengthEnvelope &envelope : fit.envelopes)
    r.envelopes.push_back(report_envelope(study, envelope));
  for (const Finding &finding : fit.findings)
    r.findings.push_back({kind_word(finding.kind), finding.text, finding.targets, finding.measured,
                          finding.low, finding.high, finding.points});
  r.forward_runs = fit.runs.forward, r.from_store = fit.runs.from_store,
  r.failed_runs = fit.runs.failed;
  r.wall_seconds = fit.runs.wall_seconds, r.run_seconds = fit.runs.run_seconds;
  return r;
}

std::string radius_note(const Study &study) {
  std::set<std::string> radii;
  for (const SpecimenEntry &s : study.specimens)
    radii.insert(significant(1e3 * s.r_min, 3) + " to " +
                 significant(1e3 * s.r_min * s.r_ratio, 3) + " mm");
  if (radii.empty()) return "";
  return "The particle radius is " + list_text({radii.begin(), radii.end()}) +
         ". It belongs to the material, not to the numerics alone: with the bond strengths found "
         "here the fracture toughness "
         "K_IC grows with the square root of the radius. The identified set holds for this radius.";
}

}  // namespace

std::string path_in_result(const std::filesystem::path &path,
                           const std::filesystem::path &directory) {
  if (path.empty()) return "";
  const auto inner = std::filesystem::absolute(path).lexically_normal();
  const auto outer = (std::filesystem::absolute(directory) / "").lexically_normal();
  const auto relative = inner.lexically_relative(outer);
  const bool inside = !relative.empty() && *relative.begin() != "..";
  return inside ? relative.generic_string() : inner.generic_string();
}

ReportEnvelope report_envelope(const Study &study, const StrengthEnvelope &envelope) {
  ReportEnvelope r;
  r.name = envelope.name, r.response = envelope.response, r.over = envelope.over;
  r.unit = envelope.unit, r.left_out = envelope.left_out, r.why_none = envelope.why_none;
  for (const EnvelopePoint &point : envelope.points) {
    r.tests.push_back(point.test);
    r.over_values.push_back(shown(point.over, r.unit));
    r.values.push_back(shown(point.value, r.unit));
  }
  if (envelope.line) {
    r.cohesion = shown(envelope.line->cohesion, r.unit);
    r.cohesion_error = shown_width(envelope.line->cohesion_error, r.unit);
    r.friction_angle = envelope.line->friction_angle;
    r.friction_angle_error = envelope.line->friction_angle_error;
  }
  for (const Target &target : study.targets) {
    if (target.envelope != envelope.name) continue;
    const bool cohesion = target.response == "cohesion";
    const std::string unit = cohesion ? r.unit : "deg";
    (cohesion ? r.measured_cohesion : r.measured_friction_angle) = shown(target.value, unit);
    (cohesion ? r.measured_cohesion_sd : r.measured_friction_angle_sd) = shown_width(target.sd, unit);
  }
  return r;
}

ReportInput report_input(const Study &study, const FitResult &result,
                         const std::filesystem::path &directory) {
  ReportInput input;
  input.study_name = result.study, input.study_title = result.title,
  input.study_file = result.study_file;
  input.tolerance_text = result.tolerance_text, input.replay = result.replay;
  for (const SingleFit &fit : result.fits) {
    input.fits.push_back(fit_of(study, result, fit, directory));
    input.fits.back().replay = result.replay;
  }
  for (const LedgerPoint &point : result.ledger) {
    ReportPoint r;
    r.phase = point.phase, r.parameters = shown_point(result, point.parameters);
    for (const auto &response : point.responses)
      r.responses[response.first] = shown(response.second, study.target(response.first).unit);
    input.points.push_back(std::move(r));
  }
  input.specimens = read_specimens(study, directory);
  input.ledger = read_ledger(directory);
  if (study.data)
    for (const Measurement &measurement : study.data->measurements)
      for (const MeasuredCurve &curve : measurement.replicates) {
        const std::string label =
            curve.replicate.empty() ? measurement.name : measurement.name + " " + curve.replicate;
        input.measured_curves.push_back(
            {measurement.test, label, measurement.source, curve.names, curve.columns});
      }
  for (const Assumption &assumption : study.assumptions)
    input.assumptions.push_back({assumption.text, assumption.source});
  input.resolution_note = radius_note(study);
  return input;
}

}  // namespace bondlab
