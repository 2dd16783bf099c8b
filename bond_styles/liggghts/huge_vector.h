// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a vector of doubles for the arrays a step streams through: aligned for the widest vector
// instructions, and on large pages, so that walking tens of megabytes doesn't miss the page tables.
// Failure: std::bad_alloc. Limits: none; where the system has no large pages they are just pages.
#ifndef BONDLAB_HUGE_VECTOR_H
#define BONDLAB_HUGE_VECTOR_H

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace bondlab {

template <class T>
struct HugeAllocator {
  using value_type = T;
  HugeAllocator() = default;
  template <class U>
  HugeAllocator(const HugeAllocator<U> &) {}

  T *allocate(std::size_t n) {
    constexpr std::size_t large = std::size_t(1) << 21;  // bytes of a large page
    const std::size_t bytes = n * sizeof(T), unit = bytes >= large ? large : 64;
    void *p = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    if (!p) throw std::bad_alloc();
    if (unit == large) madvise(p, bytes, MADV_HUGEPAGE);  // a wish; refusing it costs only time
    return static_cast<T *>(p);
  }
  void deallocate(T *p, std::size_t) { std::free(p); }

  template <class U>
  bool operator==(const HugeAllocator<U> &) const { return true; }
  template <class U>
  bool operator!=(const HugeAllocator<U> &) const { return false; }
};

using HugeVector = std::vector<double, HugeAllocator<double>>;

}  // namespace bondlab

#endif
