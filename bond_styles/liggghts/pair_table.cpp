// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see pair_table.h.
#include "pair_table.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "laws/bond_batch.h"

namespace bondlab {
namespace {

double two_ints(int a, int b) {
  const std::int32_t both[2] = {a, b};
  double d;
  std::memcpy(&d, both, sizeof d);
  return d;
}

void split_ints(double d, int &a, int &b) {
  std::int32_t both[2];
  std::memcpy(both, &d, sizeof d);
  a = both[0];
  b = both[1];
}

template <class T>
void permute(std::vector<T> &v, const std::vector<int> &order) {
  std::vector<T> w(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) w[k] = v[order[k]];
  v.swap(w);
}

}  // namespace

PairTable::PairTable(int columns) : columns_(columns) {}

void PairTable::resize_state() {
  state_.resize(static_cast<std::size_t>(padded()) * columns_, 0.0);
}

void PairTable::widen(int columns) {
  if (columns <= columns_) return;
  PairTable wide(columns);
  wide.lo = lo;
  wide.resize_state();
  for (int row = 0; row < size(); ++row)
    for (int c = 0; c < columns_; ++c) wide.value(c, row) = value(c, row);
  state_.swap(wide.state_);
  columns_ = columns;
}

void PairTable::clear() {
  for (auto *v : {&lo, &hi, &info, &at_lo, &at_hi, &own_lo, &own_hi}) v->clear();
  state_.clear();
  slot_begin_.clear();
  slot_end_.clear();
  slot_rows_.clear();
}

int PairTable::append(int tag_a, int tag_b, int information, const double *values) {
  const int row = size();
  lo.push_back(std::min(tag_a, tag_b));
  hi.push_back(std::max(tag_a, tag_b));
  info.push_back(information);
  resize_state();
  for (int c = 0; c < columns_; ++c) value(c, row) = values[c];
  return row;
}

int PairTable::find(int tag_a, int tag_b) const {
  const int a = std::min(tag_a, tag_b), b = std::max(tag_a, tag_b);
  int first = 0, count = size();
  while (count > 0) {
    const int half = count / 2, mid = first + half;
    if (lo[mid] < a || (lo[mid] == a && hi[mid] < b)) {
      first = mid + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return first < size() && lo[first] == a && hi[first] == b ? first : -1;
}

void PairTable::remove_if(const std::function<bool(int)> &dead) {
  std::vector<int> keep;
  keep.reserve(size());
  for (int row = 0; row < size(); ++row)
    if (!dead(row)) keep.push_back(row);
  if (static_cast<int>(keep.size()) != size()) reorder(keep);
}

void PairTable::reorder(const std::vector<int> &order) {
  permute(lo, order);
  permute(hi, order);
  permute(info, order);
  PairTable ordered(columns_);
  ordered.lo = lo;
  ordered.resize_state();
  for (int row = 0; row < size(); ++row)
    for (int c = 0; c < columns_; ++c) ordered.value(c, row) = value(c, order[row]);
  state_.swap(ordered.state_);
}

void PairTable::pad() {
  const int n = size(), all = padded();
  for (auto *v : {&at_lo, &at_hi, &own_lo, &own_hi}) v->resize(all, n ? v->at(n - 1) : 0);
  for (int row = n; row < all; ++row)
    for (int c = 0; c < columns_; ++c) value(c, row) = value(c, n - 1);
}

int PairTable::index(int nlocal, const std::function<int(int)> &tag_to_index,
                     const std::function<int(int, int)> &closest) {
  std::vector<int> order(size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [this](int a, int b) {
    return lo[a] != lo[b] ? lo[a] < lo[b] : hi[a] < hi[b];
  };
  const auto same = [this](int a, int b) { return lo[a] == lo[b] && hi[a] == hi[b]; };
  if (!std::is_sorted(order.begin(), order.end(), before))
    std::stable_sort(order.begin(), order.end(), before);
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  const auto local = [&](int tag) {
    const int i = tag_to_index(tag);
    return i >= 0 && i < nlocal;
  };
  order.erase(std::remove_if(order.begin(), order.end(),
                             [&](int r) { return !local(lo[r]) && !local(hi[r]); }),
              order.end());
  reorder(order);

  const int n = size();
  for (auto *v : {&at_lo, &at_hi, &own_lo, &own_hi}) v->resize(n);
  int missing = -1;
  std::vector<int> count(nlocal + 1, 0);
  for (int row = 0; row < n; ++row) {
    const int a = tag_to_index(lo[row]), b = tag_to_index(hi[row]);
    if (a < 0 || b < 0) {
      if (missing < 0) missing = row;
      at_lo[row] = at_hi[row] = own_lo[row] = own_hi[row] = std::max(a, b);
      continue;
    }
    own_lo[row] = a;
    own_hi[row] = b;
    // measure from a local end to the other's nearest image
    if (a < nlocal) {
      at_lo[row] = a;
      at_hi[row] = closest(a, b);
    } else {
      at_hi[row] = b;
      at_lo[row] = closest(b, a);
    }
    if (a < nlocal) ++count[a];
    if (b < nlocal) ++count[b];
  }

  slot_begin_.assign(nlocal, 0);
  int total = 0;
  for (int i = 0; i < nlocal; ++i) {
    slot_begin_[i] = total;
    total += count[i];
  }
  slot_end_ = slot_begin_;
  slot_rows_.resize(total);
  for (int row = 0; row < n; ++row)
    for (const int i : {own_lo[row], own_hi[row]})
      if (i < nlocal && missing < 0) slot_rows_[slot_end_[i]++] = row;
  pad();
  return missing;
}

int PairTable::packed_size(int slot) const { return 1 + rows_of(slot) * (2 + columns()); }

int PairTable::pack(int slot, double *buffer) const {
  int m = 0;
  buffer[m++] = two_ints(rows_of(slot), columns_);
  for (int k = 0; k < rows_of(slot); ++k) {
    const int row = row_of(slot, k);
    buffer[m++] = two_ints(lo[row], hi[row]);
    buffer[m++] = two_ints(info[row], 0);
    for (int c = 0; c < columns_; ++c) buffer[m++] = value(c, row);
  }
  return m;
}

int PairTable::unpack(const double *buffer, int new_slot) {
  int m = 0, rows, width, a, b, information, unused;
  split_ints(buffer[m++], rows, width);
  if (rows > 0) widen(width);  // a restart file may come before the commands that ask for columns
  std::vector<double> values(columns_, 0.0);
  if (static_cast<int>(slot_end_.size()) <= new_slot) {
    slot_begin_.resize(new_slot + 1, static_cast<int>(slot_rows_.size()));
    slot_end_.resize(new_slot + 1, static_cast<int>(slot_rows_.size()));
  }
  slot_begin_[new_slot] = static_cast<int>(slot_rows_.size());
  for (int k = 0; k < rows; ++k) {
    split_ints(buffer[m], a, b);
    split_ints(buffer[m + 1], information, unused);
    m += 2;
    std::copy(buffer + m, buffer + m + width, values.begin());
    slot_rows_.push_back(append(a, b, information, values.data()));
    m += width;
  }
  slot_end_[new_slot] = static_cast<int>(slot_rows_.size());
  return m;
}

int PairTable::longest_slot() const {
  int longest = 0;
  for (int s = 0; s < slots(); ++s) longest = std::max(longest, rows_of(s));
  return longest;
}

double PairTable::bytes() const {
  return size() * (3.0 * sizeof(int) + 4.0 * sizeof(int) + columns() * sizeof(double)) +
         slot_rows_.size() * sizeof(int);
}

}  // namespace bondlab
