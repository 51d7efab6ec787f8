#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/percentile.h"
#include "saca/base/core/proportion.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/tune/draws.h"
#include "saca/lab/verification/physics_figures.h"
#include "saca/onboard/manoeuvre/drive.h"

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

/// The default car's table: ours beside the reference.
void add_figures(const manoeuvre::Car& car, bool quiet, json& figures) {
  int outside = 0;
  for (const verification::Figure& figure : verification::physics_figures(car)) {
    outside += in_band(figure) ? 0 : 1;
    figures[figure.name] = figure.value;
    figures[figure.name + ".low"] = figure.low;
    figures[figure.name + ".high"] = figure.high;
    if (figure.reference) {
      figures[figure.name + ".reference"] = *figure.reference;
    }
    if (!quiet) {
      const std::string reference =
          figure.reference ? fmt::format("{:8.3f}", *figure.reference) : "       -";
      app::print("{:48} {:9.4f}   reference {}   band {:7.3f} to {:7.3f}   {}\n", figure.name,
                 figure.value, reference, figure.low, figure.high,
                 in_band(figure) ? "inside" : "OUTSIDE");
    }
  }
  figures["physics.outside_band"] = outside;
  if (!quiet) {
    app::print("outside their bands: {}\n", outside);
  }
}

/// T-drifts of one car over speed and grip, each many times.
void add_drifts(const std::string& name, const manoeuvre::Car& car, const PhysicsOptions& options,
                json& figures) {
  const manoeuvre::Plan plan{manoeuvre::PolicyId::t_drift_left, std::nullopt};
  constexpr double horizon = 40.0;
  for (const double grip : {0.2, 0.3, 0.5, 0.7, 0.9, 1.0}) {
    for (const double speed : {10.0, 12.0, 14.0, 16.0, 20.0, 25.0}) {
      world::Scene scene;
      scene.ego.v_B = {speed, 0.0};
      scene.grip = grip;
      const std::string key = fmt::format(".{}.v{:g}.mu{:.1f}", name, speed, grip);
      if (manoeuvre::refusal(car, plan, scene)) {
        figures["t_drift.refused" + key] = true;
        if (!options.as_json) {
          app::print("{:16} {:5g} {:5.1f}   refused\n", name, speed, grip);
        }
        continue;
      }
      const auto endings = tune::draw_endings(car, plan, scene, grip, horizon, options.drift_draws,
                                              options.seed, 0, options.threads);
      const Proportion across =
          proportion(tune::num_across(endings, plan, scene.road), options.drift_draws);
      std::vector<double> forward;
      std::vector<double> sideways;
      for (const auto& ending : endings) {
        forward.push_back(ending.X_WB.p.x);
        sideways.push_back(ending.X_WB.p.y);
      }
      figures["t_drift.within_10_deg.share" + key] = across.share;
      figures["t_drift.within_10_deg.low" + key] = across.low;
      figures["t_drift.within_10_deg.high" + key] = across.high;
      for (const auto& [percent, share] : {std::pair{"p05", 0.05}, {"p50", 0.5}, {"p95", 0.95}}) {
        figures[fmt::format("t_drift.forward_m.{}{}", percent, key)] = percentile(forward, share);
        figures[fmt::format("t_drift.sideways_m.{}{}", percent, key)] = percentile(sideways, share);
      }
      if (!options.as_json) {
        app::print(
            "{:16} {:5g} {:5.1f}   {:5.1f} ({:5.1f} to {:5.1f})   {:7.2f} {:7.2f} {:7.2f}   "
            "{:6.2f} {:6.2f} {:6.2f}\n",
            name, speed, grip, 100.0 * across.share, 100.0 * across.low, 100.0 * across.high,
            percentile(forward, 0.05), percentile(forward, 0.5), percentile(forward, 0.95),
            percentile(sideways, 0.05), percentile(sideways, 0.5), percentile(sideways, 0.95));
        std::fflush(stdout);
      }
    }
  }
}

int physics(const PhysicsOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    complain(places.error().message);
    return bad_input;
  }
  const auto usual = find_car(places.value(), "compact_rwd_ev");
  if (!usual.has_value()) {
    return refused(usual.error());
  }
  const auto car = prepare::read_car(usual.value());
  if (!car.has_value()) {
    complain(car.error().message);
    return bad_input;
  }
  json figures;
  add_figures(car.value(), options.as_json, figures);
  if (options.drift_draws > 0 && !options.as_json) {
    app::print(
        "\nT-drift, {} draws each; forward and sideways: p05 p50 p95\n{:16} {:>5} {:>5}   "
        "{:23}   {:23}   {}\n",
        options.drift_draws, "car", "m/s", "grip", "within 10 deg, %", "forward, m", "sideways, m");
  }
  for (const std::string& name :
       options.drift_draws > 0 ? options.cars : decltype(options.cars){}) {
    const auto file = find_car(places.value(), name);
    if (!file.has_value()) {
      return refused(file.error());
    }
    const auto one = prepare::read_car(file.value());
    if (!one.has_value()) {
      complain(one.error().message);
      return bad_input;
    }
    add_drifts(file.value().stem().string(), one.value(), options, figures);
  }
  if (options.as_json) {
    if (options.drift_draws > 0) {
      figures["t_drift.n"] = options.drift_draws;
      figures["t_drift.seed"] = options.seed;
    }
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
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = physics(*options); });
}

}  // namespace saca::app
