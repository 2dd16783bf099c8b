// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what a deck with bonds at a temperature must do, for the tests of every deck that has the
// variables `temperature`, `reference`, `strength_slope`, `modulus_slope`, `activation`.
//
// Method: the deck at a temperature against the same deck with the strength, modulus or creep rate
// of that temperature given by hand. Units: SI, K. Failure: expectations of the test that calls.
#ifndef BONDLAB_TESTS_WARM_BONDS_H
#define BONDLAB_TESTS_WARM_BONDS_H

#include "deck_tools.h"

namespace engine::decks {

// `largest_load` of a run with these values; `test` brings it to its strength, `elastic` doesn't.
inline void expect_bonds_of_their_temperature(double (*largest_load)(const Values &),
                                              const Values &test, const Values &elastic) {
  // 20 K above the reference at -1 % a kelvin: 0.8 times. Creep of next to nothing makes all of one
  // bond style.
  const Values warm{{"temperature", "320"}, {"reference", "300"}, {"creep_rate", "1e-90"}};
  const Values cold{{"creep_rate", "1e-90"}};
  EXPECT_NEAR(largest_load(test + warm + Values{{"strength_slope", "-0.01"}}) /
                  largest_load(test + cold + Values{{"sigma_c", "28e6"}, {"tau_c", "72e6"}}),
              1.0, 1e-9);
  const double soft = largest_load(elastic + cold + Values{{"E_b", "20e9"}}),
               hard = largest_load(elastic + cold);
  EXPECT_GT(hard, 1.05 * soft);
  // its time step is that of the harder bonds, so that waves are not the same: a tenth of the
  // difference
  EXPECT_NEAR(largest_load(elastic + warm + Values{{"modulus_slope", "-0.01"}}), soft,
              0.1 * (hard - soft));
  // Arrhenius: exp(-Q/R (1/320 - 1/300)) = 12.25 times the rate
  const Values creep{{"creep_stress", "10e6"}, {"creep_exponent", "1"}};
  const double faster = std::exp(-100e3 / 8.31446261815324 * (1.0 / 320 - 1.0 / 300));
  const double flowing =
      largest_load(elastic + creep + Values{{"creep_rate", std::to_string(5 * faster)}});
  EXPECT_LT(flowing, 0.9 * hard);
  // grains that slip or stick make much of a rounding of the rate: a hundredth of the difference
  EXPECT_NEAR(largest_load(elastic + creep +
                           Values{{"temperature", "320"},
                                  {"reference", "300"},
                                  {"activation", "100e3"},
                                  {"creep_rate", "5"}}),
              flowing, 0.01 * (hard - flowing));
}

}  // namespace engine::decks

#endif
