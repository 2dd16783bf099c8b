// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/diagnose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/random.h"
#include "base/user_error.h"

namespace bondlab::diagnose {

namespace {

constexpr double quantile_90 = 1.2816, interval = 1.959964;
constexpr int resamples = 200;
constexpr double stable = 0.8;
constexpr int most_anchors = 2;                    // an explanation
constexpr double worth_checking = 20;              // behind the best in deviance
constexpr double settled = 2;                      // of chi squared, gained by the last anchor
constexpr double hopeless = 2, hopeless_pair = 4;  // times what chance leaves
constexpr double hopeless_roughly = 1.3;           // the same, by few runs of the engine

// One way to explain the data: a single effect or a pair.
struct Explanation {
  Refit fit;
  std::optional<ModelPoint> anchor;  // where the model was made right for it
  double left = 0;                   // largest score of what is left, over what chance leaves
  bool complete = false;             // nothing is left
  std::vector<Spot> remains;
};

// One whose change is not known as well is less likely for that alone; where it leaves nothing, and
// no more than the best does, the data have not spoken against it.
bool leaves_no_more(const Explanation &rival, const Refit &best) {
  return rival.complete && rival.fit.admissible() && rival.fit.chi2 <= best.chi2;
}

class Work {
 public:
  Work(Prober &prober, const Evidence &evidence, const DiagnosisSetup &setup,
       const DiagnoseOptions &options)
      : prober_(prober),
        evidence_(evidence),
        setup_(setup),
        options_(options),
        whitening_(evidence) {}

  Diagnosis run(const ModelPoint &start);

 private:
  Explanation explain(const std::vector<std::size_t> &effects);
  void judge(Explanation &out, const Linearisation &model);
  void check(Explanation &out);
  void check_best(std::vector<Explanation> &list, std::size_t most, double most_left);
  std::vector<Spot> beyond_null(const Omnibus::Prepared &prepared,
                                const Eigen::VectorXd &residual) const;
  double second_score(const Refit &fit, const Linearisation &model) const;
  void name_single(const std::vector<Explanation> &singles, std::size_t best);
  bool name_pair(const ScoreTable &scores, const std::vector<Explanation> &singles);
  void resample(const ScoreTable &scores, const Eigen::VectorXd &residual, std::size_t best);
  NamedEffect named(const Refit &fit, std::size_t index) const;

  Prober &prober_;
  const Evidence &evidence_;
  const DiagnosisSetup &setup_;
  const DiagnoseOptions &options_;
  Whitening whitening_;
  std::unique_ptr<Omnibus> omnibus_;
  Diagnosis out_;
  std::vector<double> wins_;  // share of resamples, one an effect
};

std::vector<Spot> Work::beyond_null(const Omnibus::Prepared &prepared,
                                    const Eigen::VectorXd &residual) const {
  std::vector<Spot> spots;
  const double limit = setup_.null.omnibus_strict;
  const auto blocks = prepared.block_scores(residual);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (blocks[b] > limit) spots.push_back({omnibus_->blocks()[b].name, blocks[b]});
  const Eigen::VectorXd drifts = prepared.drift_scores(residual);
  for (Eigen::Index d = 0; d < drifts.size(); ++d)
    if (std::abs(drifts(d)) > limit) {
      const auto &drift = omnibus_->drifts()[static_cast<std::size_t>(d)];
      spots.push_back({drift.parameter + ": " + drift.over, drifts(d)});
    }
  std::stable_sort(spots.begin(), spots.end(), [](const Spot &a, const Spot &b) {
    return std::abs(a.score) > std::abs(b.score);
  });
  return spots;
}

// The largest score of any further effect once those of the fit are on.
double Work::second_score(const Refit &fit, const Linearisation &model) const {
  Linearisation rest = model;
  for (const auto effect : fit.effects)
    rest.traces.col(static_cast<Eigen::Index>(effect)).setZero();
  const Projection fitted(fit.columns);
  const ScoreTable scores(fitted, rest, setup_.catalogue);
  return scores.largest(fitted.off(fit.residual));
}

Explanation Work::explain(const std::vector<std::size_t> &effects) {
  Explanation out;
  out.fit = refit(prober_, whitening_, setup_.catalogue, out_.model, effects);
  Linearisation model = out_.model;
  // What the model does not know of its rows grows with the effect's size, and so is known only
  // once that is.
  for (int pass = 0; pass < 2 && out.fit.ok; ++pass) {
    const Eigen::MatrixXd unknown = prober_.uncertainty(out.fit.point);
    if (unknown.size() == 0) break;
    const Whitening wider(evidence_, unknown);
    model = linearise(prober_, wider, out_.model.point);
    out.fit = refit(prober_, wider, setup_.catalogue, model, effects);
  }
  if (out.fit.ok) judge(out, model);
  return out;
}

// What is left of it, and its entry in the list of what was tried.
void Work::judge(Explanation &out, const Linearisation &model) {
  Tried tried{out.fit.effects, {}, out.fit.deviance};
  for (const auto effect : tried.effects)
    tried.amplitudes.push_back(out.fit.point.amplitude(static_cast<Eigen::Index>(effect)));
  const auto before = std::find_if(out_.tried.begin(), out_.tried.end(),
                                   [&](const Tried &t) { return t.effects == tried.effects; });
  if (before == out_.tried.end())
    out_.tried.push_back(tried);
  else
    *before = tried;
  const Projection fitted(out.fit.columns);
  const Omnibus::Prepared prepared(*omnibus_, fitted);
  const Eigen::VectorXd rest = fitted.off(out.fit.residual);
  out.remains = beyond_null(prepared, rest);
  const double asked = second_score(out.fit, model);
  out.left = std::max(prepared.largest(rest).score / setup_.null.omnibus_strict,
                      asked / setup_.null.trace_strict);
  out.complete = out.remains.empty() && asked < setup_.null.trace_strict;
  if (asked >= setup_.null.trace_strict)
    out.remains.push_back({"a further effect of the catalogue", asked});
}

// Where the engine itself has an explanation: the model is made right there, and fitted again.
void Work::check(Explanation &out) {
  // Chi squared gained by the fit there.
  const auto made_right = [&](const ModelPoint &anchor, Anchoring how) {
    const auto near = prober_.anchored(anchor, how);
    if (!near) return 0.0;
    const Whitening whitening(evidence_, near->uncertainty(anchor));
    const Linearisation there = linearise(*near, whitening, anchor);
    const Refit fit = refit(*near, whitening, setup_.catalogue, there, out.fit.effects);
    if (!fit.ok) return 0.0;
    out.fit = fit;
    out.anchor = anchor;
    judge(out, there);
    return there.residual.squaredNorm() - fit.chi2;
  };
  for (int count = 0; count < most_anchors; ++count)
    if (made_right(out.fit.point, Anchoring::rough) < settled) break;
  if (out.anchor && out.left < hopeless_roughly) made_right(*out.anchor, Anchoring::whole);
}

// Those near the best, the best first, and not those that leave far too much.
void Work::check_best(std::vector<Explanation> &list, std::size_t most, double most_left) {
  std::vector<Explanation *> near;
  for (auto &e : list)
    if (e.fit.admissible()) near.push_back(&e);
  std::stable_sort(near.begin(), near.end(), [](const Explanation *a, const Explanation *b) {
    return a->fit.deviance < b->fit.deviance;
  });
  const auto &alarm = setup_.null.trace_alarm;
  if (near.empty() || out_.before.deviance - near.front()->fit.deviance < alarm * alarm) return;
  const double best = near.front()->fit.deviance;
  for (std::size_t i = 0; i < std::min(most, near.size()); ++i)
    if (near[i]->fit.deviance - best < worth_checking && near[i]->left < most_left) check(*near[i]);
}

NamedEffect Work::named(const Refit &fit, std::size_t index) const {
  NamedEffect out;
  out.effect = fit.effects[index];
  const double unit = setup_.catalogue[out.effect].switch_on;
  const auto at = fit.point.z.size() + static_cast<Eigen::Index>(index);
  const double amplitude = fit.point.amplitude(static_cast<Eigen::Index>(out.effect));
  const double sd = std::sqrt(std::max(0.0, fit.covariance(at, at)));
  out.size = amplitude * unit;
  out.low = (amplitude - interval * sd) * unit;
  out.high = (amplitude + interval * sd) * unit;
  out.gain = out_.before.deviance - fit.deviance;
  out.p = p_value(setup_.null.trace, std::sqrt(std::max(0.0, out.gain)));
  return out;
}

// How often each effect comes out on top when noise is drawn anew about the best explanation.
void Work::resample(const ScoreTable &scores, const Eigen::VectorXd &residual, std::size_t best) {
  wins_.assign(setup_.catalogue.size(), 0);
  // The scores t are jointly normal with the cosines as covariance.
  const auto column = static_cast<Eigen::Index>(best);
  const Eigen::VectorXd mean =
      scores.cosines().col(column) * scores.unit().col(column).dot(residual);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scores.cosines());
  const Eigen::MatrixXd root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  RandomStream random(options_.seed, 6);
  Eigen::VectorXd draw(mean.size());
  for (int i = 0; i < resamples; ++i) {
    for (Eigen::Index k = 0; k < draw.size(); ++k) draw(k) = random.normal();
    wins_[scores.scores_of(mean + root * draw).front().effect] += 1.0 / resamples;
  }
}

void Work::name_single(const std::vector<Explanation> &singles, std::size_t best) {
  const Refit &winner = singles[best].fit;
  out_.after = winner;
  out_.realised_gain = out_.before.deviance - winner.deviance;
  out_.effects = {named(winner, 0)};
  out_.stability = wins_[winner.effects.front()];
  double margin = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < singles.size(); ++i) {
    if (i == best || !singles[i].fit.ok) continue;
    const double behind = singles[i].fit.deviance - winner.deviance;
    const bool likely = behind < margin_needed ||
                        (out_.stability < stable && wins_[singles[i].fit.effects.front()] > 0.05);
    if (leaves_no_more(singles[i], winner) ||
        (likely && out_.before.deviance - singles[i].fit.deviance > 0)) {
      out_.effects.push_back(named(singles[i].fit, 0));
      out_.effects.back().margin = behind;
    } else {
      margin = std::min(margin, behind);
    }
  }
  out_.margin = margin;
  out_.verdict = out_.effects.size() == 1 ? Verdict::one : Verdict::set;
  if (out_.verdict == Verdict::one) out_.effects.front().margin = margin;
}

bool Work::name_pair(const ScoreTable &scores, const std::vector<Explanation> &singles) {
  auto pairs = scores.pairs(out_.model.residual);
  if (pairs.size() > options_.confirmed_pairs) pairs.resize(options_.confirmed_pairs);
  std::vector<Explanation> explanations;
  for (const auto &pair : pairs) explanations.push_back(explain({pair.first, pair.second}));
  check_best(explanations, options_.checked_pairs, hopeless_pair);
  const Explanation *best = nullptr;
  for (const auto &e : explanations)
    if (e.fit.admissible() && (!best || e.fit.deviance < best->fit.deviance)) best = &e;
  if (!best) return false;
  out_.after = best->fit;
  out_.anchor = best->anchor;
  out_.remains = best->remains;
  if (!best->complete) return false;
  // Either member alone must lose more than what chance gives the best of a catalogue.
  const double needed = setup_.null.trace_strict * setup_.null.trace_strict;
  for (const auto effect : best->fit.effects) {
    double alone = out_.before.deviance;
    for (const auto &single : singles)
      if (single.fit.ok && single.fit.effects.front() == effect)
        alone = std::min(alone, single.fit.deviance);
    if (alone - best->fit.deviance < needed) return false;
  }
  double margin = std::numeric_limits<double>::infinity();
  std::vector<const Explanation *> rivals;
  for (const auto &e : explanations) {
    if (&e == best || !e.fit.admissible()) continue;
    const double behind = e.fit.deviance - best->fit.deviance;
    if (behind < margin_needed || leaves_no_more(e, best->fit))
      rivals.push_back(&e);
    else
      margin = std::min(margin, behind);
  }
  out_.realised_gain = out_.before.deviance - best->fit.deviance;
  for (std::size_t i = 0; i < 2; ++i) out_.effects.push_back(named(best->fit, i));
  for (const auto *rival : rivals)
    for (std::size_t i = 0; i < 2; ++i) {
      const auto effect = rival->fit.effects[i];
      const bool known = std::any_of(out_.effects.begin(), out_.effects.end(),
                                     [&](const NamedEffect &e) { return e.effect == effect; });
      if (known) continue;
      out_.effects.push_back(named(rival->fit, i));
      out_.effects.back().margin = rival->fit.deviance - best->fit.deviance;
    }
  out_.margin = margin;
  out_.verdict = rivals.empty() ? Verdict::two : Verdict::set;
  if (out_.verdict == Verdict::two)
    for (auto &effect : out_.effects) effect.margin = margin;
  return true;
}

Diagnosis Work::run(const ModelPoint &start) {
  out_.noise = whitening_.noise();
  out_.false_alarm = setup_.null.rate;
  out_.model = fit_base(prober_, evidence_, setup_.catalogue, start, out_.before, whitening_);
  out_.after = out_.before;
  omnibus_ =
      std::make_unique<Omnibus>(evidence_, whitening_, setup_.parameters, out_.model.jacobian);
  const Projection fitted(out_.model.jacobian);
  const Omnibus::Prepared prepared(*omnibus_, fitted);
  const ScoreTable scores(fitted, out_.model, setup_.catalogue);
  const Eigen::VectorXd residual = fitted.off(out_.model.residual);
  for (std::size_t k = 0; k < setup_.catalogue.size(); ++k)
    out_.smallest_size.push_back(scores.hidden(k)
                                     ? std::numeric_limits<double>::infinity()
                                     : (setup_.null.trace_alarm + quantile_90) / scores.norm(k) *
                                           setup_.catalogue[k].switch_on);

  const auto ranked = scores.scores(residual);
  const double omnibus = prepared.largest(residual).score;
  const double trace = ranked.empty() ? 0 : std::sqrt(ranked.front().gain);
  out_.p_omnibus = p_value(setup_.null.omnibus, omnibus);
  out_.p_trace = p_value(setup_.null.trace, trace);
  out_.omnibus = omnibus, out_.omnibus_alarm = setup_.null.omnibus_alarm;
  out_.trace = trace, out_.trace_alarm = setup_.null.trace_alarm;
  out_.where = beyond_null(prepared, residual);
  if (omnibus <= setup_.null.omnibus_alarm && trace <= setup_.null.trace_alarm) return out_;

  out_.verdict = Verdict::not_in_catalogue;
  out_.remains = out_.where;
  if (ranked.empty()) return out_;
  out_.predicted_gain = ranked.front().gain;
  resample(scores, residual, ranked.front().effect);
  std::vector<Explanation> singles;
  for (const auto &score : ranked) {
    const bool near =
        ranked.front().gain - score.gain < options_.worth_refitting || singles.size() < 2;
    if (singles.size() == options_.confirmed || !near || score.gain <= 0) break;
    singles.push_back(explain({score.effect}));
  }
  check_best(singles, options_.checked, hopeless);
  std::size_t best = singles.size();
  for (std::size_t i = 0; i < singles.size(); ++i)
    if (singles[i].fit.admissible() &&
        (best == singles.size() || singles[i].fit.deviance < singles[best].fit.deviance))
      best = i;
  if (best < singles.size()) {
    const Explanation &winner = singles[best];
    const double gain = out_.before.deviance - winner.fit.deviance;
    const bool significant = std::sqrt(std::max(0.0, gain)) > setup_.null.trace_alarm;
    out_.remains = winner.remains;
    out_.after = winner.fit;
    out_.anchor = winner.anchor;
    if (significant && winner.complete) {
      name_single(singles, best);
      return out_;
    }
  }
  name_pair(scores, singles);
  return out_;
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::one:
      return "one";
    case Verdict::set:
      return "set";
    case Verdict::two:
      return "two";
    case Verdict::not_in_catalogue:
      return "not_in_catalogue";
    case Verdict::nothing:
      return "nothing";
  }
  return "";
}

Linearisation fit_base(Prober &prober, const Whitening &whitening,
                       const std::vector<EffectEntry> &catalogue, const ModelPoint &start,
                       Refit &base) {
  base = refit(prober, whitening, catalogue, linearise(prober, whitening, start, false), {});
  if (!base.ok)
    throw UserError(Place{},
                    "the model gives no figures at the best fit, so there is nothing to diagnose");
  return linearise(prober, whitening, base.point);
}

Linearisation fit_base(Prober &prober, const Evidence &evidence,
                       const std::vector<EffectEntry> &catalogue, const ModelPoint &start,
                       Refit &base, Whitening &whitening) {
  Linearisation model = fit_base(prober, whitening, catalogue, start, base);
  const Eigen::MatrixXd unknown = prober.uncertainty(base.point);
  if (unknown.size() == 0) return model;
  whitening = Whitening(evidence, unknown);
  return fit_base(prober, whitening, catalogue, base.point, base);
}

Diagnosis diagnose(Prober &prober, const Evidence &evidence, const DiagnosisSetup &setup,
                   const ModelPoint &start, const DiagnoseOptions &options) {
  Diagnosis out = Work(prober, evidence, setup, options).run(start);
  double best = out.before.deviance;
  for (const auto &tried : out.tried) best = std::min(best, tried.behind);
  for (auto &tried : out.tried) tried.behind -= best;
  return out;
}

}  // namespace bondlab::diagnose
