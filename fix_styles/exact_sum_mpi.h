// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: add up exact sums over all ranks: afterwards every rank holds the same exact sum.
//
// Method: the limbs are integers, so MPI_SUM on them is exact in any order. A message of N sums has
// 560 N bytes. Units: those of the sums. Failure: MPI's own.
#ifndef BONDLAB_EXACT_SUM_MPI_H
#define BONDLAB_EXACT_SUM_MPI_H

#include <mpi.h>

#include "exact_sum.h"

namespace bondlab {

inline void sum_over_ranks(ExactSum *sums, std::size_t count, MPI_Comm world) {
  static_assert(sizeof(ExactSum) == ExactSum::words * sizeof(std::int64_t));
  for (std::size_t i = 0; i < count; ++i) sums[i].prepare_to_send();
  MPI_Allreduce(MPI_IN_PLACE, sums->data(), static_cast<int>(count * ExactSum::words), MPI_INT64_T,
                MPI_SUM, world);
}

template <std::size_t N>
void sum_over_ranks(ExactSums<N> &sums, MPI_Comm world) {
  sum_over_ranks(sums.data(), N, world);
}

}  // namespace bondlab

#endif
