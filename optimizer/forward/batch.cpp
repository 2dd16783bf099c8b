// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/batch.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>

#include "base/units.h"
#include "forward/bond_gap_check.h"
#include "forward/interrupt.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

constexpr double kHeartbeatInterval = 10;   // s
constexpr double kReportInterval = 1;       // s
constexpr double kElsewhereInterval = 0.5;  // s between looks at runs of other processes
// Jobs that wait for cores and are looked at: in a batch of thousands the rest must not cost a look
// every few milliseconds.
constexpr int kLookAhead = 32;
constexpr auto kNap = std::chrono::milliseconds(3);

double seconds_between(std::chrono::steady_clock::time_point a,
                       std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

EngineForwardModel::Batch::Batch(const Study &study, const ForwardSettings &settings,
                                 RunStore &store,
                                 std::map<std::string, ForwardOutcome> &failed_here,
                                 std::function<void(const BatchProgress &)> progress)
    : study_(study),
      settings_(settings),
      store_(store),
      failed_here_(failed_here),
      progress_(std::move(progress)) {
  begin_ = last_report_ = last_heartbeat_ = last_look_elsewhere_ = Clock::now();
}

EngineForwardModel::Batch::~Batch() {
  for (Job &job : jobs_) {
    if (job.stage != Stage::running) continue;
    if (job.process) job.process->kill();
    std::error_code ignored;
    fs::remove_all(settings_.results / job.directory, ignored);  // half a result is no result
    try {
      store_.mark_lost(job.id, "bondlab was stopped");
    } catch (const UserError &) {
      // The store itself fails: the run stays `running` in a dead process, which the next command
      // sees.
    }
  }
}

std::vector<ForwardOutcome> EngineForwardModel::Batch::run(
    const std::vector<ForwardRequest> &requests) {
  const std::vector<std::size_t> job_of = make_jobs(requests);
  for (Job &job : jobs_)
    if (job.stage == Stage::pending) look_up(job);
  report(true);
  std::size_t first_open = 0;  // all before it are settled
  while (true) {
    while (first_open < jobs_.size() && jobs_[first_open].stage == Stage::settled) ++first_open;
    if (first_open == jobs_.size()) break;
    if (const int signal = interrupt_signal()) throw Interrupted(signal);
    bool busy = false;
    int waiting = 0;
    for (std::size_t i = first_open; i < jobs_.size() && waiting < kLookAhead; ++i) {
      Job &job = jobs_[i];
      if (job.stage == Stage::pending && fits(job)) {
        start(job);
        busy = true;
      } else if (job.stage == Stage::pending) {
        ++waiting;
      } else if (job.stage == Stage::running && job.process->poll()) {
        finish(job);
        busy = true;
      }
    }
    const Clock::time_point now = Clock::now();
    if (seconds_between(last_look_elsewhere_, now) > kElsewhereInterval) {
      last_look_elsewhere_ = now;
      for (Job &job : jobs_)
        if (job.stage == Stage::elsewhere) look_up(job);
    }
    if (seconds_between(last_heartbeat_, now) > kHeartbeatInterval) {
      last_heartbeat_ = now;
      store_.heartbeat();
    }
    report(false);
    if (!busy) std::this_thread::sleep_for(kNap);
  }
  report(true);
  std::vector<ForwardOutcome> outcomes;
  for (const std::size_t job : job_of) outcomes.push_back(jobs_[job].outcome);
  return outcomes;
}

std::vector<std::size_t> EngineForwardModel::Batch::make_jobs(
    const std::vector<ForwardRequest> &requests) {
  std::vector<Job> planned;
  for (const ForwardRequest &request : requests) {
    Job job;
    job.plan = plan_run(study_, request);
    planned.push_back(std::move(job));
  }
  make_specimens(planned);
  std::vector<std::size_t> job_of;
  std::map<std::string, std::size_t> by_key;
  for (Job &job : planned) {
    job.key = key_of(job.plan, settings_.engine.hash);
    const auto [at, is_new] = by_key.emplace(job.key.full, jobs_.size());
    job_of.push_back(at->second);
    if (is_new) jobs_.push_back(std::move(job));
  }
  return job_of;
}

void EngineForwardModel::Batch::make_specimens(std::vector<Job> &jobs) {
  struct Wanted {
    SpecimenEntry entry;
    int packing;
    double gap;
    SpecimenFile file;
    std::string error;
  };
  std::map<std::string, Wanted> wanted;
  const auto name_of = [](const Job &job, double gap) {
    return job.plan.specimen.name + " " + std::to_string(job.plan.packing) + " " +
           canonical_number(gap);
  };
  const auto gap_of = [](const Job &job) {
    const auto gap = job.plan.numeric.find("gap");
    return gap == job.plan.numeric.end() ? 0 : gap->second;
  };
  for (const Job &job : jobs)
    if (job.plan.wants_specimen)
      wanted.emplace(name_of(job, gap_of(job)),
                     Wanted{job.plan.specimen, job.plan.packing, gap_of(job), {}, ""});
  std::vector<Wanted *> list;
  for (auto &[name, entry] : wanted) list.push_back(&entry);

  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i; (i = next++) < list.size() && !interrupt_signal();) {
      try {
        list[i]->file = settings_.specimens(list[i]->entry, list[i]->packing);
        if (list[i]->gap > 0) check_bond_gap(list[i]->file.path, list[i]->gap);
      } catch (const std::exception &error) {
        list[i]->error = error.what();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::min<int>(settings_.cores, static_cast<int>(list.size())); ++i)
    threads.emplace_back(work);
  work();
  for (std::thread &thread : threads) thread.join();
  if (const int signal = interrupt_signal()) throw Interrupted(signal);

  for (Job &job : jobs) {
    if (!job.plan.wants_specimen) continue;
    const Wanted &found = wanted.at(name_of(job, gap_of(job)));
    job.plan.specimen_file = found.file;
    if (found.error.empty()) continue;
    job.stage = Stage::settled;
    job.outcome.failure.cause = FailureCause::specimen;
    job.outcome.failure.message = "the specimen '" + job.plan.specimen.name + "' (seed " +
                                  std::to_string(job.plan.seed()) +
                                  ") can't be tested: " + found.error;
    job.outcome.deck_variables = job.plan.numeric;
  }
}

void EngineForwardModel::Batch::fill_common(Job &job, const std::string &directory) {
  const fs::path folder = settings_.results / directory;
  job.directory = directory;
  job.outcome.run_id = std::to_string(job.id);
  job.outcome.run_directory = folder.string();
  job.outcome.replay_command = replay_command(folder);
  job.outcome.deck_variables = job.plan.numeric;
}

void EngineForwardModel::Batch::look_up(Job &job) {
  const RunRecord run = store_.get_or_queue(job.key, job.plan);
  job.id = run.id;
  if (job.expected < 0) job.expected = store_.mean_seconds(run.workload).value_or(-1);
  job.stage = Stage::pending;
  switch (run.state) {
    case RunState::done: {
      Verdict verdict = judge_output(job.plan, settings_.results / run.directory);
      if (!verdict.ok) {  // somebody removed or changed it
        store_.mark_lost(run.id, "its files are gone: " + verdict.message);
        return;
      }
      fill_common(job, run.directory);
      job.outcome.ok = true;
      job.outcome.from_store = true;
      job.outcome.curve = std::move(verdict.curve);
      job.outcome.wall_seconds = run.wall_seconds;
      job.outcome.cost = measured_cost(settings_.results / run.directory);
      job.stage = Stage::settled;
      return;
    }
    case RunState::failed: {
      const auto here = failed_here_.find(job.key.full);
      if (here != failed_here_.end()) {
        job.outcome = here->second;
        job.outcome.from_store = true;
        job.stage = Stage::settled;
      } else if (run.attempts >= settings_.max_attempts) {
        fill_common(job, run.directory);
        job.outcome.from_store = true;
        job.outcome.wall_seconds = run.wall_seconds;
        job.outcome.failure = {
            run.cause,
            run.message + " (failed " + std::to_string(run.attempts) + " times, not tried again)",
            job.outcome.run_directory, job.outcome.replay_command,
            log_tail(job.outcome.run_directory)};
        job.stage = Stage::settled;
      }
      return;
    }
    case RunState::running:
      if (store_.owner_is_alive(run)) job.stage = Stage::elsewhere;
      return;
    case RunState::queued:
    case RunState::lost:
      return;
  }
}

bool EngineForwardModel::Batch::fits(const Job &job) const {
  int ranks = job.plan.ranks, running = 1;
  for (const Job &other : jobs_) {
    if (other.stage != Stage::running) continue;
    ranks += other.plan.ranks;
    ++running;
  }
  return ranks <= settings_.cores && (settings_.jobs <= 0 || running <= settings_.jobs);
}

// What a dead process left: its engine may still be writing, and half a result is no result.
void EngineForwardModel::Batch::forget_lost_run(const RunRecord &run,
                                                const std::string &new_directory) {
  if ((run.state != RunState::running && run.state != RunState::lost) || run.directory.empty())
    return;
  const fs::path folder = settings_.results / run.directory;
  kill_processes_of_run(folder);
  if (run.directory == new_directory) return;  // it had been removed, and its name was free again
  // a process that is just dying may still put a file where the folder was being emptied
  for (int attempt = 0; attempt < 50 && fs::exists(folder); ++attempt) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    if (fs::exists(folder)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void EngineForwardModel::Batch::start(Job &job) {
  const RunRecord before = store_.get_or_queue(job.key, job.plan);
  const std::string directory = new_run_folder(settings_.results, job.id, job.plan, job.key);
  const fs::path folder = settings_.results / directory;
  if (!store_.claim(job.id, directory)) {  // another process was faster
    std::error_code ignored;
    fs::remove(folder, ignored);
    look_up(job);
    return;
  }
  job.stage = Stage::running;
  forget_lost_run(before, directory);
  fill_common(job, directory);
  job.history = {};
  job.history.id = job.id;
  job.history.started = utc_now();
  write_manifest(folder, settings_.engine, job.plan, job.key, job.history);
  write_replay(folder, settings_.engine, job.plan, job.key, job.id);
  Launch launch = make_launch(settings_.engine, job.plan, job.key, job.id, folder);
  launch.stall_limit =
      settings_.stall_limit > 0 ? settings_.stall_limit : std::max(60.0, job.plan.wall_limit / 2);
  try {
    job.process = std::make_unique<EngineProcess>(launch);
  } catch (const UserError &error) {
    settle_failed(job, {FailureCause::launcher, error.what(), "", "", ""});
  }
}

void EngineForwardModel::Batch::finish(Job &job) {
  const fs::path folder = settings_.results / job.directory;
  const RunEnd end = job.process->end();
  job.process.reset();
  job.outcome.wall_seconds = end.wall_seconds;
  Verdict verdict = judge_run(end, job.plan, folder);
  if (!verdict.ok) {
    settle_failed(job, {verdict.cause, verdict.message, "", "", ""});
    return;
  }
  job.history.state = "done";
  job.history.finished = utc_now();
  job.history.wall_seconds = end.wall_seconds;
  job.history.cost = job.outcome.cost = measured_cost(folder);
  write_manifest(folder, settings_.engine, job.plan, job.key, job.history);
  thin_out(folder, job.plan);
  store_.finish_done(job.id, end.wall_seconds);
  job.outcome.ok = true;
  job.outcome.curve = std::move(verdict.curve);
  job.stage = Stage::settled;
}

void EngineForwardModel::Batch::settle_failed(Job &job, const Failure &failure) {
  const fs::path folder = settings_.results / job.directory;
  job.outcome.ok = false;
  job.outcome.failure = failure;
  job.outcome.failure.run_directory = folder.string();
  job.outcome.failure.command = job.outcome.replay_command;
  job.outcome.failure.log_tail = log_tail(folder);
  job.history.state = "failed";
  job.history.finished = utc_now();
  job.history.wall_seconds = job.outcome.wall_seconds;
  job.history.cause = failure.cause;
  job.history.message = failure.message;
  write_manifest(folder, settings_.engine, job.plan, job.key, job.history);
  store_.finish_failed(job.id, failure, job.outcome.wall_seconds);
  failed_here_[job.key.full] = job.outcome;
  job.stage = Stage::settled;
}

BatchProgress EngineForwardModel::Batch::count() const {
  BatchProgress progress;
  progress.total = static_cast<int>(jobs_.size());
  for (const Job &job : jobs_) {
    if (job.stage == Stage::settled) {
      (job.outcome.ok ? progress.done : progress.failed) += 1;
      progress.from_store += job.outcome.ok && job.outcome.from_store;
    }
    progress.running += job.stage == Stage::running || job.stage == Stage::elsewhere;
  }
  progress.elapsed = seconds_between(begin_, Clock::now());
  progress.left = seconds_left();
  return progress;
}

// Core-seconds still to be spent over the cores at work. Runs of a test nobody has timed yet take
// the batch's mean.
double EngineForwardModel::Batch::seconds_left() const {
  double sum = 0, timed = 0;
  for (const Job &job : jobs_) {
    const double seconds =
        job.stage == Stage::settled && job.outcome.ok ? job.outcome.wall_seconds : job.expected;
    if (seconds <= 0) continue;
    sum += seconds;
    ++timed;
  }
  double core_seconds = 0, longest = 0;
  int cores_wanted = 0, largest = 1, unsettled = 0;
  for (const Job &job : jobs_) {
    if (job.stage == Stage::settled) continue;
    ++unsettled;
    if (timed == 0) return -1;
    const double spent = job.process ? job.process->seconds() : 0;
    const double left = std::max(0.0, (job.expected > 0 ? job.expected : sum / timed) - spent);
    core_seconds += left * job.plan.ranks;
    cores_wanted += job.plan.ranks;
    largest = std::max(largest, job.plan.ranks);
    longest = std::max(longest, left);
  }
  if (unsettled == 0) return 0;
  const int limit = settings_.jobs > 0 ? settings_.jobs * largest : settings_.cores;
  return std::max(longest, core_seconds / std::max(1, std::min(cores_wanted, limit)));
}

void EngineForwardModel::Batch::report(bool force) {
  if (!progress_) return;
  const BatchProgress progress = count();
  const int settled = progress.done + progress.failed;
  const Clock::time_point now = Clock::now();
  if (!force && settled == reported_settled_ && progress.running == reported_running_ &&
      seconds_between(last_report_, now) < kReportInterval)
    return;
  last_report_ = now;
  reported_settled_ = settled;
  reported_running_ = progress.running;
  progress_(progress);
}

}  // namespace bondlab
