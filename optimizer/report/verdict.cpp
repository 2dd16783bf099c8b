// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/verdict.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "report/number_text.h"

namespace bondlab {
namespace {

std::string missed_words(const ReportTarget &target) {
  if (!std::isfinite(target.simulated))
    return target.name + " could not be simulated" +
           (target.why_missing.empty() ? "" : " (" + target.why_missing + ")");
  return target.name + " is missed: " + with_unit(significant(target.simulated), target.unit) +
         " simulated against " + with_unit(significant(target.measured), target.unit) +
         " measured (" + signed_percent(deviation(target)) + ")";
}

std::string sentence_for(const std::vector<const ReportTarget *> &targets) {
  std::vector<std::string> met;
  std::string missed;
  double largest = 0;
  for (const ReportTarget *target : targets) {
    if (target->met) {
      met.push_back(target->name);
      if (std::isfinite(deviation(*target)))
        largest = std::max(largest, std::fabs(deviation(*target)));
    } else {
      missed += (missed.empty() ? "" : "; ") + missed_words(*target);
    }
  }
  std::string text;
  if (!met.empty()) {
    text = list_text(met) + (met.size() == 1 ? " is met" : " are met") + " (" +
           (met.size() == 1 ? "" : "at most ") + fixed(100 * largest, 1) + "\u00a0% off)";
    if (!missed.empty()) text += "; ";
  }
  return text + missed + ".";
}

}  // namespace

double deviation(const ReportTarget &target) {
  return target.measured != 0 ? target.simulated / target.measured - 1 : no_number;
}

std::string with_unit(const std::string &number, const std::string &unit) {
  return unit.empty() || unit == "1" ? number : number + "\u00a0" + unit;
}

std::string targets_sentence(const ReportFit &fit) {
  std::vector<const ReportTarget *> fitted, predicted;
  for (const ReportTarget &target : fit.targets)
    (target.in_fit ? fitted : predicted).push_back(&target);
  std::string text;
  if (!fitted.empty()) text = sentence_for(fitted);
  if (!predicted.empty())
    text += (text.empty() ? "" : " ") + std::string("Predicted, not fitted: ") +
            sentence_for(predicted);
  return text;
}

std::string headline(const ReportInput &input) {
  if (input.fits.empty()) return "No fit has been finished yet.";
  const ReportFit &fit = input.fits.front();
  return fit.verdict.empty() ? targets_sentence(fit) : fit.verdict;
}

std::string all_met_sentence(const ReportInput &input, const ReportFit &fit) {
  if (input.fits.empty()) return "";
  std::vector<std::string> names;
  for (const ReportTarget &target : fit.targets)
    if (target.in_fit && std::isfinite(target.tolerance)) names.push_back(target.name);
  if (names.empty()) return "";
  long complete = 0, meeting = 0;
  for (const ReportPoint &point : input.points) {
    bool whole = true, met = true;
    for (const ReportTarget &target : fit.targets) {
      if (!target.in_fit || !std::isfinite(target.tolerance)) continue;
      const auto value = point.responses.find(target.name);
      if (value == point.responses.end() || !std::isfinite(value->second))
        whole = false;
      else if (std::fabs(value->second - target.measured) > target.tolerance)
        met = false;
    }
    complete += whole;
    meeting += whole && met;
  }
  if (complete == 0) return "";
  const std::string of =
      counted(complete, "parameter set", "parameter sets") + " run with all of " + list_text(names);
  if (meeting == 0) return "Of the " + of + ", none meets them together.";
  return "Of the " + of + ", " + count_text(meeting) + (meeting == 1 ? " meets" : " meet") +
         " them together.";
}

}  // namespace bondlab
