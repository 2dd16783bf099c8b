// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: run a deck given as text with lmp_bondlab on some ranks in a folder of its own, with a time
// limit, and give back what a test wants to look at.
//
// Method: `lmp_bondlab -in in.deck -log log.bondlab` in its own process group, standard input closed,
//   output to screen.txt; after the limit the group is ended. One rank is started as bondlab does
//   it, without mpirun; several by `mpirun -np K`. Ranks wait for one another at every exchange,
//   and on two cores a run beside them makes each of these waits a time slice. So a run of several
//   ranks waits until it is the only one, runs of one rank go side by side; the limit counts from
//   the start. The folder is removed with the EngineFolder, unless the test has failed: then its
//   place is printed.
// Units: the limit in s. Failure: a run that can't be started gives exit status 127.
// Limits: runs of other test programs don't wait; ctest keeps those of whole studies apart.
#ifndef BONDLAB_TESTS_ENGINE_RUN_H
#define BONDLAB_TESTS_ENGINE_RUN_H

#include <filesystem>
#include <string>
#include <vector>

namespace engine {

// A new, empty folder, removed at the end of its life.
class EngineFolder {
 public:
  EngineFolder();
  ~EngineFolder();
  EngineFolder(const EngineFolder &) = delete;
  EngineFolder &operator=(const EngineFolder &) = delete;
  const std::filesystem::path &path() const { return path_; }
  std::string file(const std::string &name) const { return (path_ / name).string(); }
  void write(const std::string &name, const std::string &text) const;
  std::string read(const std::string &name) const;  // "" if there is no such file
  bool has(const std::string &name) const;

 private:
  std::filesystem::path path_;
};

struct EngineResult {
  int status = 0;  // exit status; 128 + signal if it was killed
  bool timed_out = false;
  std::string screen;  // standard output and error
  bool ok() const { return status == 0 && !timed_out; }
  bool says(const std::string &text) const { return screen.find(text) != std::string::npos; }
};

// `arguments` are added to the command line, for instance {"-var", "E", "1e9"}.
EngineResult run_deck(const EngineFolder &folder, const std::string &deck, int ranks = 1,
                      const std::vector<std::string> &arguments = {}, double limit = 180.0);

// A table in the format of curve.tsv and broken_bonds.tsv.
struct Table {
  std::string kind;  // first line without "# "
  std::vector<std::string> names, units;
  std::vector<std::vector<std::string>> rows;
  std::string completion;                                     // "" if there is no such line
  std::vector<double> column(const std::string &name) const;  // throws if absent
  double last(const std::string &name) const;
};
Table read_table(const std::string &path);

struct Particle {
  double x = 0, y = 0, z = 0;
  double radius = 1e-3;
  double density = 2500;
};
// The text of a data file for atom_style bonded/sphere; the box is wide, in 2D thin in z.
std::string data_file(const std::vector<Particle> &particles, int dimension, double half_width);

}  // namespace engine

#endif
