// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include "base/user_error.h"

namespace bondlab {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path &path, const std::string &what, int error) {
  throw UserError(Place{path.string()}, what + ": " + std::strerror(error));
}

// The process number keeps two reports at a time apart; it never shows in a finished file.
fs::path beside(const fs::path &path) {
  fs::path name = path;
  name += ".part-" + std::to_string(::getpid());
  return name;
}

void write_and_flush(const fs::path &path, const std::string &text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail(path, "can't be written", errno);
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      ::close(file);
      fail(path, "can't be written", error);
    }
    done += static_cast<std::size_t>(count);
  }
  const bool flushed = ::fsync(file) == 0;
  const int error = errno;
  if (::close(file) != 0 || !flushed) fail(path, "can't be written", flushed ? errno : error);
}

}  // namespace

void write_whole_file(const fs::path &path, const std::string &text) {
  const fs::path temporary = beside(path);
  try {
    write_and_flush(temporary, text);
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "can't be written", errno);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

StagedDirectory::StagedDirectory(const fs::path &final_path)
    : final_(final_path), staging_(beside(final_path)) {
  std::error_code error;
  fs::remove_all(staging_, error);
  fs::create_directories(staging_, error);
  if (error) throw UserError(Place{staging_.string()}, "can't be made: " + error.message());
}

StagedDirectory::~StagedDirectory() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

void StagedDirectory::publish() {
  fs::path old = final_;
  old += ".old-" + std::to_string(::getpid());
  std::error_code error;
  const bool replaces = fs::exists(final_);
  if (replaces) fs::rename(final_, old, error);
  if (!error) fs::rename(staging_, final_, error);
  if (error) {
    std::error_code ignored;
    if (replaces && !fs::exists(final_)) fs::rename(old, final_, ignored);
    throw UserError(Place{final_.string()}, "can't be replaced: " + error.message());
  }
  staging_.clear();
  fs::remove_all(old, error);  // a rest of the old pictures does no harm
}

}  // namespace bondlab
