// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_bonded_box.h.
#include "fix_bonded_box.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

constexpr double kReach = 20;          // largest sides of the start's box beyond it
constexpr double kFewBins = 1 << 20;   // 4 MB
constexpr double kBinsPerGrain = 100;  // a specimen in the box of its file has some 45
constexpr double kLargestBin = 40;     // usual ones; the engine refuses a flat box's at 100

}  // namespace

FixBondedBox::FixBondedBox(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), far_(0.0), larger_bins_(false) {
  for (int d = 0; d < 3; d++) {
    start_lo_[d] = domain->boxlo[d];
    start_hi_[d] = domain->boxhi[d];
    far_ = std::max(far_, kReach * (start_hi_[d] - start_lo_[d]));
  }
}

int FixBondedBox::setmask() { return PRE_EXCHANGE; }

void FixBondedBox::watch() {
  if (domain->nonperiodic != 2) return;
  double mine[6], all[6];  // -lo, hi
  for (int d = 0; d < 3; d++) mine[d] = -start_lo_[d], mine[3 + d] = start_hi_[d];
  for (int i = 0; i < atom->nlocal; i++) {
    check_grain(i);
    for (int d = 0; d < 3; d++) {
      mine[d] = std::max(mine[d], -atom->x[i][d]);
      mine[3 + d] = std::max(mine[3 + d], atom->x[i][d]);
    }
  }
  MPI_Allreduce(mine, all, 6, MPI_DOUBLE, MPI_MAX, world);
  double lo[3], hi[3];
  for (int d = 0; d < 3; d++) lo[d] = -all[d], hi[d] = all[3 + d];
  bound_bins(lo, hi);
}

void FixBondedBox::check_grain(int i) {
  const double *x = atom->x[i];
  bool near = true;
  for (int d = 0; d < 3; d++) {
    // a fixed side loses what passes it, a periodic one takes it back
    const bool grows_down = domain->boundary[d][0] >= 2, grows_up = domain->boundary[d][1] >= 2;
    if (std::isnan(x[d])) near = false;
    if ((grows_down && x[d] < start_lo_[d] - far_) || (grows_up && x[d] > start_hi_[d] + far_))
      near = false;
  }
  if (near) return;
  char text[256];
  if (std::isnan(x[0]) || std::isnan(x[1]) || std::isnan(x[2]))
    std::snprintf(text, sizeof text,
                  "the position of atom %d is not a number: %g %g %g at step " BIGINT_FORMAT,
                  atom->tag[i], x[0], x[1], x[2], update->ntimestep);
  else
    std::snprintf(text, sizeof text,
                  "atom %d has flown to %g %g %g m at step " BIGINT_FORMAT
                  ", more than %g box sides (%g m) beyond the box of the start",
                  atom->tag[i], x[0], x[1], x[2], update->ntimestep, kReach, far_);
  error->one(FLERR, text);
}

// Of the neighbour lists and of the sorting of particles, which by themselves are half a cutoff
// wide.
void FixBondedBox::bound_bins(const double *lo, const double *hi) {
  const double usual = 0.5 * neighbor->cutneighmax;
  if (!(usual > 0.0)) return;
  const int dimensions = domain->dimension;
  double bins = 1.0;
  for (int d = 0; d < dimensions; d++) bins *= std::max(1.0, (hi[d] - lo[d]) / usual);
  const double most = std::max(kFewBins, kBinsPerGrain * static_cast<double>(atom->natoms));
  if (bins <= most && !larger_bins_) return;
  larger_bins_ = bins > most;
  const double factor = std::min(kLargestBin, std::pow(bins / most, 1.0 / dimensions)),
               width = larger_bins_ ? factor * usual : 0.0;  // 0: as the engine sets it
  char size[64], every[32], binsize[] = "binsize", sort[] = "sort";
  std::snprintf(size, sizeof size, "%.17g", width);
  std::snprintf(every, sizeof every, "%d", atom->sortfreq);
  char *lists[] = {binsize, size}, *sorting[] = {sort, every, size};
  neighbor->modify_params(2, lists);
  if (atom->sortfreq > 0) atom->modify_params(3, sorting);
}
