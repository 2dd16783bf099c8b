// SPDX-License-Identifier: GPL-2.0-or-later
#include "refine/feasibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.h"

namespace bondlab {

namespace {

constexpr double sds_allowed = 2;

struct Span {
  double low = 0, high = 0;
  int points = 0;
  void add(double value) {
    low = points ? std::min(low, value) : value;
    high = points ? std::max(high, value) : value;
    ++points;
  }
};

std::string number_in(const Target &target, double si) {
  return fmt::format("{:.4g}", from_si(si, target.unit));
}

std::string unit_after(const Target &target) {
  return target.unit.empty() || target.unit == "1" ? "" : " " + target.unit;
}

Finding single(const Target &target, const std::vector<LedgerPoint> &ledger) {
  Span span;
  for (const auto &point : ledger) {
    const auto figure = point.responses.find(target.name);
    if (figure != point.responses.end()) span.add(figure->second);
  }
  Finding finding;
  finding.targets = {target.name};
  finding.measured = target.value;
  finding.low = span.low;
  finding.high = span.high;
  finding.points = span.points;
  if (span.points == 0) return finding;
  const double slack = sds_allowed * target.sd;
  const bool reached = target.value >= span.low - slack && target.value <= span.high + slack;
  finding.kind = reached ? FindingKind::reachable : FindingKind::unreachable_target;
  finding.text = fmt::format(
      "{} lay between {} and {}{} over all {} parameter sets run; measured: {}{}", target.name,
      number_in(target, span.low), number_in(target, span.high), unit_after(target), span.points,
      number_in(target, target.value), unit_after(target));
  if (!reached)
    finding.text += fmt::format(
        ". No parameter set within the bounds reached it, not even within {:.0f} sd", sds_allowed);
  return finding;
}

bool inside(const Finding &span) { return span.low <= span.measured && span.measured <= span.high; }

Finding ratio(const Target &a, const Target &b, const std::vector<LedgerPoint> &ledger) {
  // The larger measured value on top: "UCS/sigma_t = 14.6" is how an engineer says it.
  const Target &top = std::fabs(a.value) >= std::fabs(b.value) ? a : b;
  const Target &bottom = &top == &a ? b : a;
  Span span;
  for (const auto &point : ledger) {
    const auto over = point.responses.find(top.name), under = point.responses.find(bottom.name);
    if (over != point.responses.end() && under != point.responses.end() && under->second != 0)
      span.add(over->second / under->second);
  }
  Finding finding;
  finding.targets = {top.name, bottom.name};
  finding.measured = top.value / bottom.value;
  finding.low = span.low;
  finding.high = span.high;
  finding.points = span.points;
  const double sd =
      std::fabs(finding.measured) * std::hypot(top.sd / top.value, bottom.sd / bottom.value);
  const bool reached = finding.measured >= span.low - sds_allowed * sd &&
                       finding.measured <= span.high + sds_allowed * sd;
  finding.kind = reached ? FindingKind::reachable : FindingKind::unreachable_ratio;
  finding.text = fmt::format(
      "The ratio {}/{} lay between {:.3g} and {:.3g} over all {} parameter sets run; measured: "
      "{:.3g} +- {:.2g} "
      "({:.0f} sd)",
      top.name, bottom.name, span.low, span.high, span.points, finding.measured, sds_allowed * sd,
      sds_allowed);
  if (reached) return finding;
  finding.text += fmt::format(
      ". No parameter set within the bounds reached it: {} and {} cannot be met together", top.name,
      bottom.name);
  if (inside(single(top, ledger)) && inside(single(bottom, ledger)))
    finding.text += fmt::format(
        ", though each alone is within reach ({}: {} to {}{}; {}: {} to {}{})", top.name,
        number_in(top, single(top, ledger).low), number_in(top, single(top, ledger).high),
        unit_after(top), bottom.name, number_in(bottom, single(bottom, ledger).low),
        number_in(bottom, single(bottom, ledger).high), unit_after(bottom));
  finding.text += ". This is a property of the model as the study sets it up, not of the search";
  return finding;
}

// Whether the ratio moved by less than half of what either target did (in logarithms).
bool stiffer_than_parts(const Finding &ratio, const Finding &a, const Finding &b) {
  const auto width = [](const Finding &span) {
    return span.low > 0 ? std::log(span.high / span.low) : 0.0;
  };
  return width(ratio) < 0.5 * std::min(width(a), width(b));
}

}  // namespace

std::vector<Finding> judge_feasibility(const Study &study, const std::vector<std::string> &targets,
                                       const std::vector<LedgerPoint> &ledger) {
  std::vector<Finding> findings;
  std::set<std::string> unreachable;
  for (const auto &name : targets) {
    auto finding = single(study.target(name), ledger);
    if (finding.kind == FindingKind::unreachable_target) unreachable.insert(name);
    if (finding.points > 0) findings.push_back(std::move(finding));
  }
  for (std::size_t i = 0; i < targets.size(); ++i)
    for (std::size_t j = i + 1; j < targets.size(); ++j) {
      const Target &a = study.target(targets[i]), &b = study.target(targets[j]);
      // E over a strength is a ratio of like dimension too, and as good an evidence as any.
      if (!same_dimension(a.unit, b.unit) || a.value == 0 || b.value == 0) continue;
      auto finding = ratio(a, b, ledger);
      if (finding.points == 0) continue;
      const bool one_unreachable = unreachable.count(a.name) || unreachable.count(b.name);
      if (one_unreachable && !stiffer_than_parts(finding, single(a, ledger), single(b, ledger)))
        continue;
      findings.push_back(std::move(finding));
    }
  return findings;
}

}  // namespace bondlab
