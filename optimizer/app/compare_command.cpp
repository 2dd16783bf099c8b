// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab compare STUDY`: run the parameter sets of a published table on several packings and
// set our figures beside the published ones.
// Method: every case through every test its quantities name, on packings 0 .. n-1 (the study's seed
// plus the number), all in one batch; mean and standard deviation over packings. A judged figure
// agrees when the means differ by no more than the tolerance. Where at least four cases give a
// quantity, the exponents of a power law over the parameters that vary are fitted to the published and
// to our means (least squares of logarithms), side by side.
// Units: those of the study's quantities. Failure: a failed run is left out of the mean and counted;
// exit status 2 if a case has no run left. Disagreement is a result, not a failure: exit status 0.
#include <fmt/core.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "app/commands.h"
#include "base/units.h"
#include "base/write_file.h"
#include "forward/engine_forward_model.h"
#include "forward/interrupt.h"
#include "response/check.h"
#include "response/response.h"

namespace bondlab {

namespace {

struct Options {
  std::string study, out;
  std::vector<std::string> cases;
  int packings = 0, jobs = 0;
};

struct Figure {
  int count = 0, failed = 0;
  double sum = 0, squares = 0;
  std::string trouble;  // why a run gave no figure
  double mean() const { return sum / count; }
  double sd() const {
    if (count < 2) return 0;
    const double variance = (squares - sum * sum / count) / (count - 1);
    return variance > 0 ? std::sqrt(variance) : 0;
  }
};

// figures[case][quantity]
using Figures = std::vector<std::map<std::string, Figure>>;

std::set<std::string> tests_of(const Study &study, const PublishedCase &one) {
  std::set<std::string> tests;
  for (const PublishedQuantity &quantity : study.quantities)
    if (one.expected.count(quantity.name)) tests.insert(quantity.test);
  return tests;
}

bool agrees(const PublishedQuantity &quantity, double ours, double published) {
  const double allowed = quantity.relative ? quantity.tolerance * std::abs(published) : quantity.tolerance;
  return std::abs(ours - published) <= allowed;
}

std::string tolerance_text(const PublishedQuantity &quantity) {
  return quantity.relative ? fmt::format("{:g} %", 100 * quantity.tolerance)
                           : format_quantity(quantity.tolerance, quantity.unit);
}

// Exponents of quantity = c prod p^a over the parameters that differ between the cases.
struct PowerLaw {
  std::vector<std::string> parameters;
  std::vector<double> exponents;
};
PowerLaw power_law(const Study &study, const std::vector<std::size_t> &rows, const std::vector<double> &values) {
  PowerLaw law;
  std::vector<std::size_t> columns;
  for (std::size_t p = 0; p < study.parameters.size(); ++p) {
    std::set<double> different;
    bool positive = true;
    for (const std::size_t row : rows) {
      different.insert(study.cases[row].values[p]);
      positive = positive && study.cases[row].values[p] > 0;
    }
    if (different.size() > 1 && positive) columns.push_back(p);
  }
  if (rows.size() < columns.size() + 2 || columns.empty()) return law;
  Eigen::MatrixXd A(rows.size(), columns.size() + 1);
  Eigen::VectorXd b(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!(values[r] > 0)) return law;
    A(r, 0) = 1;
    for (std::size_t c = 0; c < columns.size(); ++c) A(r, c + 1) = std::log(study.cases[rows[r]].values[columns[c]]);
    b(r) = std::log(values[r]);
  }
  const Eigen::VectorXd x = A.colPivHouseholderQr().solve(b);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    law.parameters.push_back(study.parameters[columns[c]].name);
    law.exponents.push_back(x(c + 1));
  }
  return law;
}

class Table {
 public:
  void line(const std::string &text) { text_ += text + "\n"; }
  const std::string &text() const { return text_; }

 private:
  std::string text_;
};

std::string number_in(double si, const std::string &unit) {
  const std::string text = format_quantity(si, unit);
  const std::size_t space = text.find(' ');
  return space == std::string::npos ? text : text.substr(0, space);
}

// A Markdown table, and the same as TSV with SI values.
void write_tables(const Study &study, const std::vector<std::size_t> &chosen, const Figures &figures, int packings,
                  Table &page, Table &tsv) {
  page.line(fmt::format("# {}\n\n{} packing{} a case. Ours: mean +- standard deviation over packings.\n",
                        study.title.empty() ? study.name : study.title, packings, packings == 1 ? "" : "s"));
  tsv.line("case\tquantity\tunit\tpublished\tpublished_sd\tours\tours_sd\truns\tfailed\tdifference\tagrees");
  for (const PublishedQuantity &quantity : study.quantities) {
    page.line(fmt::format("## {} ({}{})\n", quantity.name, quantity.unit == "1" ? "" : quantity.unit + ", ",
                          quantity.judged ? "goal: within " + tolerance_text(quantity) : "reported, not judged"));
    page.line("| case | published | ours | difference | |");
    page.line("|---|---|---|---|---|");
    int good = 0, judged = 0;
    std::vector<std::size_t> rows;
    std::vector<double> theirs, ours;
    for (const std::size_t k : chosen) {
      const PublishedCase &one = study.cases[k];
      const auto expected = one.expected.find(quantity.name);
      if (expected == one.expected.end()) continue;
      const Figure &figure = figures[k].at(quantity.name);
      const auto sd = one.expected_sd.find(quantity.name);
      std::string published = number_in(expected->second, quantity.unit);
      if (sd != one.expected_sd.end()) published += " +- " + number_in(sd->second, quantity.unit);
      if (figure.count == 0) {
        page.line(fmt::format("| {} | {} | none: {} | | |", one.name, published, figure.trouble));
        judged += quantity.judged;
        continue;
      }
      const bool ok = agrees(quantity, figure.mean(), expected->second);
      std::string shown = number_in(figure.mean(), quantity.unit);
      if (figure.count > 1) shown += " +- " + number_in(figure.sd(), quantity.unit);
      if (figure.failed) shown += fmt::format(" ({} of {} runs)", figure.count, figure.count + figure.failed);
      const std::string difference =
          quantity.relative ? fmt::format("{:+.1f} %", 100 * (figure.mean() / expected->second - 1))
                            : fmt::format("{:+.3g}", figure.mean() - expected->second);
      page.line(fmt::format("| {} | {} | {} | {} | {} |", one.name, published, shown, difference,
                            quantity.judged ? (ok ? "agrees" : "differs") : ""));
      tsv.line(fmt::format("{}\t{}\t{}\t{:.9g}\t{:.9g}\t{:.9g}\t{:.9g}\t{}\t{}\t{:.6g}\t{}", one.name, quantity.name,
                           study.test(quantity.test).definition.responses.at(quantity.response).unit, expected->second,
                           sd == one.expected_sd.end() ? 0.0 : sd->second, figure.mean(), figure.sd(), figure.count,
                           figure.failed, figure.mean() - expected->second, ok ? "yes" : "no"));
      good += ok && quantity.judged;
      judged += quantity.judged;
      rows.push_back(k);
      theirs.push_back(expected->second);
      ours.push_back(figure.mean());
    }
    if (quantity.judged) page.line(fmt::format("\n{} of {} agree.", good, judged));
    const PowerLaw published = power_law(study, rows, theirs), simulated = power_law(study, rows, ours);
    for (std::size_t c = 0; c < simulated.exponents.size() && c < published.exponents.size(); ++c)
      page.line(fmt::format("{}Exponent of {}: published {:.3f}, ours {:.3f}.", c ? "" : "\n", simulated.parameters[c],
                            published.exponents[c], simulated.exponents[c]));
    page.line("");
  }
}

void compare(const Options &options) {
  const Study study = read_study(options.study);
  check_response_functions(study);
  if (study.cases.empty())
    throw UserError(options.study + ": the study has no [[cases]]; see study.md, \"A published table\"");
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < study.cases.size(); ++k)
    if (options.cases.empty() ||
        std::find(options.cases.begin(), options.cases.end(), study.cases[k].name) != options.cases.end())
      chosen.push_back(k);
  for (const std::string &name : options.cases) {
    bool found = false;
    for (const PublishedCase &one : study.cases) found = found || one.name == name;
    if (!found) throw UserError("--case: there is no case '" + name + "' in " + options.study);
  }
  const int packings = options.packings > 0 ? options.packings : study.case_packings;

  struct Slot {
    std::size_t case_index;
    std::string test;
  };
  std::vector<ForwardRequest> requests;
  std::vector<Slot> slots;
  for (const std::size_t k : chosen)
    for (const std::string &test : tests_of(study, study.cases[k]))
      for (int packing = 0; packing < packings; ++packing) {
        requests.push_back({test, deck_variables(study, test, study.cases[k].values), packing});
        slots.push_back({k, test});
      }
  ForwardSettings settings;
  settings.results = results_directory(options.out, study.name);
  settings.engine = find_engine();
  settings.jobs = options.jobs > 0 ? options.jobs : study.options.jobs;
  catch_interrupts();
  EngineForwardModel model(study, settings);
  const std::vector<ForwardOutcome> outcomes = model.run(requests, [](const BatchProgress &) {});

  Figures figures(study.cases.size());
  double seconds = 0;
  int failed = 0;
  for (std::size_t r = 0; r < outcomes.size(); ++r) {
    seconds += outcomes[r].wall_seconds;
    failed += !outcomes[r].ok;
    for (const PublishedQuantity &quantity : study.quantities) {
      if (quantity.test != slots[r].test) continue;
      if (!study.cases[slots[r].case_index].expected.count(quantity.name)) continue;
      Figure &figure = figures[slots[r].case_index][quantity.name];
      try {
        if (!outcomes[r].ok) throw std::runtime_error(outcomes[r].failure.message);
        const auto &response = study.test(quantity.test).definition.responses.at(quantity.response);
        const double value = evaluate(response.function, outcomes[r].curve, {outcomes[r].deck_variables});
        figure.sum += value;
        figure.squares += value * value;
        ++figure.count;
      } catch (const std::runtime_error &error) {
        ++figure.failed;
        figure.trouble = error.what();
      }
    }
  }
  Table page, tsv;
  write_tables(study, chosen, figures, packings, page, tsv);
  const std::filesystem::path folder = settings.results;
  write_file(folder / "comparison.md", page.text());
  write_file(folder / "comparison.tsv", tsv.text());
  fmt::print("{}\n{} runs ({} failed), {:.0f} s of engine time\ntable: {}\n", page.text(), outcomes.size(), failed,
             seconds, (folder / "comparison.md").string());
  for (const std::size_t k : chosen)
    for (const auto &[name, figure] : figures[k])
      if (figure.count == 0)
        throw RunsFailed("the case '" + study.cases[k].name + "' has no figure for " + name + ": " + figure.trouble);
}

}  // namespace

void add_compare(CLI::App &app) {
  CLI::App *command = app.add_subcommand("compare", "run a published table's cases and set our figures beside it");
  const auto options = std::make_shared<Options>();
  command->add_option("study", options->study, "study file (TOML) with [[cases]]")->required();
  command->add_option("--case", options->cases, "only this case; more than once for more")->take_all();
  command->add_option("--packings", options->packings, "packings a case (default: the study's)")
      ->check(CLI::PositiveNumber);
  command->add_option("--jobs", options->jobs, "runs at a time; 0: as many as the cores take")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out, "results folder (default: bondlab-results/<study>)");
  command->callback([options] { compare(*options); });
}

}  // namespace bondlab
