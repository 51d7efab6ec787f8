#include <memory>
#include <string>

#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/clock.h"
#include "saca/lab/banks/bank_statistics.h"

namespace saca::app {
namespace {

struct StatsOptions {
  std::string file = "runs/memory.sqlite";
  bool as_json = false;
};

int show_stats(const StatsOptions& options) {
  const auto statistics = banks::bank_statistics(options.file, SteadyClock());
  if (!statistics.has_value()) {
    return refused(statistics.error());
  }
  if (options.as_json) {
    app::print_json(json_of(statistics.value()));
  } else {
    app::print("{}", text_of(statistics.value()));
  }
  return success;
}

}  // namespace

void add_memory_stats(CLI::App& memory, int& exit_code) {
  CLI::App* const command = memory.add_subcommand(
      "stats", "What encounters the bank knows and which it lacks, and how long it takes to ask");
  const auto options = std::make_shared<StatsOptions>();
  command->add_option("--memory", options->file, "The memory bank")->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = show_stats(*options); });
}

}  // namespace saca::app
