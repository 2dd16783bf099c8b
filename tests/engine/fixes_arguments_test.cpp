// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every wrong argument of a fix ends the run with a sentence that names the fix, what was given and
// what is allowed.
#include <gtest/gtest.h>

#include "fixes_deck.h"

namespace {

using namespace engine;

struct Wrong {
  const char *fix;      // after "fix f all "
  const char *message;  // part of what must be said
  int dimension = 3;
};

class WrongArguments : public testing::TestWithParam<Wrong> {};

TEST_P(WrongArguments, AreExplained) {
  const Wrong &w = GetParam();
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0, 0}, {0, 0.005, 0}}, w.dimension, 0.02));
  const EngineResult r = run_deck(
      folder,
      few_particles(w.dimension, 1e-8) + "variable one equal 1\nfix f all " + w.fix + "\nrun 1\n");
  EXPECT_NE(r.status, 0) << w.fix;
  EXPECT_FALSE(r.timed_out);
  const std::string style = std::string(w.fix).substr(0, std::string(w.fix).find(' '));
  EXPECT_TRUE(r.says("ERROR: Fix " + style + " (id f): ")) << r.screen;
  EXPECT_TRUE(r.says(w.message)) << "expected: " << w.message << "\n" << r.screen;
}

INSTANTIATE_TEST_SUITE_P(
    Platen, WrongArguments,
    testing::Values(
        Wrong{"platen wall 0 0 0 0 1 0",
              "the surface is 'wall', allowed are plane|cylinder|sphere"},
        Wrong{"platen plane 0 0 zero 0 1 0 modulus 1e9", "is 'zero', it must be a number"},
        Wrong{"platen plane 0 0 0 0 0 0 modulus 1e9", "the normal is 0 0 0"},
        Wrong{"platen plane 0 -1 0 0 1", "is missing at the end of the command"},
        Wrong{"platen plane 0 -1 0 0 1 0", "needs a stiffness"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 0",
              "modulus (Pa) is '0', it must be a number > 0"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus nan", "it must be a number > 0"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 stiffness_per_radius 1e9", "given twice"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 friction 0.3", "friction needs `ratio"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 friction -1 ratio 2", "friction is '-1'"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 speed 3",
              "unknown keyword 'speed', allowed are touch"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 at_rest velocity 0 1 0",
              "at_rest can't be used"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 servo fw 1", "is 'fw', allowed are fx|fy|fz"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 servo fy 1", "servo needs `gain G`"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 servo fy 1 gain 1e-3 vmax 0",
              "vmax (m/s) is '0'"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 velocity 0 1 0 servo fy 1 gain 1 vmax 1",
              "for the same direction"},
        Wrong{"platen cylinder w 0 0 0 1 inside modulus 1e9", "is 'w', allowed are x|y|z|vector"},
        Wrong{"platen cylinder z 0 0 0 -1 inside modulus 1e9", "the radius (m) is '-1'"},
        Wrong{"platen cylinder z 0 0 0 1 within modulus 1e9",
              "is 'within', allowed are outside|inside"},
        Wrong{"platen plane 0 0.003 0 0 1 0 modulus 1e9", "is behind the platen's surface"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 touch along 0 -1 0", "meets no particle"},
        Wrong{"platen sphere 0 -1 0 0.1 outside modulus 1e9", "a sphere can't be used in 2D", 2},
        Wrong{"platen cylinder x 0 -1 0 0.1 outside modulus 1e9", "must be z in 2D", 2},
        Wrong{"platen plane 0 -1 0 0 1 1 modulus 1e9", "no z component in 2D", 2},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 velocity 0 0 1", "can't move along z in 2D",
              2},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 follow loading 0 1 0", "there is no fix drive"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 follow l 0 1 0 velocity 0 1 0", "given twice"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 free 0", "is '0', it must be a number > 0"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 free 1 y velocity 0 1 0 ramp 1", "no ramp"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 frame 1e6", "frame needs `mass M`"},
        Wrong{"platen plane 0 -1 0 0 1 0 modulus 1e9 frame 1e6 mass 1", "frame needs velocity or"}));

INSTANTIATE_TEST_SUITE_P(
    Others, WrongArguments,
    testing::Values(
        Wrong{"damp/local", "alpha is missing"},
        Wrong{"damp/local 1", "is '1', it must be in 0 <= x < 1"},
        Wrong{"damp/local -0.1", "is '-0.1'"},
        Wrong{"damp/local 0.7x", "is '0.7x', it must be a number"},
        Wrong{"damp/local 0.7 0.7", "'0.7' is too many"},
        Wrong{"gauge axial w", "is 'w', allowed are x|y|z"},
        Wrong{"gauge axial z layers 0.25 0.75 thickness 1e-3", "is 'z', allowed are x|y", 2},
        Wrong{"gauge axial y layers 0.75 0.25 thickness 1e-3", "must be above the lower one"},
        Wrong{"gauge axial y layers 0.25 1.5 thickness 1e-3", "is '1.5'"},
        Wrong{"gauge axial y layers 0.25 0.75", "needs `thickness T`"},
        Wrong{"gauge layers 0.25 0.75 thickness 1", "needs `axial"},
        Wrong{"gauge axial y layers 0.25 0.75 thickness 1 lateral y strip 1", "is the axial one"},
        Wrong{"gauge axial y layers 0.25 0.75 thickness 1 lateral x", "lateral needs `strip T`"},
        Wrong{"gauge axial y layers 0.25 0.75 thickness 1 extent 1 0",
              "must be above the lower one"},
        Wrong{"gauge axial y layers 0.25 0.75 thickness 1 width 3", "unknown keyword 'width'"},
        Wrong{"curve 0 c.tsv a 1 v_one", "is '0', it must be an integer >= 1"},
        Wrong{"curve 10 c.tsv", "needs at least one column"},
        Wrong{"curve 10 c.tsv a 1", "the value of column 'a' is missing"},
        Wrong{"curve 10 c.tsv a 1 v_one a 1 v_one", "two columns 'a'"},
        Wrong{"curve 10 c.tsv time s v_one", "two columns 'time'"},
        Wrong{"curve 10 c.tsv a 1 one", "value 'one' must be v_NAME"},
        Wrong{"curve 10 c.tsv a 1 v_two",
              "value 'v_two' does not exist: there is no such variable"},
        Wrong{"curve 10 c.tsv a 1 f_two[1]", "there is no such fix"},
        Wrong{"curve 10 c.tsv a 1 c_two", "there is no such compute"},
        Wrong{"curve 10 c.tsv a 1 f_f[1]", "value 'f_f[1]' has no components"},
        Wrong{"stop/peak 10 v_one drop 1 min 0", "is '1', it must be in 0 <= x < 1"},
        Wrong{"stop/peak 10 v_one min 0", "needs `drop FRACTION`"},
        Wrong{"stop/peak 10 v_one drop 0.2", "needs `min VALUE`"},
        Wrong{"stop/peak 10 v_one drop 0.2 min 0 max_abs v_one -1",
              "is '-1', it must be a number >= 0"},
        Wrong{"stop/peak 10 v_one drop 0.2 min 0 max v_one 1", "unknown keyword 'max'"},
        Wrong{"stop/peak 10 v_one drop 0.2 min 0 unless v_two", "there is no such variable"},
        Wrong{"grip glue", "unknown keyword 'glue', allowed are velocity"},
        Wrong{"membrane y -1", "the pressure (Pa) is '-1'"},
        Wrong{"drive ramp 1", "needs `speed V`"},
        Wrong{"drive speed 1 at_load 3 end", "need `load VALUE`"},
        Wrong{"drive speed 1 at 3 stop", "is 'stop', allowed are speed|hold|keep|unload|end"},
        Wrong{"drive speed 1 at 3 hold -1", "is '-1', it must be a number >= 0"},
        Wrong{"drive speed 1 load v_one cycles 60 every 1 to 0.1", "has 60 events, at most 52"},
        Wrong{"drive speed 1 load v_one cycles 1.5 every 1 to 0.1", "must be an integer"},
        Wrong{"bond/log ten b.tsv", "is 'ten', it must be an integer >= 1"},
        Wrong{"bond/log 10 b.tsv", "needs a bond style of bonded particles"},
        Wrong{"bond/log 10 b.tsv more", "unknown keyword 'more'"}));

TEST(WrongOrder, ACurveMustComeAfterThePlatensItReads) {
  EngineFolder folder;
  folder.write("particles.data", data_file({{0, 0, 0}}, 3, 0.01));
  const EngineResult r =
      run_deck(folder,
               few_particles(3, 1e-8) +
                   "variable one equal 1\nfix c all curve 10 c.tsv a 1 v_one\n"
                   "fix p all platen plane 0 -0.005 0 0 1 0 modulus 1e9\nrun 1\n");
  EXPECT_NE(r.status, 0);
  EXPECT_TRUE(r.says("Fix curve (id c): must come after fix platen (id p)")) << r.screen;
}

}  // namespace
