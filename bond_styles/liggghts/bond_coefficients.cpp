// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see bond_coefficients.h.
#include "bond_coefficients.h"

#include <cmath>
#include <cstdlib>

#include "read_number.h"

using namespace LAMMPS_NS;
using namespace bondlab::laws;

BondCoefficients::BondCoefficients(const char *style, std::vector<std::string> words, Stop stop)
    : style_(style), words_(std::move(words)), next_(0), stop_(std::move(stop)) {}

void BondCoefficients::wrong(const std::string &text) const {
  stop_("bond_coeff for bond_style " + style_ + ": " + text);
  abort();
}

void BondCoefficients::unknown(const std::string &word, const std::string &allowed) const {
  wrong("unknown keyword '" + word + "', allowed are " + allowed +
        " and, for all bond styles, softening, tension_modulus, damping, contact");
}

std::string BondCoefficients::keyword() { return words_[next_++]; }

std::string BondCoefficients::word(const char *name) {
  if (!more()) wrong(std::string("'") + name + "' has no value");
  return words_[next_++];
}

double BondCoefficients::number(const char *name, Range range) {
  const std::string given = word(name);
  const double v = bondlab::read_number(given.c_str());
  const bool good = std::isfinite(v) && (range == any || v > 0.0 || (range == not_negative && v == 0.0));
  if (!good)
    wrong(std::string(name) + " is " + given + ", it must be " +
          (range == positive ? "positive" : (range == any ? "a number" : "0 or positive")));
  return v;
}

bool BondCoefficients::flag(const char *name) {
  const std::string given = word(name);
  if (given != "yes" && given != "no") wrong(std::string(name) + " is " + given + ", it must be yes or no");
  return given == "yes";
}

void BondCoefficients::scatter(std::vector<StrengthDistribution *> strengths) {
  const std::string kind = word("scatter");
  if (kind != "none" && kind != "normal" && kind != "weibull")
    wrong("scatter is '" + kind +
          "', allowed are none, normal (standard deviations over means) and weibull (moduli)");
  for (StrengthDistribution *s : strengths) {
    s->spread = number("a spread after `scatter` (one for each strength)",
                       kind == "weibull" ? positive : not_negative);
    if (kind == "normal") s->spread *= s->mean;
    s->scatter = kind == "weibull" ? Scatter::weibull : (kind == "normal" ? Scatter::normal : Scatter::none);
  }
}

void BondCoefficients::seed(std::vector<StrengthDistribution *> strengths) {
  const double value = number("seed", not_negative);
  if (value != std::floor(value)) wrong("seed is " + words_[next_ - 1] + ", it must be a whole number");
  for (StrengthDistribution *s : strengths) s->seed = static_cast<std::uint64_t>(value);
}

BondOptions BondCoefficients::take_options() {
  BondOptions options;
  std::vector<std::string> rest;
  const std::vector<std::string> all = words_;
  for (std::size_t k = 0; k < all.size();) {
    const std::string &word = all[k];
    const bool known = word == "softening" || word == "tension_modulus" || word == "damping" || word == "contact";
    if (!known) {
      rest.push_back(word);
      k++;
      continue;
    }
    next_ = k + 1;
    if (word == "softening") options.fracture_energy = number("softening (fracture energy, J/m2)", not_negative);
    if (word == "tension_modulus") options.tension = number("tension_modulus (E_t/E_c)", positive);
    if (word == "damping") options.damping = number("damping (share of the critical)", not_negative);
    if (word == "contact") options.contact = flag("contact") ? 1.0 : 0.0;
    k = next_;
  }
  words_ = rest;
  next_ = 0;
  return options;
}
