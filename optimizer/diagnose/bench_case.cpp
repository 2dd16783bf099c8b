// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/bench_case.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace bondlab::diagnose {

namespace {

constexpr int null_draws = 4000;

double largest_size(std::size_t effect) {
  return effect < rheology::catalogue_count ? bench_catalogue()[effect].largest : 0.9;
}

}  // namespace

bool BenchRun::names(std::size_t effect) const {
  return std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                     [&](const NamedEffect &e) { return e.effect == effect; });
}

bool BenchRun::names_only(std::size_t effect) const {
  return diagnosis.verdict == Verdict::one && names(effect);
}

std::vector<rheology::Series> bench_series(const std::vector<std::string> &names) {
  std::vector<rheology::Series> out;
  for (const auto &series : rheology::all_series())
    if (names.empty() || std::find(names.begin(), names.end(), series.name) != names.end() ||
        std::find(names.begin(), names.end(), series.test) != names.end())
      out.push_back(series);
  return out;
}

Bench::Bench(std::vector<rheology::Series> series, int rocks, int replicates, std::uint64_t seed) {
  for (int r = 0; r < rocks; ++r) {
    const std::uint64_t rock_seed = hash_ints({seed, static_cast<std::uint64_t>(r)});
    const auto rock = bench_rock(rock_seed);
    BenchLaboratory laboratory(series, replicates, rock, rock_seed);
    Whitening plan(laboratory.blank());
    ModelPoint at = laboratory.nominal();
    const rheology::Material nominal;
    for (std::size_t i = 0; i < rheology::base_count; ++i)
      at.z(static_cast<Eigen::Index>(i)) = std::log(base(rock, i) / base(nominal, i));
    Linearisation model = linearise(laboratory, plan, at);
    const Omnibus omnibus(laboratory.blank(), plan, bench_parameters(), model.jacobian);
    // The noise estimate that data with these replicates will have.
    const Evidence example = laboratory.measure({rock, {}}, rock_seed);
    NullTable null = make_null_table(omnibus, model, bench_catalogue(), example,
                                     Whitening(example).noise(), 0.01, null_draws, rock_seed);
    setups_.push_back(std::make_unique<BenchSetup>(
        BenchSetup{std::move(laboratory), std::move(plan), std::move(model), std::move(null)}));
  }
}

double Bench::lambda_of(std::size_t rock, std::size_t effect, double size) const {
  const auto &s = *setups_[rock];
  BenchTruth with{s.laboratory.rock(), {}}, without = with;
  with.effects.size[effect] = size;
  const Eigen::VectorXd change =
      s.plan.apply(s.laboratory.exact(with) - s.laboratory.exact(without));
  return Projection(s.model.jacobian).off(change).norm();
}

double Bench::size_of(std::size_t rock, std::size_t effect, double lambda) const {
  double low = 0, high = largest_size(effect);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (lambda_of(rock, effect, middle) < lambda ? low : high) = middle;
  }
  return high;
}

BenchRun Bench::run(const Wish &wish, std::uint64_t number) {
  const std::size_t rock = rock_of(number);
  BenchTruth truth{setups_[rock]->laboratory.rock(), {}};
  for (const auto effect : wish.hidden)
    truth.effects.size[effect] = size_of(rock, effect, wish.lambda);
  return run(wish, truth, number);
}

BenchRun Bench::run(const Wish &wish, const BenchTruth &truth, std::uint64_t number) {
  auto &s = *setups_[rock_of(number)];
  BenchRun out;
  out.hidden = wish.hidden;
  out.truth = truth;
  s.laboratory.take_packings(hash_ints({number, 21}));
  out.evidence = s.laboratory.measure(truth, hash_ints({number, 22}), wish.stated_over_true);
  auto catalogue = bench_catalogue();
  if (wish.left_out && *wish.left_out < catalogue.size())
    catalogue[*wish.left_out].lowest = catalogue[*wish.left_out].largest = 0;
  out.diagnosis = diagnose(s.laboratory, out.evidence, {catalogue, bench_parameters(), s.null},
                           s.laboratory.nominal());
  return out;
}

}  // namespace bondlab::diagnose
