// SPDX-License-Identifier: GPL-2.0-or-later
// Job: `atom_style bonded/sphere`: ghosts, migration between ranks and restarts.
// See atom_vec_bonded_sphere.h.
#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
constexpr int kCommon = 23;  // doubles of a particle apart from forces and tables
}

// ---- ghosts -------------------------------------------------------------------------------------
// A ghost gets its position, in a border also identity and size; with velocities if somebody needs
// them, with its orientation if a law does.

int AtomVecBondedSphere::values_per_ghost(bool velocities) const {
  return 3 + 6 + 4 + (velocities ? 6 : 0);
}

int AtomVecBondedSphere::pack_ghost(int n, int *list, double *buf, int pbc_flag, int *pbc,
                                    bool border, bool velocities) {
  double shift[3] = {0.0, 0.0, 0.0}, speed[3] = {0.0, 0.0, 0.0};
  if (pbc_flag) {
    shift[0] = pbc[0] * domain->xprd;
    shift[1] = pbc[1] * domain->yprd;
    shift[2] = pbc[2] * domain->zprd;
    if (deform_vremap) {
      speed[0] = pbc[0] * h_rate[0] + pbc[5] * h_rate[5] + pbc[4] * h_rate[4];
      speed[1] = pbc[1] * h_rate[1] + pbc[3] * h_rate[3];
      speed[2] = pbc[2] * h_rate[2];
    }
  }
  const bool orientation = border || send_orientation;
  int m = 0;
  for (int k = 0; k < n; k++) {
    const int j = list[k];
    for (int d = 0; d < 3; d++) buf[m++] = x[j][d] + shift[d];
    if (border) {
      buf[m++] = ubuf(tag[j]).d;
      buf[m++] = ubuf(type[j]).d;
      buf[m++] = ubuf(mask[j]).d;
      buf[m++] = radius[j];
      buf[m++] = rmass[j];
      buf[m++] = density[j];
    }
    if (orientation)
      for (int d = 0; d < 4; d++) buf[m++] = quat[j][d];
    if (velocities) {
      const bool dragged = mask[j] & deform_groupbit;
      for (int d = 0; d < 3; d++) buf[m++] = dragged ? v[j][d] + speed[d] : v[j][d];
      for (int d = 0; d < 3; d++) buf[m++] = omega[j][d];
    }
  }
  if (border && atom->nextra_border)
    for (int k = 0; k < atom->nextra_border; k++)
      m += modify->fix[atom->extra_border[k]]->pack_border(n, list, &buf[m]);
  return m;
}

void AtomVecBondedSphere::unpack_ghost(int n, int first, double *buf, bool border,
                                       bool velocities) {
  const bool orientation = border || send_orientation;
  int m = 0;
  for (int i = first; i < first + n; i++) {
    if (border && i == nmax) grow(0);
    for (int d = 0; d < 3; d++) x[i][d] = buf[m++];
    if (border) {
      tag[i] = (int)ubuf(buf[m++]).i;
      type[i] = (int)ubuf(buf[m++]).i;
      mask[i] = (int)ubuf(buf[m++]).i;
      radius[i] = buf[m++];
      rmass[i] = buf[m++];
      density[i] = buf[m++];
    }
    if (orientation)
      for (int d = 0; d < 4; d++) quat[i][d] = buf[m++];
    if (velocities) {
      for (int d = 0; d < 3; d++) v[i][d] = buf[m++];
      for (int d = 0; d < 3; d++) omega[i][d] = buf[m++];
    }
  }
  if (border && atom->nextra_border)
    for (int k = 0; k < atom->nextra_border; k++)
      m += modify->fix[atom->extra_border[k]]->unpack_border(n, first, &buf[m]);
}

int AtomVecBondedSphere::pack_comm(int n, int *list, double *buf, int flag, int *pbc) {
  return pack_ghost(n, list, buf, flag, pbc, false, false);
}
int AtomVecBondedSphere::pack_comm_vel(int n, int *list, double *buf, int flag, int *pbc) {
  return pack_ghost(n, list, buf, flag, pbc, false, true);
}
void AtomVecBondedSphere::unpack_comm(int n, int first, double *buf) {
  unpack_ghost(n, first, buf, false, false);
}
void AtomVecBondedSphere::unpack_comm_vel(int n, int first, double *buf) {
  unpack_ghost(n, first, buf, false, true);
}
int AtomVecBondedSphere::pack_border(int n, int *list, double *buf, int flag, int *pbc) {
  return pack_ghost(n, list, buf, flag, pbc, true, false);
}
int AtomVecBondedSphere::pack_border_vel(int n, int *list, double *buf, int flag, int *pbc) {
  return pack_ghost(n, list, buf, flag, pbc, true, true);
}
void AtomVecBondedSphere::unpack_border(int n, int first, double *buf) {
  unpack_ghost(n, first, buf, true, false);
}
void AtomVecBondedSphere::unpack_border_vel(int n, int first, double *buf) {
  unpack_ghost(n, first, buf, true, true);
}

int AtomVecBondedSphere::pack_reverse(int n, int first, double *buf) {
  int m = 0;
  for (int i = first; i < first + n; i++) {
    for (int d = 0; d < 3; d++) buf[m++] = f[i][d];
    for (int d = 0; d < 3; d++) buf[m++] = torque[i][d];
  }
  return m;
}

void AtomVecBondedSphere::unpack_reverse(int n, int *list, double *buf) {
  int m = 0;
  for (int k = 0; k < n; k++) {
    const int j = list[k];
    for (int d = 0; d < 3; d++) f[j][d] += buf[m++];
    for (int d = 0; d < 3; d++) torque[j][d] += buf[m++];
  }
}

// ---- migration ----------------------------------------------------------------------------------

int AtomVecBondedSphere::pack_common(int i, double *buf) const {
  int m = 0;
  for (int d = 0; d < 3; d++) buf[m++] = x[i][d];
  for (int d = 0; d < 3; d++) buf[m++] = v[i][d];
  buf[m++] = ubuf(tag[i]).d;
  buf[m++] = ubuf(type[i]).d;
  buf[m++] = ubuf(mask[i]).d;
  buf[m++] = ubuf(image[i]).d;
  buf[m++] = radius[i];
  buf[m++] = rmass[i];
  buf[m++] = density[i];
  for (int d = 0; d < 3; d++) buf[m++] = omega[i][d];
  for (int d = 0; d < 3; d++) buf[m++] = xref[i][d];
  for (int d = 0; d < 4; d++) buf[m++] = quat[i][d];
  return m;
}

int AtomVecBondedSphere::unpack_common(int i, const double *buf) {
  int m = 0;
  for (int d = 0; d < 3; d++) x[i][d] = buf[m++];
  for (int d = 0; d < 3; d++) v[i][d] = buf[m++];
  tag[i] = (int)ubuf(buf[m++]).i;
  type[i] = (int)ubuf(buf[m++]).i;
  mask[i] = (int)ubuf(buf[m++]).i;
  image[i] = (tagint)ubuf(buf[m++]).i;
  radius[i] = buf[m++];
  rmass[i] = buf[m++];
  density[i] = buf[m++];
  for (int d = 0; d < 3; d++) omega[i][d] = buf[m++];
  for (int d = 0; d < 3; d++) xref[i][d] = buf[m++];
  for (int d = 0; d < 4; d++) quat[i][d] = buf[m++];
  atom->num_bond[i] = 0;
  atom->nspecial[i][0] = atom->nspecial[i][1] = atom->nspecial[i][2] = 0;
  return m;
}

// NULL: a particle without rows.
int AtomVecBondedSphere::unpack_tables(int i, const double *buf) {
  static const double no_rows = 0.0;
  const int fresh = next_slot();
  int m = bonds.unpack(buf ? buf : &no_rows, fresh);
  m += contacts.unpack(buf ? buf + m : &no_rows, fresh);
  slot[i] = fresh;
  stale = true;
  return m;
}

int AtomVecBondedSphere::pack_exchange(int i, double *buf) {
  int m = 1;
  m += pack_common(i, buf + m);
  for (int d = 0; d < 6; d++) buf[m++] = saved_force[i][d];
  m += bonds.pack(slot[i], buf + m);
  m += contacts.pack(slot[i], buf + m);
  if (atom->nextra_grow)
    for (int k = 0; k < atom->nextra_grow; k++)
      m += modify->fix[atom->extra_grow[k]]->pack_exchange(i, &buf[m]);
  buf[0] = m;
  return m;
}

int AtomVecBondedSphere::unpack_exchange(double *buf) {
  const int i = atom->nlocal;
  if (i == nmax) grow(0);
  int m = 1;
  m += unpack_common(i, buf + m);
  for (int d = 0; d < 6; d++) saved_force[i][d] = buf[m++];
  m += unpack_tables(i, buf + m);
  if (atom->nextra_grow)
    for (int k = 0; k < atom->nextra_grow; k++)
      m += modify->fix[atom->extra_grow[k]]->unpack_exchange(i, &buf[m]);
  atom->nlocal++;
  return m;
}

// ---- restart ------------------------------------------------------------------------------------
// Every particle saves its own rows, so a pair stands in the file twice; the second copy is dropped
// when the table is put in order.

// Exact: the engine writes this many doubles.
int AtomVecBondedSphere::size_restart() {
  int n = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    n += 1 + kCommon + 6 + bonds.packed_size(slot[i]) + contacts.packed_size(slot[i]);
    if (atom->nextra_restart)
      for (int k = 0; k < atom->nextra_restart; k++)
        n += modify->fix[atom->extra_restart[k]]->size_restart(i);
  }
  return n;
}

int AtomVecBondedSphere::pack_restart(int i, double *buf) {
  int m = 1;
  m += pack_common(i, buf + m);  // begins with the position, which the engine reads there
  // after a run the particles may have migrated since forces were saved; during one they are here
  const bool kept = saved_step == update->ntimestep;
  for (int d = 0; d < 3; d++) {
    buf[m + d] = kept ? saved_force[i][d] : f[i][d];
    buf[m + 3 + d] = kept ? saved_force[i][3 + d] : torque[i][d];
  }
  m += 6;
  m += bonds.pack(slot[i], buf + m);
  m += contacts.pack(slot[i], buf + m);
  if (atom->nextra_restart)
    for (int k = 0; k < atom->nextra_restart; k++)
      m += modify->fix[atom->extra_restart[k]]->pack_restart(i, &buf[m]);
  buf[0] = m;
  return m;
}

int AtomVecBondedSphere::unpack_restart(double *buf) {
  const int i = atom->nlocal;
  if (i == nmax) {
    grow(0);
    if (atom->nextra_store) memory->grow(atom->extra, nmax, atom->nextra_store, "atom:extra");
  }
  int m = 1;
  m += unpack_common(i, buf + m);
  for (int d = 0; d < 6; d++) saved_force[i][d] = buf[m++];
  m += unpack_tables(i, buf + m);
  double **extra = atom->extra;
  if (atom->nextra_store) {
    const int size = static_cast<int>(buf[0]) - m;
    for (int k = 0; k < size; k++) extra[i][k] = buf[m++];
  }
  atom->nlocal++;
  return m;
}

// The time step goes along: computed from the bonded network (timestep_bonded), it would come out
// otherwise after bonds have broken. So does the time, which the engine would count from 0 again.
// Before the first run there are no forces to go on from.
void AtomVecBondedSphere::write_restart_settings(FILE *fp) {
  const bool forces = saved_step == update->ntimestep || update->whichflag != 0;
  const double settings[5] = {thickness, density_override, update->dt, forces ? 1.0 : 0.0,
                              update->get_cur_time()};
  fwrite(settings, sizeof settings, 1, fp);
}

void AtomVecBondedSphere::read_restart_settings(FILE *fp) {
  int me, good = 1;
  MPI_Comm_rank(world, &me);
  double settings[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
  if (me == 0) good = fread(settings, sizeof settings, 1, fp) == 1;
  MPI_Bcast(&good, 1, MPI_INT, 0, world);
  if (!good) error->all(FLERR, "restart file ends within the settings of atom_style bonded/sphere");
  MPI_Bcast(settings, 5, MPI_DOUBLE, 0, world);
  thickness = settings[0];
  density_override = settings[1];
  update->dt = settings[2];
  saved_step = settings[3] != 0.0 ? update->ntimestep : -1;  // known before the particles come
  update->atime = settings[4];
  update->atimestep = update->ntimestep;
}
