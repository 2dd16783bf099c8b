// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bondlab {
namespace {

constexpr const char *none = "\u2013";
constexpr const char *minus = "\u2212";
constexpr const char *narrow_space = "\u202f";

std::string with_true_minus(std::string text) {
  if (!text.empty() && text.front() == '-') {
    // "-0.00" is zero to a reader
    const bool zero = text.find_first_of("123456789") == std::string::npos;
    text = (zero ? "" : minus) + text.substr(1);
  }
  return text;
}

void strip_zeros(std::string &text) {
  if (text.find('.') == std::string::npos) return;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
}

std::string rounded_text(double value, int digits, bool strip) {
  if (!std::isfinite(value)) return none;
  if (value == 0) return "0";
  const double size = std::fabs(value);
  if (size >= 1e-4 && size < 1e7) {
    // Two steps, because rounding can carry into the next power of ten (9.9996 -> 10).
    const double rounded = std::stod(fmt::format("{:.{}e}", value, digits - 1));
    const int power = static_cast<int>(std::floor(std::log10(std::fabs(rounded)) + 1e-12));
    std::string text = fmt::format("{:.{}f}", rounded, std::max(0, digits - 1 - power));
    if (strip) strip_zeros(text);
    return with_true_minus(text);
  }
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = text.find('e');
  std::string mantissa = text.substr(0, e);
  if (strip) strip_zeros(mantissa);
  return with_true_minus(mantissa) + "e" +
         with_true_minus(fmt::format("{}", std::stoi(text.substr(e + 1))));
}

}  // namespace

std::string significant(double value, int digits) { return rounded_text(value, digits, true); }
std::string significant_full(double value, int digits) {
  return rounded_text(value, digits, false);
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return none;
  return with_true_minus(fmt::format("{:.{}f}", value, decimals));
}

std::string plus_minus(double value, double sd) {
  if (!std::isfinite(value)) return none;
  if (!std::isfinite(sd) || sd <= 0) return significant(value);
  const int power = static_cast<int>(std::floor(std::log10(sd)));
  const int decimals = std::clamp(1 - power, 0, 8);
  return fixed(value, decimals) + " ± " + fixed(sd, decimals);
}

std::string signed_percent(double share) {
  if (!std::isfinite(share)) return none;
  const double percent = 100 * share;
  const std::string text = fixed(percent, std::fabs(percent) < 9.95 ? 1 : 0);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return (percent > 0 && !zero ? "+" : "") + text + "\u00a0%";
}

std::string count_text(long count) {
  std::string digits = fmt::format("{}", std::labs(count));
  if (digits.size() > 4)
    for (std::size_t i = digits.size() - 3; i < digits.size() && i > 0; i = i >= 3 ? i - 3 : 0)
      digits.insert(i, narrow_space);
  return (count < 0 ? minus : "") + digits;
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return none;
  if (seconds < 9.95) return fmt::format("{:.1f}\u00a0s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 120) return fmt::format("{}\u00a0s", whole);
  if (whole < 7200) return fmt::format("{}\u00a0min {:02}\u00a0s", whole / 60, whole % 60);
  return fmt::format("{}\u00a0h {:02}\u00a0min", whole / 3600, whole % 3600 / 60);
}

std::string counted(long count, const std::string &one, const std::string &many) {
  return count_text(count) + "\u00a0" + (count == 1 ? one : many);
}

std::string list_text(const std::vector<std::string> &words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace bondlab
