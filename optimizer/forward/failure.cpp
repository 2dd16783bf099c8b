// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/failure.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/table_file.h"
#include "base/units.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

std::string text_or_nothing(const fs::path &file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Blanks collapsed and comments cut, so that an echoed command can be compared with the deck's.
std::string command_of(const std::string &line) {
  std::istringstream words(line.substr(0, line.find('#')));
  std::string command;
  for (std::string word; words >> word;) command += (command.empty() ? "" : " ") + word;
  return command;
}

struct DeckCommand {
  std::string command;
  int line = 0;  // the first of a continued one
};

std::vector<DeckCommand> deck_commands(const std::string &deck) {
  std::vector<DeckCommand> commands;
  std::istringstream lines(deck);
  std::string joined;
  int number = 0, first = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    if (joined.empty()) first = number;
    const bool continued = !line.empty() && line.back() == '&';
    if (continued) line.pop_back();
    joined += line;
    if (continued) {
      joined += ' ';
      continue;
    }
    const std::string command = command_of(joined);
    if (!command.empty()) commands.push_back({command, first});
    joined.clear();
  }
  return commands;
}

// The engine's first error message, without the source position it appends.
std::optional<std::string> engine_error(const std::string &text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("ERROR", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    std::string words = colon == std::string::npos ? line : line.substr(colon + 2);
    const std::size_t source = words.rfind(" (");
    if (source != std::string::npos && words.find(".cpp:", source) != std::string::npos)
      words.erase(source);
    while (!words.empty() && std::isspace(static_cast<unsigned char>(words.back())))
      words.pop_back();
    return words;
  }
  return std::nullopt;
}

bool contains(const std::string &text, const char *part) {
  return text.find(part) != std::string::npos;
}

bool says_not_a_number(const std::string &words) {
  std::string lower;
  for (const char c : words)
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (contains(lower, "non-numeric") || contains(lower, "not a number")) return true;
  for (std::size_t at = lower.find("nan"); at != std::string::npos;
       at = lower.find("nan", at + 1)) {
    const bool begins = at == 0 || !std::isalpha(static_cast<unsigned char>(lower[at - 1]));
    const bool ends =
        at + 3 == lower.size() || !std::isalpha(static_cast<unsigned char>(lower[at + 3]));
    if (begins && ends) return true;
  }
  return false;
}

FailureCause cause_of(const std::string &words) {
  if (contains(words, "Lost atoms") || contains(words, "Atom count is inconsistent") ||
      contains(words, "Out of range atoms"))
    return FailureCause::lost_atoms;
  if (contains(words, "Bond atom") && contains(words, "missing"))
    return FailureCause::bond_atoms_missing;
  if (contains(words, "has flown to")) return FailureCause::runaway_atoms;
  if (says_not_a_number(words)) return FailureCause::not_a_number;
  return FailureCause::deck_error;
}

std::string advice_for(FailureCause cause) {
  switch (cause) {
    case FailureCause::lost_atoms:
      return "; particles left a box that doesn't grow (the deck's `boundary`), or the specimen "
             "blew up: try a "
             "smaller `safety` (time step)";
    case FailureCause::bond_atoms_missing:
      return "; a bond is longer than the ghost shell: the specimen came apart or the time step is "
             "too large";
    case FailureCause::runaway_atoms:
      return "; no specimen that breaks throws grains so far: try a smaller `safety` (time step) "
             "or "
             "look at what the deck was given";
    case FailureCause::not_a_number:
      return "; the integration diverged: try a smaller `safety` (time step)";
    default:
      return "";
  }
}

std::string with_deck_place(const RunPlan &plan, const std::string &log, const std::string &words) {
  const int line = last_deck_line(text_or_nothing(plan.deck), log);
  return to_string(Place{plan.deck.string(), line, 0}) + ": " + words;
}

std::string signal_words(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

// The signal that ended a rank, as mpirun reports it: in its text, or as 128 + signal in its
// status.
int rank_signal(const RunEnd &end, const std::string &screen) {
  const std::string words = "exited on signal ";
  const std::size_t at = screen.find(words);
  if (at != std::string::npos) return std::atoi(screen.c_str() + at + words.size());
  if (end.signal) return end.signal;
  return end.status > 128 && end.status < 128 + 65 ? end.status - 128 : 0;
}

bool launcher_failed(const std::string &screen) {
  return contains(screen, "mpirun was unable to") ||
         contains(screen, "There are not enough slots available") ||
         contains(screen, "An ORTE daemon has unexpectedly failed") ||
         contains(screen, "mpirun has detected an attempt to run as root");
}

// The first line of mpirun's boxed message that says something.
std::string launcher_words(const std::string &screen) {
  std::istringstream lines(screen);
  std::string words;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '-' && words.size() < 200)
      words += (words.empty() ? "" : " ") + line;
  return words;
}

Verdict failed(FailureCause cause, const std::string &message) {
  Verdict verdict;
  verdict.cause = cause;
  verdict.message = message;
  return verdict;
}

}  // namespace

int last_deck_line(const std::string &deck, const std::string &log) {
  const std::vector<DeckCommand> commands = deck_commands(deck);
  std::size_t at = 0;  // the command after the last one found
  int line = 0;
  std::istringstream lines(log);
  for (std::string text; std::getline(lines, text);) {
    const std::string command = command_of(text);
    if (command.empty()) continue;
    const auto same = [&](const DeckCommand &other) { return other.command == command; };
    auto found = std::find_if(commands.begin() + static_cast<long>(at), commands.end(), same);
    if (found == commands.end())
      found = std::find_if(commands.begin(), commands.end(), same);  // a jump back
    if (found == commands.end()) continue;
    line = found->line;
    at = static_cast<std::size_t>(found - commands.begin()) + 1;
  }
  return line;
}

std::string log_tail(const fs::path &directory, int lines) {
  for (const char *name : {kLogName, kScreenName}) {
    std::string text = text_or_nothing(directory / name);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    if (text.empty()) continue;
    std::size_t begin = text.size();
    for (int i = 0; i < lines && begin != std::string::npos && begin > 0; ++i)
      begin = text.rfind('\n', begin - 1);
    return begin == std::string::npos || begin == 0 ? text : text.substr(begin + 1);
  }
  return "";
}

Verdict judge_output(const RunPlan &plan, const fs::path &directory) {
  const fs::path file = directory / plan.curve;
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    return failed(FailureCause::missing_output, "the run wrote no '" + plan.curve + "'");
  Verdict verdict;
  try {
    verdict.curve = read_curve(file);
    for (const std::string &column : plan.columns) verdict.curve.column(column);
  } catch (const NotFinite &not_finite) {
    return failed(FailureCause::not_a_number,
                  not_finite.what() + advice_for(FailureCause::not_a_number));
  } catch (const UserError &user_error) {
    return failed(FailureCause::bad_output, user_error.place().file.empty()
                                                ? file.string() + ": " + user_error.text()
                                                : user_error.what());
  }
  if (!verdict.curve.complete)
    return failed(FailureCause::truncated_output, "'" + file.string() + "' ends after " +
                                                      std::to_string(verdict.curve.rows()) +
                                                      " rows without '# complete:'");
  if (verdict.curve.rows() == 0)
    return failed(FailureCause::bad_output, "'" + file.string() + "' has no rows");
  verdict.ok = true;
  return verdict;
}

Verdict judge_run(const RunEnd &end, const RunPlan &plan, const fs::path &directory) {
  const std::string log = text_or_nothing(directory / kLogName),
                    screen = text_or_nothing(directory / kScreenName);
  const std::string hung =
      end.reason == EndReason::by_itself ? "" : " (then it hung and was ended)";

  std::optional<std::string> words = engine_error(log);
  if (!words) words = engine_error(screen);
  if (words) {
    const FailureCause cause = cause_of(*words);
    const std::string said = cause == FailureCause::deck_error ? with_deck_place(plan, log, *words)
                                                               : "the engine stopped: " + *words;
    return failed(cause, said + hung + advice_for(cause));
  }
  if (end.reason == EndReason::wall_limit)
    return failed(FailureCause::timeout,
                  "ended at the wall limit of " + canonical_number(plan.wall_limit) +
                      " s; give the test '" + plan.test +
                      "' a longer wall_limit, or look at the log for what slows it down");
  if (end.reason == EndReason::stalled)
    return failed(FailureCause::no_progress,
                  "ended after " + format_quantity(end.wall_seconds, "s", 3) +
                      ": neither log nor curve had grown for a long time");
  if (end.status == 0) return judge_output(plan, directory);

  if (launcher_failed(screen))
    return failed(FailureCause::launcher,
                  "mpirun couldn't start the engine: " + launcher_words(screen));
  // A curve with NaN explains a crash better than the signal does.
  const Verdict output = judge_output(plan, directory);
  if (output.cause == FailureCause::not_a_number) return output;
  if (const int signal = rank_signal(end, screen))
    return failed(FailureCause::engine_crash, "the engine was ended by " + signal_words(signal));
  return failed(
      FailureCause::engine_crash,
      "the engine ended with status " + std::to_string(end.status) + " without an error message");
}

}  // namespace bondlab
