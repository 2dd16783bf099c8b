// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a made-up result for the tests of this room: run files of two tests and the ReportInput that
//   goes with them.
// Method: discs on a jittered triangular lattice, cracks chosen along a band (compression) and a
//   diameter (Brazilian), curves from a simple formula. Nothing here is physics; it only has the
//   shape of real files. Everything follows from `spacing`.
// Units: SI.
// Failure: UserError when a file can't be written.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/random.h"
#include "report/atomic_file.h"
#include "report/report.h"

namespace bondlab::example {

struct Disc {
  double x, y, r;
};

inline std::vector<Disc> discs_in(bool disc_shape, double spacing, RandomStream &random) {
  std::vector<Disc> discs;
  const double row = spacing * std::sqrt(3.0) / 2;
  for (int j = 0; j * row < 0.1; ++j)
    for (int i = -200; i <= 200; ++i) {
      const double x = (i + 0.5 * (j % 2)) * spacing + 0.12 * spacing * (random.uniform() - 0.5);
      const double y =
          (j + 0.5) * row + 0.12 * spacing * (random.uniform() - 0.5) - (disc_shape ? 0.05 : 0);
      const double r = spacing * (0.4 + 0.12 * random.uniform());
      if (disc_shape ? std::hypot(x, y) + r < 0.025 : std::fabs(x) + r < 0.025 && y + r < 0.1)
        discs.push_back({x, y, r});
    }
  return discs;
}

inline void write_particles(const std::filesystem::path &file, const std::vector<Disc> &discs) {
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n50000\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n-0.1 0.1\n-0.1 "
      "0.2\n-0.001 0.001\n"
      "ITEM: ATOMS id type radius x y z\n",
      discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i)
    text += fmt::format("{} 1 {:.9g} {:.9g} {:.9g} 0\n", i + 1, discs[i].r, discs[i].x, discs[i].y);
  write_whole_file(file, text);
}

// Bonds whose middle is within `width` of the line through (x0, y0) with slope angle, and a few
// anywhere.
inline std::string broken_bonds(const std::vector<Disc> &discs, double spacing, double angle,
                                double x0, double y0, double width, RandomStream &random,
                                std::size_t *count) {
  std::string text =
      "# bondlab-broken-bonds 1\n# names: "
      "step\ttime\tid1\tid2\ttype\tx\ty\tz\tmode\tsigma\ttau\tsigma_c\ttau_c\n"
      "# units: 1\ts\t1\t1\t1\tm\tm\tm\t1\tPa\tPa\tPa\tPa\n";
  struct Event {
    double time;
    std::string rest;
  };
  std::vector<Event> events;
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (std::size_t j = i + 1; j < discs.size(); ++j) {
      if (std::fabs(discs[i].y - discs[j].y) > 1.3 * spacing ||
          std::hypot(discs[i].x - discs[j].x, discs[i].y - discs[j].y) > 1.3 * spacing)
        continue;
      const double x = (discs[i].x + discs[j].x) / 2, y = (discs[i].y + discs[j].y) / 2;
      const double off = std::fabs(std::cos(angle) * (y - y0) - std::sin(angle) * (x - x0));
      const bool band = off < width && random.uniform() < 0.75, stray = random.uniform() < 0.02;
      if (!band && !stray) continue;
      const double time =
          band ? 0.0078 + 0.0022 * random.uniform() : 0.005 + 0.004 * random.uniform();
      events.push_back(
          {time, fmt::format("{}\t{}\t1\t{:.9g}\t{:.9g}\t0\t{}\t1e7\t2e7\t1e7\t3e7\n", i + 1, j + 1,
                             x, y, random.uniform() < (band ? 0.35 : 0.08) ? "shear" : "tension")});
    }
  std::sort(events.begin(), events.end(),
            [](const Event &a, const Event &b) { return a.time < b.time; });
  for (const Event &event : events)
    text += fmt::format("{}\t{:.7g}\t{}", std::lround(event.time * 5e6), event.time, event.rest);
  *count = events.size();
  return text + "# complete: end_of_run\n";
}

// Share of the peak load at time t of 0.01 s: straight, bending over at 0.0085 s, then falling.
inline double load(double t) {
  const double s = t / 0.0085;
  return s <= 1 ? s * (1 + 0.18 * (1 - s) * s) - 0.02 * std::pow(s, 12) + 0.02 * s
                : std::max(0.3, 1 - 12 * (s - 1) * (s - 1) - 2.4 * (s - 1));
}

inline std::string uniaxial_curve(std::size_t broken) {
  std::string text =
      "# bondlab-curve 1\n# names: "
      "step\ttime\tdisplacement\taxial_stress\tforce_top\tforce_bottom\tstrain_platen\tstrain_"
      "axial\t"
      "strain_lateral\tbroken_bonds\tkinetic_energy\tstrain_energy\n# units: "
      "1\ts\tm\tPa\tN\tN\t1\t1\t1\t1\tJ\tJ\n";
  for (int i = 0; i <= 1000; ++i) {
    const double t = 1e-5 * i, strain = 0.0034 * t / 0.0085, p = 138.2e6 * load(t),
                 wave = 0.15e6 * std::sin(i * 0.7);
    const double crack = std::pow(t / 0.01, 9);
    text += fmt::format(
        "{}\t{:.7g}\t{:.7g}\t{:.8g}\t{:.8g}\t{:.8g}\t{:.7g}\t{:.7g}\t{:.7g}\t{}\t0\t0\n", 50 * i, t,
        0.1 * strain, p + wave, (p + wave) * 0.05, (p - wave) * 0.05, strain * 1.02, strain,
        0.23 * strain * (1 + 1.5 * crack), std::lround(static_cast<double>(broken) * crack));
  }
  return text + "# complete: stop_after_peak\n";
}

inline std::string brazilian_curve(std::size_t broken) {
  std::string text =
      "# bondlab-curve 1\n# names: "
      "step\ttime\tdisplacement\tforce_top\tforce_bottom\tbroken_bonds\tkinetic_energy\tstrain_"
      "energy\n"
      "# units: 1\ts\tm\tN\tN\t1\tJ\tJ\n";
  for (int i = 0; i <= 600; ++i) {
    const double t = i / 6e4, p = 1.25e6 * load(t) * (1 - std::exp(-600 * t));
    text += fmt::format("{}\t{:.7g}\t{:.7g}\t{:.8g}\t{:.8g}\t{}\t0\t0\n", 50 * i, t,
                        1.5e-4 * t / 0.01, p * 1.004, p * 0.996,
                        std::lround(static_cast<double>(broken) * std::pow(t / 0.01, 8)));
  }
  return text + "# complete: stop_after_peak\n";
}

inline ReportTarget target(const std::string &name, const std::string &test,
                           const std::string &function, const std::string &unit, double measured,
                           double sd, double simulated, bool in_fit) {
  ReportTarget t;
  t.name = name, t.test = test, t.function = function, t.unit = unit;
  t.measured = measured, t.sd = sd, t.simulated = simulated, t.in_fit = in_fit;
  t.tolerance = 0.03 * measured, t.met = std::fabs(simulated - measured) <= t.tolerance;
  t.noise_sd = 0.004 * measured;
  t.source = "granite data sheet, table 1", t.sd_source = "assumed";
  return t;
}

inline ReportFit fit(const std::string &name, bool all, RandomStream &random) {
  ReportFit f;
  f.name = name;
  f.converged = true, f.misfit = all ? 41.7 : 0.0823, f.degrees_of_freedom = all ? 1 : 0;
  f.targets = {
      target("E", "ucs", "uniaxial.tangent_modulus_gauge", "GPa", 41.5, 1.245,
             all ? 40.37 : 41.6231, true),
      target("nu", "ucs", "uniaxial.poisson_gauge", "1", 0.23, 0.0115, all ? 0.2371 : 0.2284, true),
      target("UCS", "ucs", "uniaxial.peak_stress", "MPa", 138.8, 6.94, all ? 113.9 : 138.2, true),
      target("sigma_t", "split", "brazilian.tensile_strength", "MPa", 9.5, 0.95,
             all ? 12.94 : 15.87, all)};
  const char *names[] = {"E_c", "kn_ks", "sigma_c"}, *units[] = {"GPa", "1", "MPa"};
  const double values[] = {28.43, 1.87, all ? 84.1 : 102.6}, sds[] = {0.91, 0.14, 4.3},
               low[] = {15, 1, 40}, high[] = {45, 4, 180};
  for (int p = 0; p < 3; ++p) {
    ReportParameter q;
    q.name = names[p], q.unit = units[p], q.value = values[p], q.sd = sds[p], q.lower = low[p],
    q.upper = high[p];
    q.interval_lower = q.value - 1.96 * q.sd, q.interval_upper = q.value + 1.96 * q.sd;
    q.logarithmic = p != 1;
    q.sets = p == 0   ? std::vector<std::string>{"E_c", "E_b"}
             : p == 1 ? std::vector<std::string>{"kn_ks", "kb_ratio"}
                      : std::vector<std::string>{"sigma_c"};
    f.parameters.push_back(q);
  }
  f.correlation = {{1, -0.86, 0.11}, {-0.86, 1, 0.02}, {0.11, 0.02, 1}};
  double best = INFINITY;
  for (int i = 0; i < 26; ++i) {
    ReportStep step;
    step.runs = 2 * (i + 1);
    step.phase = i < 12 ? "design" : i < 15 ? "noise" : "refine";
    const double shrink = i < 12 ? 1 : 0.5 * std::exp(-0.35 * (i - 12));
    for (int p = 0; p < 3; ++p)
      step.parameters.push_back(i < 12 ? low[p] + (high[p] - low[p]) * random.uniform()
                                       : values[p] * (1 + 0.3 * shrink * (random.uniform() - 0.5)));
    step.misfit =
        f.misfit + (i < 12 ? 60 + 900 * random.uniform() : 80 * shrink * shrink * random.uniform());
    if (i == 5) step.misfit = no_number;
    if (step.misfit < best) best = step.misfit, step.accepted = true;
    step.best_misfit = best;
    f.history.push_back(step);
  }
  f.forward_runs = 52, f.from_store = all ? 30 : 0, f.failed_runs = 1, f.wall_seconds = 552,
  f.run_seconds = 1042;
  f.notes = {"12 parameter sets were placed by a Latin hypercube.",
             "The noise of the responses was measured with 3 runs.",
             "Marquardt steps ended after 5 steps."};
  f.replay = "bondlab fit inputs/studies/granite.toml --fit " + name;
  return f;
}

// Writes the run files below `directory` and returns the input. `spacing` 1.75e-3 gives about 1,900
// discs, 5e-3 about 200.
inline ReportInput make(const std::filesystem::path &directory, double spacing = 5e-3) {
  RandomStream random(7);
  ReportInput input;
  input.study_name = "granite",
  input.study_title = "Granite: three bond parameters from four measured properties";
  input.study_file = "inputs/studies/granite.toml";
  input.tolerance_text =
      "a target is met when the simulated figure lies within 3 % of the measured one";
  input.fits = {fit("main", false, random), fit("trade-off", true, random)};
  ReportFit &main = input.fits[0];
  for (const char *test : {"ucs", "split"}) {
    const bool ucs = std::string(test) == "ucs";
    const std::filesystem::path run = std::filesystem::path("runs") / (std::string(test) + "-4f2a");
    std::filesystem::create_directories(directory / run);
    const std::vector<Disc> discs = discs_in(!ucs, spacing, random);
    std::size_t count = 0;
    const std::string events =
        ucs ? broken_bonds(discs, spacing, 1.12, 0, 0.05, 1.6e-3, random, &count)
            : broken_bonds(discs, spacing, 1.5707963, 0, 0, 0.9e-3, random, &count);
    write_particles(directory / run / "particles_end.txt", discs);
    write_whole_file(directory / run / "broken_bonds.tsv", events);
    write_whole_file(directory / run / "curve.tsv",
                     ucs ? uniaxial_curve(count) : brazilian_curve(count));
    ReportRunFiles files;
    files.test = test, files.kind = ucs ? "uniaxial_compression" : "brazilian",
    files.directory = run.string();
    files.variables = {
        {"dim", 2}, {"diameter", 0.05}, {"thickness", 1}, {"width", 0.05}, {"height", 0.1}};
    files.quality = {{"platen_imbalance", 0.0123}};
    files.run_id = "4f2a", files.wall_seconds = 21.3;
    files.replay = "cd " + run.string() + " && mpirun -np 1 lmp_bondlab -in in." + files.kind;
    main.best_runs.push_back(files);
  }
  main.findings.push_back({"unreachable_ratio",
                           "UCS / sigma_t was between 8.1 and 9.3 in 38 parameter sets; measured "
                           "is 14.6. The two exclude each other in this model.",
                           {"UCS", "sigma_t"},
                           14.61,
                           8.1,
                           9.3,
                           38});
  input.fits[1].findings = main.findings;
  for (const ReportTarget &t : main.targets) {
    ReportPacking packing;
    packing.name = t.name, packing.unit = t.unit, packing.measured = t.measured,
    packing.used = t.simulated;
    packing.values = {t.simulated * 1.012, t.simulated * 0.984, t.simulated * 1.031};
    packing.mean = t.simulated * 1.009, packing.sd = t.simulated * 0.0236;
    main.packings.push_back(packing);
  }
  for (const ReportStep &step : main.history) {
    ReportPoint point;
    point.phase = step.phase, point.parameters = step.parameters;
    const double e = step.parameters[0], k = step.parameters[1], s = step.parameters[2];
    point.responses = {{"E", 1.75 * e / std::pow(k, 0.28)},
                       {"nu", 0.1 + 0.068 * k},
                       {"UCS", 1.35 * s * std::pow(k, -0.02)}};
    if (step.runs != 12)
      point.responses["sigma_t"] = point.responses["UCS"] / (8.1 + 1.2 * random.uniform());
    input.points.push_back(point);
  }
  input.specimens = {
      {"compression", "rectangle", "50 mm \u00d7 100 mm", 2043, 0.66e-3, 1.0956e-3, 0.158, 4.12,
       "1"},
      {"brazilian", "disc", "diameter 50 mm", 812, 0.66e-3, 1.0956e-3, 0.161, 4.08, "1"}};
  input.assumptions = {
      {"The radius multiplier of the bonds is 1.", "paper, section 3.2"},
      {"Bond and grain moduli are equal, and so are their stiffness ratios.", "paper, section 3.2"},
      {"The standard deviations of E, nu and UCS are 3, 5 and 5 %.", "assumed"}};
  input.resolution_note =
      "The smallest particle radius is 0.66 mm. It carries the fracture toughness: K_IC grows with "
      "the square root of the radius, "
      "so that strengths found with one radius hold for that radius only.";
  input.confirm_command = "bondlab fit inputs/studies/granite_12952.toml";
  for (int i = 0; i < 52; ++i) {
    ReportRun run;
    run.id = fmt::format("{:08x}", 0x4f2a0000u + 7919u * static_cast<unsigned>(i)),
    run.test = i % 2 ? "split" : "ucs";
    run.wall_seconds = 18 + 0.1 * i;
    run.steps = 14900, run.particles = 573, run.bonds = 1226, run.bond_step_ns = 31 + i % 2;
    run.directory = "runs/" + run.test + "-" + run.id;
    if (i == 11)
      run.ok = false, run.cause = "lost_atoms",
      run.message = "Lost atoms: original 812 current 811 (in.brazilian, step 41200).";
    input.ledger.push_back(run);
  }
  input.replay = "bondlab fit inputs/studies/granite.toml";
  return input;
}

}  // namespace bondlab::example
