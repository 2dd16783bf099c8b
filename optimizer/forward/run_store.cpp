// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/run_store.h"

#include <sqlite3.h>

#include <chrono>
#include <thread>

namespace bondlab {

namespace {

constexpr int kApplication = 0x424c5253;  // "BLRS": tells our file from any other SQLite file
constexpr double kHeartbeatLimit =
    120;  // s; an owner on another host without a sign for so long is dead
constexpr int kBusyMilliseconds =
    30000;  // another process's commit takes milliseconds; this is for a sick disk

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

const RunState kStates[] = {RunState::queued, RunState::running, RunState::done, RunState::failed,
                            RunState::lost};

RunState state_from(const std::string &name) {
  for (const RunState state : kStates)
    if (to_string(state) == name) return state;
  throw UserError("the run store holds an unknown state '" + name + "'");
}

const char *const kSchema =
    "CREATE TABLE runs ("
    " id INTEGER PRIMARY KEY AUTOINCREMENT,"
    " key TEXT NOT NULL UNIQUE, point TEXT NOT NULL, seed INTEGER NOT NULL, test TEXT NOT NULL, "
    "workload TEXT NOT NULL,"
    " variables TEXT NOT NULL, ranks INTEGER NOT NULL,"
    " state TEXT NOT NULL, attempts INTEGER NOT NULL DEFAULT 0, directory TEXT NOT NULL DEFAULT '',"
    " cause TEXT NOT NULL DEFAULT 'none', message TEXT NOT NULL DEFAULT '',"
    " wall_seconds REAL NOT NULL DEFAULT 0, queued_at REAL NOT NULL, started_at REAL, finished_at "
    "REAL,"
    " host TEXT NOT NULL DEFAULT '', boot TEXT NOT NULL DEFAULT '', pid INTEGER NOT NULL DEFAULT 0,"
    " start_ticks INTEGER NOT NULL DEFAULT 0, heartbeat REAL NOT NULL DEFAULT 0);"
    "CREATE INDEX runs_by_point ON runs(point);"
    "CREATE INDEX runs_by_workload ON runs(workload, state);"
    "CREATE TABLE failures ("
    " run INTEGER NOT NULL REFERENCES runs(id), attempt INTEGER NOT NULL, cause TEXT NOT NULL, "
    "message TEXT NOT NULL,"
    " directory TEXT NOT NULL, wall_seconds REAL NOT NULL, finished_at REAL NOT NULL);";

const char *const kColumns =
    "id, key, point, test, workload, seed, state, attempts, directory, cause, message, "
    "wall_seconds,"
    " host, boot, pid, start_ticks, heartbeat";

}  // namespace

std::string to_string(RunState state) {
  switch (state) {
    case RunState::queued:
      return "queued";
    case RunState::running:
      return "running";
    case RunState::done:
      return "done";
    case RunState::failed:
      return "failed";
    case RunState::lost:
      return "lost";
  }
  return "";
}

// One prepared statement. Indices count from 1 when binding and from 0 when reading, as SQLite's
// do.
class RunStore::Statement {
 public:
  Statement(const RunStore &store, const std::string &sql) : store_(store) {
    if (sqlite3_prepare_v2(store.database_, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
      store.fail("prepare a query");
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement &) = delete;
  Statement &operator=(const Statement &) = delete;

  Statement &bind(const std::string &text) {
    check(sqlite3_bind_text(statement_, ++bound_, text.c_str(), static_cast<int>(text.size()),
                            SQLITE_TRANSIENT));
    return *this;
  }
  Statement &bind(double value) {
    check(sqlite3_bind_double(statement_, ++bound_, value));
    return *this;
  }
  Statement &bind(std::int64_t value) {
    check(sqlite3_bind_int64(statement_, ++bound_, value));
    return *this;
  }
  bool step() {
    const int status = sqlite3_step(statement_);
    if (status == SQLITE_ROW) return true;
    if (status != SQLITE_DONE) store_.fail("read or write");
    return false;
  }
  std::string text(int i) const {
    const auto *value = sqlite3_column_text(statement_, i);
    return value ? reinterpret_cast<const char *>(value) : "";
  }
  std::int64_t whole(int i) const { return sqlite3_column_int64(statement_, i); }
  double number(int i) const { return sqlite3_column_double(statement_, i); }
  bool is_null(int i) const { return sqlite3_column_type(statement_, i) == SQLITE_NULL; }

 private:
  void check(int status) {
    if (status != SQLITE_OK) store_.fail("bind a value");
  }
  const RunStore &store_;
  sqlite3_stmt *statement_ = nullptr;
  int bound_ = 0;
};

void RunStore::fail(const std::string &doing) const {
  const int code = database_ ? sqlite3_errcode(database_) : SQLITE_NOMEM;
  const std::string reason = database_ ? sqlite3_errmsg(database_) : "no memory";
  std::string advice;
  if (code == SQLITE_NOTADB)
    advice = "; this file isn't a run store: choose another --out or move it away";
  if (code == SQLITE_FULL) advice = "; free some space and start the same command again";
  if (code == SQLITE_READONLY || code == SQLITE_CANTOPEN)
    advice = "; check the permissions of the folder";
  throw UserError({file_.string(), 0, 0}, "the run store can't " + doing + ": " + reason + advice);
}

void RunStore::execute(const std::string &sql) const {
  if (sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail("be read or written");
}

RunStore::RunStore(const std::filesystem::path &file) : file_(file), self_(this_process()) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  const int status =
      sqlite3_open_v2(file.c_str(), &database_,
                      SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  try {
    if (status != SQLITE_OK) fail("be opened");
    sqlite3_busy_timeout(database_, kBusyMilliseconds);
    int application = 0, version = 0;
    {
      Statement pragma(*this, "PRAGMA application_id");
      if (pragma.step()) application = static_cast<int>(pragma.whole(0));
    }
    {
      Statement pragma(*this, "PRAGMA user_version");
      if (pragma.step()) version = static_cast<int>(pragma.whole(0));
    }
    if (application == kApplication && version != schema_version)
      throw UserError({file.string(), 0, 0},
                      "this run store has schema version " + std::to_string(version) +
                          ", this bondlab reads version " + std::to_string(schema_version) +
                          "; use the bondlab it was made with, or another --out");
    // Two processes may open a new store at the same moment, and SQLite doesn't wait when the
    // journal's mode changes.
    for (int waited = 0;
         sqlite3_exec(database_, "PRAGMA journal_mode=WAL", nullptr, nullptr, nullptr) != SQLITE_OK;
         waited += 10) {
      if (sqlite3_errcode(database_) != SQLITE_BUSY || waited > kBusyMilliseconds)
        fail("be read or written");
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    execute("PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON");
    if (application == kApplication) return;
    execute("BEGIN IMMEDIATE");
    bool exists = false, ours = false;  // another process may have made it since
    {
      Statement tables(*this, "SELECT count(*) FROM sqlite_master");
      exists = tables.step() && tables.whole(0) > 0;
      Statement pragma(*this, "PRAGMA application_id");
      ours = pragma.step() && pragma.whole(0) == kApplication;
    }
    if (exists && !ours) {
      execute("ROLLBACK");
      throw UserError({file.string(), 0, 0},
                      "this SQLite file isn't a run store; choose another --out or move it away");
    }
    if (!exists)
      execute(std::string(kSchema) + "PRAGMA application_id=" + std::to_string(kApplication) +
              ";PRAGMA user_version=" + std::to_string(schema_version));
    execute("COMMIT");
  } catch (...) {
    sqlite3_close(database_);
    throw;
  }
}

RunStore::~RunStore() { sqlite3_close(database_); }

RunRecord RunStore::read_row(Statement &row) const {
  RunRecord run;
  run.id = row.whole(0);
  run.key = row.text(1);
  run.point = row.text(2);
  run.test = row.text(3);
  run.workload = row.text(4);
  run.seed = static_cast<std::uint64_t>(row.whole(5));
  run.state = state_from(row.text(6));
  run.attempts = static_cast<int>(row.whole(7));
  run.directory = row.text(8);
  run.cause = failure_cause_from(row.text(9));
  run.message = row.text(10);
  run.wall_seconds = row.number(11);
  run.owner = {row.text(12), row.text(13), row.whole(14), row.whole(15)};
  run.heartbeat = row.number(16);
  return run;
}

std::optional<RunRecord> RunStore::find(const std::string &key) const {
  Statement query(*this, std::string("SELECT ") + kColumns + " FROM runs WHERE key = ?");
  query.bind(key);
  if (!query.step()) return std::nullopt;
  return read_row(query);
}

RunRecord RunStore::get_or_queue(const RunKey &key, const RunPlan &plan) {
  if (const auto run = find(key.full)) return *run;
  std::string variables;
  for (const auto &[name, text] : plan.variables)
    variables += (variables.empty() ? "" : " ") + name + "=" + text;
  Statement insert(
      *this,
      "INSERT INTO runs (key, point, seed, test, workload, variables, ranks, state, queued_at)"
      " VALUES (?, ?, ?, ?, ?, ?, ?, 'queued', ?) ON CONFLICT(key) DO NOTHING");
  insert.bind(key.full)
      .bind(key.point)
      .bind(static_cast<std::int64_t>(key.seed))
      .bind(plan.virtual_test)
      .bind(workload_of(plan))
      .bind(variables);
  insert.bind(static_cast<std::int64_t>(plan.ranks)).bind(now());
  insert.step();
  return find(key.full).value();
}

bool RunStore::owner_is_alive(const RunRecord &run) const {
  if (run.owner.host == self_.host && run.owner.boot == self_.boot) return is_alive(run.owner);
  if (run.owner.host == self_.host) return false;  // this machine has been started again since
  return now() - run.heartbeat < kHeartbeatLimit;
}

bool RunStore::claim(std::int64_t id, const std::string &directory) {
  execute("BEGIN IMMEDIATE");  // from here to COMMIT nobody else can change the row
  try {
    bool free = false;
    {
      Statement query(*this, std::string("SELECT ") + kColumns + " FROM runs WHERE id = ?");
      query.bind(id);
      if (query.step()) {
        const RunRecord run = read_row(query);
        free = run.state == RunState::queued || run.state == RunState::lost ||
               run.state == RunState::failed ||
               (run.state == RunState::running && !owner_is_alive(run));
      }
    }
    if (free) {
      Statement update(*this,
                       "UPDATE runs SET state = 'running', directory = ?, cause = 'none', message "
                       "= '', started_at = ?, finished_at = NULL,"
                       " host = ?, boot = ?, pid = ?, start_ticks = ?, heartbeat = ? WHERE id = ?");
      const double time = now();
      update.bind(directory)
          .bind(time)
          .bind(self_.host)
          .bind(self_.boot)
          .bind(self_.pid)
          .bind(self_.start_ticks)
          .bind(time)
          .bind(id);
      update.step();
    }
    execute("COMMIT");
    return free;
  } catch (...) {
    sqlite3_exec(database_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

void RunStore::finish_done(std::int64_t id, double wall_seconds) {
  Statement update(*this,
                   "UPDATE runs SET state = 'done', attempts = attempts + 1, wall_seconds = ?, "
                   "finished_at = ? WHERE id = ?");
  update.bind(wall_seconds).bind(now()).bind(id).step();
}

void RunStore::finish_failed(std::int64_t id, const Failure &failure, double wall_seconds) {
  execute("BEGIN IMMEDIATE");
  try {
    Statement update(*this,
                     "UPDATE runs SET state = 'failed', attempts = attempts + 1, cause = ?, "
                     "message = ?, wall_seconds = ?, finished_at = ?"
                     " WHERE id = ?");
    const double time = now();
    update.bind(to_string(failure.cause))
        .bind(failure.message)
        .bind(wall_seconds)
        .bind(time)
        .bind(id)
        .step();
    Statement insert(
        *this,
        "INSERT INTO failures (run, attempt, cause, message, directory, wall_seconds, finished_at)"
        " SELECT id, attempts, cause, message, directory, wall_seconds, finished_at FROM runs "
        "WHERE id = ?");
    insert.bind(id).step();
    execute("COMMIT");
  } catch (...) {
    sqlite3_exec(database_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

void RunStore::mark_lost(std::int64_t id, const std::string &why) {
  Statement update(*this,
                   "UPDATE runs SET state = 'lost', message = ?, finished_at = ? WHERE id = ?");
  update.bind(why).bind(now()).bind(id).step();
}

void RunStore::heartbeat() {
  Statement update(*this,
                   "UPDATE runs SET heartbeat = ? WHERE state = 'running' AND pid = ? AND "
                   "start_ticks = ? AND boot = ? AND host = ?");
  update.bind(now())
      .bind(self_.pid)
      .bind(self_.start_ticks)
      .bind(self_.boot)
      .bind(self_.host)
      .step();
}

std::optional<double> RunStore::mean_seconds(const std::string &workload) const {
  Statement query(*this,
                  "SELECT avg(wall_seconds) FROM runs WHERE workload = ? AND state = 'done'");
  query.bind(workload);
  if (!query.step() || query.is_null(0)) return std::nullopt;
  return query.number(0);
}

RunStore::Counts RunStore::counts() const {
  Counts counts;
  Statement query(*this, "SELECT state, count(*) FROM runs GROUP BY state");
  while (query.step()) {
    const int count = static_cast<int>(query.whole(1));
    switch (state_from(query.text(0))) {
      case RunState::queued:
        counts.queued = count;
        break;
      case RunState::running:
        counts.running = count;
        break;
      case RunState::done:
        counts.done = count;
        break;
      case RunState::failed:
        counts.failed = count;
        break;
      case RunState::lost:
        counts.lost = count;
        break;
    }
  }
  return counts;
}

}  // namespace bondlab
