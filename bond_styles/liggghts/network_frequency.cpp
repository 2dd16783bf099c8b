// SPDX-License-Identifier: GPL-2.0-or-later
// Job: see network_frequency.h.
#include "network_frequency.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "atom.h"
#include "atom_vec_bonded_sphere.h"
#include "bond_bpm.h"
#include "comm.h"
#include "domain.h"
#include "fix_styles/exact_sum_mpi.h"
#include "laws/pair_geometry.h"
#include "laws/strength.h"
#include "pointers.h"

namespace LAMMPS_NS {
namespace {

using bondlab::laws::Vec3;

// Six numbers a particle: displacement times sqrt(m), rotation times sqrt(I).
using Mode = std::vector<double>;

class Network : protected Pointers {
 public:
  explicit Network(LAMMPS *lmp)
      : Pointers(lmp), flat_(domain->dimension == 2), bonds_(AtomVecBondedSphere::of(lmp, "the time step")->bonds) {
    for (BondBPM *style : BondBPM::all(lmp)) style->refresh();
    stiffness_.assign(bonds_.size(), {0.0, 0.0, 0.0, 0.0});
    for (BondBPM *style : BondBPM::all(lmp))
      for (int row = 0; row < bonds_.size(); row++) {
        if (!style->computes(row)) continue;
        double dashpot = 0.0;
        stiffness_[row] = style->whole_stiffness(row, dashpot);
        damping_time_ = std::max(damping_time_, dashpot);
      }
    const double factor = flat_ ? 0.5 : 0.4;
    for (int i = 0; i < atom->nlocal; i++) {
      const double m = atom->rmass[i], r = atom->radius[i];
      root_mass_.push_back(std::sqrt(m));
      root_inertia_.push_back(std::sqrt(factor * m) * r);
    }
  }

  double damping_time() const { return largest(damping_time_); }

  double largest(double mine) const {
    double all = 0.0;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, world);
    return all;
  }

  double dot(const Mode &a, const Mode &b) const {
    bondlab::ExactSums<1> sum;
    for (std::size_t k = 0; k < a.size(); k++) sum.add(0, a[k] * b[k]);
    bondlab::sum_over_ranks(sum, world);
    return sum.value(0);
  }

  Mode start() const {
    Mode u(6 * atom->nlocal, 0.0);
    for (int i = 0; i < atom->nlocal; i++)
      for (int k = 0; k < 6; k++)
        if (!flat_ || k < 2 || k == 5)
          u[6 * i + k] = bondlab::laws::uniform_of_pair(atom->tag[i], -1 - k, 1, 23) - 0.5;
    return u;
  }

  // M^-1/2 K M^-1/2 u
  Mode apply(const Mode &u) {
    double **v = atom->v, **w = atom->omega;
    for (int i = 0; i < atom->nlocal; i++)
      for (int d = 0; d < 3; d++) {
        v[i][d] = u[6 * i + d] / root_mass_[i];
        w[i][d] = u[6 * i + 3 + d] / root_inertia_[i];
      }
    comm->forward_comm();
    Mode out(u.size(), 0.0);
    for (int row = 0; row < bonds_.size(); row++) add_pair(row, out);
    for (int i = 0; i < atom->nlocal; i++)
      for (int d = 0; d < 3; d++) {
        out[6 * i + d] /= root_mass_[i];
        out[6 * i + 3 + d] /= root_inertia_[i];
      }
    return out;
  }

  // Gershgorin by particles, rotations scaled by the radius: the shear displacement of a pair is
  // u_j - u_i - c (phi_i + phi_j) with phi = R theta, c = d/(R_i + R_j), so the rows of a particle sum to
  //   translation  2 k + 2 c k_s                                      over m_i
  //   rotation     2 (c + c^2) k_s + k_b (1/R_i^2 + 1/(R_i R_j))      over I_i/R_i^2
  // k: the larger of normal and shear stiffness, k_b: of bend and twist.
  double gershgorin() const {
    std::vector<double> move(atom->nlocal, 0.0), turn(atom->nlocal, 0.0);
    for (int row = 0; row < bonds_.size(); row++) {
      const BondBPM::Stiffness &s = stiffness_[row];
      const int ends[2] = {bonds_.at_lo[row], bonds_.at_hi[row]};
      const int own[2] = {bonds_.own_lo[row], bonds_.own_hi[row]};
      const double k = std::max(s.normal, s.shear), kb = std::max(s.bend, s.twist);
      for (int side = 0; side < 2; side++) {
        const int i = own[side];
        if (i >= atom->nlocal) continue;
        const double ri = atom->radius[ends[side]], rj = atom->radius[ends[1 - side]];
        const double arm = bonds_.value(BondBPM::REST, row) / (ri + rj);
        move[i] += 2.0 * k + 2.0 * arm * s.shear;
        turn[i] += 2.0 * arm * (1.0 + arm) * s.shear + kb * (1.0 / (ri * ri) + 1.0 / (ri * rj));
      }
    }
    double highest = 0.0;
    for (int i = 0; i < atom->nlocal; i++) {
      const double r = atom->radius[i];
      highest = std::max(highest, move[i] / (root_mass_[i] * root_mass_[i]));
      highest = std::max(highest, turn[i] * r * r / (root_inertia_[i] * root_inertia_[i]));
    }
    return largest(highest);
  }

 private:
  const bool flat_;
  const bondlab::PairTable &bonds_;
  std::vector<BondBPM::Stiffness> stiffness_;
  double damping_time_ = 0.0;
  std::vector<double> root_mass_, root_inertia_;

  static Vec3 vec(const double *p) { return {p[0], p[1], p[2]}; }

  // -(force and torque) of one pair for the velocities as displacements
  void add_pair(int row, Mode &out) const {
    using bondlab::laws::cross;
    using bondlab::laws::dot;
    const BondBPM::Stiffness &s = stiffness_[row];
    const int i = bonds_.at_lo[row], j = bonds_.at_hi[row];
    const Vec3 d = vec(atom->x[j]) - vec(atom->x[i]);
    const double length = std::sqrt(dot(d, d)), ri = atom->radius[i], rj = atom->radius[j];
    const Vec3 e = (1.0 / length) * d;
    const Vec3 wi = vec(atom->omega[i]), wj = vec(atom->omega[j]);
    const Vec3 spin = (1.0 / (ri + rj)) * (ri * wi + rj * wj);
    const Vec3 u = vec(atom->v[j]) - vec(atom->v[i]), q = wj - wi;
    const double stretch = dot(u, e), twist = dot(q, e);
    const Vec3 shear = u - stretch * e - cross(spin, d);
    const Vec3 force = (s.normal * stretch) * e + s.shear * (shear - dot(shear, e) * e);
    Vec3 moment = s.bend * (q - twist * e) + (s.twist * twist) * e;
    const double ai = length * ri / (ri + rj), aj = length * rj / (ri + rj);
    Vec3 lever = cross(e, force);
    if (flat_) {
      moment = {0.0, 0.0, s.bend * q.z};
      lever = {0.0, 0.0, lever.z};
    }
    const int a = bonds_.own_lo[row], b = bonds_.own_hi[row];
    if (a < atom->nlocal) put(out, a, -1.0, force, moment + ai * lever);
    if (b < atom->nlocal) put(out, b, 1.0, force, moment - aj * lever);
  }

  static void put(Mode &out, int i, double sign, Vec3 f, Vec3 t) {
    const double values[6] = {f.x, f.y, f.z, t.x, t.y, t.z};
    for (int k = 0; k < 6; k++) out[6 * i + k] += sign * values[k];
  }
};

// Largest eigenvalue of the symmetric tridiagonal matrix (a, b) by bisection on Sturm counts, and the
// size of the last component of its unit vector.
double largest_ritz(const std::vector<double> &a, const std::vector<double> &b, double &last) {
  const int n = static_cast<int>(a.size());
  double low = 0.0, high = 0.0;
  for (int k = 0; k < n; k++)
    high = std::max(high, a[k] + (k ? std::fabs(b[k - 1]) : 0.0) + (k + 1 < n ? std::fabs(b[k]) : 0.0));
  for (int step = 0; step < 200 && high - low > 1e-14 * high; step++) {
    const double x = 0.5 * (low + high);
    int below = 0;
    double q = 1.0;
    for (int k = 0; k < n; k++) {
      q = a[k] - x - (k ? b[k - 1] * b[k - 1] / q : 0.0);
      if (q == 0.0) q = 1e-300;
      below += q < 0.0;
    }
    (below == n ? high : low) = x;
  }
  // its vector by the recurrence of the rows, scaled as it grows
  std::vector<double> s(n, 1.0);
  double norm2 = 1.0;
  for (int k = 0; k + 1 < n; k++) {
    s[k + 1] = ((high - a[k]) * s[k] - (k ? b[k - 1] * s[k - 1] : 0.0)) / b[k];
    norm2 += s[k + 1] * s[k + 1];
  }
  last = std::fabs(s[n - 1]) / std::sqrt(norm2);
  return high;
}

// To 24 bits, upwards: stiffness and mass doubled give the same frequency to rounding, and then the
// same step to the bit.
double rounded_up(double value) {
  int exponent;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::ceil(std::ldexp(mantissa, 24) * (1.0 - 1e-12)), exponent - 24);
}

}  // namespace

NetworkFrequency network_frequency(LAMMPS *lmp) {
  Atom *atom = lmp->atom;
  Network network(lmp);
  NetworkFrequency result{0.0, network.gershgorin(), network.damping_time()};
  if (!(result.gershgorin2 > 0.0)) return result;

  const int n = atom->nlocal;
  std::vector<double> kept;
  for (int i = 0; i < n; i++)
    for (int d = 0; d < 3; d++) {
      kept.push_back(atom->v[i][d]);
      kept.push_back(atom->omega[i][d]);
    }

  constexpr int kSteps = 40;
  std::vector<double> a, b;
  Mode u = network.start(), before(u.size(), 0.0);
  double size = std::sqrt(network.dot(u, u));
  for (double &value : u) value /= size;
  double residual = 0.0;
  for (int step = 0; step < kSteps; step++) {
    Mode next = network.apply(u);
    const double along = network.dot(u, next);
    for (std::size_t k = 0; k < next.size(); k++)
      next[k] -= along * u[k] + (step ? b.back() * before[k] : 0.0);
    a.push_back(along);
    residual = std::sqrt(network.dot(next, next));
    if (!(residual > 1e-9 * result.gershgorin2)) break;  // a few particles: all modes are found
    if (step + 1 == kSteps) break;
    b.push_back(residual);
    for (double &value : next) value /= residual;
    before.swap(u);
    u.swap(next);
  }
  double last = 1.0;
  const double theta = largest_ritz(a, b, last);
  result.omega2 = rounded_up(std::min(theta + residual * last, result.gershgorin2));

  std::size_t at = 0;
  for (int i = 0; i < n; i++)
    for (int d = 0; d < 3; d++) {
      atom->v[i][d] = kept[at++];
      atom->omega[i][d] = kept[at++];
    }
  lmp->comm->forward_comm();
  return result;
}

}  // namespace LAMMPS_NS
