// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see fix_bond_log.h.
#include "fix_bond_log.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "bond_bpm.h"
#include "comm.h"
#include "fix_arguments.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using bondlab::number_text;

namespace {
const char *const kModes[] = {"tension", "shear", "crushing"};  // by BreakEvent::mode
}

FixBondLog::FixBondLog(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg),
      table_(lmp, this, "bondlab-broken-bonds 1"),
      particles_(NULL),
      gathered_{0, 0, 0} {
  vector_flag = 1;
  size_vector = 4;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;

  FixArguments a(lmp, this, narg, arg);
  nevery = a.count("the number of steps between two gatherings");
  table_.path = a.word("the file name");
  table_.append = a.next_is("append");
  if (a.more()) a.unknown_keyword("append");
  table_.names = {"step", "time", "id1",   "id2", "type",    "x",    "y",
                  "z",    "mode", "sigma", "tau", "sigma_c", "tau_c"};
  table_.units = {"1", "s", "1", "1", "1", "m", "m", "m", "1", "Pa", "Pa", "Pa", "Pa"};
}

int FixBondLog::setmask() { return END_OF_STEP | POST_RUN; }

void FixBondLog::init() {
  particles_ = AtomVecBondedSphere::of(lmp, "fix bond/log");
  if (BondBPM::all(lmp).empty())
    stop_with_error(lmp, this,
                    std::string("needs a bond style of bonded particles, like "
                                "`bond_style parallel`; this run has '") +
                        (force->bond_style ? force->bond_style : "none") + "'");
}

void FixBondLog::setup(int) {
  table_.setup();
  gather();
}

void FixBondLog::end_of_step() { gather(); }

void FixBondLog::post_run() {
  gather();
  table_.finish();
}

void FixBondLog::gather() {
  static_assert(std::is_trivially_copyable<BreakEvent>::value, "sent between ranks as bytes");
  std::vector<BreakEvent> &mine = particles_->breaks;
  long long count = static_cast<long long>(mine.size()), all = 0;
  MPI_Allreduce(&count, &all, 1, MPI_LONG_LONG, MPI_SUM, world);
  if (all == 0) return;

  std::vector<int> bytes(comm->nprocs), place(comm->nprocs);
  const int mine_bytes = static_cast<int>(count * sizeof(BreakEvent));
  MPI_Allgather(&mine_bytes, 1, MPI_INT, bytes.data(), 1, MPI_INT, world);
  for (int r = 1; r < comm->nprocs; r++) place[r] = place[r - 1] + bytes[r - 1];
  std::vector<BreakEvent> events(all);
  MPI_Allgatherv(mine.data(), mine_bytes, MPI_BYTE, events.data(), bytes.data(), place.data(),
                 MPI_BYTE, world);
  mine.clear();
  std::sort(events.begin(), events.end(), [](const BreakEvent &a, const BreakEvent &b) {
    return std::tie(a.step, a.tag_lo, a.tag_hi) < std::tie(b.step, b.tag_lo, b.tag_hi);
  });
  for (const BreakEvent &e : events) {
    gathered_[e.mode]++;
    table_.row(e.step, {number_text(table_.time_at(e.step)), std::to_string(e.tag_lo),
                        std::to_string(e.tag_hi), std::to_string(e.type), number_text(e.x[0]),
                        number_text(e.x[1]), number_text(e.x[2]), kModes[e.mode],
                        number_text(e.sigma), number_text(e.tau), number_text(e.sigma_c),
                        number_text(e.tau_c)});
  }
}

double FixBondLog::compute_vector(int n) {
  double count[3] = {0, 0, 0};
  if (particles_)
    for (const BreakEvent &e : particles_->breaks) count[e.mode] += 1.0;
  MPI_Allreduce(MPI_IN_PLACE, count, 3, MPI_DOUBLE, MPI_SUM, world);
  for (int k = 0; k < 3; k++) count[k] += static_cast<double>(gathered_[k]);
  return n == 0 ? count[0] + count[1] + count[2] : count[n - 1];
}

void FixBondLog::reset_timestep(bigint to, bigint from) { table_.clock.renumber(to, from); }

namespace {
struct LogState {
  bigint gathered[3];
  bondlab::StepClock clock;
};
}  // namespace

// The counts go with the restart, and what is counted is in the file.
void FixBondLog::write_restart(FILE *fp) {
  if (table_.is_open()) gather();
  if (comm->me != 0) return;
  const LogState state = {{gathered_[0], gathered_[1], gathered_[2]}, table_.clock};
  const int size = sizeof state;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&state, sizeof state, 1, fp);
}

void FixBondLog::restart(char *buf) {
  LogState state;
  std::memcpy(&state, buf, sizeof state);
  std::copy(state.gathered, state.gathered + 3, gathered_);
  table_.clock = state.clock;
}
