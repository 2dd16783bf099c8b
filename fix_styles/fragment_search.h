// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the fragments of a specimen: sets of particles that intact bonds hold together.
//
// Method: union-find over particles in order of their tags, so the result doesn't depend on the order
// of the bonds; fragments are numbered by mass, the heaviest first (equal masses: the one with the
// smallest tag first). The size of a fragment is the diameter of the sphere of its mass, as a sieve
// analysis reports it: (6 m/(pi rho))^(1/3) with the density of its particles, so its pores aren't
// counted.
//
// Units: SI. Failure: a bond to a tag that isn't there is left out. Limits: fragments that only touch
// or interlock count as separate.
#ifndef BONDLAB_FRAGMENT_SEARCH_H
#define BONDLAB_FRAGMENT_SEARCH_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace bondlab {

struct FragmentParticle {
  double tag = 0, mass = 0, density = 0;  // tag: a whole number
  double x[3] = {0, 0, 0}, v[3] = {0, 0, 0};
};

struct Fragment {
  int first_tag = 0, particles = 0;
  double mass = 0, size = 0;               // kg, m
  double x[3] = {0, 0, 0}, v[3] = {0, 0, 0};  // of the centre of mass
};

// `bonds`: pairs of tags. Particles come in any order.
inline std::vector<Fragment> find_fragments(std::vector<FragmentParticle> particles,
                                            const std::vector<std::pair<int, int>> &bonds) {
  std::sort(particles.begin(), particles.end(),
            [](const auto &a, const auto &b) { return a.tag < b.tag; });
  const std::size_t n = particles.size();
  std::vector<std::size_t> parent(n);
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto place = [&](int tag) {
    const auto at = std::lower_bound(particles.begin(), particles.end(), tag,
                                     [](const auto &p, int t) { return p.tag < t; });
    return at != particles.end() && at->tag == tag ? std::size_t(at - particles.begin()) : n;
  };
  for (const auto &[a, b] : bonds) {
    const std::size_t i = place(a), j = place(b);
    if (i == n || j == n) continue;
    const std::size_t ri = root(i), rj = root(j);
    parent[std::max(ri, rj)] = std::min(ri, rj);  // the root has the smallest tag
  }
  std::vector<std::size_t> number(n, n);
  std::vector<Fragment> fragments;
  std::vector<double> volume;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t r = root(i);
    if (number[r] == n) {
      number[r] = fragments.size();
      fragments.emplace_back();
      fragments.back().first_tag = static_cast<int>(particles[r].tag);
      volume.push_back(0);
    }
    Fragment &f = fragments[number[r]];
    const FragmentParticle &p = particles[i];
    ++f.particles;
    f.mass += p.mass;
    volume[number[r]] += p.mass / p.density;
    for (int d = 0; d < 3; ++d) f.x[d] += p.mass * p.x[d], f.v[d] += p.mass * p.v[d];
  }
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    Fragment &f = fragments[k];
    f.size = std::cbrt(6 * volume[k] / 3.14159265358979323846);
    for (int d = 0; d < 3; ++d) f.x[d] /= f.mass, f.v[d] /= f.mass;
  }
  std::sort(fragments.begin(), fragments.end(), [](const Fragment &a, const Fragment &b) {
    return a.mass != b.mass ? a.mass > b.mass : a.first_tag < b.first_tag;
  });
  return fragments;
}

// Share of the mass in fragments smaller than `size`.
inline double passing(const std::vector<Fragment> &fragments, double size) {
  double all = 0, fine = 0;
  for (const Fragment &f : fragments) {
    all += f.mass;
    if (f.size < size) fine += f.mass;
  }
  return all > 0 ? fine / all : 0;
}

}  // namespace bondlab

#endif
