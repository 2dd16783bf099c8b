// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: write a table of results row by row so that a reader can tell a finished one from a torn
// one, and go on with it after a restart.
//
// Format: tab separated text,
//     # bondlab-curve 1                  kind and version
//     # names: step	time	...
//     # units: 1	s	...
//     0	0	...                     first column: the step, never falling
//     # complete: end_of_run             only when the run ended as it should
// Numbers are the shortest that read back to the same double. Every row is flushed as a whole line,
// so a killed run loses at most an unfinished line.
// Going on: rows beyond the step of the restart, an unfinished line and the completion line are cut
// off, so that a restarted run leaves the file an uninterrupted one would have left.
//
// Units: the caller's, named in the header. Failure: std::runtime_error with the path and the
// system's reason. One process writes.
#ifndef BONDLAB_TABLE_FILE_H
#define BONDLAB_TABLE_FILE_H

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bondlab {

inline std::string number_text(double x) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, x).ptr);
}

class TableFile {
 public:
  TableFile() = default;
  TableFile(const TableFile &) = delete;
  TableFile &operator=(const TableFile &) = delete;
  ~TableFile() {
    if (file_) std::fclose(file_);
  }

  bool is_open() const { return file_ != nullptr; }
  std::int64_t last_step() const { return last_step_; }  // of the rows in the file; -1: none

  // A new file; an old one of that name is replaced.
  void create(const std::string &path, const std::string &kind,
              const std::vector<std::string> &names, const std::vector<std::string> &units) {
    path_ = path;
    last_step_ = -1;
    file_ = std::fopen(path.c_str(), "w");
    if (!file_) fail("can't be created");
    put(header(kind, names, units));
  }

  // Goes on with a file up to and including `step`; a new file if there is none.
  void go_on(const std::string &path, const std::string &kind,
             const std::vector<std::string> &names, const std::vector<std::string> &units,
             std::int64_t step) {
    path_ = path;
    std::ifstream in(path, std::ios::binary);
    if (!in) return create(path, kind, names, units);
    std::stringstream buffer;
    buffer << in.rdbuf();
    const std::string text = buffer.str(), head = header(kind, names, units);
    if (text.size() < head.size() && head.compare(0, text.size(), text) == 0)
      return create(path, kind, names, units);  // died while the header was written
    if (text.compare(0, head.size(), head) != 0)
      throw std::runtime_error(
          "file '" + path +
          "' can't be gone on with: its header is not that of this run, which is\n" + head);
    last_step_ = -1;
    std::size_t keep = head.size();
    for (std::size_t end; (end = text.find('\n', keep)) != std::string::npos; keep = end + 1) {
      const std::int64_t row_step = std::strtoll(text.c_str() + keep, nullptr, 10);
      if (text[keep] == '#' || row_step > step) break;
      last_step_ = row_step;
    }
    file_ = std::fopen(path.c_str(), "r+");
    if (!file_) fail("can't be opened for writing");
    cut(static_cast<long>(keep));
  }

  // `cells` without the step.
  void row(std::int64_t step, const std::vector<std::string> &cells) {
    std::string line = std::to_string(step);
    for (const std::string &cell : cells) line += '\t' + cell;
    put(line + '\n');
    last_step_ = step;
  }

  void complete(const std::string &reason) {
    end_of_rows_ = std::ftell(file_);
    put("# complete: " + reason + '\n');
  }

  // Takes the completion line off again, for another run that goes on.
  void resume() {
    if (end_of_rows_ >= 0) cut(end_of_rows_);
  }

 private:
  static std::string joined(const std::vector<std::string> &words) {
    std::string line;
    for (const std::string &w : words) line += (line.empty() ? "" : "\t") + w;
    return line;
  }
  static std::string header(const std::string &kind, const std::vector<std::string> &names,
                            const std::vector<std::string> &units) {
    return "# " + kind + "\n# names: " + joined(names) + "\n# units: " + joined(units) + '\n';
  }
  void put(const std::string &text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
      fail("can't be written");
  }
  void cut(long length) {
    if (std::fflush(file_) != 0 || ftruncate(fileno(file_), length) != 0 ||
        std::fseek(file_, length, SEEK_SET) != 0)
      fail("can't be shortened");
    end_of_rows_ = -1;
  }
  [[noreturn]] void fail(const char *what) const {
    throw std::runtime_error("file '" + path_ + "' " + what + ": " + std::strerror(errno));
  }

  std::FILE *file_ = nullptr;
  std::string path_;
  std::int64_t last_step_ = -1;
  long end_of_rows_ = -1;  // where the completion line begins; -1: there is none
};

}  // namespace bondlab

#endif
