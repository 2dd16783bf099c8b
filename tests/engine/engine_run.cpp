// SPDX-License-Identifier: GPL-2.0-or-later
// Job: starting the engine from tests. See engine_run.h.
#include "engine_run.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace engine {

namespace fs = std::filesystem;

EngineFolder::EngineFolder() {
  std::string pattern = (fs::temp_directory_path() / "bondlab-test-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder: " + pattern);
  path_ = pattern;
}

EngineFolder::~EngineFolder() {
  if (testing::Test::HasFailure()) {
    std::fprintf(stderr, "the run is left in %s\n", path_.c_str());
    return;
  }
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void EngineFolder::write(const std::string &name, const std::string &text) const {
  std::ofstream(path_ / name) << text;
}

std::string EngineFolder::read(const std::string &name) const {
  std::ifstream in(path_ / name);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

bool EngineFolder::has(const std::string &name) const { return fs::exists(path_ / name); }

namespace {

// Held during a run: alone by one of several ranks, shared by those of one. The lock is on the
// program itself and goes with the process, however that ends.
class Turn {
 public:
  explicit Turn(bool alone) : file_(open(BONDLAB_LMP, O_RDONLY | O_CLOEXEC)) {
    while (flock(file_, alone ? LOCK_EX : LOCK_SH) != 0 && errno == EINTR) {
    }
  }
  ~Turn() { close(file_); }
  Turn(const Turn &) = delete;
  Turn &operator=(const Turn &) = delete;

 private:
  int file_;
};

[[noreturn]] void start(const EngineFolder &folder, const std::vector<std::string> &command,
                        bool by_mpirun) {
  setpgid(0, 0);
  if (chdir(folder.path().c_str()) != 0) _exit(127);
  const int in = open("/dev/null", O_RDONLY);
  const int out = open("screen.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (in < 0 || out < 0) _exit(127);
  dup2(in, 0);
  dup2(out, 1);
  dup2(out, 2);
  if (geteuid() == 0) {  // OpenMPI refuses to run as root otherwise
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  }
  setenv("OMP_NUM_THREADS", "1", 1);
  if (!by_mpirun) {  // the same four words as in optimizer/forward/run_folder.cpp, and why
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
    setenv("OMPI_MCA_orte_tmpdir_base", folder.path().c_str(), 1);
    setenv("OMPI_MCA_pml", "ob1", 1);
    setenv("OMPI_MCA_btl", "self", 1);
  }
  std::vector<char *> argv;
  for (const std::string &word : command) argv.push_back(const_cast<char *>(word.c_str()));
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  _exit(127);
}

// Exit status as a shell gives it; ends the group at the limit, first politely, so that mpirun can
// take its ranks with it.
int wait_for(pid_t child, double limit, bool &timed_out) {
  using clock = std::chrono::steady_clock;
  const auto begin = clock::now();
  bool asked = false;
  for (;;) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child)
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const double waited = std::chrono::duration<double>(clock::now() - begin).count();
    if (waited > limit && !asked) {
      timed_out = asked = true;
      kill(-child, SIGTERM);
    }
    if (waited > limit + 5.0) kill(-child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

EngineResult run_deck(const EngineFolder &folder, const std::string &deck, int ranks,
                      const std::vector<std::string> &arguments, double limit) {
  folder.write("in.deck", deck);
  const bool by_mpirun = ranks != 1;
  std::vector<std::string> command;
  if (by_mpirun)
    command = {BONDLAB_MPIRUN,    "-np",       std::to_string(ranks),
               "--oversubscribe", "--bind-to", "none"};
  for (const char *word : {BONDLAB_LMP, "-in", "in.deck", "-log", "log.bondlab"})
    command.push_back(word);
  command.insert(command.end(), arguments.begin(), arguments.end());
  EngineResult result;
  const Turn turn(by_mpirun);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) start(folder, command, by_mpirun);
  setpgid(child, child);  // also here: whichever of the two comes first
  result.status = wait_for(child, limit, result.timed_out);
  result.screen = folder.read("screen.txt");
  return result;
}

namespace {
std::vector<std::string> split(const std::string &line) {
  std::vector<std::string> words;
  std::stringstream in(line);
  for (std::string word; std::getline(in, word, '\t');) words.push_back(word);
  return words;
}
}  // namespace

Table read_table(const std::string &path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("no table " + path);
  Table t;
  const auto after = [](const std::string &line, const std::string &start, std::string &rest) {
    if (line.compare(0, start.size(), start) != 0) return false;
    rest = line.substr(start.size());
    return true;
  };
  std::string line, rest;
  for (int number = 0; std::getline(in, line); ++number) {
    if (number == 0 && after(line, "# ", rest))
      t.kind = rest;
    else if (after(line, "# names: ", rest))
      t.names = split(rest);
    else if (after(line, "# units: ", rest))
      t.units = split(rest);
    else if (after(line, "# complete: ", rest))
      t.completion = rest;
    else
      t.rows.push_back(split(line));
  }
  return t;
}

std::vector<double> Table::column(const std::string &name) const {
  for (std::size_t c = 0; c < names.size(); ++c)
    if (names[c] == name) {
      std::vector<double> values;
      for (const auto &row : rows) values.push_back(std::strtod(row.at(c).c_str(), nullptr));
      return values;
    }
  throw std::runtime_error("no column " + name);
}

double Table::last(const std::string &name) const {
  const std::vector<double> values = column(name);
  if (values.empty()) throw std::runtime_error("no rows");
  return values.back();
}

std::string data_file(const std::vector<Particle> &particles, int dimension, double half_width) {
  std::ostringstream out;
  out.precision(17);
  double thin = 0.0;
  for (const Particle &p : particles) thin = std::max(thin, p.radius);
  const double dz = dimension == 2 ? thin : half_width;
  out << "particles of a test\n\n" << particles.size() << " atoms\n1 atom types\n1 bond types\n\n";
  out << -half_width << ' ' << half_width << " xlo xhi\n";
  out << -half_width << ' ' << half_width << " ylo yhi\n";
  out << -dz << ' ' << dz << " zlo zhi\n\nAtoms\n\n";
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle &p = particles[i];
    out << i + 1 << " 1 " << 2 * p.radius << ' ' << p.density << ' ' << p.x << ' ' << p.y << ' '
        << p.z << '\n';
  }
  return out.str();
}

}  // namespace engine
