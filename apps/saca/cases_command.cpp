#include "apps/saca/cases_commands.h"
#include "apps/saca/commands.h"

namespace saca::app {

void add_cases(CLI::App& line, int& exit_code) {
  CLI::App* const cases = line.add_subcommand(
      "cases", "Cases from records of crashes: made, looked at, and taught with");
  cases->require_subcommand(1);
  add_cases_build(*cases, exit_code);
  add_cases_check(*cases, exit_code);
  add_cases_eval(*cases, exit_code);
  add_cases_export(*cases, exit_code);
  add_cases_show(*cases, exit_code);
}

}  // namespace saca::app
