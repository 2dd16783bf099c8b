// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab report DIR`: make report.html and pictures/ again from result.json and the runs in
// DIR, without the study. Units: none. Failure: UserError (exit status 1) when DIR has no result,
// the result is damaged, or gnuplot is missing.
#include <iostream>
#include <memory>

#include "app/commands.h"
#include "report/report.h"
#include "report/result_json.h"

namespace bondlab {

void add_report(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "report", "Write report.html and pictures/ again from a fit's result.json");
  auto directory = std::make_shared<std::string>();
  command
      ->add_option("DIR", *directory,
                   "directory of the result: what `bondlab fit` named at its end")
      ->required();
  command->callback([directory] {
    const std::filesystem::path page = write_report(read_result(*directory), *directory);
    std::cout << "report: " << page.string() << "\n";
  });
}

}  // namespace bondlab
