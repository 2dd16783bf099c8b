// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see command_timestep_bonded.h.
//
// Method: Gershgorin's theorem on M^-1 K, block by block, with rotations scaled by the radius. The
// shear displacement of a pair is u_j - u_i - c (phi_i + phi_j), phi = R theta, c = d/(R_i + R_j), so
// with k the larger of normal and shear stiffness, k_s the shear one and k_b the larger of bending
// and twisting,
//   translation of i:  sum of 2 k + 2 c k_s                                       over m_i
//   rotation of i:     sum of 2 (c + c^2) k_s + k_b (1/R_i^2 + 1/(R_i R_j))       over I_i/R_i^2
// bound omega^2 from above. A bound, so the step is safe; on packings it lies 10 to 30 % below the
// true limit. Deterministic: sums run in order of tags, the maximum is exact.
#include "command_timestep_bonded.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "bond_bpm.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "pair.h"
#include "neighbor.h"
#include "read_number.h"
#include "update.h"

using namespace LAMMPS_NS;

double CommandTimestepBonded::frequency_bound(LAMMPS *lmp, double &damping_time) {
  Atom *atom = lmp->atom;
  const std::vector<BondBPM *> styles = BondBPM::all(lmp);
  const double inertia_factor = lmp->domain->dimension == 2 ? 0.5 : 0.4;
  for (BondBPM *style : styles) style->refresh();
  const bondlab::PairTable &t = styles[0]->style()->bonds;
  const int nlocal = atom->nlocal;
  double longest = 0.0;
  std::vector<double> move(nlocal, 0.0), turn(nlocal, 0.0);
  for (int row = 0; row < t.size(); row++) {
    BondBPM::Stiffness stiffness{0.0, 0.0, 0.0, 0.0};
    double dashpot = 0.0;
    for (BondBPM *style : styles)
      if (style->computes(row)) stiffness = style->whole_stiffness(row, dashpot);
    const double k = std::max(stiffness.normal, stiffness.shear), ks = stiffness.shear;
    const double kb = std::max(stiffness.bend, stiffness.twist);
    longest = std::max(longest, dashpot);
    const int ends[2] = {t.at_lo[row], t.at_hi[row]};
    const int own[2] = {t.own_lo[row], t.own_hi[row]};
    for (int side = 0; side < 2; side++) {
      const int i = own[side];
      if (i >= nlocal) continue;
      const double ri = atom->radius[ends[side]], rj = atom->radius[ends[1 - side]];
      const double arm = t.value(BondBPM::REST, row) / (ri + rj);
      move[i] += 2.0 * k + 2.0 * arm * ks;
      turn[i] += 2.0 * arm * (1.0 + arm) * ks + kb * (1.0 / (ri * ri) + 1.0 / (ri * rj));
    }
  }
  double highest[2] = {0.0, longest}, all[2] = {0.0, 0.0};
  for (int i = 0; i < nlocal; i++) {
    highest[0] = std::max(highest[0], move[i] / atom->rmass[i]);
    highest[0] = std::max(highest[0], turn[i] / (inertia_factor * atom->rmass[i]));
  }
  MPI_Allreduce(highest, all, 2, MPI_DOUBLE, MPI_MAX, lmp->world);
  damping_time = all[1];
  return all[0];
}

void CommandTimestepBonded::command(int narg, char **arg) {
  if (narg != 1) error->all(FLERR, "timestep_bonded: expected `timestep_bonded SAFETY`, for example 0.8");
  const double safety = bondlab::read_number(arg[0]);
  if (!(safety > 0.0) || safety > 1.0) {
    const std::string text =
        std::string("timestep_bonded: SAFETY is ") + arg[0] + ", it must be above 0 and at most 1";
    error->all(FLERR, text.c_str());
  }
  if (BondBPM::all(lmp).empty())
    error->all(FLERR, "timestep_bonded: there is no BondLab bond style");
  lmp->init();
  domain->pbc();
  domain->reset_box();
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
  comm->exchange();
  comm->borders();
  AtomVecBondedSphere::of(lmp, "timestep_bonded")->mark_stale();
  double damping_time = 0.0;
  const double omega2 = frequency_bound(lmp, damping_time);
  if (!(omega2 > 0.0)) error->all(FLERR, "timestep_bonded: no bonds are installed, so there is no frequency to take a step from");
  // a dashpot proportional to stiffness damps the highest mode most
  const double omega = std::sqrt(omega2), zeta = 0.5 * omega * damping_time;
  update->dt = safety * 2.0 / omega * (std::sqrt(1.0 + zeta * zeta) - zeta);
  if (force->pair) force->pair->reset_dt();
  if (comm->me == 0) {
    const char *form = "  time step %.6g s (%g of the bound 2/omega)\n";
    if (screen) fprintf(screen, form, update->dt, safety);
    if (logfile) fprintf(logfile, form, update->dt, safety);
  }
}
