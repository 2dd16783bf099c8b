// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see command_timestep_bonded.h. The frequency is that of network_frequency.h.
#include "command_timestep_bonded.h"

#include <cmath>
#include <string>

#include "atom_vec_bonded_sphere.h"
#include "bond_bpm.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "neighbor.h"
#include "network_frequency.h"
#include "pair.h"
#include "read_number.h"
#include "update.h"

using namespace LAMMPS_NS;

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
  const NetworkFrequency network = network_frequency(lmp);
  if (!(network.omega2 > 0.0)) error->all(FLERR, "timestep_bonded: no bonds are installed, so there is no frequency to take a step from");
  // a dashpot proportional to stiffness damps the highest mode most
  const double omega = std::sqrt(network.omega2), zeta = 0.5 * omega * network.damping_time;
  update->dt = safety * 2.0 / omega * (std::sqrt(1.0 + zeta * zeta) - zeta);
  if (force->pair) force->pair->reset_dt();
  if (comm->me == 0) {
    const char *form = "  time step %.6g s (%g of the limit 2/omega)\n";
    if (screen) fprintf(screen, form, update->dt, safety);
    if (logfile) fprintf(logfile, form, update->dt, safety);
  }
}
