// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how far a batch of forward runs is, as one line that is written over.
// Method: on standard error, where that is a terminal; nothing where it is a file.
// Units: s. Failure: none.
#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "forward/forward_model.h"

namespace bondlab {

class ProgressLine {
 public:
  ~ProgressLine() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  void show(const BatchProgress &progress) {
    if (!terminal_ || progress.total == progress.from_store) return;
    std::string line =
        fmt::format("{} of {} runs done, {} running, {:.0f} s", progress.done + progress.failed,
                    progress.total, progress.running, progress.elapsed);
    if (progress.left >= 0) line += fmt::format(", about {:.0f} s left", std::ceil(progress.left));
    fmt::print(stderr, "\r\033[K{}", line);
    std::fflush(stderr);
    shown_ = true;
  }

 private:
  const bool terminal_ = isatty(STDERR_FILENO) == 1;
  bool shown_ = false;
};

}  // namespace bondlab
