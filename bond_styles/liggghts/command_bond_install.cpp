// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see command_bond_install.h.
#include "command_bond_install.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "bond_bpm.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "neighbor.h"
#include "read_number.h"

using namespace LAMMPS_NS;

void CommandBondInstall::bad(const std::string &text) const {
  error->all(FLERR, ("bond_install: " + text).c_str());
  abort();
}

void CommandBondInstall::command(int narg, char **arg) {
  if (!domain->box_exist) bad("read a specimen first (read_data or read_restart)");
  style_ = AtomVecBondedSphere::of(lmp, "bond_install");
  if (BondBPM::all(lmp).empty())
    bad("give `bond_style` (a BondLab style) before `bond_install`");
  if (!force->pair) bad("give `pair_style grain` before `bond_install`: it sets the reach of neighbour lists");
  if (narg < 3)
    bad("expected `bond_install GROUP gap GAP [type N]` or `bond_install GROUP file FILE [type N]`");
  const int group_index = group->find(arg[0]);
  if (group_index < 0) bad(std::string("there is no group '") + arg[0] + "'");
  group_bit_ = group->bitmask[group_index];
  int type = 1;
  if (narg > 3) {
    if (narg != 5 || strcmp(arg[3], "type") != 0)
      bad(std::string("unknown word '") + arg[3] + "', allowed is `type N`");
    type = force->inumeric(FLERR, arg[4]);
  }
  if (type < 1 || type > atom->nbondtypes)
    bad("bond type " + std::to_string(type) + " is not between 1 and " +
        std::to_string(atom->nbondtypes) + " (`bond types` in the data file)");

  bond_style_ = NULL;
  for (BondBPM *style : BondBPM::all(lmp))
    if (style->mine(type)) bond_style_ = style;
  if (!bond_style_)
    bad("give `bond_coeff` for bond type " + std::to_string(type) + " before `bond_install`");

  int mine;
  if (!strcmp(arg[1], "gap")) {
    const double gap = bondlab::read_number(arg[2]);
    if (!std::isfinite(gap) || gap < 0.0)
      bad(std::string("gap is ") + arg[2] + " m, it must be 0 or positive");
    mine = by_gap(gap, type);
  } else if (!strcmp(arg[1], "file")) {
    mine = from_file(arg[2], type);
  } else {
    bad(std::string("unknown word '") + arg[1] + "', allowed are gap and file");
  }
  style_->set_reference_positions();
  // now, while the ghosts are here: particles that change rank before the first step take their
  // bonds with them only if these are in order
  style_->mark_stale();
  style_->index_tables();

  bigint count = mine, total = 0;
  MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (total == 0) bad("no pair of particles is within reach: the packing doesn't touch, or the gap is too small");
  if (comm->me == 0) {
    const char *form = "%s " BIGINT_FORMAT " bonds installed, %.3f a particle\n";
    const double each = 2.0 * total / atom->natoms;
    if (screen) fprintf(screen, form, " ", total, each);
    if (logfile) fprintf(logfile, form, " ", total, each);
  }
}

// Ghosts out to `reach`, with neighbour lists initialised as a run would.
void CommandBondInstall::ghosts(double reach) {
  comm->cutghostuser = std::max(comm->cutghostuser, reach);
  lmp->init();
  if (domain->triclinic) bad("triclinic boxes are not supported");
  domain->pbc();
  domain->reset_box();
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
  comm->exchange();
  comm->borders();
}

void CommandBondInstall::install(int a, int b, int type) {
  double distance2 = 0.0;
  for (int d = 0; d < 3; d++)
    distance2 += (atom->x[a][d] - atom->x[b][d]) * (atom->x[a][d] - atom->x[b][d]);
  const double distance = std::sqrt(distance2);
  std::vector<double> values(style_->bonds.columns(), 0.0);
  values[BondBPM::REST] = values[BondBPM::REFERENCE] = distance;
  if (atom->tag[a] > atom->tag[b]) std::swap(a, b);
  bond_style_->create(atom->x[a], atom->x[b], style_->quat[a], style_->quat[b],
                      values.data() + BondBPM::LAW);
  style_->bonds.append(atom->tag[a], atom->tag[b], type, values.data());
}

// Cells of the size of the reach; every own particle looks at its own and the neighbouring cells.
int CommandBondInstall::by_gap(double gap, int type) {
  double largest = 0.0, all = 0.0;
  for (int i = 0; i < atom->nlocal; i++) largest = std::max(largest, atom->radius[i]);
  MPI_Allreduce(&largest, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  const double reach = (2.0 * all + gap) * 1.01;
  ghosts(1.5 * reach + neighbor->skin);

  const int n = atom->nlocal + atom->nghost;
  const bool flat = domain->dimension == 2;
  std::unordered_map<long long, std::vector<int>> cells;
  const auto cell = [&](const double *x, int dx, int dy, int dz) {
    const long long a = (long long)std::floor(x[0] / reach) + dx;
    const long long b = (long long)std::floor(x[1] / reach) + dy;
    const long long c = flat ? 0 : (long long)std::floor(x[2] / reach) + dz;
    return ((a & 0x1fffff) << 42) | ((b & 0x1fffff) << 21) | (c & 0x1fffff);
  };
  for (int i = 0; i < n; i++) cells[cell(atom->x[i], 0, 0, 0)].push_back(i);
  int count = 0;
  const int depth = flat ? 0 : 1;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & group_bit_)) continue;
    for (int dx = -1; dx <= 1; dx++)
      for (int dy = -1; dy <= 1; dy++)
        for (int dz = -depth; dz <= depth; dz++) {
          const auto found = cells.find(cell(atom->x[i], dx, dy, dz));
          if (found == cells.end()) continue;
          for (const int j : found->second) {
            if (i == j || !(atom->mask[j] & group_bit_) || atom->tag[i] == atom->tag[j]) continue;
            double d2 = 0.0;
            for (int d = 0; d < 3; d++)
              d2 += (atom->x[i][d] - atom->x[j][d]) * (atom->x[i][d] - atom->x[j][d]);
            const double limit = atom->radius[i] + atom->radius[j] + gap;
            if (d2 > limit * limit) continue;
            // a pair of own particles is met twice and installed once; a cut pair on both sides
            const bool own = j < atom->nlocal;
            if (own && atom->tag[i] > atom->tag[j]) continue;
            install(i, j, type);
            if (atom->tag[i] < atom->tag[j]) count++;
          }
        }
  }
  return count;
}

// Pairs `id1 id2` counted as the particles' ids are (from 1), `#` comments.
int CommandBondInstall::from_file(const char *file, int type) {
  std::vector<int> pairs;
  if (comm->me == 0) {
    FILE *fp = fopen(file, "r");
    if (!fp) error->one(FLERR, (std::string("bond_install: can't open ") + file).c_str());
    char line[256];
    for (int number = 1; fgets(line, sizeof line, fp); number++) {
      int a, b;
      char more;
      if (line[0] == '#' || line[0] == '\n') continue;
      if (sscanf(line, "%d %d %c", &a, &b, &more) != 2 || a < 1 || b < 1 || a == b) {
        const std::string text = std::string("bond_install: ") + file + ":" +
                                 std::to_string(number) +
                                 ": expected two different positive ids, found `" +
                                 std::string(line, strcspn(line, "\n")) + "`";
        fclose(fp);
        error->one(FLERR, text.c_str());
      }
      pairs.push_back(a);
      pairs.push_back(b);
    }
    fclose(fp);
  }
  int n = pairs.size();
  MPI_Bcast(&n, 1, MPI_INT, 0, world);
  pairs.resize(n);
  MPI_Bcast(pairs.data(), n, MPI_INT, 0, world);

  double largest = 0.0, all = 0.0;
  for (int i = 0; i < atom->nlocal; i++) largest = std::max(largest, atom->radius[i]);
  MPI_Allreduce(&largest, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  ghosts(4.0 * all + neighbor->skin);
  std::vector<int> found(n / 2, 0), anywhere(n / 2, 0);  // the pair is complete on a rank
  int count = 0;
  for (int k = 0; k < n / 2; k++) {
    const int a = style_->index_of(std::min(pairs[2 * k], pairs[2 * k + 1]));
    const int b = style_->index_of(std::max(pairs[2 * k], pairs[2 * k + 1]));
    if (a < 0 || b < 0) continue;
    const bool own_a = a < atom->nlocal;
    if (!own_a && b >= atom->nlocal) continue;
    const int i = own_a ? a : b, j = domain->closest_image(i, own_a ? b : a);
    double d2 = 0.0;
    for (int d = 0; d < 3; d++)
      d2 += (atom->x[i][d] - atom->x[j][d]) * (atom->x[i][d] - atom->x[j][d]);
    if (d2 > 16.0 * all * all) continue;
    found[k] = 1;
    install(i, j, type);
    if (own_a) count++;
  }
  MPI_Allreduce(found.data(), anywhere.data(), n / 2, MPI_INT, MPI_MAX, world);
  for (int k = 0; k < n / 2; k++)
    if (!anywhere[k])
      bad(std::string(file) + ": the particles " + std::to_string(pairs[2 * k]) + " and " +
          std::to_string(pairs[2 * k + 1]) + " are missing or further apart than four of the largest radii");
  return count;
}
