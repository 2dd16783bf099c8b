/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: read the arguments of a fix one by one and say clearly what is wrong with one: name and ID
   of the fix, the value given, the values allowed.

   Every rank reads the same arguments and so stops at the same error. Units: as the caller says in
   `what`, for instance "modulus (Pa)". Failure: Error::fix_error, exit status 1. */

#ifndef BONDLAB_FIX_ARGUMENTS_H
#define BONDLAB_FIX_ARGUMENTS_H

#include <string>

#include "pointers.h"

namespace LAMMPS_NS {

class Fix;

class FixArguments : protected Pointers {
 public:
  // `first`: the first argument to read; 3 is the one after the style's name.
  FixArguments(LAMMPS *lmp, Fix *fix, int narg, char **arg, int first = 3);

  enum Range { ANY, POSITIVE, NOT_NEGATIVE };

  bool more() const { return next_ < narg_; }
  bool next_is(const char *keyword);  // and takes it if so
  std::string word(const char *what);
  double number(const char *what, Range range = ANY);
  double number_in(const char *what, double low, double high);  // low <= x < high
  int count(const char *what);                                  // an integer of at least 1
  // One of the words in `allowed` (separated by '|'): which, counted from 0.
  int choice(const char *what, const char *allowed);
  void unknown_keyword(const char *allowed);
  [[noreturn]] void fail(const std::string &text) const;

 private:
  Fix *fix_;
  int narg_;
  char **arg_;
  int next_;
};

// Ends the run on all ranks with "Fix STYLE (id ID): text". To be called by all ranks.
[[noreturn]] void stop_with_error(LAMMPS *lmp, Fix *fix, const std::string &text);

}  // namespace LAMMPS_NS

#endif
