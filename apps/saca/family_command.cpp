#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/lab/family_samples/sample_sheet.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct FamilyCommand {
  std::string name;
  std::string car = "compact_rwd_ev";
  int count = 12;
  int first = 0;
  std::string split = "tuning";
  std::string test_log;
  std::string svg = "runs/family.svg";
  std::string write;
  std::string cues;  ///< a suite whose cues they have; empty: they have none
  bool twins = false;
  bool as_json = false;
};

/// A family to be drawn from, and by which seed.
struct DrawnFamily {
  families::Family family;
  std::uint64_t seed = 0;
};

Result<DrawnFamily> open_family(const FamilyCommand& options, const Places& places) {
  auto read = read_family(places, options.name);
  const auto splits = read_splits(places);
  const fs::path some_file =
      options.write.empty() ? fs::path() : fs::path(options.write) / "x.toml";
  if (auto problem = long_work::why_outputs_unwritable({options.svg, some_file})) {
    return *problem;
  }
  if (!read.has_value() || !splits.has_value()) {
    return read.has_value() ? splits.error() : read.error();
  }
  DrawnFamily drawn{.family = std::move(read).value(), .seed = 0};
  if (!options.cues.empty()) {
    const auto cues = eval::cues_of_suite(places.root / "scenarios" / "families", options.cues);
    if (!cues.has_value()) {
      return Error{cues.error().code, "--cues: " + cues.error().message};
    }
    drawn.family.cues = cues.value();
  }
  std::optional<families::TestLog> log;
  if (!options.test_log.empty()) {
    log = families::TestLog{options.test_log,
                            fmt::format("saca family {} --first {} --sample {}", options.name,
                                        options.first, options.count)};
  }
  const auto seed = families::seed_for(splits.value(), *families::split_from(options.split),
                                       drawn.family.name, log);
  if (!seed.has_value()) {
    const std::string hint = options.split == "test" ? " (--test-log FILE)" : "";
    return Error{seed.error().code, seed.error().message + hint};
  }
  drawn.seed = seed.value();
  return drawn;
}

/// Draws and writes them, and the sheet of their pictures.
/// @return  "samples" of schema saca.family_samples/1
Result<json> draw_all(const FamilyCommand& options, const DrawnFamily& drawn,
                      const Inputs& inputs) {
  report::ContactSheet sheet = family_samples::empty_sheet(drawn.family);
  const auto side =
      options.twins ? family_samples::SampleSide::twin : family_samples::SampleSide::risk;
  json list = json::array();
  const world::Footprint ego = manoeuvre::footprint(inputs.car);
  for (int k = options.first; k < options.first + options.count; ++k) {
    const auto sample = families::sample(drawn.family, drawn.seed, static_cast<std::uint64_t>(k),
                                         inputs.car_name, ego);
    if (!sample.has_value()) {
      return sample.error();
    }
    const scenario::Scenario& scenario = family_samples::chosen(sample.value(), side);
    fs::path file;
    if (!options.write.empty()) {
      file = fs::path(options.write) / (scenario.name + ".toml");
      auto problem = long_work::write_output(file, scenario::write_scenario(scenario));
      if (problem) {
        return *problem;
      }
    }
    list.push_back(family_samples::json_of(scenario, file));
    sheet.scenes.push_back(
        family_samples::picture_of(sample.value(), side, inputs.car, inputs.harm));
  }
  if (const auto problem = long_work::write_output(options.svg, report::contact_sheet(sheet))) {
    return *problem;
  }
  return list;
}

int run(const FamilyCommand& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto drawn = open_family(options, inputs.value().places);
  if (!drawn.has_value()) {
    return refused(drawn.error());
  }
  const auto list = draw_all(options, drawn.value(), inputs.value());
  if (!list.has_value()) {
    return refused(list.error());
  }
  if (options.as_json) {
    app::print_json(json{{"schema", "saca.family_samples/1"},
                         {"family", drawn.value().family.name},
                         {"split", options.split},
                         {"seed", drawn.value().seed},
                         {"svg", options.svg},
                         {"samples", list.value()}});
  } else {
    app::print("{} samples of {}: {}\n", options.count, drawn.value().family.name,
               fs::absolute(options.svg).string());
  }
  return success;
}

}  // namespace

void add_family(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("family", "Draw encounters of a family, as a sheet of pictures");
  const auto options = std::make_shared<FamilyCommand>();
  command->add_option("name", options->name, "A shipped family, or a file of your own (*.toml)")
      ->required();
  command->add_option("--sample", options->count, "How many")
      ->check(CLI::Range(1, 400))
      ->capture_default_str();
  command->add_option("--first", options->first, "Number of the first")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  command->add_option("--split", options->split, "Whose seed is used")
      ->check(one_of({"tuning", "calibration", "test"}))
      ->capture_default_str();
  command->add_option("--test-log", options->test_log,
                      "Where a use of the test split is noted; needed for it");
  command->add_option("--cues", options->cues, "With the cues of this suite");
  command->add_flag("--twins", options->twins, "The same encounters without risk");
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command->add_option("--svg", options->svg, "The sheet")->capture_default_str();
  command->add_option("--write", options->write, "Folder: write them there as scenario files");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
