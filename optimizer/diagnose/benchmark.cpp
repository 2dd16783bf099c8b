// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/benchmark.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <cmath>
#include <map>
#include <set>

#include "base/random.h"
#include "diagnose/advice.h"
#include "diagnose/comparators.h"
#include "diagnose/placebo.h"

namespace bondlab::diagnose {

namespace {

using rheology::catalogue_count;
using rheology::effect_count;

std::uint64_t number_of(std::uint64_t question, std::size_t effect, int i) {
  // The rock is the number modulo the rocks: consecutive cases go through all of them.
  return question * 1000000 + effect * 10000 + static_cast<std::uint64_t>(i);
}

Eigen::VectorXd true_z(const BenchTruth &truth) {
  const rheology::Material nominal;
  Eigen::VectorXd z(rheology::base_count);
  for (std::size_t i = 0; i < rheology::base_count; ++i)
    z(static_cast<Eigen::Index>(i)) = std::log(base(truth.material, i) / base(nominal, i));
  return z;
}

void count_parameters(const BenchRun &run, NamingResult &result) {
  const Eigen::VectorXd z = true_z(run.truth);
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const auto inside = [&](const Refit &fit) {
      return std::abs(fit.point.z(i) - z(i)) < 1.96 * std::sqrt(fit.covariance(i, i));
    };
    const Refit &before = run.diagnosis.before, &after = run.diagnosis.after;
    result.inside_before.count(inside(before));
    result.inside_after.count(inside(after));
    const double shift = std::abs(after.point.z(i) - before.point.z(i));
    if (shift > 2 * std::sqrt(before.covariance(i, i))) {
      result.shifted_inside_before.count(inside(before));
      result.shifted_inside_after.count(inside(after));
    }
  }
}

void count_others(const BenchSetup &setup, const BenchRun &run, bool ours, NamingResult &result) {
  const auto &model = run.diagnosis.model;
  const Whitening whitening(run.evidence);
  const Projection fitted(model.jacobian);
  const Omnibus omnibus(run.evidence, whitening, bench_parameters(), model.jacobian);
  const Omnibus::Prepared prepared(omnibus, fitted);
  const ScoreTable scores(fitted, model, bench_catalogue());
  const Eigen::VectorXd residual = fitted.off(model.residual);
  const std::array<Naming, 3> names = {
      name_by_largest_residual(omnibus, prepared, scores, residual, setup.null.omnibus_alarm),
      name_by_bic(scores, residual), name_by_lasso(scores, bench_catalogue(), residual)};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto truth = run.hidden.front();
    const bool in = std::find(names[i].begin(), names[i].end(), truth) != names[i].end();
    const bool alone = in && names[i].size() == 1;
    result.others[i].unique.count(alone);
    result.others[i].within_set.count(in);
    result.others[i].wrong.count(!names[i].empty() && !in);
    result.others[i].better.count(alone && !ours);
  }
}

void count_left_out(const BenchRun &run, LeftOutResult &result, Rate &of_effect) {
  const auto verdict = run.diagnosis.verdict;
  const bool said = verdict == Verdict::not_in_catalogue;
  result.said_so.count(said);
  of_effect.count(said);
  result.missed.count(verdict == Verdict::nothing);
  result.wrongly_named.count(!said && verdict != Verdict::nothing);
}

// Ranks with ties at their mean.
std::vector<double> ranks(const std::vector<double> &values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> out(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && values[order[j]] == values[order[i]]) ++j;
    for (std::size_t k = i; k < j; ++k) out[order[k]] = 0.5 * static_cast<double>(i + j - 1);
    i = j;
  }
  return out;
}

double rank_correlation(const std::vector<double> &x, const std::vector<double> &y) {
  const auto a = ranks(x), b = ranks(y);
  const double n = static_cast<double>(x.size());
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

const std::vector<std::string> &held_out_series() {
  static const std::vector<std::string> names = {"uc_fast_343K", "uc_large", "bd_large",
                                                 "tpb_large",    "ds_high",  "dt_slow"};
  return names;
}

}  // namespace

double Rate::upper() const {
  if (hits >= cases) return 1;
  return boost::math::quantile(boost::math::beta_distribution<>(hits + 1.0, cases - hits), 0.95);
}

std::string Rate::text() const {
  return fmt::format("{:5.1f} %  ({} of {})", 100 * share(), hits, cases);
}

const std::vector<std::string> &few_series() {
  static const std::vector<std::string> names = {"uc_mid_293K", "bd_small", "ds_mid"};
  return names;
}

const std::vector<std::vector<std::string>> &poor_laboratories() {
  static const std::vector<std::vector<std::string>> list = {
      {"uc_mid_293K"},           {"bd_small", "tpb_small"}, {"ds_mid", "dt_mid"},
      {"uc_mid_293K", "dt_mid"}, {"direct_shear"},          {"bd_small", "ds_low", "ds_high"}};
  return list;
}

NullResult null_benchmark(Bench &bench, int cases, double stated_over_true) {
  NullResult result;
  for (int i = 0; i < cases; ++i) {
    const auto run = bench.run({{}, 0, {}, stated_over_true}, number_of(1, 0, i));
    result.alarms.count(run.diagnosis.verdict != Verdict::nothing);
    result.noise_reported.count(run.diagnosis.noise.stated_wrong);
  }
  return result;
}

NamingResult naming_benchmark(Bench &bench, int cases_per_effect, double lambda) {
  NamingResult result;
  result.others[0].name = "largest residual";
  result.others[1].name = "refit each, BIC";
  result.others[2].name = "LASSO on traces";
  for (std::size_t effect = 0; effect < catalogue_count; ++effect) {
    Rate unique;
    for (int i = 0; i < cases_per_effect; ++i) {
      const auto number = number_of(2, effect, i);
      const auto run = bench.run({{effect}, lambda, {}, 1}, number);
      const auto &d = run.diagnosis;
      const bool alone = run.names_only(effect), in = run.names(effect);
      unique.count(alone);
      result.unique.count(alone);
      result.within_set.count(in && d.verdict != Verdict::two);
      result.wrong.count(!d.effects.empty() && !in);
      result.missed.count(d.verdict == Verdict::nothing);
      result.unexplained.count(d.verdict == Verdict::not_in_catalogue);
      if (alone) {
        const auto &named = d.effects.front();
        const double size = run.truth.effects.size[effect];
        result.size_covered.count(named.low <= size && size <= named.high);
        const double ratio = d.realised_gain / std::max(1e-9, d.predicted_gain);
        result.gain_foretold.count(ratio > 0.5 && ratio < 2);
        count_parameters(run, result);
      }
      count_others(bench.setup(bench.rock_of(number)), run, alone, result);
    }
    result.unique_by_effect.push_back(unique);
  }
  return result;
}

LeftOutResult left_out_benchmark(Bench &bench, int cases_per_effect, double lambda) {
  LeftOutResult result;
  result.said_so_by_effect.resize(effect_count);
  for (std::size_t effect = 0; effect < catalogue_count; ++effect)
    for (int i = 0; i < cases_per_effect; ++i)
      count_left_out(bench.run({{effect}, lambda, effect, 1}, number_of(3, effect, i)), result,
                     result.said_so_by_effect[effect]);
  return result;
}

LeftOutResult outsider_benchmark(Bench &bench, int cases_per_effect, double lambda) {
  LeftOutResult result;
  result.said_so_by_effect.resize(effect_count);
  for (std::size_t effect = catalogue_count; effect < effect_count; ++effect)
    for (int i = 0; i < cases_per_effect; ++i)
      count_left_out(bench.run({{effect}, lambda, {}, 1}, number_of(4, effect, i)), result,
                     result.said_so_by_effect[effect]);
  return result;
}

PairResult pair_benchmark(Bench &bench, int cases, double lambda) {
  PairResult result;
  RandomStream random(1, 31);
  for (int i = 0; i < cases; ++i) {
    const std::size_t first = random.index(catalogue_count);
    const std::size_t second = (first + 1 + random.index(catalogue_count - 1)) % catalogue_count;
    const auto run = bench.run({{first, second}, lambda, {}, 1}, number_of(5, 0, i));
    const bool a = run.names(first), b = run.names(second);
    int wrong = 0;
    for (const auto &e : run.diagnosis.effects) wrong += e.effect != first && e.effect != second;
    result.both.count(run.diagnosis.verdict == Verdict::two && a && b);
    result.one_right_none_wrong.count((a || b) && wrong == 0);
    result.any_wrong.count(wrong > 0 && run.diagnosis.verdict != Verdict::set);
  }
  return result;
}

HoldoutResult holdout_benchmark(Bench &bench, int cases_per_effect, double lambda) {
  HoldoutResult result;
  double before = 0, after = 0, placebo_after = 0, floor_before = 0, floor_after = 0;
  const auto &held = held_out_series();
  for (std::size_t effect = 0; effect < catalogue_count; ++effect)
    for (int i = 0; i < cases_per_effect; ++i) {
      const auto number = number_of(6, effect, i);
      const auto run = bench.run({{effect}, lambda, {}, 1}, number);
      auto &laboratory = bench.setup(bench.rock_of(number)).laboratory;
      const Whitening whitening(run.evidence);
      Eigen::VectorXd on = Eigen::VectorXd::Ones(whitening.rows()), off = on;
      for (const auto &series : run.evidence.series)
        if (std::find(held.begin(), held.end(), series.name) != held.end())
          on.segment(series.first, series.count).setZero();
      off -= on;
      for (const auto &scatter : run.evidence.scatter) off(scatter.row) = 0;
      const auto &catalogue = bench_catalogue();
      const auto &model = run.diagnosis.model;
      const auto judge = [&](const std::vector<std::size_t> &effects, double &gap, double &floor) {
        const Refit fit = refit(laboratory, whitening, catalogue, model, effects, on);
        const auto rows = laboratory.probe({fit.point});
        gap += whitening.residual(rows.front()).cwiseProduct(off).squaredNorm();
        // Expected of a right model: noise of the rows held out, and of the fit's parameters there.
        const Linearisation there = linearise(laboratory, whitening, fit.point, true);
        Eigen::MatrixXd columns(whitening.rows(), fit.covariance.cols());
        columns.leftCols(there.jacobian.cols()) = there.jacobian;
        for (std::size_t k = 0; k < effects.size(); ++k)
          columns.col(there.jacobian.cols() + static_cast<Eigen::Index>(k)) =
              there.traces.col(static_cast<Eigen::Index>(effects[k]));
        columns.array().colwise() *= off.array();
        floor += off.sum() + (columns * fit.covariance).cwiseProduct(columns).sum();
        return fit;
      };
      judge({effect}, after, floor_after);
      const Refit base = judge({}, before, floor_before);
      RandomStream random(number, 32);
      const auto placebo =
          placebo_of(model.traces.col(static_cast<Eigen::Index>(effect)), random);
      if (!placebo) continue;
      const Eigen::VectorXd residual = whitening.residual(laboratory.probe({base.point}).front());
      Eigen::MatrixXd columns(whitening.rows(), model.jacobian.cols() + 1);
      columns << model.jacobian, *placebo;
      Eigen::MatrixXd fitted = columns;
      fitted.array().colwise() *= on.array();
      const Eigen::VectorXd x =
          fitted.completeOrthogonalDecomposition().solve(residual.cwiseProduct(on));
      placebo_after += (residual - columns * x).cwiseProduct(off).squaredNorm();
      ++result.cases;
    }
  result.closed_by_effect = (before - after) / (before - floor_after);
  result.closed_by_placebo = (before - placebo_after) / (before - floor_before);
  return result;
}

IsolabilityResult isolability_benchmark(const std::vector<std::vector<std::string>> &laboratories,
                                        int cases_per_effect, double lambda) {
  constexpr int rocks = 2;
  IsolabilityResult result;
  std::vector<double> foretold, counted;
  const auto &catalogue = bench_catalogue();
  for (std::size_t l = 0; l < laboratories.size(); ++l) {
    Bench bench(bench_series(laboratories[l]), rocks);
    std::vector<bool> visible;
    for (std::size_t k = 0; k < catalogue_count; ++k)
      visible.push_back(bench.lambda_of(0, k, catalogue[k].largest) >= lambda &&
                        bench.lambda_of(1, k, catalogue[k].largest) >= lambda);
    for (std::size_t effect = 0; effect < catalogue_count; ++effect) {
      if (!visible[effect]) continue;
      std::vector<double> chance(catalogue_count, 0), share(catalogue_count, 0);
      for (int i = 0; i < cases_per_effect; ++i) {
        const auto number = number_of(10 + l, effect, i);
        const auto &setup = bench.setup(bench.rock_of(number));
        const ScoreTable scores(Projection(setup.model.jacobian), setup.model, catalogue);
        const auto run = bench.run({{effect}, lambda, {}, 1}, number);
        for (std::size_t other = 0; other < catalogue_count; ++other) {
          const double cosine =
              scores.cosines()(static_cast<Eigen::Index>(effect), static_cast<Eigen::Index>(other));
          const bool possible =
              !scores.hidden(other) && (cosine > 0 || catalogue[other].lowest < 0);
          chance[other] += possible ? confusion_chance(cosine, lambda) : 0;
          share[other] += run.diagnosis.verdict != Verdict::two && run.names(other);
        }
      }
      for (std::size_t other = 0; other < catalogue_count; ++other) {
        if (other == effect || !visible[other]) continue;
        // As printed, in steps of 5 %: what is rarer is printed as never.
        foretold.push_back(std::round(20 * chance[other] / cases_per_effect));
        counted.push_back(std::round(20 * share[other] / cases_per_effect));
        result.confused_pairs += counted.back() > 0;
      }
    }
  }
  result.pairs = static_cast<int>(foretold.size());
  result.rank_correlation = rank_correlation(foretold, counted);
  return result;
}

AdviceResult advice_benchmark(const std::vector<std::string> &series, int cases, double lambda) {
  constexpr int rocks = 2;
  AdviceResult result;
  Bench few(bench_series(series), rocks), all(bench_series({}), rocks);
  std::map<std::string, std::unique_ptr<Bench>> more;
  const auto with = [&](const std::string &further) -> Bench & {
    auto &bench = more[further];
    if (!bench) {
      auto names = series;
      names.push_back(further);
      bench = std::make_unique<Bench>(bench_series(names), rocks);
    }
    return *bench;
  };
  const auto &full = all.setup(0).laboratory.blank();
  std::vector<bool> present(full.rows.size(), false);
  std::vector<TestOption> options;
  for (const auto &s : full.series) {
    const bool there = std::find(series.begin(), series.end(), s.name) != series.end();
    TestOption option{s.name, {}};
    for (int row = s.first; row < s.first + s.count; ++row) {
      present[static_cast<std::size_t>(row)] = there;
      option.rows.push_back(row);
    }
    if (!there) options.push_back(option);
  }
  RandomStream random(1, 33);
  for (int i = 0; i < cases; ++i) {
    const std::size_t effect = static_cast<std::size_t>(i) % catalogue_count;
    const auto number = number_of(8, 0, i);
    const auto rock = few.rock_of(number);
    if (few.lambda_of(rock, effect, bench_catalogue()[effect].largest) < lambda) continue;
    const Bench::Wish wish{{effect}, lambda, {}, 1};
    const auto run = few.run(wish, number);
    if (run.diagnosis.verdict != Verdict::set || !run.names(effect)) continue;
    std::vector<std::size_t> rivals;
    std::vector<double> amplitudes;
    for (const auto &named : run.diagnosis.effects) {
      rivals.push_back(named.effect);
      amplitudes.push_back(named.size / bench_catalogue()[named.effect].switch_on);
    }
    auto &setup = all.setup(rock);
    const Linearisation model = linearise(setup.laboratory, setup.plan, run.diagnosis.before.point);
    const auto advice = advise(model, present, options, rivals, amplitudes);
    const auto separates = [&](const std::string &further) {
      return with(further).run(wish, run.truth, number).names_only(effect);
    };
    result.separated.count(separates(advice.front().test));
    result.separated_by_random.count(separates(options[random.index(options.size())].name));
  }
  return result;
}

FrameResult frame_benchmark(Bench &bench, int cases, double lambda) {
  FrameResult result;
  for (int i = 0; i < cases; ++i) {
    const auto run = bench.run({{rheology::frame_compliance}, lambda, {}, 1}, number_of(9, 0, i));
    const auto &d = run.diagnosis;
    bool bond = false;
    for (const auto &e : d.effects) bond |= bench_catalogue()[e.effect].kind == EffectKind::bond;
    const bool frame = run.names(rheology::frame_compliance);
    result.called_bond.count(bond && !frame);
    result.bond_beside.count(bond && frame && d.verdict != Verdict::set);
  }
  return result;
}

std::string benchmark_table(int n) {
  std::string out;
  const auto line = [&](const std::string &what, const std::string &goal,
                        const std::string &reached) {
    out += fmt::format("{:<66} {:<9} {}\n", what, goal, reached);
  };
  Bench bench(bench_series({})), few(bench_series(few_series()));
  const auto null = null_benchmark(bench, 40 * n, 1);
  line("nothing hidden: alarms at nominal 1 %", "<= 2 %",
       fmt::format("{}, upper 95 % limit {:.1f} %", null.alarms.text(), 100 * null.alarms.upper()));
  for (const double wrong : {0.5, 2.0}) {
    const auto r = null_benchmark(bench, 10 * n, wrong);
    line(fmt::format("  scatter stated {} times too large: alarms", wrong), "<= 5 %",
         r.alarms.text());
    line("    and reported", "", r.noise_reported.text());
  }
  for (const double lambda : {10.0, 20.0}) {
    const auto r = naming_benchmark(bench, n, lambda);
    line(fmt::format("one effect of {} noise units: right and alone", lambda), ">= 90 %",
         r.unique.text());
    line("  right, or within the offered set", ">= 97 %", r.within_set.text());
    line("  wrong", "<= 1 %", r.wrong.text());
    line("  called not in the catalogue; called nothing", "",
         r.unexplained.text() + "; " + r.missed.text());
    for (const auto &o : r.others)
      line("  " + o.name + ": alone; within; wrong; right where we are not", "",
           fmt::format("{:.1f}; {:.1f}; {:.1f}; {:.1f} %", 100 * o.unique.share(),
                       100 * o.within_set.share(), 100 * o.wrong.share(), 100 * o.better.share()));
    line("  size within its 95 % interval", "93-97 %", r.size_covered.text());
    line("  gain foretold within a factor of 2", ">= 80 %", r.gain_foretold.text());
    line("  planted parameters in their 95 % interval, before", "", r.inside_before.text());
    line("  planted parameters in their 95 % interval, after", ">= 93 %", r.inside_after.text());
    line("  those shifted by over 2 sd: before", "biased", r.shifted_inside_before.text());
    line("  those shifted by over 2 sd: after", "", r.shifted_inside_after.text());
    const auto l = left_out_benchmark(bench, n, lambda);
    line("  left out of the catalogue: said so", ">= 80 %", l.said_so.text());
    line("  left out of the catalogue: wrongly named", "<= 15 %", l.wrongly_named.text());
    const auto u = outsider_benchmark(bench, n, lambda);
    line("  never in the catalogue: said so", ">= 80 %", u.said_so.text());
    line("  never in the catalogue: wrongly named", "<= 15 %", u.wrongly_named.text());
    const auto p = pair_benchmark(bench, 10 * n, lambda);
    line("  two at once: both named", ">= 70 %", p.both.text());
    line("  two at once: one right, none wrong", ">= 90 %", p.one_right_none_wrong.text());
    const auto h = holdout_benchmark(bench, std::max(2, n / 4), lambda);
    line("  gap held out, closed by the right effect", ">= 70 %",
         fmt::format("{:5.1f} %", 100 * h.closed_by_effect));
    line("  gap held out, closed by a placebo", "<= 10 %",
         fmt::format("{:5.1f} %", 100 * h.closed_by_placebo));
    line("  yielding frame called an effect of bonds", "never",
         frame_benchmark(bench, 5 * n, lambda).called_bond.text());
    const auto f = frame_benchmark(few, 5 * n, lambda);
    line("    with few tests", "never", f.called_bond.text());
    line("    with few tests: a bond effect invented beside it", "", f.bond_beside.text());
  }
  const auto i = isolability_benchmark(poor_laboratories(), n, 8);
  line("foretold against counted confusion: rank correlation", ">= 0.8",
       fmt::format("{:.2f}  ({} pairs, {} confused)", i.rank_correlation, i.pairs,
                   i.confused_pairs));
  const auto a = advice_benchmark(few_series(), 20 * n, 8);
  line("ambiguous cases that the advised test separates", ">= 80 %", a.separated.text());
  line("  that a random further test separates", "", a.separated_by_random.text());
  return out;
}

}  // namespace bondlab::diagnose
