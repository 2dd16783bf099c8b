// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/check_packing.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/units.h"
#include "specimen/neighbours.h"

namespace bondlab {

namespace {

// Four digits are enough to find a particle and to see how far off it is.
std::string shown(double value) { return format_quantity(value, "", 4); }

// Collects at most ten errors of a kind.
class Findings {
 public:
  Findings(const PackingFile &packing) : packing_(packing) {}
  void add(const std::string &kind, std::size_t row, const std::string &text) {
    constexpr int most = 10;
    const PackingRow &r = packing_.rows[row];
    if (++count_[kind] <= most)
      errors_.add(Place{packing_.path.string(), r.line, 0},
                  "particle " + std::to_string(r.id) + " " + text);
  }
  void throw_if_any() {
    for (const auto &[kind, count] : count_)
      if (count > 10)
        errors_.add(Place{packing_.path.string(), 0, 0},
                    std::to_string(count - 10) + " more " + kind);
    errors_.throw_if_any();
  }

 private:
  const PackingFile &packing_;
  std::map<std::string, int> count_;
  ErrorCollector errors_;
};

std::string at(const Particle &p) {
  return "at (" + shown(p.x) + ", " + shown(p.y) + ", " + shown(p.z) + ") m";
}

void check_places(const PackingFile &packing, const PackingLimits &limits, Findings &found) {
  const bool has_box = packing.box_line[0] > 0;
  for (std::size_t i = 0; i < packing.rows.size(); ++i) {
    const Particle &p = packing.rows[i].particle;
    const double centre[3] = {p.x, p.y, p.z};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(p.r) ||
        p.r <= 0) {
      found.add("particles that are not finite", i,
                "has a place or radius that is not finite or not positive");
      continue;
    }
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k)
      inside = inside &&
               (!has_box || (centre[k] >= packing.box_lo[k] && centre[k] <= packing.box_hi[k]));
    if (!inside) {
      found.add("particles outside the box", i, at(p) + " is outside the box of the file");
      continue;
    }
    if (!packing.made_from) continue;
    const Container container = packing.made_from->container();
    const double out = p.r - container.depth(p.x, p.y, p.z);
    if (out > limits.stick_out * p.r)
      found.add("particles outside the specimen", i,
                at(p) + " sticks out of the " + shape_name(container.shape()) + " by " +
                    shown(out) + " m (allowed: " + shown(limits.stick_out * p.r) + " m)");
    if (container.dimension() == 2 && p.z != 0)
      found.add("particles out of the plane", i,
                at(p) + " is out of the plane of a 2D specimen (allowed: z = 0)");
  }
}

void check_contacts(const PackingFile &packing, const PackingLimits &limits, Findings &found) {
  std::vector<Particle> particles;
  double r_mean = 0;
  for (const PackingRow &row : packing.rows) {
    particles.push_back(row.particle);
    r_mean += row.particle.r / static_cast<double>(packing.rows.size());
  }
  const double gap = limits.gap > 0 ? limits.gap : bond_gap * r_mean;
  const PairList bonds = find_pairs(particles, gap);
  std::vector<int> bonds_of(particles.size(), 0);
  const Container body = packing.made_from ? packing.made_from->container()
                                           : Container(ContainerShape::disc, Dimensions());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (std::size_t k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(bonds.other[k]);
      ++bonds_of[i];
      ++bonds_of[j];
      if (body.crosses_notch(particles[i], particles[j]))
        found.add("bonds across the notch", j,
                  "would be bonded to particle " + std::to_string(packing.rows[i].id) +
                      " across the notch: its gap is within the bond gap of " + shown(gap) + " m");
      const double overlap =
          -gap_between(particles[i], particles[j]) / std::min(particles[i].r, particles[j].r);
      if (overlap > limits.overlap)
        found.add("overlaps", j,
                  "overlaps particle " + std::to_string(packing.rows[i].id) + " by " +
                      shown(overlap) + " of the smaller radius (allowed: " + shown(limits.overlap) +
                      ")");
    }
  }
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (bonds_of[i] == 0)
      found.add("particles without a neighbour", i,
                at(particles[i]) + " touches no other: none is within the bond gap of " +
                    shown(gap) + " m");
  // Particles alone are named above; here are parts of two and more beside the largest.
  const Clusters clusters = connected_clusters(bonds);
  std::vector<std::size_t> size(static_cast<std::size_t>(clusters.count), 0), first(size);
  for (std::size_t i = particles.size(); i-- > 0;) {
    ++size[static_cast<std::size_t>(clusters.label[i])];
    first[static_cast<std::size_t>(clusters.label[i])] = i;
  }
  const std::size_t largest =
      static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  for (std::size_t c = 0; c < size.size(); ++c)
    if (c != largest && size[c] > 1)
      found.add("separate parts", first[c],
                "belongs to a part of " + std::to_string(size[c]) +
                    " particles that touches the rest nowhere within the bond gap of " +
                    shown(gap) + " m");
}

}  // namespace

void check_packing(const PackingFile &packing, const PackingLimits &limits) {
  if (packing.rows.empty())
    throw UserError(Place{packing.path.string(), 0, 0}, "no particles in the specimen");
  Findings found(packing);
  check_places(packing, limits, found);
  found.throw_if_any();  // distances between particles that are nowhere mean nothing
  check_contacts(packing, limits, found);
  found.throw_if_any();
}

void check_packing(const std::filesystem::path &path, const PackingLimits &limits) {
  check_packing(read_packing_file(path), limits);
}

void check_packing(const Specimen &specimen, const PackingLimits &limits) {
  PackingFile packing;
  packing.made_from = specimen.request;
  for (std::size_t i = 0; i < specimen.particles.size(); ++i)
    packing.rows.push_back(
        {static_cast<long>(i) + 1, specimen.particles[i], specimen.densities[i], 0});
  check_packing(packing, limits);
}

}  // namespace bondlab
