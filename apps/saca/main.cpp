#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <system_error>

#include "apps/saca/commands.h"
#include "apps/saca/parsing.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/version.h"
#include "saca/base/core/standard_files.h"
#include "saca/lab/shell/refusal.h"

namespace {

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

void add_commands(CLI::App& line, int& exit_code) {
  using namespace saca::app;
  add_run(line, exit_code);
  add_replay(line, exit_code);
  add_explain(line, exit_code);
  add_report(line, exit_code);
  add_verify(line, exit_code);
  add_scenarios(line, exit_code);
  add_import(line, exit_code);
  add_memory(line, exit_code);
  add_cases(line, exit_code);
  add_reason(line, exit_code);
  add_model(line, exit_code);
  add_physics(line, exit_code);
  add_drive(line, exit_code);
  add_harm(line, exit_code);
  add_oracle(line, exit_code);
  add_whatif(line, exit_code);
  add_family(line, exit_code);
  add_cues(line, exit_code);
  add_balance(line, exit_code);
  add_forecast(line, exit_code);
  add_ladder(line, exit_code);
  add_learn(line, exit_code);
  add_tables(line, exit_code);
  add_suite(line, exit_code);
  add_search_showcase(line, exit_code);
  add_tune(line, exit_code);
  add_atlas(line, exit_code);
  add_danger(line, exit_code);
  add_reach(line, exit_code);
  add_intent(line, exit_code);
  add_traffic(line, exit_code);
  add_vehicle(line, exit_code);
  add_bench(line, exit_code);
  add_completion(line, exit_code);
  add_man(line, exit_code);
}

/// Does what was typed.
/// @param typed      the words after the program's name
/// @param exit_code  that its command leaves
int run_line(CLI::App& line, const std::vector<std::string>& typed, const int& exit_code) {
  using namespace saca::app;
  std::vector<std::string> words = saca::shell::as_spelt(typed);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the end
  try {
    line.parse(std::move(words));
  } catch (const CLI::ParseError& problem) {
    std::ostringstream told;
    if (line.exit(problem, told, told) != 0) {
      return refuse_line(line, problem);
    }
    saca::app::print("{}", told.str());  // the help that was asked for
    return success;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    complain("the output cannot be written");
    return exit_code == success ? cannot_write : exit_code;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace saca::app;
  saca::occupy_standard_files();
  if (waiting_was_chosen_here) {  // not for the language model's process
    ::unsetenv(how_to_wait);
  }
  try {
    CLI::App line{
        "SACA chooses, in the last seconds before a crash, the manoeuvre that harms least.",
        "saca"};
    line.set_version_flag("--version", "saca " + version_text());
    add_settings(line);
    line.require_subcommand(1);
    int exit_code = success;
    add_commands(line, exit_code);
    return run_line(line, {argv + std::min(argc, 1), argv + argc}, exit_code);
  } catch (const std::system_error& problem) {
    complain(std::string("cannot go on: ") + problem.what());
    return cannot_write;
  } catch (const std::exception& problem) {
    complain(std::string("internal error, please report it: ") + problem.what());
    return internal_error;
  }
}
