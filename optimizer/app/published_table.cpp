// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/published_table.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "base/units.h"

namespace bondlab {

namespace {

bool agrees(const PublishedQuantity &quantity, double ours, double published) {
  const double allowed = quantity.relative ? quantity.tolerance * std::abs(published) : quantity.tolerance;
  return std::abs(ours - published) <= allowed;
}

std::string tolerance_text(const PublishedQuantity &quantity) {
  return quantity.relative ? fmt::format("{:g} %", 100 * quantity.tolerance)
                           : format_quantity(quantity.tolerance, quantity.unit);
}

std::string number_in(double si, const std::string &unit) {
  const std::string text = format_quantity(si, unit);
  return text.substr(0, text.find(' '));
}

// What a power law may be over: a parameter's value, or a size that cases give their specimens.
double variable_of(const Study &study, const PublishedCase &one, const std::string &name) {
  for (std::size_t p = 0; p < study.parameters.size(); ++p)
    if (study.parameters[p].name == name) return one.values[p];
  const auto size = one.sizes.find(name);
  return size == one.sizes.end() ? 0 : size->second;
}

std::vector<std::string> variables_of(const Study &study, const PublishedQuantity &quantity,
                                      const std::vector<std::size_t> &rows) {
  std::vector<std::string> candidates, names;
  for (const auto &[name, exponent] : quantity.exponents) candidates.push_back(name);
  if (candidates.empty())
    for (const Parameter &parameter : study.parameters) candidates.push_back(parameter.name);
  for (const std::string &name : candidates) {
    std::set<double> different;
    for (const std::size_t row : rows) different.insert(variable_of(study, study.cases[row], name));
    if (different.size() > 1 && *different.begin() > 0) names.push_back(name);
  }
  return names;
}

// Exponents a_i of quantity = c_group prod p_i^a_i; empty when they can't be had.
std::vector<double> power_law(const Study &study, const PublishedQuantity &quantity,
                              const std::vector<std::size_t> &rows, const std::vector<double> &values) {
  const std::vector<std::string> names = variables_of(study, quantity, rows);
  std::vector<std::string> groups = {""};
  if (!quantity.exponents.empty()) {
    groups.clear();
    for (const std::size_t row : rows)
      if (std::find(groups.begin(), groups.end(), study.cases[row].group) == groups.end())
        groups.push_back(study.cases[row].group);
  }
  const std::size_t constants = groups.size() + names.size();
  if (names.empty() || rows.size() <= constants) return {};
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows.size(), constants);
  Eigen::VectorXd b(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!(values[r] > 0)) return {};
    const PublishedCase &one = study.cases[rows[r]];
    for (std::size_t g = 0; g < groups.size(); ++g)
      A(r, g) = groups.size() == 1 || groups[g] == one.group;
    for (std::size_t c = 0; c < names.size(); ++c)
      A(r, groups.size() + c) = std::log(variable_of(study, one, names[c]));
    b(r) = std::log(values[r]);
  }
  const Eigen::VectorXd x = A.colPivHouseholderQr().solve(b);
  return {x.data() + groups.size(), x.data() + constants};
}

class Column {
 public:
  Column(const Study &study, const PublishedQuantity &quantity, const PublishedFigures &figures)
      : study_(study), quantity_(quantity), figures_(figures) {}

  void add(std::size_t k, PublishedTables &tables);
  void finish(PublishedTables &tables) const;

 private:
  std::string relative(std::size_t k) const;

  const Study &study_;
  const PublishedQuantity &quantity_;
  const PublishedFigures &figures_;
  int good_ = 0, judged_ = 0;
  std::vector<std::size_t> rows_, published_rows_;
  std::vector<double> ours_, published_;
};

// Over the first case of the same group that has a figure.
std::string Column::relative(std::size_t k) const {
  if (!study_.relative_cases) return "";
  for (std::size_t first = 0; first <= k; ++first) {
    if (study_.cases[first].group != study_.cases[k].group) continue;
    const auto found = figures_[first].find(quantity_.name);
    if (found == figures_[first].end() || found->second.count == 0) continue;
    return fmt::format(" {:.3f} |", figures_[k].at(quantity_.name).mean() / found->second.mean());
  }
  return " |";
}

void Column::add(std::size_t k, PublishedTables &tables) {
  const PublishedCase &one = study_.cases[k];
  const auto found = figures_[k].find(quantity_.name);
  if (found == figures_[k].end()) return;
  const PublishedFigure &figure = found->second;
  const auto expected = one.expected.find(quantity_.name);
  const auto sd = one.expected_sd.find(quantity_.name);
  const bool known = expected != one.expected.end(), judged = known && quantity_.judged;
  const std::string &unit = quantity_.unit;
  std::string published = known ? number_in(expected->second, unit) : "";
  if (sd != one.expected_sd.end()) published += " +- " + number_in(sd->second, unit);
  judged_ += judged;
  if (figure.count == 0) {
    tables.page += fmt::format("| {} | {} | none: {} | | |{}\n", one.name, published, figure.trouble,
                               study_.relative_cases ? " |" : "");
    return;
  }
  const double ours = figure.mean();
  const bool ok = known && agrees(quantity_, ours, expected->second);
  std::string shown = number_in(ours, unit), difference;
  if (figure.count > 1) shown += " +- " + number_in(figure.sd(), unit);
  shown += figure.failed ? fmt::format(" ({} of {} runs)", figure.count, figure.count + figure.failed)
                         : fmt::format(" ({})", figure.count);
  if (known)
    difference = quantity_.relative ? fmt::format("{:+.1f} %", 100 * (ours / expected->second - 1))
                                    : fmt::format("{:+.3g}", ours - expected->second);
  tables.page += fmt::format("| {} | {} | {} | {} | {} |{}\n", one.name, published, shown, difference,
                             judged ? (ok ? "agrees" : "differs") : "", relative(k));
  const auto optional = [](bool there, double value) { return there ? fmt::format("{:.9g}", value) : "nan"; };
  tables.tsv += fmt::format(
      "{}\t{}\t{}\t{}\t{:.9g}\t{:.9g}\t{:.9g}\t{}\t{}\t{}\t{}\n", one.name, quantity_.name,
      unit_of(study_, quantity_),
      optional(known, known ? expected->second : 0), sd == one.expected_sd.end() ? 0.0 : sd->second, ours,
      figure.sd(), figure.count, figure.failed, optional(known, known ? ours - expected->second : 0),
      !known ? "unknown" : ok ? "yes" : "no");
  good_ += ok && judged;
  rows_.push_back(k);
  ours_.push_back(ours);
  if (known) {
    published_rows_.push_back(k);
    published_.push_back(expected->second);
  }
}

void Column::finish(PublishedTables &tables) const {
  if (judged_ > 0) tables.page += fmt::format("\n{} of {} agree.\n", good_, judged_);
  const std::vector<std::string> names = variables_of(study_, quantity_, rows_);
  const std::vector<double> ours = power_law(study_, quantity_, rows_, ours_);
  std::vector<double> published;
  if (published_rows_ == rows_) published = power_law(study_, quantity_, published_rows_, published_);
  if (!ours.empty()) tables.page += "\n";
  for (std::size_t c = 0; c < ours.size(); ++c) {
    const auto given = quantity_.exponents.find(names[c]);
    std::string theirs;
    if (c < published.size()) theirs = fmt::format("published {:.3f}, ", published[c]);
    else if (given != quantity_.exponents.end()) theirs = fmt::format("published {:.3f}, ", given->second);
    tables.page += fmt::format("Exponent of {}: {}ours {:.3f}.\n", names[c], theirs, ours[c]);
  }
  tables.page += "\n";
}

}  // namespace

PublishedTables published_tables(const Study &study, const std::vector<std::size_t> &chosen,
                                 const PublishedFigures &figures) {
  PublishedTables tables;
  tables.page = fmt::format("# {}\n\nOurs: mean +- standard deviation over packings (their number).\n\n",
                            study.title.empty() ? study.name : study.title);
  tables.tsv = "case\tquantity\tunit\tpublished\tpublished_sd\tours\tours_sd\truns\tfailed\tdifference\tagrees\n";
  for (const PublishedQuantity &quantity : study.quantities) {
    tables.page += fmt::format("## {} ({}{})\n\n", quantity.name, quantity.unit == "1" ? "" : quantity.unit + ", ",
                               quantity.judged ? "goal: within " + tolerance_text(quantity) : "reported, not judged");
    tables.page += study.relative_cases ? "| case | published | ours | difference | | to the first |\n|---|---|---|---|---|---|\n"
                                        : "| case | published | ours | difference | |\n|---|---|---|---|---|\n";
    Column column(study, quantity, figures);
    for (const std::size_t k : chosen) column.add(k, tables);
    column.finish(tables);
  }
  return tables;
}

}  // namespace bondlab
