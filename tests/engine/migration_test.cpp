// SPDX-License-Identifier: GPL-2.0-or-later
//
// Particles that change rank take their bonds, contacts and memory along: specimens that move, turn
// or are displaced through the boundaries between ranks come out as on one rank, bit for bit.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

constexpr double kPi = 3.14159265358979323846;

std::string run(const std::string &deck, int ranks, const EngineFolder &folder) {
  const EngineResult r = run_deck(folder, deck, ranks, {}, 300.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  return folder.read("end.txt");
}

// A cluster of n x n x n spheres (n x n discs), touching, turning about z and moving along x.
struct Cluster {
  int dimension = 3, n = 5;
  double speed = 0.0, spin = 0.0, start = 0.0;  // m/s, rad/s, m
  double spacing = 2e-3;                        // m

  std::string data(double half_width) const {
    std::vector<Particle> particles;
    std::ostringstream velocities;
    velocities.precision(17);
    const double d = spacing;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < (dimension == 3 ? n : 1); ++k) {
          Particle p;
          // not quite a lattice, so that no force is zero by symmetry
          p.x = start + d * (i - 0.5 * (n - 1)) + 1e-5 * std::sin(7.0 * i + 3.0 * j + k);
          p.y = d * (j - 0.5 * (n - 1)) + 1e-5 * std::sin(5.0 * i - 2.0 * j + 4.0 * k);
          p.z = dimension == 3 ? d * (k - 0.5 * (n - 1)) : 0.0;
          p.radius = 1e-3 * (1.0 - 0.02 * ((i + 2 * j + 3 * k) % 5));
          particles.push_back(p);
          velocities << particles.size() << ' ' << speed - spin * p.y << ' ' << spin * (p.x - start)
                     << " 0 0 0 " << spin << '\n';
        }
    return data_file(particles, dimension, half_width) + "\nVelocities\n\n" + velocities.str();
  }

  Preamble deck(const EngineFolder &folder) const {
    folder.write("cluster.data", data(0.03));
    Preamble p;
    p.dimension = dimension;
    p.specimen = "cluster.data";
    p.install = "gap 3e-4";
    p.skin = "2e-4";
    if (dimension == 2) p.atom_style = "bonded/sphere thickness 0.01";
    return p;
  }
};

}  // namespace

class Moving : public testing::TestWithParam<int> {};

// 25 mm to the right: through the boundary between 2 ranks and three of 4.
TEST_P(Moving, translation_through_rank_boundaries) {
  Cluster c;
  c.dimension = GetParam();
  c.speed = 200.0;
  c.start = -0.0125;
  const auto deck = [&](const EngineFolder &f, const char *grid) {
    return std::string("processors ") + grid + "\n" + c.deck(f).text() +
           "velocity all ramp vy 0 0.5 x -0.02 0.0 sum yes\n"  // and vibrating
           "fix integrate all nve/bonded\nvariable n equal ceil(1.25e-4/dt)\nrun $n\n" +
           dump_all("end.txt");
  };
  EngineFolder one, two, four;
  const std::string alone = run(deck(one, "1 1 1"), 1, one);
  const auto rows = read_dump(one, "end.txt");
  EXPECT_GT(rows.at(1)[0], 0.0);  // it has arrived
  EXPECT_TRUE(alone == run(deck(two, "2 1 1"), 2, two)) << "2 ranks";
  EXPECT_TRUE(alone == run(deck(four, "4 1 1"), 4, four)) << "4 ranks";
}

// A quarter of a turn about a point where four ranks meet; momenta as at the start.
TEST_P(Moving, rotation_about_a_corner_of_four_ranks) {
  Cluster c;
  c.dimension = GetParam();
  c.spin = 5000.0;
  const auto deck = [&](const EngineFolder &f, const char *grid) {
    return std::string("processors ") + grid + "\n" + c.deck(f).text() +
           "fix integrate all nve/bonded\nvariable n equal ceil(" + std::to_string(0.5 * kPi / c.spin) +
           "/dt)\nrun $n\n" + dump_all("end.txt");
  };
  EngineFolder one, four;
  EXPECT_TRUE(run(deck(one, "1 1 1"), 1, one) == run(deck(four, "2 2 1"), 4, four));
  // angular momentum about the centre of the cluster, up to a common factor of all masses
  std::map<int, double> radius;
  std::map<int, Row> start;
  std::istringstream data(one.read("cluster.data"));
  std::string line;
  while (std::getline(data, line) && line != "Atoms") {
  }
  while (std::getline(data, line) && line != "Velocities") {
    std::istringstream f(line);
    int id, type;
    double diameter, density, x, y, z;
    if (f >> id >> type >> diameter >> density >> x >> y >> z) {
      radius[id] = 0.5 * diameter;
      start[id] = {x, y, z, -c.spin * y, c.spin * x, 0, 0, 0, c.spin};
    }
  }
  const auto momentum = [&](const std::map<int, Row> &rows) {
    double L = 0.0;
    for (const auto &[id, r] : rows) {
      const double R = radius[id], m = c.dimension == 2 ? R * R : R * R * R;
      L += m * (r[0] * r[4] - r[1] * r[3]) + (c.dimension == 2 ? 0.5 : 0.4) * m * R * R * r[8];
    }
    return L;
  };
  const std::map<int, Row> end = read_dump(one, "end.txt");
  EXPECT_NEAR(momentum(end) / momentum(start), 1.0, 1e-12);
  // it started in the corner (-,-): a quarter of a turn brings it to (+,-)
  EXPECT_NEAR(std::atan2(end.at(1)[1], end.at(1)[0]), -0.25 * kPi, 0.2);
}

// Weak bonds that break, grains that slide on each other, all flying through the boundaries.
TEST_P(Moving, rubble_with_sliding_contacts) {
  Cluster c;
  c.dimension = GetParam();
  c.speed = 200.0;
  c.start = -0.0125;
  const auto deck = [&](const EngineFolder &f, const char *grid) {
    Preamble p = c.deck(f);
    p.bond = "5e9 2.0 5e6 5e6 scatter weibull 3 3";
    return std::string("processors ") + grid + "\n" + p.text() +
           "velocity all ramp vy -20 20 x -0.0175 -0.0075 sum yes\n"
           "velocity all ramp vx 20 -20 x -0.0175 -0.0075 sum yes\n"
           "fix log all bond/log 10 broken.tsv\n"
           "fix integrate all nve/bonded\nvariable n equal ceil(1.25e-4/dt)\nrun $n\n" +
           dump_all("end.txt");
  };
  EngineFolder one, four;
  const std::string alone = run(deck(one, "1 1 1"), 1, one);
  EXPECT_GT(read_table(one.file("broken.tsv")).rows.size(), c.dimension == 2 ? 8u : 50u);
  EXPECT_TRUE(alone == run(deck(four, "4 1 1"), 4, four));
  EXPECT_EQ(one.read("broken.tsv"), four.read("broken.tsv"));
}

// Pairs left unbonded within a bonded body stay in contact, with a history of shear, all the way.
TEST_P(Moving, contacts_within_a_bonded_body) {
  Cluster c;
  c.dimension = GetParam();
  c.speed = 200.0;
  c.start = -0.0125;
  c.spacing = 1.9e-3;  // overlapping
  const auto deck = [&](const EngineFolder &f, const char *grid) {
    Preamble p = c.deck(f);
    const int depth = c.dimension == 3 ? c.n : 1;
    std::string list;
    for (int i = 0; i < c.n; ++i)
      for (int j = 0; j < c.n; ++j)
        for (int k = 0; k < depth; ++k) {
          const int id = 1 + (i * c.n + j) * depth + k, next[3] = {id + c.n * depth, id + depth, id + 1};
          const bool there[3] = {i + 1 < c.n, j + 1 < c.n, k + 1 < depth};
          for (int d = 0; d < 3; ++d)
            if (there[d] && (i + 2 * j + 3 * k + d) % 3 != 0)
              list += std::to_string(id) + " " + std::to_string(next[d]) + "\n";
        }
    f.write("pairs", list);
    p.install = "file pairs";
    return std::string("processors ") + grid + "\n" + p.text() +
           "velocity all ramp vy -2 2 x -0.0175 -0.0075 sum yes\n"
           "fix integrate all nve/bonded\nvariable n equal ceil(1.25e-4/dt)\nrun $n\n" +
           dump_all("end.txt");
  };
  EngineFolder one, four;
  EXPECT_TRUE(run(deck(one, "1 1 1"), 1, one) == run(deck(four, "4 1 1"), 4, four));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Moving, testing::Values(2, 3));

// Between bond_install and the first run nothing has put particles in order but bond_install.
TEST(Migration, displaced_between_bonding_and_the_first_run) {
  Cluster c;
  c.start = -0.012;
  const auto deck = [&](const EngineFolder &f, const char *grid) {
    return std::string("processors ") + grid + "\n" + c.deck(f).text() +
           "displace_atoms all move 0.024 0.001 0\nvelocity all ramp vy 0 0.5 x 0.0 0.02\n"
           "fix integrate all nve/bonded\nrun 200\n" + dump_all("end.txt");
  };
  EngineFolder one, two;
  EXPECT_TRUE(run(deck(one, "1 1 1"), 1, one) == run(deck(two, "2 1 1"), 2, two));
  // with timestep_bonded left out too (it rebuilds the ghosts)
  EngineFolder three, four;
  const auto bare = [&](const EngineFolder &f, const char *grid) {
    Preamble q = c.deck(f);
    q.safety = 0.0;
    return std::string("processors ") + grid + "\n" + q.text() +
           "timestep 1e-7\ndisplace_atoms all move 0.024 0.001 0\nvelocity all ramp vy 0 0.5 x 0.0 0.02\n"
           "fix integrate all nve/bonded\nrun 200\n" + dump_all("end.txt");
  };
  EXPECT_TRUE(run(bare(three, "1 1 1"), 1, three) == run(bare(four, "2 1 1"), 2, four));
}

// A particle with 400 bonds: 5,600 numbers, more than the engine reserves for one that migrates.
TEST(Migration, particle_with_hundreds_of_bonds) {
  std::vector<Particle> particles(1);
  particles[0].radius = 8e-3;
  particles[0].x = -0.012;
  const int n = 400;
  for (int k = 0; k < n; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / n, r = std::sqrt(1.0 - z * z), a = k * kPi * (3.0 - std::sqrt(5.0));
    Particle p;
    p.radius = 3e-4;
    const double d = 8.3e-3;
    p.x = -0.012 + d * r * std::cos(a), p.y = d * r * std::sin(a), p.z = d * z;
    particles.push_back(p);
  }
  const auto deck = [&](const EngineFolder &f, const char *grid) {
    f.write("hub.data", data_file(particles, 3, 0.03));
    Preamble p;
    p.specimen = "hub.data";
    p.install = "gap 1e-6";
    p.skin = "5e-4";
    return std::string("processors ") + grid + "\n" + p.text() +
           "velocity all set 2000 0 0\nvelocity all ramp vy 0 5 z -0.01 0.01\n"
           "fix integrate all nve/bonded\nvariable n equal ceil(1.2e-5/dt)\nrun $n\n" + dump_all("end.txt");
  };
  EngineFolder one, two;
  const std::string alone = run(deck(one, "1 1 1"), 1, one);
  EXPECT_GT(read_dump(one, "end.txt").at(1)[0], 0.005);
  EXPECT_TRUE(alone == run(deck(two, "2 1 1"), 2, two));
}
