// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/run_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>
#include <unordered_map>

#include "base/table_file.h"
#include "base/user_error.h"
#include "specimen/data_file.h"
#include "specimen/neighbours.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

// What the log of a run tells: the last word on each, after the engine has put in its variables.
struct LogFacts {
  std::string text;
  double gap = 0;
  int dimension = 0;
  std::string specimen;  // of read_data
};

std::optional<double> number_of(const std::string &word) {
  double value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc() || result.ptr != word.data() + word.size()) return std::nullopt;
  return value;
}

LogFacts read_log(const fs::path &folder) {
  LogFacts facts;
  for (const char *name : {"log.bondlab", "log.liggghts", "log.lammps"})
    if (fs::is_regular_file(folder / name)) {
      facts.text = read_text_file(folder / name);
      break;
    }
  std::istringstream lines(facts.text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    if (words.size() < 2) continue;
    if (words[0] == "dimension")
      facts.dimension = static_cast<int>(number_of(words[1]).value_or(facts.dimension));
    if (words[0] == "read_data" && words[1].find('$') == std::string::npos)
      facts.specimen = words[1];
    if (words[0] == "bond_install")
      for (std::size_t i = 1; i + 1 < words.size(); ++i)
        if (words[i] == "gap") facts.gap = number_of(words[i + 1]).value_or(facts.gap);
  }
  return facts;
}

// The manifest of a run of the store; without one the fields stay empty.
struct ManifestFacts {
  std::string specimen, test;
  std::map<std::string, double> variables;
};

ManifestFacts read_manifest(const fs::path &folder) {
  ManifestFacts facts;
  const fs::path file = folder / "manifest.json";
  if (!fs::is_regular_file(file)) return facts;
  const nlohmann::json json = nlohmann::json::parse(read_text_file(file), nullptr, false);
  if (!json.is_object())
    throw UserError(Place{file.string(), 0, 0}, "not a JSON object, as a run's manifest is");
  facts.specimen = json.value("specimen", "");
  facts.test = json.value("virtual_test", "");
  if (json.contains("si"))
    for (const auto &[name, value] : json.at("si").items())
      if (value.is_number()) facts.variables[name] = value.get<double>();
  return facts;
}

using Places = std::unordered_map<int, Vector3>;

Places places_of(const std::vector<EndParticle> &particles) {
  Places places;
  for (const EndParticle &p : particles) places[p.id] = {p.x, p.y, p.z};
  return places;
}

std::optional<Places> find_start(const fs::path &folder, const ManifestFacts &manifest,
                                 const LogFacts &log) {
  if (fs::is_regular_file(folder / "particles_start.txt"))
    return places_of(read_particles(folder / "particles_start.txt"));
  for (const std::string &name : {manifest.specimen, log.specimen}) {
    if (name.empty()) continue;
    // A run of the store lies in OUT/runs/NAME and its specimen in OUT/specimens, wherever OUT has
    // been moved since.
    for (const fs::path &path : {fs::path(name), folder / name,
                                 folder / ".." / ".." / "specimens" / fs::path(name).filename()})
      if (fs::is_regular_file(path)) {
        Places places;
        for (const PackingRow &row : read_packing_file(path).rows)
          places[static_cast<int>(row.id)] = {row.particle.x, row.particle.y, row.particle.z};
        return places;
      }
  }
  return std::nullopt;
}

double mass_of(const RunView &run, const ViewParticle &p) {
  return run.dimension == 2 ? p.r * p.r : p.r * p.r * p.r;
}

std::unordered_map<int, int> index_by_id(const RunView &run) {
  std::unordered_map<int, int> index;
  for (std::size_t i = 0; i < run.particles.size(); ++i)
    index[run.particles[i].id] = static_cast<int>(i);
  return index;
}

// bonds_STEP.txt with the largest step, or a bonds.txt.
fs::path newest_bond_file(const fs::path &folder) {
  fs::path newest;
  long best = -2;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("bonds", 0) != 0 || entry.path().extension() != ".txt") continue;
    long step = -1;
    const std::size_t at = name.find_first_of("0123456789");
    if (at != std::string::npos) std::from_chars(name.data() + at, name.data() + name.size(), step);
    if (step > best || (step == best && entry.path() > newest)) {
      best = step;
      newest = entry.path();
    }
  }
  return newest;
}

}  // namespace

std::size_t RunView::broken(BondState state) const {
  return static_cast<std::size_t>(std::count_if(
      bonds.begin(), bonds.end(), [&](const ViewBond &bond) { return bond.state == state; }));
}

void find_bonds(RunView &run, const std::vector<BrokenBond> &events) {
  const std::unordered_map<int, int> index = index_by_id(run);
  std::map<std::pair<int, int>, std::size_t> known;
  const auto bond_of = [&](int a, int b) -> ViewBond & {
    const std::pair<int, int> pair(std::min(a, b), std::max(a, b));
    const auto [at, is_new] = known.emplace(pair, run.bonds.size());
    if (is_new) {
      run.bonds.emplace_back();
      run.bonds.back().a = pair.first, run.bonds.back().b = pair.second;
    }
    return run.bonds[at->second];
  };
  run.bonds.clear();
  if (run.has_start && run.gap > 0) {
    std::vector<Particle> start;
    for (const ViewParticle &p : run.particles)
      start.push_back({p.start[0], p.start[1], p.start[2], p.r});
    const PairList pairs = find_pairs(start, run.gap);
    for (std::size_t i = 0; i + 1 < pairs.start.size(); ++i)
      for (std::size_t k = pairs.start[i]; k < pairs.start[i + 1]; ++k)
        bond_of(static_cast<int>(i), pairs.other[k]);
    run.has_bonds = true;
  }
  for (ViewParticle &p : run.particles) p.broken = 0;
  for (const BrokenBond &event : events) {
    const auto a = index.find(event.id1), b = index.find(event.id2);
    for (const auto &end : {a, b})
      if (end != index.end()) ++run.particles[static_cast<std::size_t>(end->second)].broken;
    if (a == index.end() || b == index.end()) continue;
    ViewBond &bond = bond_of(a->second, b->second);
    bond.state = event.mode == "shear" ? BondState::shear : BondState::tension;
    bond.time = event.time;
    bond.step = event.step;
    bond.place = {event.x, event.y, event.z};
  }
}

void find_fragments(RunView &run) {
  if (!run.has_bonds) return;
  const std::size_t n = run.particles.size();
  PairList intact;
  intact.start.assign(n + 1, 0);
  for (const ViewBond &bond : run.bonds)
    if (bond.state == BondState::intact) ++intact.start[static_cast<std::size_t>(bond.a) + 1];
  std::partial_sum(intact.start.begin(), intact.start.end(), intact.start.begin());
  intact.other.resize(intact.start.back());
  std::vector<std::size_t> at(intact.start.begin(), intact.start.end() - 1);
  for (const ViewBond &bond : run.bonds)
    if (bond.state == BondState::intact)
      intact.other[at[static_cast<std::size_t>(bond.a)]++] = bond.b;
  const Clusters clusters = connected_clusters(intact);
  std::vector<Fragment> parts(static_cast<std::size_t>(clusters.count));
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Fragment &part = parts[static_cast<std::size_t>(clusters.label[i])];
    ++part.particles;
    part.share += mass_of(run, run.particles[i]);
    total += mass_of(run, run.particles[i]);
  }
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].share > parts[b].share; });
  std::vector<int> rank(parts.size());
  run.fragments.clear();
  for (std::size_t k = 0; k < order.size(); ++k) {
    rank[order[k]] = static_cast<int>(k);
    run.fragments.push_back(parts[order[k]]);
    run.fragments.back().share /= total;
  }
  for (std::size_t i = 0; i < n; ++i)
    run.particles[i].fragment = rank[static_cast<std::size_t>(clusters.label[i])];
}

void read_forces(RunView &run, const fs::path &file, const std::vector<std::string> &columns) {
  const LocalDump dump = read_local_dump(file, read_log(run.folder).text, columns);
  const int id1 = dump.column("id1"), id2 = dump.column("id2"), fn = dump.column("fn"),
            shear = dump.column("fs");
  if (id1 < 0 || id2 < 0 || fn < 0) {
    run.missing.push_back("No force chains: " + file.filename().string() + " has " +
                          join(dump.names) + ", but not id1, id2 and fn.");
    return;
  }
  const std::unordered_map<int, int> index = index_by_id(run);
  for (const std::vector<double> &row : dump.rows) {
    const auto a = index.find(static_cast<int>(row[static_cast<std::size_t>(id1)])),
               b = index.find(static_cast<int>(row[static_cast<std::size_t>(id2)]));
    if (a == index.end() || b == index.end()) continue;
    run.forces.push_back({std::min(a->second, b->second), std::max(a->second, b->second),
                          row[static_cast<std::size_t>(fn)],
                          shear < 0 ? 0 : row[static_cast<std::size_t>(shear)]});
  }
  run.has_forces = true;
  run.force_step = dump.step;
  const fs::path then = run.folder / ("particles_" + std::to_string(dump.step) + ".txt");
  if (!fs::is_regular_file(then)) return;
  const Places places = places_of(read_particles(then));
  for (const ViewParticle &p : run.particles) {
    const auto at = places.find(p.id);
    run.force_places.push_back(at == places.end() ? p.end : at->second);
  }
}

RunView read_run(const fs::path &folder, const ViewOptions &options) {
  if (!fs::is_directory(folder))
    throw UserError("there is no folder '" + folder.string() + "' (allowed: the folder of a run)");
  if (!fs::is_regular_file(folder / "particles_end.txt"))
    throw UserError("'" + folder.string() +
                    "' has no particles_end.txt (allowed: the folder of a finished run, such as "
                    "OUT/runs/NUMBER-TEST-KEY)");
  RunView run;
  run.folder = folder;
  const LogFacts log = read_log(folder);
  const ManifestFacts manifest = read_manifest(folder);
  run.test = manifest.test;
  run.variables = manifest.variables;
  run.gap = options.gap > 0 ? options.gap : log.gap;

  const std::optional<Places> start = find_start(folder, manifest, log);
  bool all_started = start.has_value();
  double out_of_plane = 0;
  for (const EndParticle &p : read_particles(folder / "particles_end.txt")) {
    ViewParticle particle;
    particle.id = p.id, particle.type = p.type, particle.r = p.radius;
    particle.start = particle.end = {p.x, p.y, p.z};
    particle.stress = p.stress;
    run.has_stress = p.has_stress;
    if (start) {
      const auto at = start->find(p.id);
      if (at == start->end())
        all_started = false;
      else
        particle.start = at->second;
    }
    out_of_plane = std::max(out_of_plane, std::fabs(p.z));
    run.particles.push_back(particle);
  }
  run.has_start = all_started;
  run.dimension = log.dimension == 2 || log.dimension == 3 ? log.dimension
                  : out_of_plane == 0                      ? 2
                                                           : 3;
  if (!run.has_start)
    run.missing.push_back(
        "No displacement: neither particles_start.txt nor the specimen's file is there.");
  if (run.gap <= 0)
    run.missing.push_back("The bond gap isn't in a log of the run; give it by --gap.");

  std::vector<BrokenBond> events;
  run.has_log = fs::is_regular_file(folder / "broken_bonds.tsv");
  if (run.has_log)
    events = read_broken_bonds(folder / "broken_bonds.tsv");
  else
    run.missing.push_back("No cracks: there is no broken_bonds.tsv.");
  find_bonds(run, events);
  find_fragments(run);

  if (fs::is_regular_file(folder / "curve.tsv"))
    run.curve = read_curve(folder / "curve.tsv");
  else
    run.missing.push_back("No curve: there is no curve.tsv.");

  const fs::path bonds = options.bond_file.empty() ? newest_bond_file(folder) : options.bond_file;
  if (bonds.empty())
    run.missing.push_back(
        "No force chains: the run dumped no bonds (compute bonded/local id1 id2 fn fs, dump local "
        "bonds_*.txt).");
  else
    read_forces(run, bonds, options.columns);
  return run;
}

}  // namespace bondlab
