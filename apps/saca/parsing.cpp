#include "apps/saca/parsing.h"

#include "apps/saca/line_description.h"
#include "saca/lab/shell/refusal.h"

namespace saca::app {
namespace {

const CLI::App& innermost(const CLI::App& line) {
  const auto parsed = line.get_subcommands();
  return parsed.empty() ? line : innermost(*parsed.back());
}

}  // namespace

ExitCode refuse_line(const CLI::App& line, const CLI::ParseError& problem) {
  const bool incomplete_or_left = dynamic_cast<const CLI::ExtrasError*>(&problem) != nullptr ||
                                  dynamic_cast<const CLI::RequiredError*>(&problem) != nullptr;
  complain(shell::refusal({.program = described(line).front(),
                           .command = described(innermost(line)).front(),
                           .left = line.remaining(true),
                           .incomplete_or_left = incomplete_or_left,
                           .problem = problem.what()}));
  return wrong_command_line;
}

}  // namespace saca::app
