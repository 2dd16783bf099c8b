// SPDX-License-Identifier: GPL-2.0-or-later
//
// What the laws' kernels cost alone: nanoseconds a bond for one block after another, without the
// engine, gathering or adding up. Run by `tools/bench --kernels`.
//
// Method: 16 blocks with columns of their own (about 100 kB: beyond the first cache, within the
// second) stand for a packing; bonds carry small random motion and none breaks, as in the elastic stage
// of a test. What comes out is checked to be a number: a kernel that met not-a-numbers would be timed
// for nothing.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <vector>

#include "beam_mohr_coulomb.h"
#include "norton.h"
#include "norton_type.h"
#include "parallel.h"
#include "strength.h"

namespace {

using namespace bondlab::laws;

constexpr int kBlocks = 16;

// Columns of kBlock values each; numbers from a hash, the same at every run.
class Columns {
 public:
  double *of(double value) {
    columns_.emplace_back();
    for (double &v : columns_.back().lane) v = value;
    return columns_.back().lane;
  }
  double *around(double centre, double spread) {
    double *column = of(0.0);
    for (int b = 0; b < kBlock; ++b)
      column[b] = centre + spread * (2.0 * uniform_of_pair(++drawn_, 1, 7, 0) - 1.0);
    return column;
  }

 private:
  struct alignas(64) Column {
    double lane[kBlock];
  };
  std::deque<Column> columns_;
  std::int64_t drawn_ = 0;
};

struct Motion {
  Kinematics3 space;
  Kinematics2 plane;
  Orientations3 turned;
};

Motion motion(Columns &c) {
  Motion m;
  const auto put = [&](double *to, const double *from) { std::copy(from, from + kBlock, to); };
  const double R = 1e-3, small = 1e-9;
  for (double *to : {m.space.dx, m.plane.dx}) put(to, c.around(1.2 * R, 0.1 * R));
  for (double *to : {m.space.dy, m.plane.dy}) put(to, c.around(1.6 * R, 0.1 * R));
  put(m.space.dz, c.around(0.0, 0.1 * R));
  for (double *to : {m.space.ux, m.space.uy, m.space.uz, m.plane.ux, m.plane.uy})
    put(to, c.around(0.0, small * R));
  for (double *to : {m.space.sx, m.space.sy, m.space.sz, m.space.qx, m.space.qy, m.space.qz, m.plane.s,
                     m.plane.q})
    put(to, c.around(0.0, small));
  for (double *to : {m.space.ri, m.space.rj, m.plane.ri, m.plane.rj}) put(to, c.around(R, 0.1 * R));
  for (int b = 0; b < kBlock; ++b) {
    m.space.per_both[b] = 1.0 / (m.space.ri[b] + m.space.rj[b]);
    m.plane.per_both[b] = 1.0 / (m.plane.ri[b] + m.plane.rj[b]);
  }
  for (double *to : {m.turned.iw, m.turned.jw}) put(to, c.of(1.0));
  for (double *to : {m.turned.ix, m.turned.iy, m.turned.iz, m.turned.jx, m.turned.jy, m.turned.jz})
    put(to, c.around(0.0, 1e-6));
  return m;
}

ContactParameters contact(Columns &c) { return {c.of(2e-3), c.of(1e7), c.of(4e6), c.of(0.5)}; }

OptionArrays options(Columns &c) { return {c.of(0.8), c.of(10.0), c.of(0.1), c.of(0.0), c.of(0.0)}; }

void finish(benchmark::State &state, double probe) {
  if (!std::isfinite(probe)) state.SkipWithError("not a number");
  state.counters["ns/bond"] = benchmark::Counter(
      1e-9 * kBlocks * kBlock, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <bool with_options, bool with_contact>
void parallel_3d(benchmark::State &state) {
  Columns c;
  struct One {
    Motion m;
    ParallelArrays3 a;
    ContactParameters contact;
    OptionArrays o;
    double *cs[3];
  };
  std::vector<One> blocks;
  for (int k = 0; k < kBlocks; ++k)
    blocks.push_back({motion(c),
                      {c.around(2e-3, 1e-5), c.of(1e-3), c.of(5e12), c.of(2.5), c.of(1.0), c.of(0.0), c.of(1e30),
                       c.of(1e30), c.of(1.0), c.of(0.0), c.of(0.0), c.of(0.0), c.of(0.0), c.of(0.0), c.of(0.0),
                       c.of(0.0), c.of(0.0), c.of(0.0), c.of(0.0)},
                      contact(c), options(c), {c.of(0.0), c.of(0.0), c.of(0.0)}});
  PairLoads3 loads;
  double probe = 0.0;
  for (auto unused : state) {
    (void)unused;
    for (One &b : blocks) {
      parallel_block_3d<true, with_options, with_contact>(b.m.space, b.a, b.contact, b.cs[0], b.cs[1], b.cs[2],
                                                          loads, b.o);
      benchmark::DoNotOptimize(loads);
    }
    probe += loads.fx[5];
  }
  finish(state, probe);
}

void parallel_2d(benchmark::State &state) {
  Columns c;
  struct One {
    Motion m;
    ParallelArrays2 a;
    ContactParameters contact;
    double *cs;
  };
  std::vector<One> blocks;
  for (int k = 0; k < kBlocks; ++k)
    blocks.push_back({motion(c),
                      {c.around(2e-3, 1e-5), c.of(1e-3), c.of(5e12), c.of(2.5), c.of(1.0), c.of(0.0), c.of(1e30),
                       c.of(1e30), 1.0, c.of(1.0), c.of(0.0), c.of(0.0), c.of(0.0), c.of(0.0), c.of(0.0)},
                      contact(c), c.of(0.0)});
  PairLoads2 loads;
  double probe = 0.0;
  for (auto unused : state) {
    (void)unused;
    for (One &b : blocks) {
      parallel_block_2d<true>(b.m.plane, b.a, b.contact, b.cs, loads);
      benchmark::DoNotOptimize(loads);
    }
    probe += loads.fx[5];
  }
  finish(state, probe);
}

void beam_3d(benchmark::State &state) {
  Columns c;
  struct One {
    Motion m;
    BeamArrays3 a;
    ContactParameters contact;
    double *cs[3];
  };
  std::vector<One> blocks;
  for (int k = 0; k < kBlocks; ++k)
    blocks.push_back({motion(c),
                      {c.around(2e-3, 1e-5), c.of(1e-3), c.of(1e10), c.of(0.4), c.of(0.4), c.of(1.0), c.of(1.0),
                       c.of(1.0), c.of(1.0), c.of(1e30), c.of(1e300), c.of(0.5), c.of(0.0), c.of(1.0), c.of(0.0), c.of(0.0),
                       c.of(0.0), c.of(1.0), c.of(0.0), c.of(0.0), c.of(0.0), c.of(1.0), c.of(0.0), c.of(0.0),
                       c.of(0.0)},
                      contact(c), {c.of(0.0), c.of(0.0), c.of(0.0)}});
  PairLoads3 loads;
  double probe = 0.0;
  for (auto unused : state) {
    (void)unused;
    for (One &b : blocks) {
      beam_block_3d<true, false>(b.m.space, b.m.turned, b.a, {}, b.contact, b.cs[0], b.cs[1], b.cs[2], loads);
      benchmark::DoNotOptimize(loads);
    }
    probe += loads.fx[5];
  }
  finish(state, probe);
}

// state.range(0): ten times the exponent m; 0: nothing creeps.
void norton_3d(benchmark::State &state, CreepKind kind, bool moments) {
  Columns c;
  const double m = 0.1 * static_cast<double>(state.range(0));
  struct One {
    Motion m;
    NortonArrays3 a;
    ContactParameters contact;
    double *cs[3];
  };
  std::vector<One> blocks;
  for (int k = 0; k < kBlocks; ++k) {
    NortonConstants constants{c.of(2e-3), c.of(1e-3), c.of(1e9), c.of(0.4), c.of(1.0), c.of(1e300), c.of(1e300),
                              c.of(1e300), c.of(1e300), c.of(1e300), c.of(1e300), c.of(m),
                              c.of(-10.0 * m * std::log(10.0)), c.of(0.5 * (m + 1.0) * std::log(3.0)),
                              c.of(round_bend_shape(m))};
    blocks.push_back({motion(c),
                      {constants, c.around(2e-3, 1e-5), c.of(1.0), c.of(0.0), c.of(1e9), c.of(0.0), c.around(0, 1),
                       c.around(0, 1), c.around(0, 1), c.around(0, 1e-4), c.around(0, 1e-4), c.around(0, 1e-4),
                       c.around(0, 1e-4), c.of(0.0), c.of(0.0), c.of(0.0)},
                      contact(c), {c.of(0.0), c.of(0.0), c.of(0.0)}});
  }
  NortonStep step;
  step.creep = kind;
  step.moments = moments;
  step.log_time = std::log(1e-7);
  PairLoads3 loads;
  double probe = 0.0;
  for (auto unused : state) {
    (void)unused;
    for (One &b : blocks) {
      norton_block_3d<true>(b.m.space, b.a, step, b.contact, b.cs[0], b.cs[1], b.cs[2], loads);
      benchmark::DoNotOptimize(loads);
    }
    probe += loads.fx[5];
  }
  finish(state, probe);
}

BENCHMARK_TEMPLATE(parallel_3d, false, false)->Name("parallel 3D, bond alone");
BENCHMARK_TEMPLATE(parallel_3d, false, true)->Name("parallel 3D, with grain contact");
BENCHMARK_TEMPLATE(parallel_3d, true, true)->Name("parallel 3D, with contact and options");
BENCHMARK(parallel_2d)->Name("parallel 2D, with grain contact");
BENCHMARK(beam_3d)->Name("beam/mohr/coulomb 3D");
BENCHMARK_CAPTURE(norton_3d, none, CreepKind::none, false)->Name("norton 3D, no creep this step")->Arg(30);
BENCHMARK_CAPTURE(norton_3d, separate, CreepKind::separate, false)->Name("norton 3D, separate, m x 10")->Arg(10)->Arg(30)->Arg(35);
BENCHMARK_CAPTURE(norton_3d, coupled, CreepKind::coupled, false)->Name("norton 3D, coupled, m x 10")->Arg(10)->Arg(30)->Arg(35);
BENCHMARK_CAPTURE(norton_3d, moments, CreepKind::coupled, true)->Name("norton 3D, coupled with moments, m x 10")->Arg(35);

}  // namespace

BENCHMARK_MAIN();
