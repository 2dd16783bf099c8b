// SPDX-License-Identifier: GPL-2.0-or-later
// Job: `atom_style bonded/sphere`: storage and output. See atom_vec_bonded_sphere.h.
// Communication between ranks and restarts are in atom_vec_bonded_sphere_comm.cpp.
#include "atom_vec_bonded_sphere.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "atom.h"
#include "bond_bpm.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "read_number.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
bool is_intact(int information) { return !(information & BondBPM::BROKEN); }
constexpr int kGrowBy = 16384;
constexpr int kContactColumns = 3;  // shear force
}  // namespace

AtomVecBondedSphere::AtomVecBondedSphere(LAMMPS *lmp)
    : AtomVec(lmp), bonds(0), contacts(kContactColumns), law_columns(0),
      listed_for_output_(false) {
  grid[0] = grid[1] = grid[2] = 0.0;
  molecular = 1;  // the engine calls the bond style only then
  bonds_allow = 1;
  mass_type = 0;

  comm_x_only = 1;
  comm_f_only = 0;
  size_forward = 3;
  size_reverse = 6;
  size_velocity = 6;
  size_data_atom = 7;
  size_data_vel = 7;
  xcol_data = 5;

  atom->sphere_flag = 1;
  atom->radius_flag = atom->rmass_flag = atom->omega_flag = atom->density_flag =
      atom->torque_flag = 1;

  thickness = 1.0;
  density_override = 0.0;
  xref = quat = saved_force = NULL;
  slot = NULL;
  send_orientation = 0;
  saved_step = -1;
  stale = true;
  generation = 0;
  size_border = values_per_ghost(false) + 6;
}

void AtomVecBondedSphere::need_orientations() {
  send_orientation = 1;
  size_forward = 3 + 4;
  comm_x_only = 0;
}

AtomVecBondedSphere::~AtomVecBondedSphere() {
  memory->destroy(xref);
  memory->destroy(quat);
  memory->destroy(saved_force);
  memory->destroy(slot);
}

AtomVecBondedSphere *AtomVecBondedSphere::of(LAMMPS *lmp, const char *who) {
  AtomVecBondedSphere *style = dynamic_cast<AtomVecBondedSphere *>(lmp->atom->avec);
  if (!style) {
    const std::string text = std::string(who) +
                             " needs particles of `atom_style bonded/sphere`, but this run has `atom_style " +
                             (lmp->atom->atom_style ? lmp->atom->atom_style : "none") + "`";
    lmp->error->all(FLERR, text.c_str());
  }
  return style;
}

void AtomVecBondedSphere::settings(int narg, char **arg) {
  for (int k = 0; k < narg; k += 2) {
    const bool is_thickness = strcmp(arg[k], "thickness") == 0;
    if (!is_thickness && strcmp(arg[k], "density") != 0) {
      const std::string text = std::string("atom_style bonded/sphere: unknown keyword '") + arg[k] +
                               "', allowed are 'thickness' (m) and 'density' (kg/m3)";
      error->all(FLERR, text.c_str());
    }
    if (k + 1 >= narg) error->all(FLERR, "atom_style bonded/sphere: a keyword has no value");
    const double value = bondlab::read_number(arg[k + 1]);
    if (!(value > 0.0) || !std::isfinite(value)) {
      const std::string text = std::string("atom_style bonded/sphere: ") + arg[k] + " is " +
                               arg[k + 1] + ", it must be a positive number";
      error->all(FLERR, text.c_str());
    }
    (is_thickness ? thickness : density_override) = value;
  }
}

void AtomVecBondedSphere::ask_for_columns(int common, int law, bool options) {
  law_columns = std::max(law_columns, law);
  bonds.widen(common + law_columns + (options ? 2 : 0));
}

void AtomVecBondedSphere::init() {
  AtomVec::init();
  for (int i = 0; i < modify->nfix; i++)
    if (modify->fix[i]->rad_mass_vary_flag)
      error->all(FLERR, "atom_style bonded/sphere: a fix that changes radii or masses can't be used");
  refuse_listed_bonds();
  find_grid();
  // index_tables() must run after each rebuild of the ghost shell: a small fix hears of it
  if (modify->find_fix("bonded_sphere_index") < 0) {
    const char *args[] = {"bonded_sphere_index", "all", "bonded/index"};
    modify->add_fix(3, const_cast<char **>(args));
  }
  if (modify->find_fix("bonded_sphere_box") < 0) {
    const char *args[] = {"bonded_sphere_box", "all", "bonded/box"};
    modify->add_fix(3, const_cast<char **>(args));
  }
  // a particle with more bonds than the engine's own reserve must still fit its send buffer
  const int record = 40 + bonds.longest_slot() * (2 + bonds.columns()) +
                     contacts.longest_slot() * (2 + contacts.columns());
  int most = record;
  MPI_Allreduce(&record, &most, 1, MPI_INT, MPI_MAX, world);
  comm->maxexchange_atom = 4 * most;
}

const bondlab::ParticleRecords &AtomVecBondedSphere::fill_records() {
  const int n = atom->nlocal + atom->nghost;
  if (domain->dimension == 2)
    records_.fill_plane(n, x, v, omega, radius);
  else
    records_.fill_space(n, x, v, omega, radius, send_orientation ? quat : NULL);
  return records_;
}

void AtomVecBondedSphere::list_bonds() {
  int longest = 1, all = 1;
  for (int i = 0; i < atom->nlocal; i++) longest = std::max(longest, bonds.rows_of(slot[i]));
  MPI_Allreduce(&longest, &all, 1, MPI_INT, MPI_MAX, world);
  if (all > atom->bond_per_atom) {
    atom->bond_per_atom = all;
    memory->grow(atom->bond_type, nmax, all, "atom:bond_type");
    memory->grow(atom->bond_atom, nmax, all, "atom:bond_atom");
  }
  bigint mine = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    atom->num_bond[i] = 0;
    for (int k = 0; k < bonds.rows_of(slot[i]); k++) {
      const int row = bonds.row_of(slot[i], k), m = atom->num_bond[i];
      if (!is_intact(bonds.info[row])) continue;
      atom->bond_type[i][m] = bonds.info[row] & BondBPM::TYPE_MASK;
      atom->bond_atom[i][m] = bonds.lo[row] == tag[i] ? bonds.hi[row] : bonds.lo[row];
      atom->num_bond[i]++;
      mine += bonds.lo[row] == tag[i];
    }
  }
  MPI_Allreduce(&mine, &atom->nbonds, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  listed_for_output_ = true;
}

void AtomVecBondedSphere::forget_listed_bonds() {
  for (int i = 0; i < atom->nlocal; i++) atom->num_bond[i] = 0;
  atom->nbonds = 0;
  listed_for_output_ = false;
}

// Bonds of a data file that nobody installed would be lost without a word.
void AtomVecBondedSphere::refuse_listed_bonds() {
  if (listed_for_output_) return;
  int any = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++) any = any || atom->num_bond[i] > 0;
  MPI_Allreduce(&any, &all, 1, MPI_INT, MPI_MAX, world);
  if (all)
    error->all(FLERR, "atom_style bonded/sphere: the data file has a `Bonds` section, and nothing installed these bonds: use `bond_install GROUP data`");
}

double AtomVecBondedSphere::mass_of(double r, double rho) const {
  const double pi = 3.14159265358979323846;
  return domain->dimension == 2 ? pi * r * r * thickness * rho : 4.0 / 3.0 * pi * r * r * r * rho;
}

int AtomVecBondedSphere::next_slot() const {
  return bonds.slots() > contacts.slots() ? bonds.slots() : contacts.slots();
}

void AtomVecBondedSphere::grow(int n) {
  if (n == 0)
    nmax += kGrowBy;
  else
    nmax = n;
  atom->nmax = nmax;
  if (nmax < 0 || nmax > MAXSMALLINT) error->one(FLERR, "Per-processor system is too big");

  tag = memory->grow(atom->tag, nmax, "atom:tag");
  type = memory->grow(atom->type, nmax, "atom:type");
  mask = memory->grow(atom->mask, nmax, "atom:mask");
  image = memory->grow(atom->image, nmax, "atom:image");
  x = memory->grow(atom->x, nmax, 3, "atom:x");
  v = memory->grow(atom->v, nmax, 3, "atom:v");
  f = memory->grow(atom->f, nmax * comm->nthreads, 3, "atom:f");
  radius = memory->grow(atom->radius, nmax, "atom:radius");
  density = memory->grow(atom->density, nmax, "atom:density");
  rmass = memory->grow(atom->rmass, nmax, "atom:rmass");
  omega = memory->grow(atom->omega, nmax, 3, "atom:omega");
  torque = memory->grow(atom->torque, nmax * comm->nthreads, 3, "atom:torque");
  memory->grow(xref, nmax, 3, "atom:xref");
  memory->grow(quat, nmax, 4, "atom:quat");
  memory->grow(saved_force, nmax, 6, "atom:saved_force");
  memory->grow(slot, nmax, "atom:slot");

  // the engine's own lists of bonds, empty but between read_data and bond_install, or in write_data
  const int old = atom->num_bond ? atom->nlocal : 0;
  memory->grow(atom->num_bond, nmax, "atom:num_bond");
  if (atom->bond_per_atom > 0) {
    memory->grow(atom->bond_type, nmax, atom->bond_per_atom, "atom:bond_type");
    memory->grow(atom->bond_atom, nmax, atom->bond_per_atom, "atom:bond_atom");
  }
  memory->grow(atom->nspecial, nmax, 3, "atom:nspecial");
  memory->grow(atom->special, nmax, atom->maxspecial, "atom:special");
  for (int i = old; i < nmax; i++) {
    atom->num_bond[i] = 0;
    atom->nspecial[i][0] = atom->nspecial[i][1] = atom->nspecial[i][2] = 0;
  }

  if (atom->nextra_grow)
    for (int k = 0; k < atom->nextra_grow; k++)
      modify->fix[atom->extra_grow[k]]->grow_arrays(nmax);
}

void AtomVecBondedSphere::grow_reset() {
  tag = atom->tag;
  type = atom->type;
  mask = atom->mask;
  image = atom->image;
  x = atom->x;
  v = atom->v;
  f = atom->f;
  radius = atom->radius;
  density = atom->density;
  rmass = atom->rmass;
  omega = atom->omega;
  torque = atom->torque;
}

void AtomVecBondedSphere::copy(int i, int j, int delflag) {
  tag[j] = tag[i];
  type[j] = type[i];
  mask[j] = mask[i];
  image[j] = image[i];
  radius[j] = radius[i];
  density[j] = density[i];
  rmass[j] = rmass[i];
  slot[j] = slot[i];
  for (int d = 0; d < 3; d++) {
    x[j][d] = x[i][d];
    v[j][d] = v[i][d];
    omega[j][d] = omega[i][d];
    xref[j][d] = xref[i][d];
  }
  for (int d = 0; d < 4; d++) quat[j][d] = quat[i][d];
  for (int d = 0; d < 6; d++) saved_force[j][d] = saved_force[i][d];

  if (atom->nextra_grow)
    for (int k = 0; k < atom->nextra_grow; k++)
      modify->fix[atom->extra_grow[k]]->copy_arrays(i, j, delflag);
}

// The engine's array of indices ends at the largest tag it knows of: that of a deleted particle may
// lie beyond.
int AtomVecBondedSphere::index_of(int t) const {
  return atom->map_style == 1 && t > atom->map_tag_max ? -1 : atom->map(t);
}

void AtomVecBondedSphere::index_tables() {
  if (!stale) return;
  stale = false;
  generation++;
  for (int i = 0; i < atom->nlocal; i++) slot[i] = i;
  const auto where = [this](int t) { return index_of(t); };
  const auto closest = [this](int a, int b) { return domain->closest_image(a, b); };

  if (bond_gone) bonds.remove_if(bond_gone);
  const int missing = bonds.index(atom->nlocal, where, closest);
  if (missing >= 0) {
    char text[512];
    snprintf(text, sizeof text,
             "Bond atoms %d %d missing at step " BIGINT_FORMAT
             ": one of the two bonded particles is not among this rank's particles and ghosts "
             "(ghost cutoff %g m). Either a particle was lost or deleted, or the specimen blew up "
             "(time step too large)",
             bonds.lo[missing], bonds.hi[missing], update->ntimestep, comm->cutghost[0]);
    error->one(FLERR, text);
  }
  // a contact whose partner left the ghost shell is long open
  contacts.remove_if([&](int r) { return where(contacts.lo[r]) < 0 || where(contacts.hi[r]) < 0; });
  contacts.index(atom->nlocal, where, closest);
}

namespace {

// The grid for coordinates of a direction with these bounds: shifted ones stay below 2^52 units, their own
// below 2^51, so that snap_to_grid() rounds.
double grid_of(double lo, double hi) {
  const double reach = 2.0 * std::max(std::fabs(lo), std::fabs(hi)) + (hi - lo);
  int exponent;
  std::frexp(reach, &exponent);
  return std::ldexp(1.0, exponent - 52);
}

}  // namespace

void AtomVecBondedSphere::find_grid() {
  for (int d = 0; d < 3; d++) {
    const bool used = domain->periodicity[d] && (d < 2 || domain->dimension == 3);
    grid[d] = used ? grid_of(domain->boxlo[d], domain->boxhi[d]) : 0.0;
  }
}

// Adding and taking away 1.5 2^52 units leaves whole units.
void AtomVecBondedSphere::snap_to_grid() {
  if (atom->nlocal == 0) return;
  for (int d = 0; d < 3; d++) {
    if (grid[d] == 0.0) continue;
    const double unit = 1.5 * 4503599627370496.0 * grid[d];
    double *p = x[0] + d;
    for (int i = 0; i < atom->nlocal; i++) p[3 * i] = (p[3 * i] + unit) - unit;
  }
}

void AtomVecBondedSphere::snap_box_to_grid() {
  find_grid();
  if (!on_grid()) return;
  for (int d = 0; d < 3; d++) {
    if (grid[d] == 0.0) continue;
    domain->boxlo[d] = grid[d] * std::round(domain->boxlo[d] / grid[d]);
    domain->boxhi[d] = grid[d] * std::round(domain->boxhi[d] / grid[d]);
  }
  domain->set_initial_box();
  domain->set_global_box();
  domain->set_local_box();
  snap_to_grid();
}

void AtomVecBondedSphere::set_reference_positions() {
  for (int i = 0; i < atom->nlocal; i++) domain->unmap(x[i], image[i], xref[i]);
}

void AtomVecBondedSphere::save_forces() {
  for (int i = 0; i < atom->nlocal; i++)
    for (int d = 0; d < 3; d++) {
      saved_force[i][d] = f[i][d];
      saved_force[i][3 + d] = torque[i][d];
    }
  saved_step = update->ntimestep;
}

bool AtomVecBondedSphere::restore_forces(bigint step) {
  if (saved_step != step) return false;
  for (int i = 0; i < atom->nlocal; i++)
    for (int d = 0; d < 3; d++) {
      f[i][d] = saved_force[i][d];
      torque[i][d] = saved_force[i][3 + d];
    }
  return true;
}

void AtomVecBondedSphere::create_atom(int itype, double *coord) {
  const int i = atom->nlocal;
  if (i == nmax) grow(0);
  tag[i] = 0;
  type[i] = itype;
  mask[i] = 1;
  image[i] = ((tagint)IMGMAX << IMG2BITS) | ((tagint)IMGMAX << IMGBITS) | IMGMAX;
  radius[i] = 0.5;
  density[i] = density_override > 0.0 ? density_override : 1.0;
  rmass[i] = mass_of(radius[i], density[i]);
  for (int d = 0; d < 3; d++) {
    x[i][d] = xref[i][d] = coord[d];
    v[i][d] = omega[i][d] = 0.0;
  }
  quat[i][0] = 1.0;
  quat[i][1] = quat[i][2] = quat[i][3] = 0.0;
  for (int d = 0; d < 6; d++) saved_force[i][d] = 0.0;
  atom->num_bond[i] = 0;
  atom->nspecial[i][0] = atom->nspecial[i][1] = atom->nspecial[i][2] = 0;
  slot[i] = next_slot();
  unpack_tables(i, NULL);  // no rows yet
  atom->nlocal++;
}

void AtomVecBondedSphere::data_atom(double *coord, tagint imagetmp, char **values) {
  const int i = atom->nlocal;
  create_atom(1, coord);
  tag[i] = atoi(values[0]);
  type[i] = atoi(values[1]);
  radius[i] = 0.5 * atof(values[2]);
  density[i] = density_override > 0.0 ? density_override : atof(values[3]);
  image[i] = imagetmp;
  const char *wrong = NULL;
  if (tag[i] <= 0) wrong = "the id must be a positive integer";
  if (type[i] <= 0 || type[i] > atom->ntypes) wrong = "the type must be between 1 and the number of atom types";
  if (!(radius[i] > 0.0)) wrong = "the diameter (m) must be positive";
  if (!(density[i] > 0.0)) wrong = "the density (kg/m3) must be positive";
  if (wrong) {
    char text[512];
    snprintf(text, sizeof text, "particle line `%s %s %s %s ...` of the data file: %s", values[0],
             values[1], values[2], values[3], wrong);
    error->one(FLERR, text);
  }
  rmass[i] = mass_of(radius[i], density[i]);
  domain->unmap(x[i], image[i], xref[i]);
}

void AtomVecBondedSphere::data_vel(int m, char **values) {
  for (int d = 0; d < 3; d++) {
    v[m][d] = atof(values[d]);
    omega[m][d] = atof(values[3 + d]);
  }
}

void AtomVecBondedSphere::fill_data(double **buf, int tag_offset) {
  for (int i = 0; i < atom->nlocal; i++) {
    buf[i][0] = ubuf(tag[i] + tag_offset).d;
    buf[i][1] = ubuf(type[i]).d;
    buf[i][2] = 2.0 * radius[i];
    buf[i][3] = density[i];
    for (int d = 0; d < 3; d++) buf[i][4 + d] = x[i][d];
    buf[i][7] = ubuf((image[i] & IMGMASK) - IMGMAX).d;
    buf[i][8] = ubuf((image[i] >> IMGBITS & IMGMASK) - IMGMAX).d;
    buf[i][9] = ubuf((image[i] >> IMG2BITS) - IMGMAX).d;
  }
}

void AtomVecBondedSphere::pack_data(double **buf) { fill_data(buf, 0); }
void AtomVecBondedSphere::pack_data(double **buf, int tag_offset) { fill_data(buf, tag_offset); }

void AtomVecBondedSphere::write_data(FILE *fp, int n, double **buf) {
  for (int i = 0; i < n; i++)
    fprintf(fp, "%d %d %.17g %.17g %.17g %.17g %.17g %d %d %d\n", (int)ubuf(buf[i][0]).i,
            (int)ubuf(buf[i][1]).i, buf[i][2], buf[i][3], buf[i][4], buf[i][5], buf[i][6],
            (int)ubuf(buf[i][7]).i, (int)ubuf(buf[i][8]).i, (int)ubuf(buf[i][9]).i);
}

void AtomVecBondedSphere::pack_vel(double **buf) { pack_vel(buf, 0); }

void AtomVecBondedSphere::pack_vel(double **buf, int tag_offset) {
  for (int i = 0; i < atom->nlocal; i++) {
    buf[i][0] = ubuf(tag[i] + tag_offset).d;
    for (int d = 0; d < 3; d++) {
      buf[i][1 + d] = v[i][d];
      buf[i][4 + d] = omega[i][d];
    }
  }
}

void AtomVecBondedSphere::write_vel(FILE *fp, int n, double **buf) {
  for (int i = 0; i < n; i++)
    fprintf(fp, "%d %.17g %.17g %.17g %.17g %.17g %.17g\n", (int)ubuf(buf[i][0]).i, buf[i][1],
            buf[i][2], buf[i][3], buf[i][4], buf[i][5], buf[i][6]);
}

bigint AtomVecBondedSphere::memory_usage() {
  const bigint per_particle = 4 * sizeof(int) + sizeof(tagint) + sizeof(double) * (3 * 5 + 3 + 3 + 4 + 6);
  return nmax * per_particle + (bigint)(bonds.bytes() + contacts.bytes());
}
