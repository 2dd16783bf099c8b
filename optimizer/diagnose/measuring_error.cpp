// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/measuring_error.h"

#include <algorithm>
#include <map>

namespace bondlab::diagnose {

namespace {

bool meant(const MeasuringError &error, const std::string &column) {
  if (error.columns != "loads") return column == error.columns;
  return column.find("stress") != std::string::npos || column.rfind("force", 0) == 0;
}

}  // namespace

void apply_measuring_errors(const EffectDefinition &effect, double size,
                            std::vector<MeasuredRun> &runs) {
  for (const auto &error : effect.measures) {
    std::map<std::pair<std::string, std::string>, double> largest;  // by series and column
    for (const auto &run : runs)
      for (std::size_t i = 0; i < run.curve.names.size(); ++i)
        for (const double v : run.curve.columns[i]) {
          double &most = largest[{run.series, run.curve.names[i]}];
          most = std::max(most, v);
        }
    for (std::size_t r = 0; r < runs.size(); ++r) {
      auto &run = runs[r];
      if (!error.test.empty() && error.test != run.kind) continue;
      const double place =
          runs.size() > 1 ? static_cast<double>(r) / static_cast<double>(runs.size() - 1) : 0;
      for (std::size_t i = 0; i < run.curve.names.size(); ++i) {
        if (!meant(error, run.curve.names[i])) continue;
        const double end = (1 - size) * largest[{run.series, run.curve.names[i]}];
        for (double &v : run.curve.columns[i]) switch (error.rule) {
            case MeasuringRule::scale:
              v *= 1 + size;
              break;
            case MeasuringRule::saturate:
              v = std::min(v, end);
              break;
            case MeasuringRule::drift:
              v *= 1 + size * place;
              break;
          }
      }
    }
  }
}

}  // namespace bondlab::diagnose
