// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: for tests only: a granite study and a forward model in closed form, with the noise and the
//   failures of real runs.
// Method: power laws fitted to the 30 design points of a published parallel-bond study of granite
//   (Table 3 of the article that inputs/studies/granite.toml names): with E_c in GPa, k = k_n/k_s,
//   s = sigma_c in MPa
//     E = 2.13 E_c^1.008 k^-0.20 GPa,  nu = 0.116 + 0.173 ln k,
//     UCS = 5.68 s^0.849 k^-0.231 E_c^0.085 MPa,  sigma_t = 0.557 s^0.978 k^-0.264 MPa.
//   The outcome is a curve from which response/ takes these figures, so that the whole path is
//   under test. Noise is a hash of the variables' bits, the packing and a seed: the same request
//   gives the same outcome, a change in the last digit gives another, as cracking does.
// Units: SI at the interface.
#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <set>
#include <tuple>

#include "base/random.h"
#include "forward/forward_model.h"
#include "study/study.h"

namespace bondlab::testing {

struct MacroFigures {
  double E = 0, nu = 0, UCS = 0, sigma_t = 0;
};

inline MacroFigures granite_law(double E_c, double k, double sigma_c) {
  const double e = E_c / 1e9, s = sigma_c / 1e6;
  return {2.13 * std::pow(e, 1.008) * std::pow(k, -0.20) * 1e9, 0.116 + 0.173 * std::log(k),
          5.68 * std::pow(s, 0.849) * std::pow(k, -0.231) * std::pow(e, 0.085) * 1e6,
          0.557 * std::pow(s, 0.978) * std::pow(k, -0.264) * 1e6};
}

class GraniteEmulator : public ForwardModel {
 public:
  using Law = std::function<MacroFigures(const std::map<std::string, double> &)>;

  Law law = [](const std::map<std::string, double> &v) {
    return granite_law(v.at("E_c"), v.at("kn_ks"), v.at("sigma_c"));
  };
  double noise_elastic = 0, noise_strength = 0;  // relative sd under any change of the request
  double packing_scatter = 0;                    // relative sd between packings, of the strengths
  std::uint64_t seed = 1;
  std::function<FailureCause(const ForwardRequest &)> fail;  // none: the run succeeds
  std::function<bool(const ForwardRequest &)> unfinished;    // true: the curve ends before the peak

  int batches = 0, runs = 0, repeated = 0;
  int largest_batch = 0;

  std::vector<ForwardOutcome> run(const std::vector<ForwardRequest> &requests,
                                  std::function<void(const BatchProgress &)> progress) override {
    ++batches;
    largest_batch = std::max(largest_batch, static_cast<int>(requests.size()));
    std::vector<ForwardOutcome> outcomes;
    BatchProgress state;
    state.total = static_cast<int>(requests.size());
    for (const auto &request : requests) {
      outcomes.push_back(one(request));
      ++(outcomes.back().ok ? state.done : state.failed);
      if (progress) progress(state);
    }
    return outcomes;
  }

 private:
  double normal(const ForwardRequest &request, std::uint64_t response, bool by_variables) const {
    std::uint64_t hash = hash_ints({seed, response, static_cast<std::uint64_t>(request.packing)});
    if (by_variables)
      for (const auto &variable : request.variables) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &variable.second, sizeof bits);
        hash = hash_ints({hash, bits});
      }
    return RandomStream(hash).normal();
  }

  ForwardOutcome one(const ForwardRequest &request) {
    ++runs;
    if (!seen_.insert({request.test, request.packing, request.variables}).second) ++repeated;
    ForwardOutcome outcome;
    outcome.run_id = request.test + "-" + std::to_string(runs);
    outcome.run_directory = "runs/" + outcome.run_id;
    outcome.replay_command = "bondlab run granite.toml --test " + request.test;
    outcome.wall_seconds = 1;
    outcome.deck_variables = request.variables;
    outcome.deck_variables["diameter"] = 0.05;
    outcome.deck_variables["thickness"] = 1;
    const FailureCause cause = fail ? fail(request) : FailureCause::none;
    if (cause != FailureCause::none) {
      outcome.failure.cause = cause;
      outcome.failure.message = "planted failure";
      outcome.failure.run_directory = outcome.run_directory;
      outcome.failure.command = outcome.replay_command;
      return outcome;
    }
    MacroFigures f = law(request.variables);
    const auto scatter = [&](std::uint64_t response, double noise, double packings) {
      return std::exp(noise * normal(request, response, true) +
                      (request.packing ? packings * normal(request, 100 + response, false) : 0.0));
    };
    f.E *= scatter(1, noise_elastic, 0);
    f.nu *= scatter(2, noise_elastic, 0);
    f.UCS *= scatter(3, noise_strength, packing_scatter);
    f.sigma_t *= scatter(4, noise_strength, packing_scatter);
    outcome.ok = true;
    outcome.curve = curve(request.test == "ucs", f);
    if (unfinished && unfinished(request))
      for (auto &column : outcome.curve.columns) column.resize(70);
    return outcome;
  }

  static Curve curve(bool compression, const MacroFigures &f) {
    Curve curve;
    curve.names = {"time",          "axial_stress", "force_top",     "force_bottom",
                   "strain_platen", "strain_axial", "strain_lateral"};
    curve.units = {"s", "Pa", "N", "N", "1", "1", "1"};
    curve.columns.resize(curve.names.size());
    const double top = compression ? f.UCS : f.sigma_t * M_PI * 0.05 / 2;
    for (int i = 0; i <= 100; ++i) {
      const double s = i / 80.0, load = s <= 1 ? s * top : top * (1 - 4 * (s - 1));
      const double strain = s * f.UCS / f.E, force = compression ? 0.05 * load : load;
      const double row[] = {1e-5 * i, load, force, force, 1.05 * strain, strain, f.nu * strain};
      for (std::size_t c = 0; c < curve.columns.size(); ++c) curve.columns[c].push_back(row[c]);
    }
    curve.complete = true;
    curve.completion = "stop_after_peak";
    return curve;
  }

  std::set<std::tuple<std::string, int, std::map<std::string, double>>> seen_;
};

inline Parameter make_parameter(const std::string &name, const std::string &unit, double lower,
                                double upper) {
  Parameter parameter;
  parameter.name = name;
  parameter.unit = unit;
  parameter.lower = lower;
  parameter.upper = upper;
  parameter.scale = Scale::logarithmic;
  parameter.sets = {name};
  return parameter;
}

inline Target make_target(const std::string &name, const std::string &test, const std::string &unit,
                          double value, double relative_sd) {
  Target target;
  target.name = name;
  target.test = test;
  target.response = name;
  target.unit = unit;
  target.value = value;
  target.sd = relative_sd * value;
  target.source = "measured";
  target.sd_source = "assumed";
  return target;
}

// The granite study: three parameters, four targets, the two fits.
inline Study granite_study() {
  Study study;
  study.name = "granite";
  study.title = "granite, closed form";
  study.file = "granite.toml";
  for (const std::string name : {"ucs", "brazilian"}) {
    TestEntry test;
    test.name = name;
    test.test = name == "ucs" ? "uniaxial_compression" : "brazilian";
    for (const std::string variable : {"E_c", "kn_ks", "sigma_c"})
      test.definition.variables[variable].name = variable;
    study.tests.push_back(test);
  }
  const auto respond = [&study](int test, const std::string &name, const std::string &unit,
                                const std::string &function) {
    study.tests[static_cast<std::size_t>(test)].definition.responses[name] = {
        name, unit, function, {}};
  };
  respond(0, "E", "Pa", "uniaxial.tangent_modulus_gauge");
  respond(0, "nu", "1", "uniaxial.poisson_gauge");
  respond(0, "UCS", "Pa", "uniaxial.peak_stress");
  respond(1, "sigma_t", "Pa", "brazilian.tensile_strength");
  study.parameters = {make_parameter("E_c", "GPa", 15e9, 45e9),
                      make_parameter("kn_ks", "1", 1.2, 4),
                      make_parameter("sigma_c", "MPa", 15e6, 60e6)};
  study.targets = {make_target("E", "ucs", "GPa", 41.5e9, 0.03),
                   make_target("nu", "ucs", "1", 0.23, 0.05),
                   make_target("UCS", "ucs", "MPa", 138.8e6, 0.05),
                   make_target("sigma_t", "brazilian", "MPa", 9.5e6, 0.05)};
  FitEntry main, trade_off;
  main.name = "main";
  main.targets = {"E", "nu", "UCS"};
  main.predicted = {"sigma_t"};
  trade_off.name = "trade-off";
  trade_off.targets = {"E", "nu", "UCS", "sigma_t"};
  study.fits = {main, trade_off};
  return study;
}

}  // namespace bondlab::testing
