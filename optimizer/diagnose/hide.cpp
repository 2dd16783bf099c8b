// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/hide.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/random.h"
#include "base/write_file.h"

namespace bondlab::diagnose {

namespace {

constexpr int packing_offset = 1000, packings_a_seed = 100;
constexpr double load_gain = 0.002, strain_gain = 0.004, jitter = 0.0005;

const std::vector<std::string> kept = {"time",          "displacement",  "axial_stress",
                                       "force_top",     "force_bottom",  "strain_platen",
                                       "strain_axial",  "strain_lateral"};

bool is_load(const std::string &name) {
  return name.find("stress") != std::string::npos || name.rfind("force", 0) == 0;
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
    const bool exact = name == "time";
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

void hide_effect(const Study &study, const std::vector<EffectDefinition> &all,
                 const ModelFactory &factory, const HideOptions &options,
                 const std::filesystem::path &out,
                 const std::function<void(const BatchProgress &)> &progress) {
  const auto effects = effects_of_study(study, all);
  const auto catalogue = catalogue_of(study, effects);
  std::size_t hidden = effects.size();
  std::vector<std::string> names;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    names.push_back(effects[k].name);
    if (effects[k].name == options.effect) hidden = k;
  }
  if (hidden == effects.size() && !options.effect.empty() && options.effect != "none")
    throw UserError("--effect: no test of this study shows '" + options.effect +
                    "' (allowed: " + join(names) + ", none)");
  const Study expanded = with_word_tests(study, effects);
  const auto model = factory(expanded);
  std::vector<ProbedSeries> series;
  for (const auto &test : study.tests) series.push_back({test.name, test.name, {}});
  ForwardProber prober(expanded, effects, *model, series, {0});
  prober.set_progress(progress);
  ModelPoint truth = prober.start();
  RandomStream random(options.seed, 41);
  for (Eigen::Index i = 0; i < truth.z.size(); ++i) truth.z(i) += options.spread * random.normal();
  if (hidden < effects.size())
    truth.amplitude(static_cast<Eigen::Index>(hidden)) =
        options.size / catalogue[hidden].switch_on;

  make_folder(out);
  std::vector<int> packings;
  for (int r = 0; r < options.replicates; ++r)
    packings.push_back(packing_offset +
                       static_cast<int>(options.seed % 10000) * packings_a_seed + r);
  prober.by_packing(truth, packings);  // all of them in one batch
  std::string manifest = "schema = 1\n\n[data]\ntitle = \"" + study.title + "\"\n";
  std::vector<std::string> files(series.size());
  for (std::size_t r = 0; r < packings.size(); ++r) {
    const auto outcomes = prober.curves(truth, packings[r]);
    for (std::size_t t = 0; t < series.size(); ++t) {
      if (!outcomes[t].ok)
        throw UserError("the run of '" + series[t].test + "' with the effect on failed: " +
                        outcomes[t].failure.message);
      const std::string file = fmt::format("{}_{}.csv", series[t].name, r + 1);
      write_file(out / file,
                 noisy_curve(outcomes[t].curve, fmt::format("specimen {}", r + 1), random));
      files[t] += fmt::format("{}\"{}\"", r > 0 ? ", " : "", file);
    }
  }
  for (std::size_t t = 0; t < series.size(); ++t) {
    const auto outcome = prober.curves(truth, packings.front())[t];
    manifest += fmt::format(
        "\n[[series]]\nname = \"{0}\"\ntest = \"{0}\"\nx = \"time\"\ny = \"{1}\"\nfiles = [{2}]\n",
        series[t].name, outcome.curve.has("axial_stress") ? "axial_stress" : "force_top", files[t]);
  }
  write_file(out / "manifest.toml", manifest);
  nlohmann::json sealed;
  sealed["effect"] = hidden < effects.size() ? effects[hidden].name : "none";
  sealed["size"] = hidden < effects.size() ? options.size : 0;
  sealed["seed"] = options.seed;
  const auto values = prober.physical(truth);
  for (std::size_t i = 0; i < values.size(); ++i)
    sealed["parameters"][study.parameters[i].name] = values[i];
  write_file(out / "sealed_truth.json", sealed.dump(2) + "\n");
}

}  // namespace bondlab::diagnose
