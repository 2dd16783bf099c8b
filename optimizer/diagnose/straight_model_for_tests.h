// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a forward model in closed form over the granite study, and a fixture with it, for the tests
//   of what stands on a forward model.
// Method: as said at each. Units: SI. Failure: as asked for.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "base/random.h"
#include "diagnose/emulated_prober.h"
#include "forward/run_plan.h"

namespace bondlab::diagnose {

constexpr double by_packing = 0.01;  // change of the logarithm of the strength, a packing
constexpr double gap_scale = 1e-4;   // m

// Straight curves to a peak of sigma_c (1 + gap / gap_scale) exp(by_packing * packing), at a slope
// of E_b; `chaos` adds noise of this sd to the logarithm of the peak, another one for every
// request; only what the request itself says is known to it, as to the engine.
class StraightModel : public ForwardModel {
 public:
  double default_gap = 0;
  double chaos = 0;
  std::string failing;  // name of a test
  std::function<bool(const ForwardRequest &)> lacks = [](const auto &) { return false; };
  std::vector<std::vector<ForwardRequest>> batches;

  std::vector<ForwardOutcome> run(const std::vector<ForwardRequest> &requests,
                                  std::function<void(const BatchProgress &)>) override {
    batches.push_back(requests);
    std::vector<ForwardOutcome> out;
    for (const auto &request : requests) out.push_back(one(request));
    return out;
  }

 private:
  ForwardOutcome one(const ForwardRequest &request) const {
    ForwardOutcome outcome;
    if (request.test == failing || lacks(request)) return outcome;
    const auto &v = request.variables;
    const double gap = v.count("gap") ? v.at("gap") : default_gap;
    const double peak = v.at("sigma_c") * (1 + gap / gap_scale) *
                        std::exp(by_packing * request.packing + chaos * noise_of(request));
    outcome.ok = true;
    outcome.curve.names = {"axial_stress", "strain_axial"};
    outcome.curve.units = {"Pa", "1"};
    outcome.curve.columns.resize(2);
    for (int i = 0; i <= 50; ++i) {
      outcome.curve.columns[0].push_back(peak * i / 50);
      outcome.curve.columns[1].push_back(peak / v.at("E_b") * i / 50);
    }
    return outcome;
  }

  static double noise_of(const ForwardRequest &request) {
    std::vector<std::uint64_t> words = {static_cast<std::uint64_t>(request.packing)};
    for (const char c : request.test) words.push_back(static_cast<std::uint64_t>(c));
    for (const auto &[name, value] : request.variables)
      words.push_back(static_cast<std::uint64_t>(std::hash<double>()(value)));
    std::uint64_t seed = 1;
    for (const auto word : words) seed = hash_ints({seed, word});
    return RandomStream(seed, 1).normal();
  }
};

class StraightModelTest : public ::testing::Test {
 protected:
  StraightModelTest() {
    gap = plan_run(study, {"ucs", {}, 0}).numeric.at("gap");
    model.default_gap = gap;
    for (const std::string test : {"ucs", "brazilian"})
      series.push_back(
          {test,
           test,
           {{CurvePart::slope, "gauge compliance 0.3 to 0.6"}, {CurvePart::peak, "log peak"}}});
  }
  Eigen::Index index(const std::string &name) const {
    for (std::size_t k = 0; k < effects.size(); ++k)
      if (effects[k].name == name) return static_cast<Eigen::Index>(k);
    throw std::runtime_error("no effect " + name);
  }
  static ModelPoint moved(ModelPoint point, Eigen::Index parameter, double step) {
    point.z(parameter) += step;
    return point;
  }
  ModelPoint with(ModelPoint point, const std::string &effect, double amplitude) const {
    point.amplitude(index(effect)) = amplitude;
    return point;
  }
  double switch_on(const std::string &effect) const {
    return catalogue_of(study, effects)[static_cast<std::size_t>(index(effect))].switch_on;
  }

  enum Row { ucs_slope, ucs_peak, brazilian_slope, brazilian_peak };
  enum ParameterIndex { E_c, kn_ks, sigma_c };
  std::filesystem::path inputs = std::filesystem::path(BONDLAB_SOURCE_DIR) / "inputs";
  Study given = read_study(inputs / "studies" / "granite.toml");
  std::vector<EffectDefinition> effects = effects_of_study(given, read_effects(inputs / "effects"));
  Study study = with_word_tests(given, effects);
  StraightModel model;
  std::vector<ProbedSeries> series;
  double gap = 0;
};

// With what an emulator of it is made from: eight packings, effects on six of them.
class EmulatedModelTest : public StraightModelTest {
 protected:
  std::vector<EffectEntry> catalogue = catalogue_of(study, effects);
  ForwardProber engine{study, effects, model, series, {0, 1, 2, 3, 4, 5, 6, 7}};
  EmulatorPlan plan = [] {
    EmulatorPlan out{8, 6};
    out.steps = {0.12, 0.12, 0.12};
    return out;
  }();
};

}  // namespace bondlab::diagnose
