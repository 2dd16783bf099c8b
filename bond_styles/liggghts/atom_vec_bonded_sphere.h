/* SPDX-License-Identifier: GPL-2.0-or-later

   Job: `atom_style bonded/sphere`: spheres (or discs of a given thickness) that can be bonded. It
   gives each particle radius, density, mass, spin, orientation and a reference position, and
   carries along, with every particle that changes rank or goes into a restart, the rows of the bond
   and contact tables and the force of the last step.

   Why the force of the last step is saved: the engine's set-up of a run computes forces anew from
   velocities of the full step, while during a run they belong to the half step; local damping
   (sign of the velocity) would take another path. A run that starts from the saved force goes on
   bit for bit (fix nve/bonded puts it back).

   Limits: no hybrid atom style, no wedge domain, no fix that changes radii.
   See atom_style_bonded_sphere.md. */

#ifdef ATOM_CLASS

AtomStyle(bonded/sphere,AtomVecBondedSphere)

#else

#ifndef BONDLAB_ATOM_VEC_BONDED_SPHERE_H
#define BONDLAB_ATOM_VEC_BONDED_SPHERE_H

#include <functional>

#include "atom_vec.h"
#include "break_event.h"
#include "pair_gather.h"
#include "pair_table.h"

namespace LAMMPS_NS {

class AtomVecBondedSphere : public AtomVec {
 public:
  explicit AtomVecBondedSphere(class LAMMPS *);
  ~AtomVecBondedSphere();

  // The atom style of this run, or an error that names who asked.
  static AtomVecBondedSphere *of(class LAMMPS *lmp, const char *who);

  double thickness;  // of 2D discs, m
  double density_override;  // kg/m3, or 0: as in the data file
  double **xref;     // [nmax][3] reference position, unwrapped, m (own particles)
  double **quat;     // [nmax][4] orientation, unit quaternion (own particles and ghosts)
  int send_orientation;  // 1: ghosts get orientations at every step
  void need_orientations();  // a bond law does

  bondlab::PairTable bonds;     // kept by bond styles
  bondlab::PairTable contacts;  // kept by pair_style grain
  // Columns of a bond: `common` ones, those of its law (of several laws the largest number), and two
  // for options if some bond type has any.
  int law_columns;
  void ask_for_columns(int common, int law, bool options);
  // Bonds that broke on this rank since somebody took them; each bond on one rank only.
  std::vector<BreakEvent> breaks;

  // Counts rebuilds of the ghost shell. The two tables are put in order at the first use after one;
  // their owners compare `generation` with the one they last saw.
  bigint generation;
  void mark_stale() { stale = true; }
  int index_of(int tag) const;  // of a particle or ghost, -1 if there is none here
  // Error, with both tags, if a bonded partner is neither here nor a ghost. `bond_gone(row)` says
  // which bond rows may be dropped beforehand.
  void index_tables();
  std::function<bool(int)> bond_gone;

  double **saved_force;     // [nmax][6] force and torque at the end of saved_step
  bigint saved_step;        // -1: none
  void save_forces();       // of the current step
  bool restore_forces(bigint step);

  // Motion of all particles and ghosts in the form pairs read it (pair_gather.h). The pair style, or
  // without one the bond style, fills it at the beginning of each force computation.
  const bondlab::ParticleRecords &fill_records();
  const bondlab::ParticleRecords &records() const { return records_; }

  // Along periodic directions positions lie on a grid as coarse as the rounding of the box's size. Then
  // a shift by the box's length is exact, and a pair through a face has the same distance, to the bit,
  // whichever of the two is the ghost. 0: not periodic.
  double grid[3];
  bool on_grid() const { return grid[0] > 0.0 || grid[1] > 0.0 || grid[2] > 0.0; }
  void snap_to_grid();      // own particles
  void snap_box_to_grid();  // before ghosts are made

  // For write_data: copies the bonds into the engine's lists, from which it writes the `Bonds`
  // section, and empties them.
  void list_bonds();
  void forget_listed_bonds();

  double mass_of(double radius, double density) const;
  void set_reference_positions();

  void settings(int, char **);
  void init();
  void grow(int);
  void grow_reset();
  void copy(int, int, int);
  int pack_comm(int, int *, double *, int, int *);
  int pack_comm_vel(int, int *, double *, int, int *);
  void unpack_comm(int, int, double *);
  void unpack_comm_vel(int, int, double *);
  int pack_reverse(int, int, double *);
  void unpack_reverse(int, int *, double *);
  int pack_border(int, int *, double *, int, int *);
  int pack_border_vel(int, int *, double *, int, int *);
  void unpack_border(int, int, double *);
  void unpack_border_vel(int, int, double *);
  int pack_exchange(int, double *);
  int unpack_exchange(double *);
  int size_restart();
  int pack_restart(int, double *);
  int unpack_restart(double *);
  void write_restart_settings(FILE *);
  void read_restart_settings(FILE *);
  void create_atom(int, double *);
  void data_atom(double *, tagint, char **);
  void data_vel(int, char **);
  void pack_data(double **);
  void pack_data(double **, int);
  void write_data(FILE *, int, double **);
  void pack_vel(double **);
  void pack_vel(double **, int);
  void write_vel(FILE *, int, double **);
  bigint memory_usage();

 private:
  int *tag, *type, *mask;
  tagint *image;
  double **x, **v, **f;
  double *radius, *density, *rmass;
  double **omega, **torque;
  int *slot;  // [nmax] names a particle's rows in both tables
  bool listed_for_output_;
  void refuse_listed_bonds();
  void find_grid();
  bool stale;
  bondlab::ParticleRecords records_;
  int next_slot() const;
  int pack_common(int, double *) const;
  int unpack_common(int, const double *);
  int unpack_tables(int, const double *);
  int values_per_ghost(bool velocities) const;
  int pack_ghost(int, int *, double *, int, int *, bool border, bool velocities);
  void unpack_ghost(int, int, double *, bool border, bool velocities);
  void fill_data(double **, int);
};

}  // namespace LAMMPS_NS

#endif
#endif
