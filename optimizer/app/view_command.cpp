// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: `bondlab view RUN`: pictures and ParaView files of a finished run, one of the store's or one
//   of a deck run by hand.
// Units: lengths with a unit ("0.08 mm") or plain in m.
// Failure: UserError (exit status 1) when RUN isn't the folder of a run or a file in it is damaged.
#include <fmt/core.h>

#include <memory>
#include <sstream>

#include "app/commands.h"
#include "base/units.h"
#include "base/user_error.h"
#include "view/view.h"

namespace bondlab {

namespace {

struct Options {
  std::string run, out, gap, plane, bonds, columns, state;
  bool png = false, no_paraview = false;
};

double gap_of(const std::string &text) {
  if (text.empty()) return 0;
  try {
    const Quantity parts = split_quantity(text);
    const double gap = parts.unit.empty() ? parts.number : parse_quantity(text, "m");
    if (gap > 0) return gap;
  } catch (const UserError &error) {
    throw UserError("--gap: " + error.text());
  }
  throw UserError("--gap is " + text + " (allowed: above 0 m)");
}

void show(const Options &options) {
  const std::filesystem::path run = options.run;
  ViewOptions read;
  read.gap = gap_of(options.gap);
  read.bond_file = options.bonds;
  std::istringstream words(options.columns);
  for (std::string word; words >> word;) read.columns.push_back(word);
  ViewOutput output;
  output.plane = options.plane;
  output.state = options.state;
  if (!options.state.empty() && !options.bonds.empty())
    throw UserError("--bonds: the forces of a --state are those of its own bonds_STEP.txt; leave one of them out");
  output.bond_columns = read.columns;
  output.png = options.png;
  output.paraview = !options.no_paraview;
  const std::filesystem::path out =
      !options.out.empty()     ? std::filesystem::path(options.out)
      : options.state.empty() ? run / "view"
                              : run / ("view_" + options.state);
  const ViewWritten written = write_view(read_run(run, read), out, output);
  for (const std::filesystem::path &file : written.files) fmt::print("{}\n", file.string());
  for (const std::string &sentence : written.missing) fmt::print("{}\n", sentence);
}

}  // namespace

void add_view(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "view", "Pictures and ParaView files of a run: cracks, forces, displacement, fragments");
  const auto options = std::make_shared<Options>();
  command
      ->add_option("RUN", options->run,
                   "folder of a run: OUT/runs/NUMBER-TEST-KEY, or where a deck was run by hand")
      ->required();
  command->add_option("--out", options->out, "folder to write into (default: RUN/view, RUN/view_STATE)");
  command->add_option("--state", options->state,
                      "the pictures show this state instead of the end: a step of the frames on the way, or "
                      "first, last, peak (the frame nearest to the largest load)");
  command->add_option("--gap", options->gap,
                      "bond gap (default: that of bond_install in the run's log)");
  command->add_option("--plane", options->plane,
                      "plane of 3D slices, horizontal and vertical axis, such as xz or zy");
  command->add_option("--bonds", options->bonds,
                      "dump of the bonds to draw forces from (default: the newest bonds_*.txt)");
  command->add_option("--bond-columns", options->columns,
                      "what its columns hold, such as \"id1 id2 fn fs\" (default: from the log)");
  command->add_flag("--png", options->png, "PNG pictures too (needs rsvg-convert)");
  command->add_flag("--no-paraview", options->no_paraview, "no .vtp files");
  command->callback([options] { show(*options); });
}

}  // namespace bondlab
