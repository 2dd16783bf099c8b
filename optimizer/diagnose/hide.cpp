// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/hide.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "base/write_file.h"
#include "diagnose/measuring_error.h"
#include "forward/run_plan.h"

namespace bondlab::diagnose {

namespace {

constexpr int packing_offset = 1000, packings_a_seed = 100;
constexpr double load_gain = 0.002, strain_gain = 0.004, jitter = 0.0005;

const std::vector<std::string> kept = {
    "time",           "displacement",  "axial_stress", "force_top",    "force_bottom",
    "side_force",     "strain_platen", "strain_axial", "strain_lateral", "strain_machine",
    "machine",        "deflection",    "lift",         "shear_stress", "normal_stress",
    "phase"};

bool is_load(const std::string &name) {
  return name.find("stress") != std::string::npos || name.rfind("force", 0) == 0;
}

// What the laboratory set, not what its sensors say.
bool is_exact(const std::string &name) { return name == "time" || name == "phase"; }

// As asked for: an effect on a deck variable must not show here.
std::string conditions_of(const Study &study, const std::string &test) {
  const auto set = plan_run(study, {test, {}, 0}).numeric;
  const auto value = [&](const char *name) {
    const auto found = set.find(name);
    return found == set.end() ? 0.0 : found->second;
  };
  const std::string kind = study.test(test).definition.name;
  const double size = value("height") > 0 ? value("height") : value("diameter");
  const double speed = value("platen_speed") > 0 ? value("platen_speed") : value("pull_speed");
  std::string out;
  const auto add = [&](const char *name, double v, const char *unit) {
    if (v > 0) out += fmt::format("{}{} = \"{:.6g} {}\"", out.empty() ? "" : ", ", name, v, unit);
  };
  if (kind == "uniaxial_compression" || kind == "direct_tension")
    add("strain_rate", speed / size, "1/s");
  add("confinement", value("confining_pressure") + value("normal_stress"), "Pa");
  add("temperature", value("temperature"), "K");
  add("size", size, "m");
  return out;
}

EffectEntry entry_of(const Study &study, const EffectDefinition &effect) {
  return catalogue_of(study, {effect}).front();
}

std::string noisy_curve(const Curve &curve, const std::string &label, RandomStream &random) {
  std::vector<std::size_t> columns;
  for (const auto &name : kept)
    for (std::size_t i = 0; i < curve.names.size(); ++i)
      if (curve.names[i] == name) columns.push_back(i);
  const double gain_of_load = 1 + load_gain * random.normal();
  std::vector<double> gain, most;
  std::string names, units;
  for (const auto i : columns) {
    const auto &name = curve.names[i];
    const bool exact = is_exact(name);
    gain.push_back(exact ? 1 : is_load(name) ? gain_of_load : 1 + strain_gain * random.normal());
    double largest = 0;
    for (const double v : curve.columns[i]) largest = std::max(largest, std::abs(v));
    most.push_back(exact ? 0 : largest);
    names += (names.empty() ? "" : ", ") + name;
    units += (units.empty() ? "" : ", ") + curve.units[i];
  }
  std::string text = fmt::format("# replicate: {}\n# names: {}\n# units: {}\n\n", label, names, units);
  for (std::size_t row = 0; row < curve.rows(); ++row) {
    for (std::size_t j = 0; j < columns.size(); ++j)
      text += fmt::format("{}{:.9g}", j > 0 ? ", " : "",
                          gain[j] * curve.columns[columns[j]][row] +
                              (most[j] > 0 ? jitter * most[j] * random.normal() : 0));
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<double> sealed_parameters(const std::filesystem::path &folder, const Study &study) {
  std::ifstream file(folder / "sealed_truth.json");
  if (!file) throw UserError(Place{(folder / "sealed_truth.json").string(), 0, 0}, "can't be read");
  const auto sealed = nlohmann::json::parse(file);
  std::vector<double> out;
  for (const auto &p : study.parameters) out.push_back(sealed.at("parameters").at(p.name));
  return out;
}

double admissible_size(const Study &study, const EffectDefinition &effect) {
  return effect.measures.empty() ? entry_of(study, effect).largest : effect.largest;
}

void hide_effect(const Study &study, const std::vector<EffectDefinition> &all,
                 const ModelFactory &factory, const HideOptions &options,
                 const std::filesystem::path &out,
                 const std::function<void(const BatchProgress &)> &progress) {
  if (options.effects.size() != options.sizes.size())
    throw UserError(fmt::format("--size: {} given, but {} hidden effects", options.sizes.size(),
                                options.effects.size()));
  std::vector<EffectDefinition> effects;
  for (const auto &name : options.effects) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const EffectDefinition &e) { return e.name == name; });
    if (found == all.end() ||
        (effects_of_study(study, {*found}).empty() && found->measures.empty())) {
      std::vector<std::string> names;
      for (const auto &effect : all)
        if (!effects_of_study(study, {effect}).empty() || !effect.measures.empty())
          names.push_back(effect.name);
      throw UserError("--effect: no test of this study shows '" + name +
                      "' (allowed: " + join(names) + ", none)");
    }
    effects.push_back(*found);
  }
  const Study expanded = with_word_tests(study, effects);
  const auto model = factory(expanded);
  std::vector<ProbedSeries> series;
  for (const auto &test : study.tests) series.push_back({test.name, test.name, {}});
  ForwardProber prober(expanded, effects, *model, series, {0});
  prober.set_progress(progress);
  ModelPoint truth = prober.start();
  RandomStream random(options.seed, 41);
  for (Eigen::Index i = 0; i < truth.z.size(); ++i) truth.z(i) += options.spread * random.normal();
  for (std::size_t k = 0; k < effects.size(); ++k)
    truth.amplitude(static_cast<Eigen::Index>(k)) =
        options.sizes[k] / entry_of(study, effects[k]).switch_on;

  make_folder(out);
  std::vector<int> packings;
  for (int r = 0; r < options.replicates; ++r)
    packings.push_back(packing_offset +
                       static_cast<int>(options.seed % 10000) * packings_a_seed + r);
  prober.by_packing(truth, packings);  // all of them in one batch
  std::vector<MeasuredRun> runs;  // series by series, as a laboratory works
  for (std::size_t t = 0; t < series.size(); ++t)
    for (const int packing : packings) {
      const auto outcome = prober.curves(truth, packing)[t];
      if (!outcome.ok)
        throw UserError("the run of '" + series[t].test + "' with the effect on failed: " +
                        outcome.failure.message);
      runs.push_back({study.test(series[t].test).definition.name, series[t].name, outcome.curve});
    }
  for (std::size_t k = 0; k < effects.size(); ++k)
    apply_measuring_errors(effects[k], options.sizes[k], runs);
  std::string manifest = "schema = 1\n\n[data]\ntitle = \"" + study.title + "\"\n";
  for (std::size_t t = 0; t < series.size(); ++t) {
    std::string files;
    for (std::size_t r = 0; r < packings.size(); ++r) {
      const std::string file = fmt::format("{}_{}.csv", series[t].name, r + 1);
      write_file(out / file, noisy_curve(runs[t * packings.size() + r].curve,
                                         fmt::format("specimen {}", r + 1), random));
      files += fmt::format("{}\"{}\"", r > 0 ? ", " : "", file);
    }
    const bool stress = runs[t * packings.size()].curve.has("axial_stress");
    manifest += fmt::format(
        "\n[[series]]\nname = \"{0}\"\ntest = \"{0}\"\nx = \"time\"\ny = \"{1}\"\n"
        "conditions = {{ {2} }}\nfiles = [{3}]\n",
        series[t].name, stress ? "axial_stress" : "force_top", conditions_of(study, series[t].test),
        files);
  }
  write_file(out / "manifest.toml", manifest);
  nlohmann::json sealed;
  sealed["effects"] = nlohmann::json::array();
  for (std::size_t k = 0; k < effects.size(); ++k)
    sealed["effects"].push_back({{"name", effects[k].name}, {"size", options.sizes[k]}});
  sealed["seed"] = options.seed;
  const auto values = prober.physical(truth);
  for (std::size_t i = 0; i < values.size(); ++i)
    sealed["parameters"][study.parameters[i].name] = values[i];
  write_file(out / "sealed_truth.json", sealed.dump(2) + "\n");
}

}  // namespace bondlab::diagnose
