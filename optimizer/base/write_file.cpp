// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/write_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/user_error.h"

namespace bondlab {

void write_file(const std::filesystem::path &file, const std::string &text) {
  const std::string temporary = file.string() + "." + std::to_string(getpid()) + ".part";
  std::FILE *stream = std::fopen(temporary.c_str(), "w");
  if (!stream)
    throw UserError({file.string(), 0, 0},
                    std::string("the file can't be written: ") + std::strerror(errno));
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  int reason = errno;
  const bool closed = std::fclose(stream) == 0;  // a full disk often shows only here
  if (written && !closed) reason = errno;
  if (written && closed && std::rename(temporary.c_str(), file.c_str()) == 0) return;
  if (written && closed) reason = errno;
  std::remove(temporary.c_str());
  throw UserError({file.string(), 0, 0},
                  std::string("the file can't be written: ") + std::strerror(reason));
}

void make_folder(const std::filesystem::path &folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw UserError({folder.string(), 0, 0}, "the folder can't be made: " + error.message());
}

}  // namespace bondlab
