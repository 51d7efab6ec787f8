#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <system_error>

#include "apps/saca/command.h"
#include "saca/base/core/standard_files.h"
#include "saca/lab/shell/cli11_line.h"
#include "saca/lab/shell/refusal.h"

namespace {

using namespace saca::app;

// OpenMP's waiting threads would spin for milliseconds at each barrier, which beside another busy
// program halves the speed of both. Its library reads how they are to wait when it is loaded,
// before main: hence this way of being earlier. Whoever sets the variable is obeyed.
constexpr const char* how_to_wait = "OMP_WAIT_POLICY";
bool waiting_was_chosen_here = false;

void choose_waiting(int /*argc*/, char** /*argv*/, char** /*environment*/) {
  if (std::getenv(how_to_wait) == nullptr) {
    waiting_was_chosen_here = ::setenv(how_to_wait, "passive", 0) == 0;
  }
}
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const chooses_waiting)(int, char**, char**) = choose_waiting;

void add_all(CLI::App& line) {
  line.set_version_flag("--version",
                        "saca " + saca::installation::version_text(
                                      {.version = SACA_VERSION, .commit = built_from()}));
  line.add_flag("--quiet", settings().quiet,
                "Neither progress nor story: only errors, and what was asked for");
  line.add_option("--cache", settings().cache,
                  "Folder for tables and atlases (default: $XDG_CACHE_HOME/saca, else "
                  "~/.cache/saca)")
      ->type_name("FOLDER");
  line.require_subcommand(1);
  for (const auto add :
       {add_run,       add_replay,  add_explain, add_report,     add_verify,
        add_scenarios, add_import,  add_memory,  add_cases,      add_reason,
        add_model,     add_physics, add_drive,   add_harm,       add_oracle,
        add_whatif,    add_family,  add_cues,    add_balance,    add_forecast,
        add_ladder,    add_learn,   add_tables,  add_suite,      add_search_showcase,
        add_tune,      add_atlas,   add_danger,  add_reach,      add_intent,
        add_traffic,   add_vehicle, add_bench,   add_shell_files}) {
    add(line);
  }
}

/// Does what was typed.
/// @param typed  the words after the program's name
ExitCode run_line(CLI::App& line, const std::vector<std::string>& typed) {
  std::vector<std::string> words = saca::shell::as_spelt(typed);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the end
  ExitCode code = success;
  try {
    line.parse(std::move(words));
  } catch (const Exit& end) {
    code = end.code;
  } catch (const CLI::ParseError& problem) {
    std::ostringstream told;
    if (line.exit(problem, told, told) != 0) {
      complain(saca::shell::refusal(line, problem));
      return wrong_command_line;
    }
    print("{}", told.str());  // the help that was asked for
    return success;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    complain("the output cannot be written");
    return code == success ? cannot_write : code;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  saca::occupy_standard_files();
  if (waiting_was_chosen_here) {  // not for the language model's process
    ::unsetenv(how_to_wait);
  }
  try {
    CLI::App line{
        "SACA chooses, in the last seconds before a crash, the manoeuvre that harms least.",
        "saca"};
    add_all(line);
    return run_line(line, {argv + std::min(argc, 1), argv + argc});
  } catch (const std::system_error& problem) {
    complain(std::string("cannot go on: ") + problem.what());
    return cannot_write;
  } catch (const std::exception& problem) {
    complain(std::string("internal error, please report it: ") + problem.what());
    return internal_error;
  }
}
