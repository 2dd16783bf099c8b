// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/study_evidence.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "diagnose/coordinate_way.h"
#include "diagnose/covariance.h"
#include "diagnose/sensor_noise.h"
#include "forward/run_plan.h"

namespace bondlab::diagnose {

namespace {

constexpr std::uint64_t sensor_seed = 1;
constexpr double sensor_dof = 60;  // of its variance: some replicates, twelve draws each

MeasuredSeries from_curves(const Study &study, const Measurement &measurement, bool whole) {
  MeasuredSeries out;
  out.probed.name = measurement.name;
  out.probed.test = measurement.test.empty() ? measurement.name : measurement.test;
  out.conditions = measurement.conditions;
  const TestEntry &test = study.test(out.probed.test);
  const auto variables = plan_run(study, {test.name, {}, 0}).numeric;
  std::vector<std::string> columns = measurement.replicates.front().names;
  for (const auto &replicate : measurement.replicates)
    columns.erase(std::remove_if(columns.begin(), columns.end(),
                                 [&](const std::string &name) {
                                   return std::find(replicate.names.begin(), replicate.names.end(),
                                                    name) == replicate.names.end();
                                 }),
                  columns.end());
  std::vector<std::string> responses;
  for (const auto &[name, response] : test.definition.responses) responses.push_back(name);
  const auto all = quantities_of(columns, responses);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(measurement.replicates.size()),
                       static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < measurement.replicates.size(); ++i) {
    const auto &replicate = measurement.replicates[i];
    Curve curve;
    curve.names = replicate.names, curve.units = replicate.units;
    curve.columns = replicate.columns;
    curve.complete = true;
    rows.row(static_cast<Eigen::Index>(i)) =
        rows_of_curve(curve, all, test.definition, variables).transpose();
    out.curves.push_back(std::move(curve));
  }
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < rows.cols(); ++j)
    if (whole || rows.col(j).allFinite()) {
      kept.push_back(j);
      out.probed.quantities.push_back(all[static_cast<std::size_t>(j)]);
    }
  out.replicates.resize(rows.rows(), static_cast<Eigen::Index>(kept.size()));
  for (std::size_t j = 0; j < kept.size(); ++j)
    out.replicates.col(static_cast<Eigen::Index>(j)) = rows.col(kept[j]);
  out.sensors =
      sensor_variance(out.curves, out.probed.quantities, test.definition, variables, sensor_seed);
  return out;
}

CurvePart part_of(const std::string &function) {
  if (function.find("peak") != std::string::npos || function.find("strength") != std::string::npos)
    return CurvePart::peak;
  return CurvePart::slope;
}

std::vector<MeasuredSeries> from_targets(const Study &study) {
  std::vector<MeasuredSeries> out;
  for (const auto &test : study.tests) {
    MeasuredSeries series;
    series.probed.name = series.probed.test = test.name;
    std::vector<double> value, sd;
    for (const auto &target : study.targets) {
      if (target.test != test.name || !(target.value > 0)) continue;
      series.probed.quantities.push_back(
          {part_of(test.definition.responses.at(target.response).function),
           "response " + target.response});
      value.push_back(std::log(target.value));
      sd.push_back(target.sd / target.value);
    }
    if (value.empty()) continue;
    const auto count = static_cast<Eigen::Index>(value.size());
    series.replicates = Eigen::Map<Eigen::RowVectorXd>(value.data(), count);
    series.stated =
        Eigen::Map<Eigen::VectorXd>(sd.data(), count).array().square().matrix().asDiagonal();
    out.push_back(series);
  }
  return out;
}

// How much more than packings the specimens scatter, one a row: by their sensors, and besides; a
// quantity of one kind of test has the same excess over both in all its series.
Eigen::VectorXd excess_of(const Study &study, const std::vector<MeasuredSeries> &series,
                          const Eigen::MatrixXd &by_packing) {
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  std::vector<ExcessTally> tallies;
  std::vector<std::size_t> tally_of_row;
  Eigen::Index row = 0;
  Eigen::VectorXd by_sensors = Eigen::VectorXd::Zero(by_packing.cols());
  const double packings_dof = static_cast<double>(by_packing.rows()) - 1;
  for (const auto &s : series) {
    const auto &test = study.test(s.probed.test).definition.name;
    const Eigen::VectorXd own = variances(s.replicates);
    const Eigen::Index first = row;
    for (std::size_t j = 0; j < s.probed.quantities.size(); ++j, ++row) {
      const auto place =
          places.emplace(std::make_pair(test, s.probed.quantities[j].name), tallies.size());
      if (place.second) tallies.emplace_back();
      tally_of_row.push_back(place.first->second);
      if (s.stated.size() > 0) continue;
      const double packings = variances(by_packing.col(row))(0),
                   sensors = s.sensors.size() > 0 ? s.sensors(row - first) : 0;
      if (packings > 0) by_sensors(row) = sensors / packings;
      const double both = packings + sensors;
      // Welch and Satterthwaite's, of a sum of two variances.
      const double dof =
          both * both / (packings * packings / packings_dof + sensors * sensors / sensor_dof);
      tallies[tally_of_row.back()].add(own(static_cast<Eigen::Index>(j)), both,
                                       static_cast<double>(s.replicates.rows()) - 1, dof);
    }
  }
  const auto excess = excess_scatter(tallies);
  Eigen::VectorXd out(row);
  for (Eigen::Index i = 0; i < row; ++i)
    out(i) = excess[tally_of_row[static_cast<std::size_t>(i)]] * (1 + by_sensors(i));
  return out;
}

}  // namespace

std::vector<MeasuredSeries> measured_series(const Study &study, bool whole) {
  std::vector<MeasuredSeries> out;
  if (study.data)
    for (const auto &measurement : study.data->measurements)
      out.push_back(from_curves(study, measurement, whole));
  else
    out = from_targets(study);
  out.erase(std::remove_if(out.begin(), out.end(),
                           [](const MeasuredSeries &s) { return s.probed.quantities.empty(); }),
            out.end());
  if (out.empty())
    throw UserError(Place{study.file.string(), 0, 0},
                    "nothing was measured that the study's tests compute: give [data] folder or "
                    "[[targets]]");
  return out;
}

std::vector<Eigen::Index> keep_modelled(std::vector<MeasuredSeries> &series,
                                        const std::vector<ProbedSeries> &model) {
  std::map<std::pair<std::string, std::string>, Eigen::Index> rows;
  Eigen::Index next = 0;
  for (const auto &s : model)
    for (const auto &q : s.quantities) rows[{s.name, q.name}] = next++;
  std::vector<Eigen::Index> used;
  for (auto &s : series) {
    std::vector<Eigen::Index> kept;
    std::vector<CurveQuantity> quantities;
    for (std::size_t j = 0; j < s.probed.quantities.size(); ++j) {
      const auto found = rows.find({s.probed.name, s.probed.quantities[j].name});
      if (found == rows.end()) continue;
      kept.push_back(static_cast<Eigen::Index>(j));
      used.push_back(found->second);
      quantities.push_back(s.probed.quantities[j]);
    }
    const Eigen::MatrixXd replicates = s.replicates, stated = s.stated;
    const Eigen::VectorXd sensors = s.sensors;
    const auto left = static_cast<Eigen::Index>(kept.size());
    s.replicates.resize(replicates.rows(), left);
    if (stated.size() > 0) s.stated.resize(left, left);
    if (sensors.size() > 0) s.sensors.resize(left);
    for (Eigen::Index i = 0; i < left; ++i) {
      s.replicates.col(i) = replicates.col(kept[static_cast<std::size_t>(i)]);
      if (sensors.size() > 0) s.sensors(i) = sensors(kept[static_cast<std::size_t>(i)]);
      for (Eigen::Index j = 0; stated.size() > 0 && j < left; ++j)
        s.stated(i, j) =
            stated(kept[static_cast<std::size_t>(i)], kept[static_cast<std::size_t>(j)]);
    }
    s.probed.quantities = quantities;
  }
  series.erase(std::remove_if(series.begin(), series.end(),
                              [](const MeasuredSeries &s) { return s.probed.quantities.empty(); }),
               series.end());
  if (series.empty())
    throw UserError(
        "no run of the study gave a figure that can be compared with what was measured");
  return used;
}

std::vector<std::string> not_modelled(const std::vector<MeasuredSeries> &series,
                                      const std::vector<ProbedSeries> &model) {
  std::set<std::pair<std::string, std::string>> known;
  for (const auto &s : model)
    for (const auto &q : s.quantities) known.insert({s.name, q.name});
  std::vector<std::string> out;
  for (const auto &s : series)
    for (const auto &q : s.probed.quantities)
      if (known.count({s.probed.name, q.name}) == 0) out.push_back(s.probed.name + ", " + q.name);
  return out;
}

std::vector<std::string> targets_of_envelopes(const Study &study) {
  std::vector<std::string> out;
  for (const auto &target : study.targets)
    if (!study.data && !target.envelope.empty())
      out.push_back(target.name + ", " + source_text(target));
  return out;
}

std::vector<ProbedSeries> that_scatter(std::vector<ProbedSeries> series,
                                       const Eigen::MatrixXd &by_packing, double may_lack) {
  const Eigen::MatrixXd filled = with_means_where_lacking(by_packing);
  const auto packings = static_cast<double>(by_packing.rows());
  Eigen::Index row = 0;
  for (auto &s : series) {
    std::vector<CurveQuantity> kept;
    for (const auto &quantity : s.quantities) {
      const auto known = static_cast<double>(by_packing.col(row).array().isFinite().count());
      const Eigen::VectorXd column = filled.col(row++);
      if (packings - known <= may_lack * packings && column.allFinite() &&
          (column.array() - column.mean()).matrix().norm() > 1e-12)
        kept.push_back(quantity);
    }
    s.quantities = kept;
  }
  series.erase(std::remove_if(series.begin(), series.end(),
                              [](const ProbedSeries &s) { return s.quantities.empty(); }),
               series.end());
  return series;
}

std::vector<ProbedSeries> probed(const std::vector<MeasuredSeries> &series) {
  std::vector<ProbedSeries> out;
  for (const auto &s : series) out.push_back(s.probed);
  return out;
}

Evidence evidence_of(const Study &study, const std::vector<MeasuredSeries> &series,
                     const Eigen::MatrixXd &by_packing) {
  Evidence out;
  const Eigen::VectorXd excess = excess_of(study, series, by_packing);
  for (const auto &s : series) {
    SeriesEvidence evidence;
    evidence.name = s.probed.name;
    evidence.test = study.test(s.probed.test).definition.name;
    evidence.conditions = s.conditions;
    evidence.first = static_cast<int>(out.rows.size());
    evidence.count = static_cast<int>(s.probed.quantities.size());
    evidence.replicates = s.replicates;
    evidence.planned = static_cast<int>(s.replicates.rows());
    const Eigen::MatrixXd covariance =
        shrunk_covariance(by_packing.middleCols(evidence.first, evidence.count));
    evidence.stated =
        s.stated.size() > 0
            ? s.stated
            : specimen_covariance(by_packing.middleCols(evidence.first, evidence.count),
                                  s.replicates, excess.segment(evidence.first, evidence.count));
    // Before others read it: a row that hardly scatters would count for more than any instrument.
    evidence.stated.diagonal() = evidence.stated.diagonal().cwiseMax(instrument_sd * instrument_sd);
    evidence.simulated = covariance / static_cast<double>(by_packing.rows());
    for (const auto &q : s.probed.quantities)
      out.rows.push_back({evidence.test, evidence.name, q.part, q.name});
    out.series.push_back(std::move(evidence));
  }
  return out;
}

Evidence without_data(Evidence evidence) {
  for (auto &series : evidence.series) series.replicates.resize(0, 0);
  return evidence;
}

}  // namespace bondlab::diagnose
