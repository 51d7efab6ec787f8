#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/case_check.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/progress.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/store.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct CheckCasesOptions {
  std::string file = "runs/memory.sqlite";
  std::string car = "compact_rwd_ev";
  std::size_t draws = 64;
  int threads = usual_threads();
  bool quarantined = false;  ///< too
  bool as_json = false;
};

/// How many are trusted then, stay as they were, and are quarantined: by memory::Trust.
using Counts = std::array<int, 3>;

/// Those that this car does not trust yet, and where wanted those in quarantine; what was worked
/// out is kept where it is interrupted.
Result<Counts> check_all(memory::Store& memory, std::vector<memory::Case> cases,
                         const PlanesOfCar& planes, const CheckCasesOptions& options) {
  const preview::ForecastTools& tools = planes.setup.forecast;
  const intent::Model& intent = planes.inputs.intent;
  const auto made_with = app::made_with(planes);
  std::erase_if(cases, [&](const memory::Case& one) {
    return one.trust == memory::Trust::quarantined ? !options.quarantined
                                                   : memory::is_trusted_by(made_with, one);
  });
  SteadyClock clock;
  long_work::ProgressLine progress("cases", static_cast<int>(cases.size()), clock,
                                   progress_display());
  Counts counts{};
  constexpr std::size_t at_once = 32;
  for (std::size_t first = 0; first < cases.size() && !long_work::interrupted(); first += at_once) {
    std::vector<std::optional<memory::Case>> checked(std::min(at_once, cases.size() - first));
    in_parallel(checked.size(), options.threads, [&](std::size_t i) {
      checked[i] = eval::checked(cases[first + i], tools, intent, options.draws, made_with);
    });
    for (std::size_t i = 0; i < checked.size(); ++i) {
      auto trust = memory::Trust::unchecked;
      const auto keep = [&](memory::Case& now) {
        if (memory::to_json(now) != memory::to_json(cases[first + i])) {
          return false;  // another process has learnt of it meanwhile: it is checked the next time
        }
        now = *checked[i];
        trust = now.trust;
        return true;
      };
      if (checked[i]) {
        if (auto problem = memory.change(checked[i]->id, keep)) {
          return *std::move(problem);
        }
      }
      ++counts.at(static_cast<std::size_t>(trust));
    }
    progress.show(static_cast<int>(first + checked.size()), 0, " cases");
  }
  return counts;
}

int check_bank(const CheckCasesOptions& options) {
  auto read = read_bank(options.file);
  if (!read.has_value()) {
    return refused(read.error());
  }
  ReadBank bank = std::move(read).value();
  const auto planes = open_planes(options.car);
  if (!planes.has_value()) {
    return refused(planes.error());
  }
  long_work::watch_for_interrupt();
  const auto counts = check_all(bank.store, std::move(bank.cases), *planes.value(), options);
  if (!counts.has_value()) {
    return refused(counts.error());
  }
  const auto [confirmed, open, refuted] = counts.value();
  if (options.as_json) {
    app::print_json(json{{"schema", "saca.memory_check/1"},
                         {"file", bank.store.name()},
                         {"car", options.car},
                         {"confirmed", confirmed},
                         {"open", open},
                         {"refuted", refuted}});
  } else {
    app::print(
        "{}: {} cases confirmed and trusted, {} stay as they were, {} refuted and quarantined\n",
        bank.store.name(), confirmed, open, refuted);
  }
  if (long_work::interrupted()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  return success;
}

}  // namespace

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
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--quarantined", options->quarantined,
                    "Also what is in quarantine: what holds over draws is served again");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = check_bank(*options); });
}

}  // namespace saca::app
