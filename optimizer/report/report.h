// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one self-contained HTML page that says what a study found, with the pictures and plotted
//   data beside it.
// Method: ReportInput is the content of result.json as plain data (result_json.h reads and writes
//   it). write_report() draws from it and from the files of the runs it names: curves by gnuplot,
//   specimens by our own SVG writer. Everything is made in a staging directory first and moved into
//   place at the end, so that a report is either the old one or the new one. The same input gives
//   the same bytes: no dates, no machine names.
// Why an own struct and not the fit's: `bondlab report DIR` rebuilds the page from DIR alone, long
//   after the fit.
// Units: a number with a `unit` beside it is in that unit; everything else is in SI (s, m, Pa, N).
//   NaN means "none" and is null in the JSON.
// Failure: UserError when gnuplot is missing or fails or a file can't be written. A run file that
//   is missing or damaged isn't an error: the page says so in that picture's place.
// Limits: pictures of 2D specimens and mid-plane slices of 3D.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace bondlab {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct ReportTarget {
  std::string name;
  std::string test;      // of the study; empty: of an envelope
  std::string envelope;  // of the study; empty: of a test
  std::string function;  // "uniaxial.peak_stress": tells where the value is drawn in the curve;
                         // "envelope.cohesion"
  std::string unit;      // of the numbers that follow
  double measured = no_number, sd = no_number;
  double tolerance = no_number;  // |simulated - measured| that counts as met
  double simulated = no_number;  // no number: see why_missing
  double noise_sd =
      no_number;  // scatter of the simulated value under tiny changes of the parameters
  bool met = false;
  bool in_fit = true;  // false: predicted only
  std::string why_missing;
  std::string source, sd_source;
};

struct ReportParameter {
  std::string name;
  std::string unit;  // of the numbers that follow
  double value = no_number;
  double sd = no_number;                                          // no number: not identifiable
  double interval_lower = no_number, interval_upper = no_number;  // 95 %
  double lower = no_number, upper = no_number;                    // bounds
  bool logarithmic = false;
  bool at_bound = false;
  bool identifiable = true;
  std::string reason;             // why not identifiable, or what the data say at a bound
  std::vector<std::string> sets;  // deck variables that take the value
};

// One step of the fit's way: a parameter set, all tests run once.
struct ReportStep {
  int runs = 0;               // forward runs made until then
  std::string phase;          // design, noise, refine, polish
  double misfit = no_number;  // no number: failed
  double best_misfit = no_number;
  bool accepted = false;
  std::vector<double> parameters;  // as ReportFit::parameters, in their units
};

// What the fit found out about the problem itself.
struct ReportFinding {
  std::string kind;  // unreachable_target, unreachable_ratio, joint_misfit, ridge, at_bound,
                     // quality, failure ...
  std::string text;  // plain words
  std::vector<std::string> targets;
  double measured = no_number;               // figure or ratio, SI
  double low = no_number, high = no_number;  // its span over all runs
  int points = 0;
};

// The run that the result rests on, one a test. Paths are relative to the result's directory where
// they can be.
struct ReportRunFiles {
  std::string test;       // name in the study
  std::string kind;       // folder of the virtual test: "uniaxial_compression"
  std::string directory;  // of the run
  std::string curve = "curve.tsv", events = "broken_bonds.tsv", particles = "particles_end.txt";
  std::map<std::string, double>
      variables;  // deck variables, SI: dim, width, height, diameter, thickness ...
  std::map<std::string, double> quality;  // figures of response/, SI
  bool ok = true;
  std::string failure;  // cause and message of a failed run
  std::string run_id;
  double wall_seconds = no_number;
  std::string replay;  // command
};

// A straight line value = c + over tan(phi) through one response of several tests, and what was
// measured of it. Angles in degrees.
struct ReportEnvelope {
  std::string name, response, over;
  std::string unit;                 // of the numbers that follow
  std::vector<std::string> tests;   // that gave a point
  std::vector<double> over_values, values;  // one each
  double cohesion = no_number, cohesion_error = no_number;  // no number: see why_none
  double friction_angle = no_number, friction_angle_error = no_number;
  double measured_cohesion = no_number, measured_cohesion_sd = no_number;
  double measured_friction_angle = no_number, measured_friction_angle_sd = no_number;
  std::vector<std::string> left_out;  // "shear_5: why"
  std::string why_none;
};

// A response on packings other than the one the fit used.
struct ReportPacking {
  std::string name, unit;  // of a target; unit of the numbers that follow
  double measured = no_number;
  double used = no_number;  // on the fit's packing
  double mean = no_number, sd = no_number;
  std::vector<double> values;  // one a packing that worked
  int failed = 0;
};

struct ReportFit {
  std::string name;
  bool converged = false;
  std::string verdict;  // one or two sentences a person reads first
  double misfit = no_number;
  int degrees_of_freedom = 0;
  std::vector<ReportTarget> targets;
  std::vector<ReportParameter> parameters;
  std::vector<std::vector<double>> correlation;  // of the parameters; empty: not known
  std::vector<ReportStep> history;
  std::vector<ReportPacking> packings;
  std::vector<ReportRunFiles> best_runs;
  std::vector<ReportEnvelope> envelopes;  // through the best runs
  std::vector<ReportFinding> findings;
  std::vector<std::string> notes;  // what was done and why
  int forward_runs = 0;            // asked for, those out of the store included
  int from_store = 0;
  int failed_runs = 0;
  double wall_seconds = no_number;
  double run_seconds = no_number;  // sum over the runs
  std::string replay;              // the command that gives this result again
};

// One parameter set with what came out; all fits together, on the packing of the fit.
struct ReportPoint {
  std::string phase;
  std::vector<double> parameters;  // as the first fit's parameters, in their units
  std::map<std::string, double>
      responses;  // by target, in the first fit's units; only those that could be had
};

struct ReportSpecimen {
  std::string name, shape;                      // rectangle, disc, cylinder
  std::string size;                             // "50 mm x 100 mm"
  int particles = 0;                            // 0: not known
  double r_min = no_number, r_max = no_number;  // m
  double porosity = no_number, coordination = no_number;
  std::string seed;
};

struct ReportMeasuredCurve {
  std::string test;  // name in the study
  std::string label, source;
  std::vector<std::string> names;            // columns, as in curve.tsv
  std::vector<std::vector<double>> columns;  // SI
};

struct ReportAssumption {
  std::string text;
  std::string source;  // "paper ..." or "assumed"
};

struct ReportRun {
  std::string id, test;
  int packing = 0;
  bool ok = true;
  std::string cause, message;  // of a failure
  double wall_seconds = no_number;
  double steps = no_number, particles = no_number, bonds = no_number,
         bond_step_ns = no_number;  // from the run's log (forward/measured_cost.h)
  std::string directory;
  std::string replay;
};

struct ReportInput {
  std::string study_name, study_title, study_file;
  std::string tolerance_text;   // what "met" means, in words
  std::vector<ReportFit> fits;  // the first is the result; the second, if any, the trade-off
  std::vector<ReportPoint> points;
  std::vector<ReportSpecimen> specimens;
  std::vector<ReportMeasuredCurve> measured_curves;
  std::vector<ReportAssumption> assumptions;
  std::string resolution_note;    // plain words on the particle radius, which carries K_IC
  std::string confirm_command;    // repeats the result at the resolution of the source
  std::vector<ReportRun> ledger;  // every run behind the result
  std::string replay;             // the command that repeats the whole
};

// Writes DIRECTORY/report.html and DIRECTORY/pictures/ (SVG, plotted data as TSV, gnuplot scripts).
// `pictures` is the report's own directory: what an earlier report left there goes. Returns the
// path of the page.
std::filesystem::path write_report(const ReportInput &input, const std::filesystem::path &directory,
                                   const std::string &gnuplot = "gnuplot");

}  // namespace bondlab
