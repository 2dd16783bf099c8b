// SPDX-License-Identifier: GPL-2.0-or-later
// Job: reading the arguments of a fix. See fix_arguments.h.
#include "fix_arguments.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "error.h"
#include "fix.h"

namespace LAMMPS_NS {

namespace {
// error->all is known to Pointers' children only.
class Stopper : protected Pointers {
 public:
  explicit Stopper(LAMMPS *lmp) : Pointers(lmp) {}
  [[noreturn]] void stop(Fix *fix, const std::string &text) {
    error->fix_error(FLERR, fix, text.c_str());
    std::abort();  // not reached: fix_error ends the process
  }
};
}  // namespace

void stop_with_error(LAMMPS *lmp, Fix *fix, const std::string &text) {
  Stopper(lmp).stop(fix, text);
}

FixArguments::FixArguments(LAMMPS *lmp, Fix *fix, int narg, char **arg, int first)
    : Pointers(lmp), fix_(fix), narg_(narg), arg_(arg), next_(first) {}

void FixArguments::fail(const std::string &text) const { stop_with_error(lmp, fix_, text); }

bool FixArguments::next_is(const char *keyword) {
  if (!more() || std::strcmp(arg_[next_], keyword) != 0) return false;
  ++next_;
  return true;
}

std::string FixArguments::word(const char *what) {
  if (!more()) fail(std::string(what) + " is missing at the end of the command");
  return arg_[next_++];
}

double FixArguments::number(const char *what, Range range) {
  const std::string text = word(what);
  char *end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0' && std::isfinite(x);
  const char *allowed = range == POSITIVE       ? "a number > 0"
                        : range == NOT_NEGATIVE ? "a number >= 0"
                                                : "a number";
  if (!is_number || (range == POSITIVE && !(x > 0.0)) || (range == NOT_NEGATIVE && x < 0.0))
    fail(std::string(what) + " is '" + text + "', it must be " + allowed);
  return x;
}

double FixArguments::number_in(const char *what, double low, double high) {
  const std::string text = more() ? arg_[next_] : "";
  const double x = number(what);
  if (x < low || x >= high) {
    char range[100];
    std::snprintf(range, sizeof range, "%g <= x < %g", low, high);
    fail(std::string(what) + " is '" + text + "', it must be in " + range);
  }
  return x;
}

int FixArguments::count(const char *what) {
  const std::string text = word(what);
  char *end = nullptr;
  const long n = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || n < 1 || n > MAXSMALLINT)
    fail(std::string(what) + " is '" + text + "', it must be an integer >= 1");
  return static_cast<int>(n);
}

int FixArguments::choice(const char *what, const char *allowed) {
  const std::string text = word(what);
  const std::string all = allowed;
  std::size_t begin = 0;
  for (int k = 0; begin <= all.size(); ++k) {
    std::size_t end = all.find('|', begin);
    if (end == std::string::npos) end = all.size();
    if (all.substr(begin, end - begin) == text) return k;
    begin = end + 1;
  }
  fail(std::string(what) + " is '" + text + "', allowed are " + all);
}

void FixArguments::unknown_keyword(const char *allowed) {
  fail("unknown keyword '" + word("keyword") + "', allowed are " + allowed);
}

}  // namespace LAMMPS_NS
