// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/trial_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/user_error.h"
#include "base/write_file.h"

namespace bondlab::diagnose {

namespace {

std::string joined(const std::vector<std::string> &names) {
  return names.empty() ? "-" : join(names);
}

std::string numbers(const std::vector<double> &values) {
  std::string out;
  for (const double v : values) out += fmt::format("{}{:.3g}", out.empty() ? "" : ", ", v);
  return out.empty() ? "-" : out;
}

// hits of cases, with the interval that would hold the true share 95 times of 100
std::string counted(int hits, int cases) {
  if (cases == 0) return "-";
  using Beta = boost::math::beta_distribution<>;
  const double low = hits == 0 ? 0 : boost::math::quantile(Beta(hits, cases - hits + 1.0), 0.025);
  const double high =
      hits == cases ? 1 : boost::math::quantile(Beta(hits + 1.0, cases - hits), 0.975);
  return fmt::format("{} of {} ({:.0f} to {:.0f} %)", hits, cases, 100 * low, 100 * high);
}

struct Count {
  int cases = 0;
  std::array<int, 5> of{};
  void add(Judgement j) { ++cases, ++of[static_cast<std::size_t>(j)]; }
  std::string row(const std::string &name) const {
    std::string out = "| " + name;
    for (const int n : of) out += " | " + counted(n, cases);
    return out + " |\n";
  }
};

constexpr const char *count_head =
    "| | right | in set | wrong | not in the catalogue | nothing |\n|--|--|--|--|--|--|\n";

std::string share(double value) {
  return std::isfinite(value) ? fmt::format("{:.0f} %", 100 * value) : "-";
}

}  // namespace

std::string trial_line(const TrialCase &t) {
  return fmt::format("{:<40} {:>5} units  {:<20} {}", t.hidden.id,
                     t.units.empty() ? "0" : fmt::format("{:.1f}", t.units.front()),
                     to_string(t.judgement), joined(t.named));
}

std::string trial_markdown(const std::vector<TrialCase> &cases) {
  std::string out =
      "| case | size | noise units | verdict | named | its size | margin | held out, closed by it "
      "/ "
      "by a placebo | parameters in their intervals, before / after "
      "|\n|--|--|--|--|--|--|--|--|--|\n";
  for (const auto &t : cases)
    out += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} / {} | {} / {} of {} |\n", t.hidden.id,
        numbers(t.sizes), numbers(t.units), to_string(t.verdict), joined(t.named),
        numbers(t.named_sizes),
        std::isfinite(t.margin) && !t.named.empty() ? fmt::format("{:.0f}", t.margin) : "-",
        t.named.empty() ? "-" : share(t.cross.closed()),
        t.named.empty() ? "-" : share(t.cross.closed_by_placebo()), t.inside_before, t.inside_after,
        t.parameters);
  const std::array<std::string, 5> kinds = {"effect", "outside", "left_out", "pair", "null"};
  const std::array<std::string, 3> others = {"largest residual", "BIC", "LASSO"};
  out += "\n" + std::string(count_head);
  for (const auto &kind : kinds) {
    Count ours;
    std::array<Count, 3> theirs;
    for (const auto &t : cases) {
      if (t.hidden.kind != kind) continue;
      ours.add(t.judgement);
      for (std::size_t i = 0; i < others.size() && i < t.others_judged.size(); ++i)
        theirs[i].add(t.others_judged[i]);
    }
    if (ours.cases == 0) continue;
    out += ours.row(kind);
    for (std::size_t i = 0; i < others.size(); ++i) out += theirs[i].row(kind + ", " + others[i]);
  }
  return out;
}

void write_trial(const std::vector<TrialCase> &cases, const std::filesystem::path &out) {
  nlohmann::json all = nlohmann::json::array();
  const auto finite = [](double v) { return std::isfinite(v) ? nlohmann::json(v) : nullptr; };
  for (const auto &t : cases) {
    nlohmann::json one;
    one["id"] = t.hidden.id, one["kind"] = t.hidden.kind;
    one["hidden"] = t.hidden.effects, one["sizes"] = t.sizes, one["units"] = t.units;
    one["verdict"] = to_string(t.verdict), one["judgement"] = to_string(t.judgement);
    one["named"] = t.named, one["named_sizes"] = t.named_sizes;
    one["margin"] = finite(t.margin), one["p_trace"] = t.p_trace, one["p_omnibus"] = t.p_omnibus;
    one["trace"] = {{"score", t.trace}, {"alarm", t.trace_alarm}};
    one["whole"] = {{"score", t.omnibus}, {"alarm", t.omnibus_alarm}};
    one["where"] = nlohmann::json::array();
    for (const auto &spot : t.where)
      one["where"].push_back({{"name", spot.name}, {"score", spot.score}});
    one["predicted_gain"] = t.predicted_gain, one["confirmed_gain"] = finite(t.confirmed_gain);
    one["held_out"] = {{"before", t.cross.before},
                       {"after", t.cross.after},
                       {"placebo", t.cross.placebo},
                       {"floor", t.cross.floor}};
    one["parameters_inside"] = {
        {"before", t.inside_before}, {"after", t.inside_after}, {"of", t.parameters}};
    one["parameters_off"] = {{"before", t.off_before}, {"after", t.off_after}};
    one["p_scatter"] = t.p_scatter;
    one["others"] = t.others, one["new_runs"] = t.new_runs;
    all.push_back(one);
  }
  write_file(out / "trial.json", all.dump(2) + "\n");
  write_file(out / "trial.md", trial_markdown(cases));
}

}  // namespace bondlab::diagnose
