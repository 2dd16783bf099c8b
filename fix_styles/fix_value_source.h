/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: a global number of the run named in a deck: v_NAME (equal-style variable), f_ID, f_ID[i],
   c_ID or c_ID[i], checked before a run and evaluated during it.

   Evaluating is collective: all ranks together. The caller wraps a step's evaluations in
   modify->clearstep_compute() and addstep_compute(), as the engine asks of whoever uses computes.
   Units: those of the source. Failure: an unknown or unsuitable source is an error that names the
   fix that asked, the source, and what it should be. */

#ifndef BONDLAB_FIX_VALUE_SOURCE_H
#define BONDLAB_FIX_VALUE_SOURCE_H

#include <string>

#include "pointers.h"

namespace LAMMPS_NS {

class Fix;

class FixValueSource : protected Pointers {
 public:
  // `asker`: the fix whose argument `text` is.
  FixValueSource(LAMMPS *lmp, Fix *asker, const std::string &text);

  const std::string &text() const { return text_; }
  void init(int every);  // before each run; the asker evaluates at multiples of `every` steps
  double evaluate();

 private:
  enum Kind { VARIABLE, FIX, COMPUTE };
  Fix *asker_;
  std::string text_, name_;
  Kind kind_;
  int component_;  // 0: the scalar, else the number in the vector
  int place_;      // in the engine's list, found by init
  [[noreturn]] void bad(const std::string &why) const;
};

}  // namespace LAMMPS_NS

#endif
