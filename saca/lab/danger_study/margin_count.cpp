#include "saca/lab/danger_study/margin_count.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/lab/danger_study/numbered_situations.h"
#include "saca/lab/learned_danger/check.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::danger_study {
namespace {

using learned_danger::PredictedSafe;
using nlohmann::json;

constexpr const char* count_schema = "saca.margins/2";

}  // namespace

std::string margin_count_of(const learned_danger::Network& network, std::uint64_t seed) {
  return fmt::format("weights {:016x}, seed {}", network.digest(), seed);
}

json json_of(const MarginCount& count, const std::string& of) {
  json all{{"schema", count_schema}, {"of", of}, {"situations", count.situations}};
  for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
    all["told_safe"][learned_danger::bin_names()[bin]] = count.told[bin].numbers();
  }
  return all;
}

Result<MarginCount> read_margin_count(const std::filesystem::path& path, const std::string& of) {
  if (!std::filesystem::exists(path)) {
    return MarginCount{};
  }
  const auto text = read_file(path, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  const json all = json::parse(text.value(), nullptr, false);
  const auto refuse = [&](const std::string& why) {
    return Error{Error::Code::malformed, path.string() +
                                             ": want an unfinished count of margins of " + of +
                                             ", got " + why + "; delete it to begin anew"};
  };
  if (!all.is_object() || all.value("schema", json()) != count_schema) {
    return refuse("something else");
  }
  if (all.value("of", json()) != of) {
    return refuse("one of other weights or another seed");
  }
  MarginCount count;
  try {
    count.situations = all.at("situations").get<int>();
    for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
      const auto told = PredictedSafe::from(
          all.at("told_safe").at(learned_danger::bin_names()[bin]).get<std::vector<int>>());
      if (!told) {
        return refuse("numbers that are none");
      }
      count.told[bin] = *told;
    }
  } catch (const json::exception& problem) {
    return refuse(problem.what());
  }
  return count;
}

Result<MarginCount> counted_on(MarginCount count, const std::string& of,
                               const std::filesystem::path& path, const manoeuvre::Car& car,
                               const learned_danger::Network& network, const SituationsTask& task) {
  constexpr int situations_at_once = 2'000;
  const NumberedSituations drawn{"margins", task.seed, task.threads};
  const world::Footprint body = manoeuvre::footprint(car);
  SteadyClock clock;
  const int remembered = count.situations;
  long_work::ProgressLine line("danger margins", task.situations, clock, task.display);
  while (count.situations < task.situations && !long_work::interrupted()) {
    std::array<bool, learned_danger::num_bins> wanted{};
    std::transform(count.told.begin(), count.told.end(), wanted.begin(),
                   [](const PredictedSafe& told) { return told.may_have_margin(); });
    const auto some = worked_out<learned_danger::MarginSample>(
        drawn, count.situations, std::min(situations_at_once, task.situations - count.situations),
        [&](std::uint64_t seed) {
          return learned_danger::driven_by_evasion(car, body, network, seed, wanted);
        });
    for (const learned_danger::MarginSample& one : some) {
      if (one.acted) {
        count.told[one.bin].add(one.told, *one.acted >= 0.0);
      }
    }
    count.situations += static_cast<int>(some.size());
    if (auto problem = write_file(path, json_of(count, of).dump())) {
      return *std::move(problem);
    }
    line.show(count.situations, remembered, " situations");
  }
  if (long_work::interrupted()) {
    return Error{Error::Code::too_late, "interrupted; the same command goes on from here"};
  }
  return count;
}

}  // namespace saca::danger_study
