#include <memory>
#include <string>
#include <utility>

#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/banks/bank_check.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

struct CheckCasesOptions {
  std::string file = "runs/memory.sqlite";
  std::string car = "compact_rwd_ev";
  std::size_t draws = 64;
  int threads = usual_threads();
  bool quarantined = false;  ///< too
  bool as_json = false;
};

int check_bank(const CheckCasesOptions& options) {
  auto read = banks::read_bank(options.file);
  if (!read.has_value()) {
    return refused(read.error());
  }
  banks::ReadBank bank = std::move(read).value();
  const auto planes = open_planes(options.car);
  if (!planes.has_value()) {
    return refused(planes.error());
  }
  long_work::watch_for_interrupt();
  const auto check =
      banks::check(bank, case_tools(*planes.value(), options.draws),
                   {.quarantined = options.quarantined ? banks::Quarantined::checked_too
                                                       : banks::Quarantined::left_alone,
                    .threads = options.threads,
                    .display = progress_display()});
  if (!check.has_value()) {
    return refused(check.error());
  }
  if (options.as_json) {
    app::print_json(json_of(check.value(), options.car));
  } else {
    app::print("{}", text_of(check.value()));
  }
  if (long_work::interrupted()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  return success;
}

}  // namespace

banks::CaseTools case_tools(const PlanesOfCar& planes, std::size_t draws) {
  return {planes.setup.forecast, &planes.inputs.intent, made_with(planes), draws};
}

void add_memory_check(CLI::App& memory, int& exit_code) {
  CLI::App* const command = memory.add_subcommand(
      "check", "Rolls out what is not trusted, with the car at hand: what holds is trusted then");
  const auto options = std::make_shared<CheckCasesOptions>();
  command->add_option("--memory", options->file, "The memory bank")->capture_default_str();
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command->add_option("--draws", options->draws, "That expected harm is the mean of")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  add_threads(*command, options->threads);
  command->add_flag("--quarantined", options->quarantined,
                    "Also what is in quarantine: what holds over draws is served again");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = check_bank(*options); });
}

}  // namespace saca::app
