#include "apps/saca/suite_sources.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/saca/surveying.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/lab/eval/paper_tables.h"
#include "saca/lab/importers/hundred_car_release.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using eval::SuiteEncounter;

/// Encounters that are all there.
SuiteEncounters source_of(Inputs inputs, std::vector<SuiteEncounter> all, int count,
                          std::string what) {
  SuiteEncounters source{
      .inputs = std::move(inputs), .what = std::move(what), .notes = {}, .at = {}};
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

/// Every event of the 100-Car study that can be rebuilt.
Result<SuiteEncounters> open_hundred_car(const SuiteCommandOptions& options, Inputs inputs) {
  if (options.data.size() != 1) {
    return Error{
        Error::Code::out_of_range,
        fmt::format("--data: want the folder of the 100-Car study's release, got {} folders",
                    options.data.size())};
  }
  const std::string& folder = options.data.front();
  long_work::watch_for_interrupt();
  const auto outcomes = importers::import_hundred_cars(
      folder, {}, [](std::size_t, std::size_t) { return !long_work::interrupted(); });
  if (!outcomes.has_value()) {
    return outcomes.error();
  }
  std::vector<SuiteEncounter> all;
  Fnv hash;
  for (const importers::HundredCarOutcome& outcome : outcomes.value()) {
    if (const auto* const rebuilt = outcome.rebuilt()) {
      hash.add(scenario::write_scenario(rebuilt->scenario));
      all.push_back({.number = all.size(),
                     .family = outcome.severity,
                     .scenario = rebuilt->scenario,
                     .twin = {}});
      all.back().scenario.car = inputs.car_name;
    }
  }
  if (all.empty()) {
    return Error{Error::Code::out_of_range, folder + ": want events that can be rebuilt, got none"};
  }
  std::string refused;
  for (const auto& [reason, times] : importers::refusals(outcomes.value())) {
    refused += fmt::format("{}{} ({})", refused.empty() ? "" : ", ", times, meaning(reason));
  }
  const std::size_t rebuilt = all.size();
  SuiteEncounters source = source_of(std::move(inputs), std::move(all), options.count,
                                     fmt::format("100-Car study ({:016x})", hash.value()));
  source.notes.push_back(fmt::format("{} of {} events were rebuilt; refused: {}.", rebuilt,
                                     outcomes.value().size(), refused));
  return source;
}

Result<SuiteEncounters> open_folder(const SuiteCommandOptions& options, Inputs inputs) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(options.name)) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    return Error{Error::Code::out_of_range,
                 options.name + ": want a folder with scenarios (*.toml), got none"};
  }
  std::vector<SuiteEncounter> all;
  Fnv hash;
  for (const fs::path& file : files) {
    const auto text = read_file(file);
    if (!text.has_value()) {
      return text.error();
    }
    hash.add(text.value());
    auto scenario =
        scenario::read_scenario(text.value(), file.string(), manoeuvre::footprint(inputs.car));
    if (!scenario.has_value()) {
      return scenario.error();
    }
    all.push_back({.number = all.size(),
                   .family = file.stem(),
                   .scenario = std::move(scenario).value(),
                   .twin = {}});
  }
  return source_of(std::move(inputs), std::move(all), options.count,
                   fmt::format("folder {} ({:016x})", options.name, hash.value()));
}

/// A table of the paper: its conditions one after the other, over and over.
Result<SuiteEncounters> open_paper_table(const SuiteCommandOptions& options, Inputs inputs) {
  auto conditions = eval::encounters_of(*eval::find_paper_table(options.name),
                                        inputs.places.root / "scenarios", inputs.car);
  if (!conditions.has_value()) {
    return conditions.error();
  }
  std::vector<SuiteEncounter> all = std::move(conditions).value();
  Fnv hash;
  if (auto problem = add_inputs(inputs.places, options.car, hash)) {
    return *problem;
  }
  for (SuiteEncounter& one : all) {
    one.scenario.car = inputs.car_name;
    one.twin->car = inputs.car_name;
    hash.add(scenario::write_scenario(one.scenario));
    hash.add(scenario::write_scenario(*one.twin));
    if (options.no_twins) {
      one.twin.reset();
    }
  }
  SuiteEncounters source{.inputs = std::move(inputs),
                         .what = fmt::format("{} ({:016x})", options.name, hash.value()),
                         .count = options.count,
                         .notes = {},
                         .at = {}};
  source.at = [all = std::move(all)](std::uint64_t number) -> Result<SuiteEncounter> {
    SuiteEncounter one = all[number % all.size()];
    one.number = number;
    return one;
  };
  return source;
}

/// What `saca suite` takes beside suites and families.
std::vector<std::string> names_beside_suites() {
  std::vector<std::string> names{"100car", "traffic"};
  if (const auto places = find_places(); places.has_value()) {
    for (const auto& entry : fs::directory_iterator(places.value().root / "data" / "protocols")) {
      names.push_back(entry.path().stem().string());
    }
  }
  for (const eval::PaperTable& table : eval::paper_tables()) {
    names.emplace_back(table.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Result<SuiteEncounters> open_encounters(const SuiteCommandOptions& options,
                                        const std::string& command) {
  const bool is_table = eval::find_paper_table(options.name) != nullptr;
  if (options.name == "100car" || is_table || fs::is_directory(options.name)) {
    auto inputs = read_inputs(options.car);
    if (!inputs.has_value()) {
      return inputs.error();
    }
    if (is_table) {
      return open_paper_table(options, std::move(inputs).value());
    }
    return options.name == "100car" ? open_hundred_car(options, std::move(inputs).value())
                                    : open_folder(options, std::move(inputs).value());
  }
  const auto suite = open_suite({.suite = options.name,
                                 .car = options.car,
                                 .count = options.count,
                                 .split = options.split,
                                 .test_log = options.test_log,
                                 .other_names = names_beside_suites()},
                                command);
  if (!suite.has_value()) {
    return suite.error();
  }
  SuiteEncounters source;
  source.inputs = suite.value().inputs;
  source.count = options.count;
  source.what =
      fmt::format("{}, {} split ({:016x})", options.name, options.split, suite.value().digest);
  source.at = [suite = suite.value(),
               twins = !options.no_twins](std::uint64_t number) -> Result<SuiteEncounter> {
    const auto sample = suite.source.sample(number);
    if (!sample.has_value()) {
      return sample.error();
    }
    return SuiteEncounter{.number = number,
                          .family = suite.source.family_of(number),
                          .scenario = sample.value().scenario,
                          .twin = twins ? std::optional(sample.value().twin) : std::nullopt};
  };
  return source;
}

}  // namespace saca::app
