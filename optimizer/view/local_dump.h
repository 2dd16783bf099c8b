// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: read what `dump local` wrote of the bonds (compute bonded/local): a row a bond, columns by
//   name.
// Method: the engine heads such columns c_ID[1], c_ID[2] ...; what they hold is in the `compute`
//   line of the run's log, which is read for it. Columns that are already headed by words are taken
//   as they are. Of a file with several frames the last is read.
// Units: SI, as compute bonded/local gives them.
// Failure: UserError with file:line for text that isn't such a dump, and when a column's meaning
//   can't be found.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bondlab {

struct LocalDump {
  long step = 0;
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
  // Column of a name, -1 when absent.
  int column(const std::string &name) const;
};

// log: text of the run's log ("" when there is none); words: the names of the columns where neither
// the file nor the log tells them.
LocalDump read_local_dump(const std::filesystem::path &file, const std::string &log,
                          const std::vector<std::string> &words = {});

}  // namespace bondlab
