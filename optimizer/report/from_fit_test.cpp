// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/from_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/test_folder.h"
#include "report/result_folder.h"
#include "report/result_json.h"
#include "specimen/specimen.h"
#include "study/specimen_request.h"

namespace bondlab {
namespace {

Study small_study() {
  Study study;
  study.name = "granite", study.title = "Granite";
  SpecimenEntry specimen;
  specimen.name = "body", specimen.size.width = 0.05, specimen.size.height = 0.1, specimen.r_min = 0.66e-3;
  study.specimens.push_back(specimen);
  TestEntry test;
  test.name = "ucs", test.specimen = "body";
  test.definition.name = "uniaxial_compression";
  test.definition.responses["UCS"] = {"UCS", "Pa", "uniaxial.peak_stress", {}};
  study.tests.push_back(test);
  Parameter parameter;
  parameter.name = "E_c", parameter.unit = "GPa", parameter.lower = 15e9, parameter.upper = 45e9;
  parameter.scale = Scale::logarithmic, parameter.sets = {"E_c", "E_b"};
  study.parameters.push_back(parameter);
  Target target;
  target.name = "strength", target.test = "ucs", target.response = "UCS", target.unit = "MPa";
  target.value = 138.8e6, target.sd = 6.94e6, target.source = "paper";
  study.targets.push_back(target);
  study.assumptions.push_back({"mu is 0.5", "assumed"});
  DataFolder data;
  Measurement measurement;
  measurement.name = "slabs", measurement.test = "ucs";
  MeasuredCurve curve;
  curve.replicate = "1", curve.names = {"strain_axial", "axial_stress"},
  curve.columns = {{0, 1e-3}, {0, 40e6}};
  measurement.replicates.push_back(curve);
  data.measurements.push_back(measurement);
  study.data = data;
  return study;
}

FitResult small_result(const std::filesystem::path &directory) {
  FitResult result;
  result.study = "granite", result.title = "Granite", result.tolerance_text = "within 3 %",
  result.replay = "bondlab fit x";
  result.parameter_names = {"E_c"}, result.parameter_units = {"GPa"};
  SingleFit fit;
  fit.name = "main", fit.verdict = "Met.", fit.misfit = 0.5;
  TargetResult target;
  target.name = "strength", target.test = "ucs", target.response = "UCS", target.unit = "MPa";
  target.measured = 138.8e6, target.sd = 6.94e6, target.tolerance = 4.164e6,
  target.simulated = 137e6, target.noise_sd = 0.5e6;
  target.met = target.in_fit = true;
  fit.targets.push_back(target);
  ParameterResult parameter;
  parameter.name = "E_c", parameter.unit = "GPa", parameter.value = 28e9, parameter.sd = NAN;
  parameter.interval_lower = parameter.interval_upper = NAN, parameter.lower = 15e9,
  parameter.upper = 45e9;
  parameter.at_bound = BoundSide::upper, parameter.identifiable = false, parameter.reason = "flat";
  fit.parameters.push_back(parameter);
  HistoryEntry entry;
  entry.runs = 3, entry.phase = "design", entry.misfit = 9, entry.best_misfit = 9,
  entry.parameters = {30e9};
  fit.history.push_back(entry);
  PackingScatter row;
  row.target = "strength", row.unit = "MPa", row.reference = 137e6, row.values = {130e6, 140e6},
  row.mean = 135e6, row.sd = 7.07e6, row.failed = 1;
  fit.packings.push_back(row);
  TestOutcome best;
  best.test = "ucs", best.outcome.ok = true,
  best.outcome.run_directory = (directory / "runs" / "1-ucs").string();
  best.outcome.deck_variables = {{"dim", 2}}, best.outcome.run_id = "1";
  fit.best.push_back(best);
  Finding finding;
  finding.kind = FindingKind::unreachable_ratio, finding.text = "no",
  finding.targets = {"strength", "other"};
  fit.findings.push_back(finding);
  fit.runs.forward = 7, fit.runs.failed = 1, fit.runs.wall_seconds = 12;
  result.fits.push_back(fit);
  LedgerPoint point;
  point.phase = "design", point.parameters = {30e9}, point.responses = {{"strength", 120e6}};
  result.ledger.push_back(point);
  return result;
}

TEST(FromFit, ShowsEachNumberInItsUnit) {
  TestFolder folder;
  const ReportInput input = report_input(small_study(), small_result(folder.path()), folder.path());
  ASSERT_EQ(input.fits.size(), 1u);
  const ReportFit &fit = input.fits[0];
  const ReportTarget &target = fit.targets.at(0);
  EXPECT_DOUBLE_EQ(target.measured, 138.8);
  EXPECT_DOUBLE_EQ(target.sd, 6.94);
  EXPECT_DOUBLE_EQ(target.tolerance, 4.164);
  EXPECT_DOUBLE_EQ(target.simulated, 137);
  EXPECT_DOUBLE_EQ(target.noise_sd, 0.5);
  EXPECT_EQ(target.function, "uniaxial.peak_stress");
  const ReportParameter &parameter = fit.parameters.at(0);
  EXPECT_DOUBLE_EQ(parameter.value, 28);
  EXPECT_TRUE(std::isnan(parameter.sd));
  EXPECT_DOUBLE_EQ(parameter.upper, 45);
  EXPECT_TRUE(parameter.at_bound);
  EXPECT_FALSE(parameter.identifiable);
  EXPECT_TRUE(parameter.logarithmic);
  EXPECT_EQ(parameter.sets, (std::vector<std::string>{"E_c", "E_b"}));
  EXPECT_DOUBLE_EQ(fit.history.at(0).parameters.at(0), 30);
  EXPECT_DOUBLE_EQ(fit.packings.at(0).measured, 138.8);
  EXPECT_DOUBLE_EQ(fit.packings.at(0).values.at(1), 140);
  EXPECT_DOUBLE_EQ(fit.packings.at(0).sd, 7.07);
  EXPECT_EQ(fit.packings.at(0).failed, 1);
  EXPECT_EQ(fit.findings.at(0).kind, "unreachable_ratio");
  EXPECT_EQ(fit.forward_runs, 7);
  EXPECT_DOUBLE_EQ(input.points.at(0).parameters.at(0), 30);
  EXPECT_DOUBLE_EQ(input.points.at(0).responses.at("strength"), 120);
  EXPECT_EQ(input.assumptions.at(0).source, "assumed");
  EXPECT_EQ(input.measured_curves.at(0).label, "slabs 1");
  EXPECT_EQ(input.measured_curves.at(0).columns.at(1).at(1), 40e6);
  EXPECT_NE(input.resolution_note.find("0.66 to 1.1 mm"), std::string::npos);
}

TEST(FromFit, NamesRunsRelativeToTheResult) {
  TestFolder folder;
  const ReportInput input = report_input(small_study(), small_result(folder.path()), folder.path());
  EXPECT_EQ(input.fits[0].best_runs.at(0).directory, "runs/1-ucs");
  EXPECT_EQ(input.fits[0].best_runs[0].kind, "uniaxial_compression");
  EXPECT_EQ(to_json(input).find(folder.path().string()), std::string::npos);
  EXPECT_EQ(path_in_result("/a/b/runs/1", "/a/b"), "runs/1");
  EXPECT_EQ(path_in_result("/a/b/runs/1", "/a/b/"), "runs/1");
  EXPECT_EQ(path_in_result("/a/bc/1", "/a/b"), "/a/bc/1");
  EXPECT_EQ(path_in_result("", "/a/b"), "");
}

TEST(FromFit, AFailedRunKeepsItsCauseAndPlace) {
  TestFolder folder;
  FitResult result = small_result(folder.path());
  ForwardOutcome &outcome = result.fits[0].best[0].outcome;
  outcome.ok = false;
  outcome.failure.cause = FailureCause::timeout, outcome.failure.message = "more than 120 s";
  outcome.failure.run_directory = (folder.path() / "runs" / "2-ucs").string();
  const ReportInput input = report_input(small_study(), result, folder.path());
  EXPECT_EQ(input.fits[0].best_runs[0].failure, "timeout: more than 120 s");
  EXPECT_EQ(input.fits[0].best_runs[0].directory, "runs/2-ucs");
}

TEST(ResultFolder, ReadsTheRunsThatEnded) {
  TestFolder folder;
  folder.write(
      "runs/10-split-b/manifest.json",
      R"({"id": 10, "state": "failed", "test": "split", "packing": 2, "cause": "timeout", "message": "slow", "wall_seconds": 120.5})");
  folder.write("runs/9-ucs-a/manifest.json",
               R"({"id": 9, "state": "done", "test": "ucs", "packing": 0, "wall_seconds": 20.25,
                   "cost": {"loop_seconds": 19, "steps": 4000, "particles": 573, "bonds": 1226, "ranks": 1, "ns_per_bond_and_step": 31.5}})");
  folder.write("runs/11-ucs-c/manifest.json",
               R"({"id": 11, "state": "running", "test": "ucs", "packing": 0})");
  folder.write("runs/12-ucs-d/manifest.json", "{\"id\": 12, \"sta");
  folder.write("runs/13-ucs-e/manifest.json",
               R"({"id": "x", "state": "done", "test": "ucs", "packing": 0})");
  folder.write("runs/note.txt", "mine");
  const std::vector<ReportRun> runs = read_ledger(folder.path());
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].id, "9");
  EXPECT_TRUE(runs[0].ok);
  EXPECT_EQ(runs[0].wall_seconds, 20.25);
  EXPECT_EQ(runs[0].directory, "runs/9-ucs-a");
  EXPECT_EQ(runs[0].steps, 4000);
  EXPECT_EQ(runs[0].bonds, 1226);
  EXPECT_EQ(runs[0].bond_step_ns, 31.5);
  EXPECT_TRUE(std::isnan(runs[1].bond_step_ns)) << "a manifest without cost";
  EXPECT_EQ(runs[1].id, "10");
  EXPECT_FALSE(runs[1].ok);
  EXPECT_EQ(runs[1].cause, "timeout");
  EXPECT_EQ(runs[1].packing, 2);
  EXPECT_TRUE(read_ledger(folder / "none").empty());
}

TEST(ResultFolder, AddsThePackingsFiguresWhereTheyAre) {
  TestFolder folder;
  const Study study = small_study();
  ASSERT_EQ(read_specimens(study, folder.path()).size(), 1u);
  EXPECT_EQ(read_specimens(study, folder.path())[0].particles, 0);
  EXPECT_EQ(read_specimens(study, folder.path())[0].size, "50 mm \u00d7 100 mm");
  folder.write(
      "specimens/rectangle-" + specimen_key(specimen_request(study.specimens[0], 0)) + ".json",
      R"({"statistics": {"count": 2043, "r_min": 6.61e-4, "r_max": 1.1e-3, "porosity": 0.158,
                   "coordination": [{"gap_over_r_mean": 0.01, "bonds_per_particle": 3.9}, {"gap_over_r_mean": 0.05, "bonds_per_particle": 4.12}]}})");
  const ReportSpecimen specimen = read_specimens(study, folder.path())[0];
  EXPECT_EQ(specimen.particles, 2043);
  EXPECT_EQ(specimen.r_min, 6.61e-4);
  EXPECT_EQ(specimen.porosity, 0.158);
  EXPECT_EQ(specimen.coordination, 4.12);
}

Target of_envelope(const std::string &response, const std::string &unit, double value) {
  Target target;
  target.name = response, target.envelope = "peak", target.response = response, target.unit = unit;
  target.value = value, target.sd = value / 10;
  return target;
}

// A line with c = 8 MPa and 45 degrees, one test left out.
StrengthEnvelope strength_envelope() {
  StrengthEnvelope envelope;
  envelope.name = "peak", envelope.unit = "MPa", envelope.response = "tau", envelope.over = "sigma_n";
  envelope.points = {{"a", 2e6, 10e6}, {"b", 5e6, 13e6}, {"c", 10e6, 18e6}};
  envelope.left_out = {"d: it crashed"};
  envelope.line = EnvelopeLine{8e6, 0.5e6, 45, 2};
  return envelope;
}

TEST(FromFit, SetsAnEnvelopeBesideItsTargets) {
  TestFolder folder;
  Study study = small_study();
  study.targets.push_back(of_envelope("cohesion", "kPa", 9e6));
  study.targets.push_back(of_envelope("friction_angle", "rad", std::atan(1.0)));
  FitResult result = small_result(folder.path());
  TargetResult target;
  target.name = "cohesion", target.envelope = "peak", target.response = "cohesion", target.unit = "kPa";
  target.measured = 9e6, target.simulated = 8e6;
  result.fits[0].targets.push_back(target);
  result.fits[0].envelopes.push_back(strength_envelope());
  const ReportFit fit = report_input(study, result, folder.path()).fits.at(0);
  EXPECT_EQ(fit.targets.at(1).function, "envelope.cohesion");
  EXPECT_EQ(fit.targets.at(1).envelope, "peak");
  ASSERT_EQ(fit.envelopes.size(), 1u);
  const ReportEnvelope &envelope = fit.envelopes[0];
  EXPECT_EQ(envelope.over_values, (std::vector<double>{2, 5, 10}));
  EXPECT_DOUBLE_EQ(envelope.cohesion, 8);
  EXPECT_DOUBLE_EQ(envelope.friction_angle, 45);
  EXPECT_DOUBLE_EQ(envelope.measured_cohesion, 9) << "MPa, as the envelope, not kPa as the target";
  EXPECT_DOUBLE_EQ(envelope.measured_cohesion_sd, 0.9);
  EXPECT_DOUBLE_EQ(envelope.measured_friction_angle, 45);
  EXPECT_DOUBLE_EQ(envelope.measured_friction_angle_sd, 4.5);
  ReportInput input;
  input.fits.push_back(fit);
  const std::string text = to_json(input);
  EXPECT_EQ(to_json(from_json(text, "result.json")), text);
  EXPECT_EQ(from_json(text, "result.json").fits[0].envelopes.at(0).left_out, envelope.left_out);
}

}  // namespace
}  // namespace bondlab
