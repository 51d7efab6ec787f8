#include "saca/lab/danger_study/danger_model.h"

#include <fmt/core.h>

#include <memory>
#include <string>
#include <utility>

#include "saca/lab/danger_study/weights.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/reach_study/needed_tables.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::danger_study {
namespace {

danger::DangerModel model_of(const DangerSources& sources, std::vector<danger::DangerTable> tables,
                             danger::LearnedValue learned) {
  const manoeuvre::Car& car = sources.car.car;
  return {danger::avoidance_of(car, reach_study::table_grip), manoeuvre::footprint(car),
          std::move(tables), std::move(learned)};
}

}  // namespace

Result<danger::LearnedValue> learned_value_of(const DangerSources& sources) {
  const std::string file = sources.weights.string();
  if (!std::filesystem::exists(sources.weights)) {
    return danger::LearnedValue();
  }
  auto network = read_network(sources.weights);
  if (!network.has_value()) {
    return network.error();
  }
  const auto& words = network.value().words();
  const auto vehicle = words.find("vehicle");
  if (vehicle == words.end() || vehicle->second != learned_danger::vehicle_word(sources.car.car)) {
    sources.tables.notice(
        fmt::format("{}: learnt of another {} than that of today; its risks are by a few "
                    "evasions (tools/danger.sh learns V_h anew)",
                    file, sources.car.name));
    return danger::LearnedValue();
  }
  const auto margins = learned_danger::Margins::from(words, file);
  if (!margins.has_value()) {
    return margins.error();
  }
  if (!margins.value()) {
    return Error{Error::Code::malformed, file + ": want margins (`saca danger margins`), got none"};
  }
  return learned_danger::learned_value(
      std::make_shared<const learned_danger::Network>(std::move(network).value()), *margins.value(),
      sources.car.car);
}

Result<danger::DangerModel> model_by_tables(const DangerSources& sources,
                                            const std::vector<danger::DangerCase>& cases) {
  auto tables = reach_study::ready_tables(cases, sources.tables);
  return tables.has_value() ? model_of(sources, std::move(tables).value(), {})
                            : Result<danger::DangerModel>(tables.error());
}

Result<danger::DangerModel> model_of_drawn(const DangerSources& sources, TableUse tables) {
  constexpr double most_grip = 0.9;
  const auto box = [](double length, double width) {
    return world::Footprint{.length = length, .width = width};
  };
  std::vector<danger::ObstacleKind> bodies;  // with the speeds that tables reach
  if (tables == TableUse::solved) {
    bodies = {{box(0.5, 0.5), 4.0},
              {box(4.5, 1.8), 30.0},
              {box(9.0, 2.5), 25.0},
              {box(16.5, 2.55), 25.0}};
  }
  const auto cases = reach_study::tables_for(sources.car, most_grip, bodies);
  return cases.has_value() ? model_by_tables(sources, cases.value())
                           : Result<danger::DangerModel>(cases.error());
}

Result<std::optional<danger::DangerModel>> usual_model(const DangerSources& sources,
                                                       const scenario::Scenario& scenario,
                                                       TableUse tables) {
  using Model = std::optional<danger::DangerModel>;
  auto learned = learned_value_of(sources);
  if (!learned.has_value()) {
    return learned.error();
  }
  if (tables == TableUse::none) {
    return learned.value() ? Model(model_of(sources, {}, std::move(learned).value())) : Model();
  }
  const auto needed = reach_study::tables_for(sources.car, scenario);
  if (!needed.has_value()) {
    return needed.error();
  }
  auto ready = reach_study::ready_tables(needed.value(), sources.tables);
  return ready.has_value()
             ? Model(model_of(sources, std::move(ready).value(), std::move(learned).value()))
             : Result<Model>(ready.error());
}

}  // namespace saca::danger_study
