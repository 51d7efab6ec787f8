#include "apps/saca/options.h"
#include "saca/lab/vehicle_study/drift_table.h"
#include "saca/lab/vehicle_study/physics_report.h"

namespace saca::app {
namespace {

struct PhysicsOptions {
  int drift_draws = 0;
  std::vector<std::string> cars{"compact_rwd_ev", "small_fwd_car", "midsize_suv", "delivery_van"};
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

void tell_physics(const PhysicsOptions& options) {
  const auto usual = need(installation::read_named_car(here(), "compact_rwd_ev"));
  const auto table = verification::physics_figures(usual.car);
  const auto meanwhile = [&](const std::string& text) { tell_meanwhile(options.as_json, text); };
  meanwhile(vehicle_study::text_of(table));
  nlohmann::json figures = vehicle_study::json_of(table);
  if (options.drift_draws > 0) {
    need(vehicle_study::add_drift_table(here(), options.cars,
                                        {options.drift_draws, options.seed, options.threads},
                                        figures, meanwhile));
  }
  tell(options.as_json, figures, "");
}

}  // namespace

void add_physics(CLI::App& line) {
  const auto [command, options] = add_command<PhysicsOptions>(
      line, "physics", "The car's stops, lane changes and drifts beside an independent reference",
      tell_physics);
  CLI::Option* const draws =
      add(command, "--drift-draws", options.drift_draws,
          "Also a table of T-drifts over car, speed and grip, each so many times",
          CLI::Range(0, 1'000'000));
  add(command, "--car", options.cars, "Cars of that table: files, or names of shipped ones")
      ->needs(draws);
  add(command, "--seed", options.seed, "Of the draws");
  add_threads(command, options.threads);
  add_json(command, options.as_json);
}

}  // namespace saca::app
