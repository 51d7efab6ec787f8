#include "apps/saca/commands.h"
#include "apps/saca/reach_commands.h"

namespace saca::app {

void add_reach(CLI::App& line, int& exit_code) {
  CLI::App* const reach = line.add_subcommand(
      "reach", "Which states can still be saved: solve, show and compare Hamilton-Jacobi values");
  reach->require_subcommand(1);
  add_reach_check(*reach, exit_code);
  add_reach_compare(*reach, exit_code);
  add_reach_solve(*reach, exit_code);
  add_reach_show(*reach, exit_code);
  add_reach_tables(*reach, exit_code);
}

}  // namespace saca::app
