#include "apps/saca/options.h"
#include "saca/lab/vehicle_study/atlas_check_run.h"
#include "saca/lab/vehicle_study/atlas_report.h"
#include "saca/lab/vehicle_study/kept_atlas.h"
#include "saca/lab/vehicle_study/package_build.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::app {
namespace {

using installation::Inputs;

struct AtlasOptions {
  std::string car = "compact_rwd_ev";
  std::string file;
  std::string package;
  int threads = usual_threads();
  int scenes = 1'000;
  std::optional<std::uint64_t> seed;  // of the samples; none: the calibration split's
  bool as_json = false;
};

/// The file that was named, else the one that `saca run` looks for.
fs::path file_of(const AtlasOptions& options, const Inputs& inputs) {
  return options.file.empty() ? vehicle_study::atlas_place(here(), inputs.car_name)
                              : fs::path(options.file);
}

double megabytes(std::size_t bytes) {
  return 1e-6 * static_cast<double>(bytes);
}

void build_atlas(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  const fs::path output = file_of(options, inputs);
  need_distinct({{"--output", output}}, {car_file(options.car)});
  if (atlas::read_atlas(output, inputs.car).has_value()) {
    app::print("{} is there and right for this car\n", output.string());
    return;
  }
  need_writable({output});
  const auto atlas = need_whole(
      vehicle_study::build_atlas_file(inputs.car, output,
                                      {.threads = options.threads, .display = here().display}),
      fmt::format(
          "interrupted; {} was not written. The same command goes on where this one stopped.",
          output.string()));
  std::error_code unknown;
  app::print("{}: {} points, {:.1f} MB\n", output.string(), atlas.nodes().size(),
             megabytes(fs::file_size(output, unknown)));
}

/// One file for a vehicle: the car's numbers, the harm model and the atlas.
void package_atlas(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  const fs::path atlas = file_of(options, inputs);
  const std::string output =
      options.package.empty() ? inputs.car_name + ".vehicle" : options.package;
  need_distinct({{"--output", output}}, {car_file(options.car), {"the atlas", atlas}});
  const std::string bytes = need(vehicle_study::package_of(
      {.car_name = inputs.car_name,
       .car = &inputs.car,
       .harm = &inputs.harm,
       .atlas = atlas,
       .remedy = " (`saca atlas build --car " + options.car + "` makes it)"}));
  write(output, bytes);
  app::print("{}: {}, {:.1f} MB\n", output, inputs.car_name, megabytes(bytes.size()));
}

ExitCode tell_atlas(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  const fs::path file = file_of(options, inputs);
  const auto info = need(atlas::read_atlas_info(file));
  const auto atlas = atlas::read_atlas(file, inputs.car);
  const vehicle_study::AtlasFile found{
      .file = file.string(),
      .car = inputs.car_name,
      .info = info,
      .problem = atlas.has_value() ? std::nullopt : std::optional(atlas.error().message)};
  tell(options.as_json, vehicle_study::json_of(found), vehicle_study::text_of(found));
  return found.problem ? bad_input : success;
}

/// The atlas beside full physics, over encounters of the families that may be trained on.
void check_atlas(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  const auto atlas = need(atlas::read_atlas(file_of(options, inputs), inputs.car));
  const auto figures = need_whole(Result(vehicle_study::check_atlas(
                                      {need(vehicle_study::families_to_check(here(), options.seed)),
                                       options.scenes, options.threads},
                                      atlas, inputs.car, inputs.harm)),
                                  "interrupted; nothing was counted");
  tell(options.as_json, vehicle_study::json_of(figures), vehicle_study::text_of(figures));
}

constexpr const char* usual_file = "Default: where saca run looks for it";

}  // namespace

void add_atlas(CLI::App& line) {
  CLI::App& atlas =
      add_group(line, "atlas", "The ego's futures under all eight policies, driven beforehand");

  const auto build = add_command<AtlasOptions>(
      atlas, "build", "Drive them with full physics and keep them in a file; can be interrupted",
      build_atlas);
  add_car(build.line, build.options.car);
  add(build.line, "--output", build.options.file, usual_file);
  add_threads(build.line, build.options.threads);

  const auto package = add_command<AtlasOptions>(
      atlas, "package", "Car, tuning, harm model and atlas as one file, which a vehicle reads",
      package_atlas);
  add(package.line, "FILE", package.options.file, usual_file);
  add_car(package.line, package.options.car);
  add(package.line, "--output", package.options.package, "Default: CAR.vehicle");

  const auto info = add_command<AtlasOptions>(
      atlas, "info", "What a file holds, and whether it can be used", tell_atlas);
  add(info.line, "FILE", info.options.file, usual_file);
  add_car(info.line, info.options.car);
  add_json(info.line, info.options.as_json);

  const auto [check, options] = add_command<AtlasOptions>(
      atlas, "check", "Beside full physics, over encounters of the families", check_atlas);
  add(check, "FILE", options.file, usual_file);
  add_car(check, options.car);
  add(check, "--scenes", options.scenes, "Encounters", CLI::Range(1, 10'000'000));
  add(check, "--seed", options.seed, "Of the samples; default: calibration's");
  add_threads(check, options.threads);
  add_json(check, options.as_json);
}

}  // namespace saca::app
