// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a published table with our figures beside it, as a page (Markdown) and as TSV.
// Method: mean and standard deviation over packings. A judged figure agrees when the means differ by
// no more than the tolerance. Exponents of power laws by least squares of logarithms, the same for
// the published figures and for ours: over every parameter that varies, or, for a quantity with
// published exponents, over those parameters and specimen sizes alone, with one constant a group of
// cases. Where nothing was published our figures stand alone.
// Units: the page has the units of the quantities, the TSV SI. Failure: none; a case without a run
// that worked says so in its row. Limits: a power law needs two more cases than it has constants,
// and positive figures.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "study/study.h"

namespace bondlab {

// One quantity of one case over its packings.
struct PublishedFigure {
  int count = 0, failed = 0;  // runs with and without the figure
  int failed_runs = 0;        // of the latter, those that broke off
  double sum = 0, squares = 0;
  std::string trouble;  // why a run gave no figure
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double sd() const {
    if (count < 2) return 0;
    const double variance = (squares - sum * sum / count) / (count - 1);
    return variance > 0 ? std::sqrt(variance) : 0;
  }
};

// [case][quantity]
using PublishedFigures = std::vector<std::map<std::string, PublishedFigure>>;

struct PublishedTables {
  std::string page, tsv;
};

// `chosen`: indices of study.cases. Quantities a case has no figure of are left out.
PublishedTables published_tables(const Study &study, const std::vector<std::size_t> &chosen,
                                 const PublishedFigures &figures);

}  // namespace bondlab
