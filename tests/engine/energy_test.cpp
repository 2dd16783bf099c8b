// SPDX-License-Identifier: GPL-2.0-or-later
//
// The energy of a pressed specimen in the engine: the work of the platens is what is stored in bonds,
// contacts and platens, moves, and was lost to damping and softening. No friction, no brittle break: then
// nothing else can take energy.
//
// Work by the trapezoid rule from every step's force and displacement, as velocity Verlet's own energy
// good to second order of the step; the dashpots' force is that of the half step before, first order.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

struct Balance {
  double work = 0.0, stored = 0.0, moving = 0.0, lost = 0.0;  // J, at the end
  double worst = 0.0;                                          // largest gap, as a share of the work
  std::size_t broken = 0;
};

// A run in several pieces must give the same as one.
Balance press(const std::string &bond, double safety, double speed, double time, double local_damping = 0.0,
              int pieces = 1) {
  Preamble p = small();
  p.contact = "5e9 2.0 0";
  p.bond = "5e9 2.0 " + bond;
  p.safety = safety;
  std::ostringstream deck;
  deck << p.text();
  for (const int side : {0, 1})
    deck << "fix " << (side ? "top" : "bottom") << " all platen plane 0 0 " << (side ? 0.012 : 0.0) << " 0 0 "
         << (side ? -1 : 1) << " touch modulus 5e9 velocity 0 0 " << (side ? -0.5 : 0.5) * speed << " ramp 2e-5\n";
  deck << "fix integrate all nve/bonded\n";
  if (local_damping > 0.0) deck << "fix damp all damp/local " << local_damping << " energy yes\n";
  deck << "compute e all energy/bonded\nfix log all bond/log 100 broken.tsv\n";
  const char *names[] = {"bonds", "contacts", "moving", "turning", "lost", "creep", "intact", "damped"};
  for (int k = 0; k < 8; ++k) deck << "variable " << names[k] << " equal c_e[" << k + 1 << "]\n";
  deck << "fix curve all curve 1 curve.tsv";
  for (const char *name : names) deck << " " << name << " J v_" << name;
  deck << " ftop N f_top[3] fbottom N f_bottom[3] dtop m f_top[9] dbottom m f_bottom[9] etop J f_top[15] ebottom J f_bottom[15]\n"
       << "variable n equal ceil(" << time << "/dt/" << pieces << ")\n";
  for (int k = 0; k < pieces; ++k) deck << "run $n\n";
  EngineFolder folder;
  const EngineResult r = run_deck(folder, deck.str(), 1, {}, 120.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1000 ? r.screen.size() - 1000 : 0);
  const Table t = read_table(folder.file("curve.tsv"));
  std::map<std::string, std::vector<double>> c;
  for (const std::string &name : t.names) c[name] = t.column(name);
  Balance b;
  double most = 0.0;
  for (std::size_t k = 1; k < t.rows.size(); ++k) {
    // forces are those on the platens
    for (const char *side : {"top", "bottom"}) {
      const std::vector<double> &f = c[std::string("f") + side], &d = c[std::string("d") + side];
      b.work -= 0.5 * (f[k] + f[k - 1]) * (d[k] - d[k - 1]);
    }
    b.stored = c["bonds"][k] + c["contacts"][k] + c["etop"][k] + c["ebottom"][k];
    b.moving = c["moving"][k] + c["turning"][k];
    b.lost = c["lost"][k] + c["damped"][k];
    most = std::max(most, std::fabs(b.work - b.stored - b.moving - b.lost));
  }
  b.worst = most / b.work;
  b.broken = read_table(folder.file("broken.tsv")).rows.size();
  return b;
}

}  // namespace

TEST(EnergyOfSpecimen, elastic) {
  const Balance coarse = press("1e12 1e12", 0.4, 4.0, 2e-5), fine = press("1e12 1e12", 0.2, 4.0, 2e-5);
  EXPECT_EQ(coarse.broken, 0u);
  EXPECT_GT(coarse.stored, 0.1 * coarse.work);
  EXPECT_GT(coarse.moving, 0.001 * coarse.work);
  EXPECT_LT(fine.worst, 1e-6);
  EXPECT_LT(fine.worst, 0.4 * coarse.worst);  // second order
}

// Cundall's damping takes its share of every force, and what it took closes the balance.
TEST(EnergyOfSpecimen, damped_locally) {
  const Balance coarse = press("1e12 1e12", 0.4, 4.0, 2e-5, 0.7), fine = press("1e12 1e12", 0.2, 4.0, 2e-5, 0.7);
  EXPECT_EQ(coarse.broken, 0u);
  EXPECT_GT(fine.lost, 0.02 * fine.work);
  EXPECT_LT(fine.worst, 1e-6);
  EXPECT_LT(fine.worst, 0.4 * coarse.worst);  // second order
}

TEST(EnergyOfSpecimen, damped_locally_in_pieces) {
  const Balance whole = press("1e12 1e12", 0.4, 4.0, 2e-5, 0.7), pieces = press("1e12 1e12", 0.4, 4.0, 2e-5, 0.7, 4);
  EXPECT_NEAR(pieces.lost / whole.lost, 1.0, 1e-3);  // the number of steps is rounded up in each piece
  EXPECT_LT(pieces.worst, 1.5 * whole.worst);
}

TEST(EnergyOfSpecimen, damped) {
  const Balance coarse = press("1e12 1e12 damping 0.5", 0.8, 4.0, 2e-5), fine = press("1e12 1e12 damping 0.5", 0.4, 4.0, 2e-5);
  EXPECT_EQ(coarse.broken, 0u);
  EXPECT_GT(fine.lost, 0.02 * fine.work);
  EXPECT_LT(fine.worst, 1e-4);
  EXPECT_LT(fine.worst, 0.7 * coarse.worst);  // first order
}

// A thousand bonds soften to the end, also under compression.
TEST(EnergyOfSpecimen, softening_to_the_end) {
  const Balance coarse = press("8e6 8e6 softening 60", 0.4, 4.0, 6e-5), fine = press("8e6 8e6 softening 60", 0.2, 4.0, 6e-5);
  EXPECT_GT(fine.broken, 500u);
  EXPECT_GT(fine.lost, 0.1 * fine.work);
  EXPECT_LT(fine.worst, 2e-3);
  EXPECT_LT(fine.worst, 0.7 * coarse.worst);  // first order
}
