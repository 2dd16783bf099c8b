// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/user_error.h"

namespace bondlab {

void write_specimen_file(const std::filesystem::path &path, const std::string &text) {
  const std::string temporary = path.string() + ".tmp" + std::to_string(::getpid());
  const auto fail = [&](const char *what) {
    const std::string reason = std::strerror(errno);
    ::unlink(temporary.c_str());
    throw UserError("can't " + std::string(what) + " " + path.string() + ": " + reason);
  };
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail("write");
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = ::write(file, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int reason = errno;
      ::close(file);
      errno = reason;
      fail("write");
    }
    written += static_cast<std::size_t>(n);
  }
  if (::fsync(file) != 0) {
    const int reason = errno;
    ::close(file);
    errno = reason;
    fail("write");
  }
  if (::close(file) != 0) fail("write");
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail("replace");
}

}  // namespace bondlab
