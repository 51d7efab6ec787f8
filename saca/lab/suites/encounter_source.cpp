#include "saca/lab/suites/encounter_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/lab/eval/paper_tables.h"
#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::suites {
namespace {

namespace fs = std::filesystem;
using eval::SuiteEncounter;

/// Encounters that are all there.
EncounterSource source_of(std::vector<SuiteEncounter> all, int count, std::string what) {
  EncounterSource source{.what = std::move(what), .notes = {}, .at = {}};
  source.count = std::min(count, static_cast<int>(all.size()));
  source.at = [all = std::move(all)](std::uint64_t number) -> Result<SuiteEncounter> {
    if (number >= all.size()) {
      return Error{Error::Code::out_of_range,
                   fmt::format("want an encounter below {}, got {}", all.size(), number)};
    }
    return all[number];
  };
  return source;
}

/// How many events were rebuilt, and why others were not.
std::string rebuilt_note(const std::vector<importers::HundredCarOutcome>& outcomes,
                         std::size_t rebuilt) {
  std::string refused;
  for (const auto& [reason, times] : importers::refusals(outcomes)) {
    refused += fmt::format("{}{} ({})", refused.empty() ? "" : ", ", times, meaning(reason));
  }
  return fmt::format("{} of {} events were rebuilt; refused: {}.", rebuilt, outcomes.size(),
                     refused);
}

}  // namespace

Result<EncounterSource> hundred_car_source(const std::vector<std::string>& data,
                                           const EncounterDraw& draw) {
  if (data.size() != 1) {
    return Error{
        Error::Code::out_of_range,
        fmt::format("--data: want the folder of the 100-Car study's release, got {} folders",
                    data.size())};
  }
  const std::string& folder = data.front();
  long_work::watch_for_interrupt();
  const auto outcomes = importers::import_hundred_cars(
      folder, {}, [](std::size_t, std::size_t) { return !long_work::interrupted(); });
  if (!outcomes.has_value()) {
    return outcomes.error();
  }
  std::vector<SuiteEncounter> all;
  Fnv hash = draw.played_with;
  for (const importers::HundredCarOutcome& outcome : outcomes.value()) {
    if (const auto* const rebuilt = outcome.rebuilt()) {
      hash.add(scenario::write_scenario(rebuilt->scenario));
      all.push_back({.number = all.size(),
                     .family = outcome.severity,
                     .scenario = rebuilt->scenario,
                     .twin = {}});
      all.back().scenario.car = draw.car_name;
    }
  }
  if (all.empty()) {
    return Error{Error::Code::out_of_range, folder + ": want events that can be rebuilt, got none"};
  }
  std::string note = rebuilt_note(outcomes.value(), all.size());
  EncounterSource source =
      source_of(std::move(all), draw.count, fmt::format("100-Car study ({:016x})", hash.value()));
  source.notes.push_back(std::move(note));
  return source;
}

Result<EncounterSource> folder_source(const std::string& folder, const EncounterDraw& draw) {
  expects(draw.car != nullptr, "a car");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    return Error{Error::Code::out_of_range,
                 folder + ": want a folder with scenarios (*.toml), got none"};
  }
  std::vector<SuiteEncounter> all;
  Fnv hash = draw.played_with;
  for (const fs::path& file : files) {
    const auto text = read_file(file);
    if (!text.has_value()) {
      return text.error();
    }
    hash.add(text.value());
    auto scenario =
        scenario::read_scenario(text.value(), file.string(), manoeuvre::footprint(*draw.car));
    if (!scenario.has_value()) {
      return scenario.error();
    }
    all.push_back({.number = all.size(),
                   .family = file.stem(),
                   .scenario = std::move(scenario).value(),
                   .twin = {}});
    all.back().scenario.car = draw.car_name;
  }
  return source_of(std::move(all), draw.count,
                   fmt::format("folder {} ({:016x})", folder, hash.value()));
}

Result<EncounterSource> paper_table_source(std::string_view table, const fs::path& scenarios,
                                           const EncounterDraw& draw, Twins twins) {
  const eval::PaperTable* const paper = eval::find_paper_table(table);
  expects(paper != nullptr && draw.car != nullptr, "a table of the paper, and a car");
  auto conditions = eval::encounters_of(*paper, scenarios, *draw.car);
  if (!conditions.has_value()) {
    return conditions.error();
  }
  std::vector<SuiteEncounter> all = std::move(conditions).value();
  Fnv hash = draw.played_with;
  for (SuiteEncounter& one : all) {
    one.scenario.car = draw.car_name;
    one.twin->car = draw.car_name;
    hash.add(scenario::write_scenario(one.scenario));
    hash.add(scenario::write_scenario(*one.twin));
    if (twins == Twins::left_out) {
      one.twin.reset();
    }
  }
  EncounterSource source{.what = fmt::format("{} ({:016x})", table, hash.value()),
                         .count = draw.count,
                         .notes = {},
                         .at = {}};
  source.at = [all = std::move(all)](std::uint64_t number) -> Result<SuiteEncounter> {
    SuiteEncounter one = all[number % all.size()];
    one.number = number;
    return one;
  };
  return source;
}

EncounterSource drawn_source(eval::SuiteSource suite, std::string what, int count, Twins twins) {
  EncounterSource source{.what = std::move(what), .count = count, .notes = {}, .at = {}};
  source.at = [suite = std::move(suite), twins](std::uint64_t number) -> Result<SuiteEncounter> {
    const auto sample = suite.sample(number);
    if (!sample.has_value()) {
      return sample.error();
    }
    return SuiteEncounter{
        .number = number,
        .family = suite.family_of(number),
        .scenario = sample.value().scenario,
        .twin = twins == Twins::played ? std::optional(sample.value().twin) : std::nullopt};
  };
  return source;
}

std::vector<std::string> names_beside_suites(const fs::path& protocols) {
  std::vector<std::string> names{"100car", "traffic"};
  for (const auto& entry : fs::directory_iterator(protocols)) {
    names.push_back(entry.path().stem().string());
  }
  for (const eval::PaperTable& table : eval::paper_tables()) {
    names.emplace_back(table.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace saca::suites
