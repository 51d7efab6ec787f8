#include "saca/lab/banks/bank_statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "saca/base/core/percentile.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/store.h"

namespace saca::banks {
namespace {

using memory::CoverageCell;

/// How long it takes to ask for the cases' own scenes [us]: one time at least.
std::vector<double> recall_times(const memory::Experience& experience,
                                 const std::vector<memory::Case>& cases, const Clock& clock) {
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
  return times;
}

std::string speeds_text(std::size_t speed_class) {
  const auto& ends = memory::speed_classes;
  if (speed_class == 0) {
    return fmt::format("below {:.0f} m/s", ends.front());
  }
  return speed_class == ends.size()
             ? fmt::format("{:.0f} m/s and more", ends.back())
             : fmt::format("{:.0f} to {:.0f} m/s", ends.at(speed_class - 1), ends.at(speed_class));
}

std::string cell_text(const CoverageCell& cell) {
  if (cell.cases == 0) {
    return fmt::format("{:15} {:17} {:>7}\n", memory::name(cell.situation),
                       speeds_text(cell.speed_class), "none");
  }
  const auto percent = [&cell](std::size_t part) {
    return fmt::format("{:.0f} %",
                       100.0 * static_cast<double>(part) / static_cast<double>(cell.cases));
  };
  return fmt::format("{:15} {:17} {:7} {:>9} {:>9} {:>11}\n", memory::name(cell.situation),
                     speeds_text(cell.speed_class), cell.cases, percent(cell.slippery),
                     percent(cell.braking_as_good),
                     std::isnan(cell.to_nearest) ? "-" : fmt::format("{:.2f}", cell.to_nearest));
}

nlohmann::json cell_json(const CoverageCell& cell) {
  using nlohmann::json;
  const auto& ends = memory::speed_classes;
  return {
      {"situation", memory::name(cell.situation)},
      {"from_mps", cell.speed_class == 0 ? 0.0 : ends.at(cell.speed_class - 1)},
      {"to_mps", cell.speed_class == ends.size() ? json(nullptr) : json(ends.at(cell.speed_class))},
      {"cases", cell.cases},
      {"slippery", cell.slippery},
      {"braking_as_good", cell.braking_as_good},
      {"to_nearest", std::isnan(cell.to_nearest) ? json(nullptr) : json(cell.to_nearest)}};
}

}  // namespace

Result<BankStatistics> bank_statistics(const std::string& file, const Clock& clock) {
  const Clock::Time begin = clock.now();
  auto opened = memory::Store::open_existing(file);
  if (!opened.has_value()) {
    return opened.error();
  }
  BankStatistics statistics;
  statistics.load = to_seconds(clock.now() - begin);
  memory::Store store = std::move(opened).value();
  const auto cases = store.all();
  if (!cases.has_value()) {
    return cases.error();
  }
  statistics.name = store.name();
  statistics.num_cases = cases.value().size();
  if (!cases.value().empty()) {
    const std::vector<double> times = recall_times(store.experience(), cases.value(), clock);
    statistics.recall_median = percentile(times, 0.5);
    statistics.recall_p99 = percentile(times, 0.99);
  }
  statistics.cells = memory::coverage(cases.value());
  return statistics;
}

nlohmann::json json_of(const BankStatistics& statistics) {
  nlohmann::json cells = nlohmann::json::array();
  for (const CoverageCell& cell : statistics.cells) {
    cells.push_back(cell_json(cell));
  }
  return {{"schema", "saca.memory_stats/1"},
          {"file", statistics.name},
          {"cases", statistics.num_cases},
          {"load_s", statistics.load},
          {"recall_us", {{"p50", statistics.recall_median}, {"p99", statistics.recall_p99}}},
          {"cells", std::move(cells)}};
}

std::string text_of(const BankStatistics& statistics) {
  std::string text = fmt::format(
      "{}: {} cases, opened in {:.2f} s; asked in {:.0f} us (median), {:.0f} us (p99)\n\n",
      statistics.name, statistics.num_cases, statistics.load, statistics.recall_median,
      statistics.recall_p99);
  text += fmt::format("{:15} {:17} {:>7} {:>9} {:>9} {:>11}\n", "whom it meets", "at", "cases",
                      "slippery", "braking", "to nearest");
  for (const CoverageCell& cell : statistics.cells) {
    text += cell_text(cell);
  }
  return text +
         "\nbraking: as good as the best. to nearest: difference from the nearest other case, "
         "median;\n0.9 to its power is their similarity.\n";
}

}  // namespace saca::banks
