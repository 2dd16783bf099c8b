// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/run_folder.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "base/units.h"
#include "base/write_file.h"
#include "forward/frame_name.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

constexpr const char *kManifest = "manifest.json";
constexpr const char *kReplay = "replay.sh";

// What mpirun needs to start as root in a container, and one thread a rank.
const std::map<std::string, std::string> &mpi_environment() {
  static const std::map<std::string, std::string> variables{{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                                                            {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                                                            {"OMP_NUM_THREADS", "1"}};
  return variables;
}

std::map<std::string, std::string> run_environment(const RunPlan &plan, const RunKey &key,
                                                   std::int64_t id) {
  std::map<std::string, std::string> variables = mpi_environment();
  variables["BONDLAB_RUN_ID"] = std::to_string(id);
  variables["BONDLAB_RUN_KEY"] = key.full;
  variables["BONDLAB_SEED"] = std::to_string(plan.seed());
  return variables;
}

bool runs_alone(const Engine &engine, const RunPlan &plan) {
  return plan.ranks == 1 && engine.alone_without_mpirun;
}

// Open MPI without mpirun: no daemon beside the run, and its session folder in the run's own, since
// two runs that share one remove it under each other's feet. A rank alone talks to nobody: looking
// for network devices would be half of what starting costs (0.50 s instead of 0.20 s, measured).
std::map<std::string, std::string> alone_environment(const std::string &folder) {
  return {{"OMPI_MCA_ess_singleton_isolated", "1"},
          {"OMPI_MCA_orte_tmpdir_base", folder},
          {"OMPI_MCA_pml", "ob1"},
          {"OMPI_MCA_btl", "self"}};
}

}  // namespace

std::string utc_now() {
  const std::time_t time = std::time(nullptr);
  std::tm parts = {};
  gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string quoted(const std::string &text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string replay_command(const fs::path &folder) {
  return "sh " + quoted((folder / kReplay).string());
}

std::string new_run_folder(const fs::path &results, std::int64_t id, const RunPlan &plan,
                           const RunKey &key) {
  char number[24];
  std::snprintf(number, sizeof number, "%06lld", static_cast<long long>(id));
  const std::string base =
      std::string("runs/") + number + "-" + plan.test + "-" + key.full.substr(0, 8);
  make_folder(results / "runs");
  for (int attempt = 1; attempt < 1000; ++attempt) {
    const std::string name = attempt == 1 ? base : base + "-" + std::to_string(attempt);
    std::error_code error;
    if (fs::create_directory(results / name, error)) return name;
    if (error)
      throw UserError({(results / name).string(), 0, 0},
                      "the folder can't be made: " + error.message());
  }
  throw UserError(
      {(results / base).string(), 0, 0},
      "a thousand folders of this run are there already; remove them or choose another --out");
}

std::vector<std::string> engine_command(const Engine &engine, const RunPlan &plan) {
  // --bind-to none: several mpirun at a time would all bind to the first cores. --oversubscribe:
  // the slots are counted by us.
  std::vector<std::string> command;
  if (!runs_alone(engine, plan))
    command = {engine.mpirun.string(), "-np", std::to_string(plan.ranks), "--oversubscribe",
               "--bind-to", "none"};
  command.insert(command.end(),
                 {engine.program.string(), "-in", plan.deck.string(), "-log", kLogName});
  const auto add = [&command](const std::string &name, const std::string &text) {
    command.insert(command.end(), {"-var", name, text});
  };
  if (plan.wants_deck_dir) add("deck_dir", plan.deck.parent_path().string());
  if (plan.wants_specimen) add("specimen", plan.specimen_file.path.string());
  for (const auto &[name, text] : plan.variables) add(name, text);
  return command;
}

Launch make_launch(const Engine &engine, const RunPlan &plan, const RunKey &key, std::int64_t id,
                   const fs::path &folder) {
  Launch launch;
  launch.command = engine_command(engine, plan);
  launch.directory = folder;
  launch.environment = run_environment(plan, key, id);
  if (runs_alone(engine, plan))
    for (const auto &[name, value] : alone_environment(fs::absolute(folder).string()))
      launch.environment[name] = value;
  launch.screen = folder / kScreenName;
  launch.wall_limit = plan.wall_limit;
  launch.watched = {folder / kLogName, folder / kScreenName, folder / plan.curve};
  return launch;
}

void write_manifest(const fs::path &folder, const Engine &engine, const RunPlan &plan,
                    const RunKey &key, const RunHistory &history) {
  nlohmann::ordered_json manifest;
  manifest["bondlab_run"] = 1;
  manifest["id"] = history.id;
  manifest["key"] = key.full;
  manifest["point"] = key.point;
  manifest["state"] = history.state;
  if (history.cause != FailureCause::none) {
    manifest["cause"] = to_string(history.cause);
    manifest["message"] = history.message;
  }
  manifest["test"] = plan.test;
  manifest["virtual_test"] = plan.virtual_test;
  manifest["deck"] = plan.deck.string();
  manifest["deck_sha256"] = plan.deck_hash;
  manifest["engine"] = engine.program.string();
  manifest["engine_sha256"] = engine.hash;
  manifest["ranks"] = plan.ranks;
  manifest["packing"] = plan.packing;
  manifest["seed"] = plan.seed();
  if (plan.wants_specimen) {
    manifest["specimen"] = plan.specimen_file.path.string();
    manifest["specimen_sha256"] = plan.specimen_file.hash;
  }
  manifest["variables"] = plan.variables;
  manifest["si"] = plan.numeric;
  manifest["command"] = engine_command(engine, plan);
  manifest["started"] = history.started;
  if (!history.finished.empty()) {
    manifest["finished"] = history.finished;
    manifest["wall_seconds"] = history.wall_seconds;
  }
  if (history.cost) {
    const MeasuredCost &cost = *history.cost;
    manifest["cost"] = {{"loop_seconds", cost.loop_seconds},
                        {"steps", cost.steps},
                        {"particles", cost.particles},
                        {"bonds", cost.bonds},
                        {"ranks", cost.ranks},
                        {"ns_per_bond_and_step", cost.ns_per_bond_and_step()}};
  }
  write_file(folder / kManifest, manifest.dump(1) + "\n");
}

void write_replay(const fs::path &folder, const Engine &engine, const RunPlan &plan,
                  const RunKey &key, std::int64_t id) {
  std::string script =
      "#!/bin/sh\n# Repeats run " + std::to_string(id) + " (" + plan.test +
      ") in a folder of its own: sh replay.sh [FOLDER]\nset -e\n" +
      "folder=${1:-$(dirname \"$0\")/replay}\nmkdir -p \"$folder\"\ncd \"$folder\"\n";
  for (const auto &[name, value] : run_environment(plan, key, id))
    script += "export " + name + "=" + value + "\n";
  if (runs_alone(engine, plan))
    for (const auto &[name, value] : alone_environment("$PWD"))
      script += "export " + name + "=\"" + value + "\"\n";
  script += "exec";
  for (const std::string &word : engine_command(engine, plan))
    script += (word == "-var" || word == "-in" ? " \\\n  " : " ") + quoted(word);
  write_file(folder / kReplay, script + " </dev/null\n");
}

void thin_out(const fs::path &folder, const RunPlan &plan) {
  std::vector<std::string> kept{plan.curve, plan.events, plan.particles,
                                kLogName,   kManifest,   kReplay};
  kept.insert(kept.end(), plan.keep.begin(), plan.keep.end());
  std::error_code ignored;
  std::vector<fs::path> removed;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    if (std::find(kept.begin(), kept.end(), entry.path().filename().string()) == kept.end() &&
        !is_frame(entry.path().filename().string()))
      removed.push_back(entry.path());
  for (const fs::path &path : removed) fs::remove_all(path, ignored);
}

}  // namespace bondlab
