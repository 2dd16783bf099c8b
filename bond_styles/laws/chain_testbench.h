// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: an engine-free bench for the laws' tests: a few grains, bonds and contacts between them, and
// velocity Verlet as fix nve/bonded does it, calling the block kernels as the engine does.
//
// Method: whole blocks of kBlock lanes, unused lanes repeat the last pair. Kinematics are those of
// liggghts/pair_gather.h: change over the step = dt times half-step velocity. A test may integrate
// (step), or prescribe positions and half-step velocities itself and ask for loads (load).
// In 2D (`flat`) only x, y and the rotation about z take part.
// The bonds' law is the parallel bond, or whatever `Bench::law` says. `Bench::options` takes the kernels
// with the options common to all laws (bond_options.h), `Bench::contacts = false` those without contact.
// Units: SI. Failure: none, it is for tests only. Limits: no neighbour search, bonds never change
// places; a handful of grains (loads are summed pair by pair in the order of their making).
#ifndef BONDLAB_LAWS_CHAIN_TESTBENCH_H
#define BONDLAB_LAWS_CHAIN_TESTBENCH_H

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "parallel.h"

namespace bondlab::laws::testbench {

struct Grain {
  Vec3 x{0, 0, 0}, v{0, 0, 0}, w{0, 0, 0};  // m, m/s, rad/s
  Vec3 f{0, 0, 0}, t{0, 0, 0};              // N, N m, after load()
  Vec3 pull{0, 0, 0}, turn{0, 0, 0};        // constant external load, N, N m
  Vec3 turned{0, 0, 0};                     // sum of the small rotations of all steps, rad
  std::array<double, 4> q{1, 0, 0, 0};      // orientation, unit quaternion (w, x, y, z)
  double radius = 0.0, mass = 0.0, inertia = 0.0;
  bool held = false;  // neither moves nor turns by itself
};

inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 unit(Vec3 a) { return (1.0 / length(a)) * a; }

// Rotates v by the rotation vector a (Rodrigues).
inline Vec3 rotated(Vec3 v, Vec3 a) {
  const double angle = length(a);
  if (angle == 0.0) return v;
  const Vec3 n = (1.0 / angle) * a;
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(n, v) + ((1.0 - c) * dot(n, v)) * n;
}

// The orientation q after a further turn by the rotation vector a.
inline std::array<double, 4> turned_by(const std::array<double, 4> &q, Vec3 a) {
  const double half = 0.5 * length(a), s = half > 0.0 ? 0.5 * std::sin(half) / half : 0.5;
  const double w = std::cos(half), x = s * a.x, y = s * a.y, z = s * a.z;
  std::array<double, 4> r{w * q[0] - x * q[1] - y * q[2] - z * q[3],
                          w * q[1] + x * q[0] + y * q[3] - z * q[2],
                          w * q[2] + y * q[0] + z * q[1] - x * q[3],
                          w * q[3] + z * q[0] + x * q[2] - y * q[1]};
  const double norm = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  for (double &c : r) c /= norm;
  return r;
}

struct ContactSpec {
  double modulus = 0.0, ratio = 1.0, mu = 0.0;  // Pa, 1, 1; modulus 0: no contact
};

// One pair, bonded or not, with its state.
struct PairRow {
  int i = 0, j = 0;
  bool bonded = false;
  double rest = 0, reference = 0, radius = 0, stiffness = 0, ratio = 1, beta = 1, tan_phi = 0;
  double sigma_c = 1e300, tau_c = 1e300;
  double kn = 0, ks = 0, mu = 0;  // contact
  double alive = 0;
  Vec3 fs{0, 0, 0}, mb{0, 0, 0}, cs{0, 0, 0};  // 2D: .x
  double mt = 0, sigma = 0, tau = 0;
  double tension = 1, failure = 1, viscous = 0;  // options: E_t/E_c, s_f, tau_v in s
  double worst = 0, lost = 0;                    // their state: s_max, energy in J
  BondFate fate = BondFate::intact;
  std::array<double, 32> own{};  // what another law keeps of a bond, see BondLaw
  // loads of the last call
  Vec3 force{0, 0, 0}, moment_i{0, 0, 0}, moment_j{0, 0, 0};
};

// The options of one block of bonds, read from their rows and written back.
struct OptionColumns {
  alignas(64) std::array<double, kBlock> tension, failure, viscous, worst, lost;
  OptionColumns(PairRow *const *rows, double dt) {
    for (int b = 0; b < kBlock; ++b) {
      const PairRow &p = *rows[b];
      tension[b] = p.tension, failure[b] = p.failure, worst[b] = p.worst, lost[b] = p.lost;
      viscous[b] = dt > 0.0 ? p.viscous / dt : 0.0;
    }
  }
  OptionArrays arrays() {
    return {tension.data(), failure.data(), viscous.data(), worst.data(), lost.data()};
  }
  void put_back(PairRow *const *rows) const {
    for (int b = 0; b < kBlock; ++b) rows[b]->worst = worst[b], rows[b]->lost = lost[b];
  }
};

// Calls f with the three switches of a law's kernel as compile-time constants.
template <class F>
void switched(bool advance, bool options, bool contacts, F f) {
  const auto third = [&](auto a, auto o) {
    contacts ? f(a, o, std::true_type()) : f(a, o, std::false_type());
  };
  const auto second = [&](auto a) {
    options ? third(a, std::true_type()) : third(a, std::false_type());
  };
  advance ? second(std::true_type()) : second(std::false_type());
}

// A law other than the parallel bond. Lane b of a block is the bond *rows[b]; unused lanes repeat the
// last one. Of the bench a law may want `dt`, `options` (then use OptionColumns) and `contacts`.
class Bench;
struct BondLaw {
  virtual ~BondLaw() = default;
  virtual void block(const Bench &, PairRow *const *rows, const Kinematics3 &,
                     const Orientations3 &, const ContactParameters &, double *csx, double *csy,
                     double *csz, bool advance, PairLoads3 &) const = 0;
  virtual void block(const Bench &, PairRow *const *rows, const Kinematics2 &,
                     const Orientations2 &, const ContactParameters &, double *cs, bool advance,
                     PairLoads2 &) const = 0;
  virtual double energy(const Bench &, const PairRow &) const = 0;  // elastic, of the bond, J
};

class Bench {
 public:
  explicit Bench(bool flat = false, double thickness = 1.0) : flat_(flat), thickness_(thickness) {}

  std::vector<Grain> grains;
  std::vector<PairRow> pairs;
  std::shared_ptr<const BondLaw> law;  // none: parallel.h
  bool options = false, contacts = true;  // which of the law's kernels
  double dt = 0.0;                        // of the step whose loads are computed, s
  double viscous = 0.0;  // 1/s, damping proportional to mass
  bool transverse_only = false;  // grains move along y and turn about z only

  bool flat() const { return flat_; }
  double thickness() const { return thickness_; }

  int add(Vec3 x, double radius, double density, bool held = false) {
    Grain g;
    g.x = x;
    g.radius = radius;
    g.mass = flat_ ? kPi * radius * radius * thickness_ * density
                   : 4.0 / 3.0 * kPi * radius * radius * radius * density;
    g.inertia = (flat_ ? 0.5 : 0.4) * g.mass * radius * radius;
    g.held = held;
    grains.push_back(g);
    return static_cast<int>(grains.size()) - 1;
  }

  double distance(int i, int j) const { return length(grains[j].x - grains[i].x); }

  PairRow &bond(int i, int j, const ParallelParameters &p, const ContactSpec &c = {}) {
    PairRow &row = contact(i, j, c);
    row.bonded = true;
    row.alive = 1.0;
    row.rest = row.reference = distance(i, j);
    row.radius = p.lambda * std::min(grains[i].radius, grains[j].radius);
    row.stiffness = p.modulus / (grains[i].radius + grains[j].radius);
    row.ratio = p.ratio;
    row.beta = p.beta;
    row.tan_phi = p.tan_phi;
    return row;
  }

  PairRow &contact(int i, int j, const ContactSpec &c) {
    PairRow row;
    row.i = i;
    row.j = j;
    const double ri = grains[i].radius, rj = grains[j].radius;
    row.reference = ri + rj;
    row.kn = flat_ ? in_series(grain_stiffness_2d(thickness_, c.modulus),
                               grain_stiffness_2d(thickness_, c.modulus))
                   : in_series(grain_stiffness_3d(ri, c.modulus), grain_stiffness_3d(rj, c.modulus));
    row.ks = row.kn / c.ratio;
    row.mu = c.mu;
    pairs.push_back(row);
    return pairs.back();
  }

  BondSection section(const PairRow &p) const {
    return flat_ ? strip_section(p.radius, thickness_) : round_section(p.radius);
  }

  // Loads of all pairs at the present positions; grain velocities are those of the half step.
  void load(double step, bool advance = true) {
    dt = step;
    for (Grain &g : grains) g.f = g.pull, g.t = g.turn;
    for (const bool bonded : {false, true}) {
      order_.clear();
      for (int k = 0; k < static_cast<int>(pairs.size()); ++k)
        if (pairs[k].bonded == bonded) order_.push_back(k);
      for (std::size_t first = 0; first < order_.size(); first += kBlock)
        flat_ ? block_2d(first, bonded, advance) : block_3d(first, bonded, advance);
    }
    for (const PairRow &p : pairs) {
      Grain &a = grains[p.i], &b = grains[p.j];
      a.f = a.f + p.force;
      b.f = b.f - p.force;
      a.t = a.t + p.moment_i;
      b.t = b.t + p.moment_j;
    }
  }

  // Velocity Verlet. Forces must be known: call load(0, false) once before the first step.
  void step(double time) {
    kick(0.5 * time);
    drift(time);
    load(time);
    kick(0.5 * time);
  }

  void drift(double time) {
    for (Grain &g : grains) {
      g.x = g.x + time * g.v;
      g.turned = g.turned + time * g.w;
      if (law) g.q = turned_by(g.q, time * g.w);
    }
  }

  // Steps with positions and spins given: grain k moves to x(k) and turns by spin(k) (rad).
  void prescribe(double time, const std::function<Vec3(int)> &x, const std::function<Vec3(int)> &spin,
                 bool advance = true) {
    for (int k = 0; k < static_cast<int>(grains.size()); ++k) {
      const Vec3 next = x(k);
      grains[k].v = (1.0 / time) * (next - grains[k].x);
      grains[k].x = next;
      const Vec3 turn = spin(k);
      grains[k].w = (1.0 / time) * turn;
      if (law) grains[k].q = turned_by(grains[k].q, turn);
    }
    load(time, advance);
  }

  double kinetic_energy() const {
    double sum = 0.0;
    for (const Grain &g : grains) sum += 0.5 * (g.mass * dot(g.v, g.v) + g.inertia * dot(g.w, g.w));
    return sum;
  }

  double normal_force(const PairRow &p) const {  // of the bond, tension positive, without damage
    const double stretch = distance(p.i, p.j) - p.rest;
    const double side = options && stretch > 0.0 ? p.tension : 1.0;
    return p.alive * side * p.stiffness * section(p).area * stretch;
  }

  double carried(const PairRow &p) const { return options ? integrity(p.worst, p.failure) : 1.0; }

  double potential_energy() const {
    double sum = 0.0;
    for (const PairRow &p : pairs) {
      const double overlap = p.reference - distance(p.i, p.j);
      sum += contact_energy(overlap > 0.0 ? p.kn * overlap : 0.0, length(p.cs), p.kn, p.ks);
      if (p.bonded && law)
        sum += law->energy(*this, p);
      else if (p.alive != 0.0)
        sum += bond_energy(p);
    }
    return sum;
  }

  // Elastic energy of an intact parallel bond: the carried share, but the whole of compression.
  double bond_energy(const PairRow &p) const {
    const double fn = normal_force(p), share = carried(p), kn = p.stiffness, ks = kn / p.ratio;
    const double open = fn > 0.0 ? share / (options ? p.tension : 1.0) : 1.0;
    return open * parallel_energy(fn, 0, 0, 0, kn, ks, section(p)) +
           share * parallel_energy(0, length(p.fs), length(p.mb), p.mt, kn, ks, section(p));
  }

  double lost_energy() const {  // by the options' damping and softening
    double sum = 0.0;
    for (const PairRow &p : pairs) sum += p.lost;
    return sum;
  }

  Vec3 momentum() const {
    Vec3 sum{0, 0, 0};
    for (const Grain &g : grains) sum = sum + g.mass * g.v;
    return sum;
  }

  Vec3 angular_momentum() const {
    Vec3 sum{0, 0, 0};
    for (const Grain &g : grains) sum = sum + g.mass * cross(g.x, g.v) + g.inertia * g.w;
    return sum;
  }

 private:
  bool flat_;
  double thickness_;
  std::vector<int> order_;

  void kick(double half) {
    const double keep = viscous > 0.0 ? std::exp(-viscous * half) : 1.0;
    for (Grain &g : grains) {
      if (g.held) continue;
      g.v = keep * g.v + (half / g.mass) * g.f;
      g.w = keep * g.w + (half / g.inertia) * g.t;
      if (flat_ || transverse_only) g.w.x = g.w.y = g.v.z = 0.0;
      if (transverse_only) g.v.x = 0.0;
    }
  }

  // Columns of one block, filled from and written back to rows.
  struct Columns {
    using Lane = std::array<double, kBlock>;
    alignas(64) Lane rest, reference, radius, stiffness, ratio, beta, tan_phi, sigma_c, tau_c;
    alignas(64) Lane kn, ks, mu, alive, fsx, fsy, fsz, mbx, mby, mbz, mt, csx, csy, csz, sigma, tau, fate;
  };

  PairRow &row(std::size_t k) { return pairs[order_[std::min(k, order_.size() - 1)]]; }

  void fill(std::size_t first, Columns &c) {
    for (int b = 0; b < kBlock; ++b) {
      const PairRow &p = row(first + b);
      c.rest[b] = p.rest, c.reference[b] = p.reference, c.radius[b] = p.radius;
      c.stiffness[b] = p.stiffness, c.ratio[b] = p.ratio, c.beta[b] = p.beta;
      c.tan_phi[b] = p.tan_phi, c.sigma_c[b] = p.sigma_c, c.tau_c[b] = p.tau_c;
      c.kn[b] = p.kn, c.ks[b] = p.ks, c.mu[b] = p.mu, c.alive[b] = p.alive;
      c.fsx[b] = p.fs.x, c.fsy[b] = p.fs.y, c.fsz[b] = p.fs.z;
      c.mbx[b] = p.mb.x, c.mby[b] = p.mb.y, c.mbz[b] = p.mb.z, c.mt[b] = p.mt;
      c.csx[b] = p.cs.x, c.csy[b] = p.cs.y, c.csz[b] = p.cs.z;
      c.sigma[b] = c.tau[b] = 0.0, c.fate[b] = 0;
    }
  }

  void empty(std::size_t first, const Columns &c) {
    for (std::size_t k = first; k < std::min(first + kBlock, order_.size()); ++k) {
      const int b = static_cast<int>(k - first);
      PairRow &p = row(k);
      p.alive = c.alive[b], p.mt = c.mt[b], p.sigma = c.sigma[b], p.tau = c.tau[b];
      p.fs = {c.fsx[b], c.fsy[b], c.fsz[b]};
      p.mb = {c.mbx[b], c.mby[b], c.mbz[b]};
      p.cs = {c.csx[b], c.csy[b], c.csz[b]};
      if (p.bonded) p.fate = static_cast<BondFate>(static_cast<int>(c.fate[b]));
    }
  }

  void block_3d(std::size_t first, bool bonded, bool advance) {
    Columns c;
    Kinematics3 k;
    PairLoads3 out;
    fill(first, c);
    for (int b = 0; b < kBlock; ++b) {
      const PairRow &p = row(first + b);
      const Grain &i = grains[p.i], &j = grains[p.j];
      const Vec3 d = j.x - i.x, u = dt * (j.v - i.v), q = dt * (j.w - i.w);
      const double share = dt / (i.radius + j.radius);
      const Vec3 s = (share * i.radius) * i.w + (share * j.radius) * j.w;
      k.dx[b] = d.x, k.dy[b] = d.y, k.dz[b] = d.z, k.ux[b] = u.x, k.uy[b] = u.y, k.uz[b] = u.z;
      k.sx[b] = s.x, k.sy[b] = s.y, k.sz[b] = s.z, k.qx[b] = q.x, k.qy[b] = q.y, k.qz[b] = q.z;
      k.ri[b] = i.radius, k.rj[b] = j.radius, k.per_both[b] = 1.0 / (i.radius + j.radius);
    }
    const ContactParameters contact{c.reference.data(), c.kn.data(), c.ks.data(), c.mu.data()};
    PairRow *rows[kBlock];
    for (int b = 0; b < kBlock; ++b) rows[b] = &row(first + b);
    OptionColumns option(rows, dt);
    if (bonded && law) {
      Orientations3 o;
      for (int b = 0; b < kBlock; ++b) {
        const auto &i = grains[rows[b]->i].q, &j = grains[rows[b]->j].q;
        o.iw[b] = i[0], o.ix[b] = i[1], o.iy[b] = i[2], o.iz[b] = i[3];
        o.jw[b] = j[0], o.jx[b] = j[1], o.jy[b] = j[2], o.jz[b] = j[3];
      }
      law->block(*this, rows, k, o, contact, c.csx.data(), c.csy.data(), c.csz.data(), advance, out);
      for (int b = 0; b < kBlock; ++b) rows[b]->cs = {c.csx[b], c.csy[b], c.csz[b]};
    } else if (bonded) {
      const ParallelArrays3 a{c.rest.data(),    c.radius.data(), c.stiffness.data(), c.ratio.data(),
                              c.beta.data(),    c.tan_phi.data(), c.sigma_c.data(),  c.tau_c.data(),
                              c.alive.data(),   c.fsx.data(),    c.fsy.data(),       c.fsz.data(),
                              c.mbx.data(),     c.mby.data(),    c.mbz.data(),       c.mt.data(),
                              c.sigma.data(),   c.tau.data(),    c.fate.data()};
      switched(advance, options, contacts, [&](auto adv, auto opt, auto con) {
        parallel_block_3d<adv.value, opt.value, con.value>(
            k, a, contact, c.csx.data(), c.csy.data(), c.csz.data(), out, option.arrays());
      });
      option.put_back(rows);
    } else {
      contact_block_3d(k, contact, advance, c.csx.data(), c.csy.data(), c.csz.data(), out);
    }
    if (!bonded || !law) empty(first, c);
    for (std::size_t r = first; r < std::min(first + kBlock, order_.size()); ++r) {
      const int b = static_cast<int>(r - first);
      row(r).force = {out.fx[b], out.fy[b], out.fz[b]};
      row(r).moment_i = {out.tix[b], out.tiy[b], out.tiz[b]};
      row(r).moment_j = {out.tjx[b], out.tjy[b], out.tjz[b]};
    }
  }

  void block_2d(std::size_t first, bool bonded, bool advance) {
    Columns c;
    Kinematics2 k;
    PairLoads2 out;
    fill(first, c);
    for (int b = 0; b < kBlock; ++b) {
      const PairRow &p = row(first + b);
      const Grain &i = grains[p.i], &j = grains[p.j];
      k.dx[b] = j.x.x - i.x.x, k.dy[b] = j.x.y - i.x.y;
      k.ux[b] = dt * (j.v.x - i.v.x), k.uy[b] = dt * (j.v.y - i.v.y);
      k.s[b] = dt / (i.radius + j.radius) * (i.radius * i.w.z + j.radius * j.w.z);
      k.q[b] = dt * (j.w.z - i.w.z);
      k.ri[b] = i.radius, k.rj[b] = j.radius, k.per_both[b] = 1.0 / (i.radius + j.radius);
    }
    const ContactParameters contact{c.reference.data(), c.kn.data(), c.ks.data(), c.mu.data()};
    PairRow *rows[kBlock];
    for (int b = 0; b < kBlock; ++b) rows[b] = &row(first + b);
    OptionColumns option(rows, dt);
    if (bonded && law) {
      Orientations2 o;
      for (int b = 0; b < kBlock; ++b) {
        const auto &i = grains[rows[b]->i].q, &j = grains[rows[b]->j].q;
        o.iw[b] = i[0], o.iz[b] = i[3], o.jw[b] = j[0], o.jz[b] = j[3];
      }
      law->block(*this, rows, k, o, contact, c.csx.data(), advance, out);
      for (int b = 0; b < kBlock; ++b) rows[b]->cs = {c.csx[b], 0.0, 0.0};
    } else if (bonded) {
      const ParallelArrays2 a{c.rest.data(), c.radius.data(),  c.stiffness.data(), c.ratio.data(),
                              c.beta.data(), c.tan_phi.data(), c.sigma_c.data(),   c.tau_c.data(),
                              thickness_,    c.alive.data(),   c.fsx.data(),       c.mbx.data(),
                              c.sigma.data(), c.tau.data(),    c.fate.data()};
      switched(advance, options, contacts, [&](auto adv, auto opt, auto con) {
        parallel_block_2d<adv.value, opt.value, con.value>(k, a, contact, c.csx.data(), out,
                                                           option.arrays());
      });
      option.put_back(rows);
    } else {
      contact_block_2d(k, contact, advance, c.csx.data(), out);
    }
    if (!bonded || !law) empty(first, c);
    for (std::size_t r = first; r < std::min(first + kBlock, order_.size()); ++r) {
      const int b = static_cast<int>(r - first);
      row(r).force = {out.fx[b], out.fy[b], 0.0};
      row(r).moment_i = {0.0, 0.0, out.ti[b]};
      row(r).moment_j = {0.0, 0.0, out.tj[b]};
    }
  }
};

}  // namespace bondlab::laws::testbench

#endif
