// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the stages of making a packing; specimen.h says what comes out and why this way.
// Units: lengths in mean radii of the distribution as asked for.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/user_error.h"
#include "specimen/fill.h"
#include "specimen/floaters.h"
#include "specimen/insertion.h"
#include "specimen/neighbours.h"
#include "specimen/relax.h"
#include "specimen/size_distribution.h"
#include "specimen/space_filling.h"
#include "specimen/specimen.h"

namespace bondlab {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::uint64_t packing_stream =
    1;  // of the seed; other uses of the same seed take other streams

constexpr double first_compression = 0.06;  // how much larger than asked for the radii are at first
constexpr double coarse_overlap = 1e-3;     // the overlap at which the count is judged
constexpr double allowed_size_error =
    4e-3;  // of the radii at that overlap, else the count is corrected
constexpr int most_counts = 4;
constexpr int least_relaxed_growths = 3,
              most_relaxed_growths = 10;  // seating floaters and relaxing
constexpr int most_growths = 200;         // rounds of seating what is left, without
constexpr double largest_growth = 1.15;   // of a floater, over r_max
constexpr double growth_of_loose = 1.3;   // the same, of one that would have no bond otherwise
constexpr double no_load = 0.02, faint_load = 0.2, any_load = 1e9;  // of the mean overlap
constexpr double most_detached = 0.1;  // share of an insertion that may be taken out
constexpr int most_steps = 5000;       // of one minimisation
constexpr double coarse_tolerance = 1e-2, fine_tolerance = 2e-3;

struct Packing {
  Container box;
  std::vector<Particle> particles;
  double size_factor = 1;  // radii now over radii as drawn
  double slope = 1.2;      // change of overlap over relative change of radii, as last seen
};

// Solid fraction to be expected: that of random close packing, less by the looser layer along the
// walls.
double expected_solid_fraction(const Container &box) {
  const double wall_part = box.boundary() / box.measure();
  return box.dimension() == 2 ? 0.847 * (1 - 0.2 * wall_part) : 0.649 * (1 - 0.237 * wall_part);
}

std::vector<Particle> scatter(const Container &box, const std::vector<double> &radii,
                              RandomStream &random) {
  std::vector<Particle> particles(radii.size());
  double lo[3], hi[3];
  box.bounds(lo, hi);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    Particle &p = particles[i];
    do {
      p.x = random.uniform(lo[0], hi[0]);
      p.y = random.uniform(lo[1], hi[1]);
      p.z = box.dimension() == 3 ? random.uniform(lo[2], hi[2]) : 0;
    } while (box.depth(p.x, p.y, p.z) <= 0);
    p.r = radii[i];
  }
  return particles;
}

void reorder(std::vector<Particle> &particles) {
  const std::vector<Particle> before = particles;
  const std::vector<std::size_t> order = space_filling_order(before);
  for (std::size_t k = 0; k < order.size(); ++k) particles[k] = before[order[k]];
}

void scale_radii(Packing &packing, double factor) {
  for (Particle &p : packing.particles) p.r *= factor;
  packing.size_factor *= factor;
}

// Scales the radii until the packing is in equilibrium at the wanted overlap: by the secant of the
// last two equilibria, kept between the largest radii seen too loose and the smallest seen too
// tight. A packing that is about to fall apart would take very long to do so: it is grown again as
// soon as a third of the overlap is left. The bounds are given up when they close without success,
// because a packing rearranges and then has others.
void reach_overlap(Packing &packing, Relaxation &relaxation, double wanted, double tolerance) {
  constexpr double unknown = 0;
  const double loose = 0.3 * wanted;
  double too_loose = unknown, too_tight = unknown, last_factor = unknown, last_overlap = 0;
  double growth = 0.7 * wanted;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const Equilibrium now = relaxation.relax(tolerance, loose, most_steps);
    const double factor = packing.size_factor;
    double next;
    if (now.overlap < loose || now.residual > tolerance) {
      too_loose = factor;
      next = factor * (1 + growth);
      if (too_tight != unknown && next >= too_tight) next = 0.5 * (factor + too_tight);
      growth *= 2;
      last_factor = unknown;
    } else {
      if (std::fabs(now.overlap / wanted - 1) < 0.1) return;
      if (last_factor != unknown)
        packing.slope = std::clamp((now.overlap - last_overlap) / (factor - last_factor), 0.8, 4.0);
      last_factor = factor;
      last_overlap = now.overlap;
      next = factor + (wanted - now.overlap) / packing.slope;
      if (now.overlap > wanted) {
        too_tight = factor;
        if (too_loose != unknown && next <= too_loose) next = 0.5 * (factor + too_loose);
      }
    }
    if (too_loose != unknown && too_tight != unknown && too_tight - too_loose < 0.01 * wanted) {
      too_loose = too_tight = unknown;
      growth = 0.7 * wanted;
    }
    scale_radii(packing, next / factor);
  }
  throw UserError(
      "no equilibrium found for the packing: the container can't be filled evenly with these "
      "particles "
      "(try smaller particles or another seed)");
}

// From random places to a jammed packing at a small overlap.
Packing pack_coarsely(const Container &box, const SizeDistribution &sizes, std::size_t count,
                      RandomStream random) {
  Packing packing{box, {}};
  const std::vector<double> radii = draw_radii(sizes, count, random);
  packing.particles = scatter(box, radii, random);
  reorder(packing.particles);
  scale_radii(packing, 1 + first_compression);
  Relaxation relaxation(packing.box, packing.particles);
  relaxation.relax(0.1, 0, most_steps);
  reorder(packing.particles);
  for (double overlap = first_compression / 3; overlap > 1.5 * coarse_overlap; overlap /= 3)
    reach_overlap(packing, relaxation, overlap, coarse_tolerance);
  reach_overlap(packing, relaxation, coarse_overlap, coarse_tolerance);
  return packing;
}

int seat(Packing &packing, const std::vector<bool> &floaters, double overlap, double r_max) {
  return seat_floaters(packing.box, packing.particles, floaters, overlap, largest_growth * r_max);
}

// Particles with no load to speak of, and those with less than it but too few contacts: bridges of
// two contacts that are about to buckle.
std::vector<bool> floaters_of(const Packing &packing, double overlap, double bridge_load) {
  std::vector<bool> floaters = find_unloaded(packing.box, packing.particles, no_load * overlap);
  const std::vector<bool> faint =
      find_unloaded(packing.box, packing.particles, bridge_load * overlap);
  const std::vector<bool> loose =
      find_floaters(packing.box, packing.particles, 0.5 * coordination_gaps[0]);
  for (std::size_t i = 0; i < floaters.size(); ++i)
    floaters[i] = floaters[i] || (faint[i] && loose[i]);
  return floaters;
}

// Floaters change the sizes, so that a packing relaxed after their growth has new ones: a few
// rounds of growth and relaxation leave some 2 %, which are then seated exactly, without overlap,
// and disturb nothing but the load of the faintest bridges. Rounds go on while there are others.
int eliminate_floaters(Packing &packing, Relaxation &relaxation, double overlap, double r_max) {
  int grown = 0;
  std::vector<bool> floaters;
  for (int round = 0; round < most_relaxed_growths; ++round) {
    const std::vector<bool> all = floaters_of(packing, overlap, any_load);
    floaters = floaters_of(packing, overlap, faint_load);
    if (round >= least_relaxed_growths && all == floaters) break;
    const int seated = seat(packing, all, overlap, r_max * packing.size_factor);
    if (seated == 0) return grown;
    grown = std::max(grown, seated);
    reach_overlap(packing, relaxation, overlap, fine_tolerance);
    floaters = floaters_of(packing, overlap, faint_load);
  }
  const std::vector<bool> faint =
      find_unloaded(packing.box, packing.particles, faint_load * overlap);
  // Seating one can take a contact from another that is seated already: repeated until all touch.
  for (int round = 0; round < most_growths; ++round) {
    if (seat(packing, floaters, 0, r_max * packing.size_factor) == 0) break;
    floaters = find_floaters(packing.box, packing.particles, 0.5 * coordination_gaps[0]);
    for (std::size_t i = 0; i < floaters.size(); ++i) floaters[i] = floaters[i] && faint[i];
  }
  return grown;
}

// Radius expansion and relaxation, stages 1 to 4 of specimen.md.
template <class Tell>
Packing expand(const Container &box, const SizeDistribution &sizes, const SpecimenRequest &request,
               int &grown, Tell &&tell) {
  const double one = box.dimension() == 2 ? pi * sizes.moment(2) : 4 * pi / 3 * sizes.moment(3);
  double count = box.measure() * expected_solid_fraction(box) / one;
  Packing packing{box, {}};
  for (int attempt = 0; attempt < most_counts; ++attempt) {
    tell("packing", 0.1 * attempt);
    packing = pack_coarsely(box, sizes, static_cast<std::size_t>(std::lround(count)),
                            RandomStream(request.seed, packing_stream));
    if (std::fabs(packing.size_factor - 1) <= allowed_size_error) break;
    double correction = packing.size_factor * packing.size_factor;
    if (box.dimension() == 3) correction *= packing.size_factor;
    const double next = std::round(count * correction);
    if (next == std::round(count)) break;
    count = next;
  }

  Relaxation relaxation(packing.box, packing.particles);
  tell("lowering the stress", 0.4);
  for (double overlap = coarse_overlap / 3; overlap > 1.5 * request.overlap; overlap /= 3)
    reach_overlap(packing, relaxation, overlap, fine_tolerance);
  reach_overlap(packing, relaxation, request.overlap, fine_tolerance);
  tell("growing floaters", 0.6);
  grown = eliminate_floaters(packing, relaxation, request.overlap, sizes.largest());
  return packing;
}

// Filling, and floaters seated in their holes.
Packing fill_and_seat(const Container &box, const SizeDistribution &sizes, RandomStream random,
                      int &grown) {
  Packing packing{box, fill_container(box, sizes, random)};
  for (int round = 0; round < most_relaxed_growths; ++round) {
    const int seated = seat_floaters(
        box, packing.particles, find_floaters(box, packing.particles, 0.5 * coordination_gaps[0]),
        0, sizes.largest());
    grown = std::max(grown, seated);
    if (seated == 0) break;
  }
  return packing;
}

// Particles that are bonded to the largest part by no chain of gaps below bond_gap.
std::vector<bool> find_detached(const std::vector<Particle> &particles) {
  double r_mean = 0;
  for (const Particle &p : particles) r_mean += p.r / static_cast<double>(particles.size());
  const Clusters clusters = connected_clusters(find_pairs(particles, bond_gap * r_mean));
  std::vector<std::size_t> size(static_cast<std::size_t>(clusters.count), 0);
  for (const int label : clusters.label) ++size[static_cast<std::size_t>(label)];
  const auto largest = std::max_element(size.begin(), size.end()) - size.begin();
  std::vector<bool> detached(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) detached[i] = clusters.label[i] != largest;
  return detached;
}

std::size_t remove(Packing &packing, const std::vector<bool> &detached) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < detached.size(); ++i)
    if (!detached[i]) packing.particles[kept++] = packing.particles[i];
  packing.particles.resize(kept);
  return detached.size() - kept;
}

// Seeds that no inserted particle touches; they are few, else the packing is none.
void remove_detached(Packing &packing) {
  const std::size_t all = packing.particles.size();
  const std::size_t removed = remove(packing, find_detached(packing.particles));
  if (static_cast<double>(removed) > most_detached * static_cast<double>(all))
    throw UserError("insertion: " + std::to_string(removed) + " of " + std::to_string(all) +
                    " particles don't hang together with the rest (allowed: " +
                    std::to_string(std::lround(100 * most_detached)) +
                    " %); take more tries or a wider range of sizes");
}

// A hole may be too large for the growth that floaters are allowed, about one in 40,000 (2D): its
// particle would have no bond, and the packing could not be tested. It may grow farther; one that
// is then still loose is taken out.
void attach_or_remove(Packing &packing, double r_max) {
  std::vector<bool> detached = find_detached(packing.particles);
  if (std::find(detached.begin(), detached.end(), true) == detached.end()) return;
  seat(packing, detached, 0, growth_of_loose / largest_growth * r_max * packing.size_factor);
  remove(packing, find_detached(packing.particles));
}

}  // namespace

Specimen make_specimen(const SpecimenRequest &given, const SpecimenProgressCallback &progress) {
  check_request(given);
  const SpecimenRequest request = canonical_request(given);
  const auto tell = [&](const char *stage, double fraction) {
    if (progress) progress({stage, fraction});
  };
  const int dimension = is_flat(request.shape) ? 2 : 3;
  const double unit = size_distribution(request.size_settings(), dimension)->moment(1);  // m
  const auto sizes = size_distribution(in_units_of(request.size_settings(), unit), dimension);
  Dimensions size = request.dimensions();
  for (double *length : {&size.width, &size.height, &size.diameter, &size.length, &size.notch_depth,
                         &size.notch_width})
    *length /= unit;
  const Container box(request.shape, size);
  Packing packing{box, {}};
  int grown = 0;
  if (request.method == "filling") {
    tell("filling", 0);
    packing = fill_and_seat(box, *sizes, RandomStream(request.seed, packing_stream), grown);
    attach_or_remove(packing, sizes->largest());
  } else if (request.method == "insertion") {
    tell("inserting", 0);
    RandomStream random(request.seed, packing_stream);
    packing.particles = insert_particles(box, *sizes, request.tries, random).particles;
    remove_detached(packing);
  } else {
    packing = expand(box, *sizes, request, grown, tell);
    attach_or_remove(packing, sizes->largest());
  }

  tell("measuring", 0.95);
  reorder(packing.particles);
  Specimen specimen;
  specimen.request = request;
  specimen.particles = packing.particles;
  for (Particle &p : specimen.particles) {
    p.x *= unit;
    p.y *= unit;
    p.z *= unit;
    p.r *= unit;
  }
  specimen.densities.assign(specimen.particles.size(), request.density);
  specimen.statistics = measure_packing(request.container(), specimen.particles);
  specimen.statistics.floaters_grown = grown;
  specimen.statistics.size_factor = packing.size_factor;
  tell("done", 1);
  return specimen;
}

}  // namespace bondlab
