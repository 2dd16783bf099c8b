/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: read the words of a `bond_coeff` command: numbers by position, keywords, and the options that
   all bond styles share. Every mistake is an error that names the command, the word and what is
   allowed; nothing is taken over before the whole command has been read.
   Units: those of the deck (SI). */

#ifndef BONDLAB_BOND_COEFFICIENTS_H
#define BONDLAB_BOND_COEFFICIENTS_H

#include <functional>
#include <string>
#include <vector>

#include "laws/strength.h"

namespace LAMMPS_NS {

// Options of one bond type, see laws/bond_options.h; the values that switch them off.
struct BondOptions {
  double tension = 1.0;          // E_t/E_c
  double fracture_energy = 0.0;  // J/m2; 0: brittle
  double damping = 0.0;          // zeta
  double contact = 1.0;          // 0: no grain contact while the bond is intact
  bool any() const { return tension != 1.0 || fracture_energy > 0.0 || damping > 0.0; }
};

class BondCoefficients {
 public:
  using Stop = std::function<void(const std::string &)>;  // must not return
  // words: all of the command after the type
  BondCoefficients(const char *style, std::vector<std::string> words, Stop stop);

  enum Range { any, positive, not_negative };
  double number(const char *name, Range);           // the next word, which must be there
  bool more() const { return next_ < words_.size(); }
  std::string keyword();                            // the next word
  std::string word(const char *name);               // the next word, which must be there
  bool flag(const char *name);                      // yes or no
  [[noreturn]] void unknown(const std::string &word, const std::string &allowed) const;
  [[noreturn]] void wrong(const std::string &text) const;

  // `scatter none|normal|weibull A [B]` after its keyword: one spread for each strength
  void scatter(std::vector<bondlab::laws::StrengthDistribution *> strengths);
  void seed(std::vector<bondlab::laws::StrengthDistribution *> strengths);

  // Takes the common options off the words; throws nothing, stops on a mistake.
  BondOptions take_options();

 private:
  std::string style_;
  std::vector<std::string> words_;
  std::size_t next_;
  Stop stop_;
};

}  // namespace LAMMPS_NS

#endif
