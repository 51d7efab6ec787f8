#include <fmt/core.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/percentile.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/coverage.h"

namespace saca::app {
namespace {

using memory::CoverageCell;
using nlohmann::json;

struct StatsOptions {
  std::string file = "runs/memory.sqlite";
  bool as_json = false;
};

/// What a bank costs: [s] to be opened, [us] to be asked.
struct BankTimes {
  double load = 0.0;
  double recall_median = 0.0;
  double recall_p99 = 0.0;
};

/// Each case's own scene is asked, without the case; of many a thousand.
BankTimes timed(const memory::Experience& experience, const std::vector<memory::Case>& cases,
                double load, const Clock& clock) {
  constexpr std::size_t most_asked = 1'000;
  const std::size_t step = std::max<std::size_t>(1, cases.size() / most_asked);
  std::vector<double> times;
  times.reserve(cases.size() / step + 1);
  for (std::size_t i = 0; i < cases.size(); i += step) {
    const std::array<match::CaseId, 1> own{cases[i].id};
    const Clock::Time begin = clock.now();
    const auto features = match::features(cases[i].scene);
    (void)experience.recall(features, own);
    constexpr double microseconds = 1e6;
    times.push_back(microseconds * to_seconds(clock.now() - begin));
  }
  return {load, percentile(times, 0.5), percentile(times, 0.99)};
}

std::string speeds_of(std::size_t speed_class) {
  const auto& ends = memory::speed_classes;
  if (speed_class == 0) {
    return fmt::format("below {:.0f} m/s", ends.front());
  }
  return speed_class == ends.size()
             ? fmt::format("{:.0f} m/s and more", ends.back())
             : fmt::format("{:.0f} to {:.0f} m/s", ends.at(speed_class - 1), ends.at(speed_class));
}

void print_stats(const std::string& name, std::size_t num_cases, const BankTimes& times,
                 const std::vector<CoverageCell>& cells) {
  app::print("{}: {} cases, opened in {:.2f} s; asked in {:.0f} us (median), {:.0f} us (p99)\n\n",
             name, num_cases, times.load, times.recall_median, times.recall_p99);
  app::print("{:15} {:17} {:>7} {:>9} {:>9} {:>11}\n", "whom it meets", "at", "cases", "slippery",
             "braking", "to nearest");
  for (const CoverageCell& cell : cells) {
    if (cell.cases == 0) {
      app::print("{:15} {:17} {:>7}\n", memory::name(cell.situation), speeds_of(cell.speed_class),
                 "none");
      continue;
    }
    const auto share = [&cell](std::size_t part) {
      return fmt::format("{:.0f} %",
                         100.0 * static_cast<double>(part) / static_cast<double>(cell.cases));
    };
    app::print("{:15} {:17} {:7} {:>9} {:>9} {:>11}\n", memory::name(cell.situation),
               speeds_of(cell.speed_class), cell.cases, share(cell.slippery),
               share(cell.braking_as_good),
               std::isnan(cell.to_nearest) ? "-" : fmt::format("{:.2f}", cell.to_nearest));
  }
  app::print(
      "\nbraking: as good as the best. to nearest: difference from the nearest other case, "
      "median;\n0.9 to its power is their similarity.\n");
}

json stats_json(const std::string& name, std::size_t num_cases, const BankTimes& times,
                const std::vector<CoverageCell>& cells) {
  json list = json::array();
  for (const CoverageCell& cell : cells) {
    const auto& ends = memory::speed_classes;
    list.push_back(
        {{"situation", memory::name(cell.situation)},
         {"from_mps", cell.speed_class == 0 ? 0.0 : ends.at(cell.speed_class - 1)},
         {"to_mps",
          cell.speed_class == ends.size() ? json(nullptr) : json(ends.at(cell.speed_class))},
         {"cases", cell.cases},
         {"slippery", cell.slippery},
         {"braking_as_good", cell.braking_as_good},
         {"to_nearest", std::isnan(cell.to_nearest) ? json(nullptr) : json(cell.to_nearest)}});
  }
  return {{"schema", "saca.memory_stats/1"},
          {"file", name},
          {"cases", num_cases},
          {"load_s", times.load},
          {"recall_us", {{"p50", times.recall_median}, {"p99", times.recall_p99}}},
          {"cells", std::move(list)}};
}

int show_stats(const StatsOptions& options) {
  const SteadyClock clock;
  const Clock::Time begin = clock.now();
  auto opened = memory::Store::open_existing(options.file);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  const double load = to_seconds(clock.now() - begin);
  memory::Store store = std::move(opened).value();
  const auto cases = store.all();
  if (!cases.has_value()) {
    return refused(cases.error());
  }
  const BankTimes times = cases.value().empty()
                              ? BankTimes{.load = load}
                              : timed(store.experience(), cases.value(), load, clock);
  const std::vector<CoverageCell> cells = memory::coverage(cases.value());
  if (options.as_json) {
    app::print_json(stats_json(store.name(), cases.value().size(), times, cells));
  } else {
    print_stats(store.name(), cases.value().size(), times, cells);
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
