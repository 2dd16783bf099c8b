// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one contiguous store of pairs of particles (bonds, or contacts with history) on this rank,
// keyed by the two permanent tags.
//
// Each rank holds every pair of which it owns at least one particle; a pair cut by a rank boundary
// is held, and computed, on both sides from the same numbers, so both take the same decisions
// without asking each other. Rows are kept in lexicographic order of (smaller tag, larger tag).
// Adding up the rows in this order gives every particle its contributions in the order of its
// partners' tags, whatever the ranks: that is what makes 1, 2 and 4 ranks agree bit for bit. It also
// reads memory in order, since tags are sorted in space when a specimen is made.
//
// Between two rebuilds of the neighbour list particles may leave and arrive several times. Each
// particle carries a slot (kept by the atom style), and each slot names the rows of that particle:
// rows arriving with a particle are appended with a new slot, doubles are dropped when the table is
// put in order again (index()).
//
// Row = tags, an integer the owner of the table may use (type, flags), and `columns` doubles of
// state. State is kept by blocks of kBlock rows, all columns of a block together: a step walks through
// one stretch of memory, not through as many as there are columns (on 175,000 bonds the latter took
// a third longer). Engine-free plain arrays; memory per row: 7 int + columns double.
//
// Failure: index() reports the first row whose partner is neither here nor a ghost.
#ifndef BONDLAB_PAIR_TABLE_H
#define BONDLAB_PAIR_TABLE_H

#include <functional>
#include <vector>

#include "huge_vector.h"
#include "laws/bond_batch.h"

namespace bondlab {

class PairTable {
 public:
  explicit PairTable(int columns);

  int size() const { return static_cast<int>(lo.size()); }
  int columns() const { return columns_; }
  int padded() const { return (size() + laws::kBlock - 1) / laws::kBlock * laws::kBlock; }
  // More columns, 0 in the rows that are here.
  void widen(int columns);

  // [size] tags of the two particles, lo < hi, and the owner's integer
  std::vector<int> lo, hi, info;
  double &value(int column, int row) { return *place(column, row); }
  double value(int column, int row) const { return *const_cast<PairTable *>(this)->place(column, row); }
  // The kBlock values of a column in the block that begins at row `first`.
  double *block(int column, int first) { return place(column, first); }
  // [padded] where the two particles are: `at_*` positions (maybe a ghost image),
  // `own_*` where their force goes (the local particle if it is here)
  std::vector<int> at_lo, at_hi, own_lo, own_hi;

  void clear();
  // Appends a row; order is restored by index(). Returns its number.
  int append(int tag_a, int tag_b, int information, const double *values);
  // Row of a pair, or -1. Valid after index(), until rows are appended.
  int find(int tag_a, int tag_b) const;
  // Removes rows for which `dead(row)`; call before index().
  void remove_if(const std::function<bool(int)> &dead);

  // Brings rows in order, drops doubles and rows without a local particle, and finds the particles.
  //   tag_to_index: index of a tag here (local preferred), -1 if absent
  //   closest:      image of particle b nearest to particle a
  //   nlocal:       particles owned by this rank
  // Returns the number of the first row with a missing partner, or -1.
  // Afterwards slot s of particle s (s < nlocal) names its rows.
  int index(int nlocal, const std::function<int(int)> &tag_to_index,
            const std::function<int(int, int)> &closest);

  // Migration and restart of the rows of one particle, by its slot.
  int packed_size(int slot) const;                // doubles
  int pack(int slot, double *buffer) const;       // returns doubles written
  int unpack(const double *buffer, int new_slot); // returns doubles read; appends rows
  int slots() const { return static_cast<int>(slot_end_.size()); }
  int rows_of(int slot) const {  // 0 for a slot this table never named
    return slot < slots() ? slot_end_[slot] - slot_begin_[slot] : 0;
  }
  int row_of(int slot, int k) const { return slot_rows_[slot_begin_[slot] + k]; }
  int longest_slot() const;

  double bytes() const;
  // Asks for the state of a block ahead of its use: its columns are too short for the processor to
  // foresee them.
  void prefetch(int first) {
    const double *p = block(0, first);
    for (int k = 0; k < columns_ * laws::kBlock; k += 8) __builtin_prefetch(p + k, 1, 2);
  }

 private:
  int columns_;
  HugeVector state_;  // [blocks][columns][kBlock]
  double *place(int column, int row) {
    const std::size_t b = row / laws::kBlock, lane = row % laws::kBlock;
    return state_.data() + (b * columns_ + column) * laws::kBlock + lane;
  }
  void resize_state();
  std::vector<int> slot_begin_, slot_end_, slot_rows_;

  void reorder(const std::vector<int> &order);
  void pad();
};

}  // namespace bondlab

#endif
