// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: SHA-256 of text and files, for keys under which results are kept for good.
// Method: FIPS 180-4. Why not a shorter hash: a collision would silently give one run's result for
// another's. Units: none. Failure: UserError when a file can't be read. Limits: about 300 MB/s; the
// engine binary is hashed once a command.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace bondlab {

class Sha256 {
 public:
  void add(std::string_view bytes);
  // Adds a field with its length before it, so that ("ab", "c") and ("a", "bc") differ.
  void add_field(std::string_view name, std::string_view value);
  std::string hex();  // 64 digits; ends the hash

 private:
  void block(const unsigned char *bytes);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> buffer_{};
  std::uint64_t length_ = 0;
};

std::string sha256(std::string_view text);
std::string sha256_file(const std::filesystem::path &file);

}  // namespace bondlab
