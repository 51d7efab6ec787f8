#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/vehicle_study/atlas_check_run.h"
#include "saca/lab/vehicle_study/atlas_report.h"
#include "saca/lab/vehicle_study/package_build.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct AtlasOptions {
  std::string car = "compact_rwd_ev";
  std::string file;
  int threads = usual_threads();
  int scenes = 1'000;
  std::optional<std::uint64_t> seed;  // of the samples; none: the calibration split's
  bool as_json = false;
};

/// The file that was named, else the one that `saca run` looks for.
fs::path file_of(const AtlasOptions& options, const Inputs& inputs) {
  return options.file.empty() ? atlas_place(inputs.places, inputs.car_name)
                              : fs::path(options.file);
}

int build(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const fs::path output = file_of(options, inputs.value());
  if (atlas::read_atlas(output, inputs.value().car).has_value()) {
    app::print("{} is there and right for this car\n", output.string());
    return success;
  }
  if (const auto problem = long_work::why_outputs_unwritable({output})) {
    return refused(*problem);
  }
  const auto atlas = make_atlas(inputs.value(), output, options.threads);
  if (!atlas.has_value()) {
    return refused(atlas.error());
  }
  if (!atlas.value()) {
    return was_interrupted;
  }
  std::error_code unknown;
  app::print("{}: {} points, {:.1f} MB\n", output.string(), atlas.value()->nodes().size(),
             1e-6 * static_cast<double>(fs::file_size(output, unknown)));
  return success;
}

/// One file for a vehicle: the car's numbers, the harm model and the atlas.
int package(const AtlasOptions& options, const std::string& package_file) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const std::string& name = inputs.value().car_name;
  const auto bytes = vehicle_study::package_of(
      {.car_name = name,
       .car = &inputs.value().car,
       .harm = &inputs.value().harm,
       .atlas = file_of(options, inputs.value()),
       .remedy = " (`saca atlas build --car " + options.car + "` makes it)"});
  if (!bytes.has_value()) {
    return refused(bytes.error());
  }
  const fs::path output =
      package_file.empty() ? fs::path(name + ".vehicle") : fs::path(package_file);
  if (const auto problem = long_work::write_output(output, bytes.value())) {
    return refused(*problem);
  }
  app::print("{}: {}, {:.1f} MB\n", output.string(), name,
             1e-6 * static_cast<double>(bytes.value().size()));
  return success;
}

int tell(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const fs::path file = file_of(options, inputs.value());
  const auto info = atlas::read_atlas_info(file);
  if (!info.has_value()) {
    return refused(info.error());
  }
  const auto atlas = atlas::read_atlas(file, inputs.value().car);
  const vehicle_study::AtlasFile found{
      .file = file.string(),
      .car = inputs.value().car_name,
      .info = info.value(),
      .problem = atlas.has_value() ? std::nullopt : std::optional(atlas.error().message)};
  if (options.as_json) {
    app::print_json(vehicle_study::json_of(found));
  } else {
    app::print("{}", vehicle_study::text_of(found));
  }
  return found.problem ? bad_input : success;
}

/// The families that an atlas is checked over, with their seeds.
Result<std::vector<vehicle_study::SeededFamily>> read_families(const AtlasOptions& options,
                                                               const Places& places) {
  const auto splits = read_splits(places);
  if (!splits.has_value()) {
    return splits.error();
  }
  if (const auto problem = vehicle_study::why_not_seed(splits.value(), options.seed)) {
    return *problem;
  }
  std::vector<vehicle_study::SeededFamily> families;
  for (const char* const name : vehicle_study::atlas_check_families) {
    auto family = read_family(places, name);
    if (!family.has_value()) {
      return family.error();
    }
    auto one = vehicle_study::seeded(std::move(family).value(), name, splits.value(), options.seed);
    if (!one.has_value()) {
      return one.error();
    }
    families.push_back(std::move(one).value());
  }
  return families;
}

/// The atlas beside full physics, over encounters of the families that may be trained on.
int check(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto atlas = atlas::read_atlas(file_of(options, inputs.value()), inputs.value().car);
  if (!atlas.has_value()) {
    return refused(atlas.error());
  }
  auto families = read_families(options, inputs.value().places);
  if (!families.has_value()) {
    return refused(families.error());
  }
  const auto figures =
      vehicle_study::check_atlas({std::move(families).value(), options.scenes, options.threads},
                                 atlas.value(), inputs.value().car, inputs.value().harm);
  if (!figures) {
    complain("interrupted; nothing was counted");
    return was_interrupted;
  }
  if (options.as_json) {
    app::print_json(vehicle_study::json_of(*figures));
  } else {
    app::print("{}", vehicle_study::text_of(*figures));
  }
  return success;
}

constexpr const char* usual_file = "Default: where saca run looks for it";

void add_common(CLI::App& command, AtlasOptions& options) {
  command.add_option("--car", options.car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
}

}  // namespace

void add_atlas(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("atlas", "The ego's futures under all eight policies, driven beforehand");
  command->require_subcommand(1);
  const auto options = std::make_shared<AtlasOptions>();

  CLI::App* const make = command->add_subcommand(
      "build", "Drive them with full physics and keep them in a file; can be interrupted");
  add_common(*make, *options);
  make->add_option("--output", options->file, usual_file);
  add_threads(*make, options->threads);
  make->callback([options, &exit_code] { exit_code = build(*options); });

  CLI::App* const carried = command->add_subcommand(
      "package", "Car, tuning, harm model and atlas as one file, which a vehicle reads");
  carried->add_option("FILE", options->file, usual_file);
  add_common(*carried, *options);
  const auto package_file = std::make_shared<std::string>();
  carried->add_option("--output", *package_file, "Default: CAR.vehicle");
  carried->callback([=, &exit_code] { exit_code = package(*options, *package_file); });

  CLI::App* const info =
      command->add_subcommand("info", "What a file holds, and whether it can be used");
  info->add_option("FILE", options->file, usual_file);
  add_common(*info, *options);
  info->add_flag("--json", options->as_json, "For programs");
  info->callback([options, &exit_code] { exit_code = tell(*options); });

  CLI::App* const compare =
      command->add_subcommand("check", "Beside full physics, over encounters of the families");
  compare->add_option("FILE", options->file, usual_file);
  add_common(*compare, *options);
  compare->add_option("--scenes", options->scenes, "Encounters")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  compare->add_option("--seed", options->seed, "Of the samples; default: calibration's");
  add_threads(*compare, options->threads);
  compare->add_flag("--json", options->as_json, "For programs");
  compare->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace saca::app
