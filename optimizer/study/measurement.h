// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: measured curves as data: replicates of one test, their mean curve and the scatter between
// them. Method: a data folder holds manifest.toml and one CSV or TSV file a replicate
// (data_folder.md). Replicates are
//   interpolated linearly onto a common grid over the range that all of them cover; mean and sample
//   standard deviation are taken point by point. With one replicate the sd is absent (NaN is never
//   stored).
// Units: SI after reading. Failure: UserErrors with file:line:column.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/user_error.h"

namespace bondlab {

struct MeasuredCurve {
  std::string file;                                                  // as named in the manifest
  std::string replicate;                                             // label of the specimen
  std::vector<std::string> names;                                    // columns
  std::vector<std::string> units;                                    // as written in the file
  std::vector<std::vector<double>> columns;                          // SI
  const std::vector<double> &column(const std::string &name) const;  // UserError when absent
};

struct Envelope {
  std::vector<double> x, mean;
  std::vector<double> sd;  // empty with one replicate
};

struct Measurement {
  std::string name;  // of the series in the manifest
  std::string test;  // name of the study's test it belongs to; may be empty
  std::string x, y;  // columns that make the curve
  std::string source;
  std::map<std::string, double> conditions;  // SI; temperature, rate ...
  std::vector<MeasuredCurve> replicates;
  Envelope envelope;
  Place place;
};

struct DataFolder {
  std::filesystem::path folder;
  std::string title, source, licence;
  std::vector<Measurement> measurements;
};

DataFolder read_data_folder(const std::filesystem::path &folder);

// Mean and scatter of y(x) over the replicates on `points` equidistant x in the range that all
// cover.
Envelope make_envelope(const std::vector<MeasuredCurve> &replicates, const std::string &x,
                       const std::string &y, int points = 200);

}  // namespace bondlab
