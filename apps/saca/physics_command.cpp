#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/vehicle_study/drift_table.h"
#include "saca/lab/vehicle_study/physics_report.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct PhysicsOptions {
  int drift_draws = 0;
  std::vector<std::string> cars{"compact_rwd_ev", "small_fwd_car", "midsize_suv", "delivery_van"};
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

/// A car that was named, and its file.
struct NamedCar {
  std::string name;
  manoeuvre::Car car;
};

Result<NamedCar> read_named(const Places& places, const std::string& name) {
  const auto file = find_car(places, name);
  if (!file.has_value()) {
    return file.error();
  }
  const auto car = prepare::read_car(file.value());
  if (!car.has_value()) {
    return car.error();
  }
  return NamedCar{file.value().stem().string(), car.value()};
}

/// The table of T-drifts, shown line by line as it grows.
std::optional<Error> add_drifts(const Places& places, const PhysicsOptions& options,
                                json& figures) {
  const vehicle_study::DriftDraws draws{options.drift_draws, options.seed, options.threads};
  if (!options.as_json) {
    app::print("{}", vehicle_study::drift_table_head(draws));
  }
  for (const std::string& name : options.cars) {
    const auto one = read_named(places, name);
    if (!one.has_value()) {
      return one.error();
    }
    vehicle_study::table_drifts(one.value().name, one.value().car, draws,
                                [&](const vehicle_study::DriftCell& cell) {
                                  vehicle_study::add_to(figures, cell);
                                  if (!options.as_json) {
                                    app::print("{}", vehicle_study::text_of(cell));
                                    std::fflush(stdout);
                                  }
                                });
  }
  figures["t_drift.n"] = options.drift_draws;
  figures["t_drift.seed"] = options.seed;
  return std::nullopt;
}

int physics(const PhysicsOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const auto usual = read_named(places.value(), "compact_rwd_ev");
  if (!usual.has_value()) {
    return refused(usual.error());
  }
  const auto table = verification::physics_figures(usual.value().car);
  if (!options.as_json) {
    app::print("{}", vehicle_study::text_of(table));
  }
  json figures = vehicle_study::json_of(table);
  if (options.drift_draws > 0) {
    if (const auto problem = add_drifts(places.value(), options, figures)) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print_json(figures);
  }
  return success;
}

}  // namespace

void add_physics(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "physics", "The car's stops, lane changes and drifts beside an independent reference");
  const auto options = std::make_shared<PhysicsOptions>();
  command
      ->add_option("--drift-draws", options->drift_draws,
                   "Also a table of T-drifts over car, speed and grip, each so many times")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command->add_option("--car", options->cars, "Cars of that table: files, or names of shipped ones")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the draws")->capture_default_str();
  add_threads(*command, options->threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = physics(*options); });
}

}  // namespace saca::app
