// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the names of the frames a deck writes on its way with `shots`: particles_STEP.txt and
//   bonds_STEP.txt.
// Method: the step when the name is one, else nothing; particles_end.txt is none. Why here: the
//   run's folder keeps them after success and the pictures read them, and both must mean the same.
// Units: none. Failure: none.
#pragma once

#include <charconv>
#include <optional>
#include <string>

namespace bondlab {

inline std::optional<long> frame_step(const std::string &file_name, const std::string &what) {
  const std::string before = what + "_", after = ".txt";
  if (file_name.size() <= before.size() + after.size() || file_name.rfind(before, 0) != 0 ||
      file_name.compare(file_name.size() - after.size(), after.size(), after) != 0)
    return std::nullopt;
  const char *first = file_name.data() + before.size(),
             *last = file_name.data() + file_name.size() - after.size();
  long step = 0;
  const auto result = std::from_chars(first, last, step);
  if (result.ec != std::errc() || result.ptr != last || step < 0) return std::nullopt;
  return step;
}

// Whether the file is a frame of either kind.
inline bool is_frame(const std::string &file_name) {
  return frame_step(file_name, "particles") || frame_step(file_name, "bonds");
}

}  // namespace bondlab
