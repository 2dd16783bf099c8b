// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/png.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/user_error.h"

namespace bondlab {

std::filesystem::path png_from_svg(const std::filesystem::path &svg, const std::string &program) {
  std::filesystem::path png = svg;
  png.replace_extension(".png");
  const std::string out = png.string(), in = svg.string();
  std::string words[] = {program, "--zoom", "2", "--output", out, in};
  char *arguments[7] = {};
  for (int k = 0; k < 6; ++k) arguments[k] = words[k].data();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw UserError("PNG pictures need rsvg-convert, but '" + program +
                    "' can't be started: " + std::strerror(error) +
                    (error == ENOENT ? "; on Debian: apt-get install librsvg2-bin" : ""));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw UserError(program + " made no picture of " + in + " (its message stands above)");
  return png;
}

}  // namespace bondlab
