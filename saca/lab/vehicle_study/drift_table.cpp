#include "saca/lab/vehicle_study/drift_table.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "saca/base/core/percentile.h"
#include "saca/base/world/scene.h"
#include "saca/lab/installation/inputs.h"
#include "saca/lab/tune/draws.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::vehicle_study {
namespace {

using nlohmann::json;

DriftSpread drift_spread(const std::vector<double>& values) {
  return {percentile(values, 0.05), percentile(values, 0.5), percentile(values, 0.95)};
}

std::optional<DriftEndings> drift_endings(const manoeuvre::Car& car, double speed, double grip,
                                          const DriftDraws& draws) {
  const manoeuvre::Plan plan{manoeuvre::PolicyId::t_drift_left, std::nullopt};
  constexpr double horizon = 40.0;
  world::Scene scene;
  scene.ego.v_B = {speed, 0.0};
  scene.grip = grip;
  if (manoeuvre::refusal(car, plan, scene)) {
    return std::nullopt;
  }
  const auto endings = tune::draw_endings(car, plan, scene,
                                          {.grip = grip,
                                           .horizon = horizon,
                                           .count = draws.count,
                                           .seed = draws.seed,
                                           .threads = draws.threads});
  std::vector<double> forward;
  std::vector<double> sideways;
  for (const tune::Ending& ending : endings) {
    forward.push_back(ending.X_WB.p.x);
    sideways.push_back(ending.X_WB.p.y);
  }
  return DriftEndings{proportion(tune::num_across(endings, plan, scene.road), draws.count),
                      drift_spread(forward), drift_spread(sideways)};
}

}  // namespace

void table_drifts(const std::string& name, const manoeuvre::Car& car, const DriftDraws& draws,
                  const std::function<void(const DriftCell& cell)>& done) {
  for (const double grip : {0.2, 0.3, 0.5, 0.7, 0.9, 1.0}) {
    for (const double speed : {10.0, 12.0, 14.0, 16.0, 20.0, 25.0}) {
      done({name, speed, grip, drift_endings(car, speed, grip, draws)});
    }
  }
}

void add_to(json& figures, const DriftCell& cell) {
  const std::string key = fmt::format(".{}.v{:g}.mu{:.1f}", cell.car, cell.speed, cell.grip);
  if (!cell.endings) {
    figures["t_drift.refused" + key] = true;
    return;
  }
  const Proportion& across = cell.endings->across;
  figures["t_drift.within_10_deg.share" + key] = across.share;
  figures["t_drift.within_10_deg.low" + key] = across.low;
  figures["t_drift.within_10_deg.high" + key] = across.high;
  for (const auto& [way, spread] :
       {std::pair{"forward_m", cell.endings->forward}, {"sideways_m", cell.endings->sideways}}) {
    figures[fmt::format("t_drift.{}.p05{}", way, key)] = spread.p05;
    figures[fmt::format("t_drift.{}.p50{}", way, key)] = spread.p50;
    figures[fmt::format("t_drift.{}.p95{}", way, key)] = spread.p95;
  }
}

std::string drift_table_head(const DriftDraws& draws) {
  return fmt::format(
      "\nT-drift, {} draws each; forward and sideways: p05 p50 p95\n{:16} {:>5} {:>5}   "
      "{:23}   {:23}   {}\n",
      draws.count, "car", "m/s", "grip", "within 10 deg, %", "forward, m", "sideways, m");
}

std::string text_of(const DriftCell& cell) {
  const std::string head = fmt::format("{:16} {:5g} {:5.1f}   ", cell.car, cell.speed, cell.grip);
  if (!cell.endings) {
    return head + "refused\n";
  }
  const auto& [across, forward, sideways] = *cell.endings;
  return head + fmt::format(
                    "{:5.1f} ({:5.1f} to {:5.1f})   {:7.2f} {:7.2f} {:7.2f}   "
                    "{:6.2f} {:6.2f} {:6.2f}\n",
                    100.0 * across.share, 100.0 * across.low, 100.0 * across.high, forward.p05,
                    forward.p50, forward.p95, sideways.p05, sideways.p50, sideways.p95);
}

std::optional<Error> add_drift_table(const installation::Installation& here,
                                     const std::vector<std::string>& cars, const DriftDraws& draws,
                                     nlohmann::json& figures,
                                     const std::function<void(const std::string& lines)>& tell) {
  tell(drift_table_head(draws));
  for (const std::string& name : cars) {
    const auto car = installation::read_named_car(here, name);
    if (!car.has_value()) {
      return car.error();
    }
    table_drifts(car.value().name, car.value().car, draws, [&](const DriftCell& cell) {
      add_to(figures, cell);
      tell(text_of(cell));
    });
  }
  figures["t_drift.n"] = draws.count;
  figures["t_drift.seed"] = draws.seed;
  return std::nullopt;
}

}  // namespace saca::vehicle_study
