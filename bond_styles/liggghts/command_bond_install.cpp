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
#include "laws/parallel.h"
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
  const bool data = narg > 1 && !strcmp(arg[1], "data");
  if (narg < (data ? 2 : 3))
    bad("expected `bond_install GROUP gap GAP [keywords]`, `bond_install GROUP file FILE [keywords]` or `bond_install GROUP data [keywords]`");
  const int group_index = group->find(arg[0]);
  if (group_index < 0) bad(std::string("there is no group '") + arg[0] + "'");
  group_bit_ = group->bitmask[group_index];
  missing_ = Missing();
  int type = 1;
  for (int k = data ? 2 : 3; k < narg;) k = keyword(narg, arg, k, type);
  if (type < 1 || type > atom->nbondtypes)
    bad("bond type " + std::to_string(type) + " is not between 1 and " +
        std::to_string(atom->nbondtypes) + " (`bond types` in the data file)");

  if (!data) style_of(type);

  int mine;
  if (!strcmp(arg[1], "gap")) {
    const double gap = bondlab::read_number(arg[2]);
    if (!std::isfinite(gap) || gap < 0.0)
      bad(std::string("gap is ") + arg[2] + " m, it must be 0 or positive");
    mine = by_gap(gap, type);
  } else if (!strcmp(arg[1], "file")) {
    const std::vector<int> pairs = read_pairs(arg[2]);
    mine = from_pairs(pairs, std::vector<int>(pairs.size() / 2, type), arg[2]);
  } else if (data) {
    std::vector<int> types;
    const std::vector<int> pairs = pairs_of_data_file(types);
    mine = from_pairs(pairs, types, "the data file");
  } else {
    bad(std::string("unknown word '") + arg[1] + "', allowed are gap, file and data");
  }
  style_->set_reference_positions();
  // now, while the ghosts are here: particles that change rank before the first step take their
  // bonds with them only if these are in order
  style_->mark_stale();
  style_->index_tables();

  bigint count = mine, total = 0, absent = 0;
  MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  MPI_Allreduce(&missing_.count, &absent, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (total == 0) bad("no pair of particles is within reach: the packing doesn't touch, or the gap is too small");
  if (comm->me == 0) {
    const char *form = "  " BIGINT_FORMAT " bonds installed, %.3f a particle\n";
    const char *cracks = "  " BIGINT_FORMAT " pairs left without their bond\n";
    const double each = 2.0 * (total - absent) / atom->natoms;
    for (FILE *out : {screen, logfile}) {
      if (out) fprintf(out, form, total - absent, each);
      if (out && absent) fprintf(out, cracks, absent);
    }
  }
}

BondBPM *CommandBondInstall::style_of(int type) const {
  for (BondBPM *style : BondBPM::all(lmp))
    if (style->mine(type)) return style;
  bad("give `bond_coeff` for bond type " + std::to_string(type) + " before `bond_install`");
}

// Reads the keyword at arg[k] and its values; returns where the next one stands.
int CommandBondInstall::keyword(int narg, char **arg, int k, int &type) {
  const std::string word = arg[k];
  const auto number = [&](int place, double least, double most, const char *allowed) {
    if (place >= narg) bad("'" + word + "' has too few values");
    const double v = bondlab::read_number(arg[place]);
    if (!(v >= least && v <= most))
      bad(word + " is " + arg[place] + ", it must be " + allowed);
    return v;
  };
  if (word == "type") {
    type = static_cast<int>(number(k + 1, 1, 65535, "a bond type"));
    return k + 2;
  }
  if (word == "missing") {
    missing_.fraction = number(k + 1, 0.0, 1.0, "a share between 0 and 1");
    return k + 2;
  }
  if (word == "open") {
    missing_.open = number(k + 1, 0.0, 1e300, "a distance, 0 or positive, m");
    return k + 2;
  }
  if (word == "seed") {
    const double seed = number(k + 1, 0.0, 1e15, "a whole number, 0 or positive");
    if (seed != std::floor(seed)) bad(std::string("seed is ") + arg[k + 1] + ", it must be a whole number");
    missing_.seed = static_cast<std::uint64_t>(seed);
    return k + 2;
  }
  if (word == "orientation") {
    double length2 = 0.0;
    for (int d = 0; d < 3; d++) {
      missing_.normal[d] = number(k + 1 + d, -1e300, 1e300, "three numbers");
      length2 += missing_.normal[d] * missing_.normal[d];
    }
    if (!(length2 > 0.0)) bad("orientation is 0 0 0, it must be a direction");
    for (double &n : missing_.normal) n /= std::sqrt(length2);
    const double angle = number(k + 4, 0.0, 90.0, "an angle between 0 and 90 degrees");
    missing_.least_cosine = angle >= 90.0 ? -1.0 : std::cos(angle * bondlab::laws::kPi / 180.0);
    return k + 5;
  }
  bad("unknown word '" + word + "', allowed are type, missing, orientation, open, seed");
}

// A pair whose bond is missing from the start: a crack. The same choice on any number of ranks.
bool CommandBondInstall::is_missing(const double *xi, const double *xj, int tag_i, int tag_j,
                                    double distance) const {
  if (missing_.fraction <= 0.0) return false;
  double along = 0.0;
  for (int d = 0; d < 3; d++) along += (xj[d] - xi[d]) * missing_.normal[d];
  if (std::fabs(along) < missing_.least_cosine * distance) return false;
  constexpr std::uint64_t stream = 17;  // apart from those of strengths
  return bondlab::laws::uniform_of_pair(tag_i, tag_j, missing_.seed, stream) < missing_.fraction;
}

// Ghosts out to `reach`, with neighbour lists initialised as a run would.
void CommandBondInstall::ghosts(double reach) {
  comm->cutghostuser = std::max(comm->cutghostuser, reach);
  style_->snap_box_to_grid();
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
  style_of(type)->create(atom->x[a], atom->x[b], style_->quat[a], style_->quat[b],
                      values.data() + BondBPM::LAW);
  int information = type;
  if (is_missing(atom->x[a], atom->x[b], atom->tag[a], atom->tag[b], distance)) {
    // a broken row from the beginning: contact only, after an open crack has closed
    information |= BondBPM::BROKEN | BondBPM::MISSING;
    if (missing_.open > 0.0) {
      information |= BondBPM::SEPARATED;
      values[BondBPM::REFERENCE] -= missing_.open;
    }
    missing_.count += a < atom->nlocal;
  }
  style_->bonds.append(atom->tag[a], atom->tag[b], information, values.data());
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
std::vector<int> CommandBondInstall::read_pairs(const char *file) {
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
  return pairs;
}

// The `Bonds` section of the data file, as the engine has read it: each bond with both its particles.
// The engine's own list is emptied: it is not what this package computes with.
std::vector<int> CommandBondInstall::pairs_of_data_file(std::vector<int> &types) {
  std::vector<int> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    for (int m = 0; m < atom->num_bond[i]; m++)
      if (atom->tag[i] < atom->bond_atom[i][m]) {
        mine.push_back(atom->tag[i]);
        mine.push_back(atom->bond_atom[i][m]);
        mine.push_back(atom->bond_type[i][m]);
      }
    atom->num_bond[i] = 0;
  }
  int n = mine.size(), total = 0;
  std::vector<int> counts(comm->nprocs), places(comm->nprocs, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int r = 0; r < comm->nprocs; r++) {
    places[r] = total;
    total += counts[r];
  }
  std::vector<int> all(total), pairs;
  MPI_Allgatherv(mine.data(), n, MPI_INT, all.data(), counts.data(), places.data(), MPI_INT, world);
  for (int k = 0; k < total; k += 3) {
    pairs.insert(pairs.end(), {all[k], all[k + 1]});
    types.push_back(all[k + 2]);
  }
  return pairs;
}

int CommandBondInstall::from_pairs(const std::vector<int> &pairs, const std::vector<int> &types,
                                   const std::string &source) {
  const int n = pairs.size();
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
    install(i, j, types[k]);
    if (own_a) count++;
  }
  MPI_Allreduce(found.data(), anywhere.data(), n / 2, MPI_INT, MPI_MAX, world);
  for (int k = 0; k < n / 2; k++)
    if (!anywhere[k])
      bad(source + ": the particles " + std::to_string(pairs[2 * k]) + " and " +
          std::to_string(pairs[2 * k + 1]) + " are missing or further apart than four of the largest radii");
  return count;
}
