// SPDX-License-Identifier: GPL-2.0-or-later
//
// bondlab: identify the parameters of bonded-particle models from measured properties.
//
// Job: put the subcommands together and turn what they throw into messages and exit statuses.
// Exit status: 0 done; 1 something the user can mend, told as `error: file:line:column: what, and
// what is allowed`; 2 forward runs failed beyond what the policy allows; 3 a fault of ours; 128 + n
// ended by signal n.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include "app/commands.h"
#include "base/user_error.h"
#include "forward/forward_model.h"

namespace {

constexpr int kUserError = 1, kRunsFailed = 2, kInternalError = 3;

// CLI11 only says that a subcommand is required.
void refuse_unknown_command(const CLI::App &app, int argc, char **argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App *command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  const std::string near = bondlab::nearest_word(argv[1], names);
  throw bondlab::UserError(std::string("there is no command '") + argv[1] + "'" +
                           (near.empty() ? "" : " (did you mean '" + near + "'?)") +
                           "; commands: " + bondlab::join(names));
}

void print_error(const std::string &text) { std::fprintf(stderr, "error: %s\n", text.c_str()); }

}  // namespace

int main(int argc, char **argv) {
  CLI::App app(
      "BondLab: identify the parameters of bonded-particle models from measured properties",
      "bondlab");
  app.set_version_flag("--version", "bondlab " BONDLAB_VERSION);
  app.require_subcommand(1);
  try {
    bondlab::add_check(app);
    bondlab::add_run(app);
    bondlab::add_compare(app);
    bondlab::add_fit(app);
    bondlab::add_report(app);
    bondlab::add_specimen(app);
    bondlab::add_view(app);
    bondlab::add_diagnose(app);
    bondlab::add_hide(app);
    bondlab::add_trial(app);
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError &error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    print_error(error.what());
    std::fprintf(stderr, "try `bondlab --help` or `bondlab COMMAND --help`\n");
    return kUserError;
  } catch (const bondlab::UserErrors &errors) {
    for (const bondlab::UserError &error : errors.errors()) print_error(error.what());
    return kUserError;
  } catch (const bondlab::UserError &error) {
    print_error(error.what());
    return kUserError;
  } catch (const bondlab::RunsFailed &error) {
    print_error(error.what());
    return kRunsFailed;
  } catch (const bondlab::Interrupted &interrupted) {
    print_error("interrupted; the same command goes on from here");
    return 128 + interrupted.signal();
  } catch (const std::bad_alloc &) {
    print_error("not enough memory");
    return kInternalError;
  } catch (const std::exception &error) {
    print_error(std::string("internal: ") + error.what() +
                " (a fault of bondlab: please report it with the command and the study)");
    return kInternalError;
  }
}
