// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see compute_fragments.h.
#include "compute_fragments.h"

#include <cstdlib>
#include <cstring>
#include <string>

#include "atom.h"
#include "bond_styles/liggghts/bond_bpm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

// The run's parts, which only Pointers' children see.
class Gathering : protected Pointers {
 public:
  explicit Gathering(LAMMPS *lmp) : Pointers(lmp) {}

  std::vector<bondlab::Fragment> search(const char *who, double &count) {
    const AtomVecBondedSphere *style = AtomVecBondedSphere::of(lmp, who);
    std::vector<double> mine;
    for (int i = 0; i < atom->nlocal; i++) {
      double u[3];
      domain->unmap(atom->x[i], atom->image[i], u);
      mine.insert(mine.end(), {static_cast<double>(atom->tag[i]), atom->rmass[i], atom->density[i],
                               u[0], u[1], u[2], atom->v[i][0], atom->v[i][1], atom->v[i][2]});
    }
    const std::vector<double> all = everyone(mine);
    std::vector<bondlab::FragmentParticle> particles(all.size() / 9);
    for (std::size_t k = 0; k < particles.size(); k++) {
      const double *a = &all[9 * k];
      particles[k] = {a[0], a[1], a[2], {a[3], a[4], a[5]}, {a[6], a[7], a[8]}};
    }

    mine.clear();
    if (const BondBPM *bond = dynamic_cast<BondBPM *>(force->bond))
      for (int row = 0; row < style->bonds.size(); row++)
        if (bond->counted_here(row) && bond->intact(row))
          mine.insert(mine.end(), {static_cast<double>(style->bonds.lo[row]),
                                   static_cast<double>(style->bonds.hi[row])});
    const std::vector<double> tags = everyone(mine);
    std::vector<std::pair<int, int>> bonds(tags.size() / 2);
    for (std::size_t k = 0; k < bonds.size(); k++)
      bonds[k] = {static_cast<int>(tags[2 * k]), static_cast<int>(tags[2 * k + 1])};
    count = static_cast<double>(bonds.size());
    return bondlab::find_fragments(std::move(particles), bonds);
  }

 private:
  std::vector<double> everyone(const std::vector<double> &mine) {
    int ranks, n = static_cast<int>(mine.size()), total = 0;
    MPI_Comm_size(world, &ranks);
    std::vector<int> counts(ranks), starts(ranks);
    MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
    for (int r = 0; r < ranks; r++) starts[r] = total, total += counts[r];
    std::vector<double> all(total);
    MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                   world);
    return all;
  }
};

enum Part { FRAGMENTS, SINGLES, LARGEST, INTACT, PARTS };

}  // namespace

namespace LAMMPS_NS {
std::vector<bondlab::Fragment> fragments_of_run(LAMMPS *lmp, const char *who, double &bonds) {
  return Gathering(lmp).search(who, bonds);
}
}  // namespace LAMMPS_NS

ComputeFragments::ComputeFragments(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg) {
  AtomVecBondedSphere::of(lmp, "compute fragments");
  if (iarg < narg && strcmp(arg[iarg], "sizes") != 0)
    error->all(FLERR, (std::string("compute fragments: unknown word '") + arg[iarg] +
                       "', allowed is `sizes S1 S2 ...` (m)")
                          .c_str());
  for (int k = iarg + 1; k < narg; k++) {
    char *end = nullptr;
    const double size = strtod(arg[k], &end);
    if (*end != '\0' || !(size > 0.0))
      error->all(FLERR, (std::string("compute fragments: a size is '") + arg[k] +
                         "', it must be a number > 0 (m)")
                            .c_str());
    sieves_.push_back(size);
  }
  vector_flag = 1;
  size_vector = PARTS + static_cast<int>(sieves_.size());
  extvector = 0;
  vector = new double[size_vector];
}

ComputeFragments::~ComputeFragments() { delete[] vector; }

void ComputeFragments::compute_vector() {
  invoked_vector = update->ntimestep;
  const auto fragments = fragments_of_run(lmp, "compute fragments", vector[INTACT]);
  double mass = 0.0, several = 0.0, single = 0.0;
  for (const bondlab::Fragment &f : fragments) {
    mass += f.mass;
    (f.particles > 1 ? several : single) += 1.0;
  }
  vector[FRAGMENTS] = several;
  vector[SINGLES] = single;
  vector[LARGEST] = fragments.empty() ? 0.0 : fragments.front().mass / mass;
  for (std::size_t k = 0; k < sieves_.size(); k++)
    vector[PARTS + k] = bondlab::passing(fragments, sieves_[k]);
}
