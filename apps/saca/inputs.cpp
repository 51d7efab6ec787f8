#include "apps/saca/inputs.h"

#include <utility>

#include "saca/core/file.h"
#include "saca/manoeuvre/ego.h"

namespace saca::app {

namespace fs = std::filesystem;

namespace {

Error no_scenario(const Places& places, const std::string& wanted) {
  std::string names;
  for (const fs::path& file : shipped_scenarios(places)) {
    if (const std::string name = file.stem().string(); name.starts_with(wanted)) {
      names += (names.empty() ? "" : ", ") + name;
    }
  }
  return Error{Error::Code::unreadable,
               wanted + ": want a scenario's file or the name of a shipped one, " +
                   (names.empty() ? "as `saca scenarios` lists them" : "e.g. " + names)};
}

}  // namespace

Result<Inputs> read_inputs(const std::string& car) {
  auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  const fs::path file = find_car(places.value(), car);
  auto read = manoeuvre::read_car(file);
  if (!read.has_value()) {
    return read.error();
  }
  auto harm = outcome::read_harm(places.value().root / "data" / "harm.toml");
  if (!harm.has_value()) {
    return harm.error();
  }
  auto intent = intent::read_model(places.value().root / "models" / "intent" / "model.safetensors");
  if (!intent.has_value()) {
    return intent.error();
  }
  return Inputs{.places = places.value(),
                .car_name = file.stem().string(),
                .car = read.value(),
                .harm = harm.value(),
                .intent = std::move(intent).value()};
}

Result<runtime::ThinkingCosts> read_costs(const Places& places) {
  const fs::path file = places.root / "data" / "thinking_costs.toml";
  const auto text = read_file(file);
  if (!text.has_value()) {
    return text.error();
  }
  return runtime::read_thinking_costs(text.value(), file.string());
}

Result<ScenarioInputs> read_scenario_inputs(const std::string& scenario) {
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  const fs::path file = find_scenario(places.value(), scenario);
  std::error_code problem;
  if (!fs::exists(file, problem)) {
    return no_scenario(places.value(), scenario);
  }
  const auto first = sim::load_scenario(file);
  if (!first.has_value()) {
    return first.error();
  }
  auto inputs = read_inputs(first.value().car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  // Again, now that the body of its car is known.
  auto read = sim::load_scenario(file, manoeuvre::footprint(inputs.value().car));
  if (!read.has_value()) {
    return read.error();
  }
  ScenarioInputs all;
  static_cast<Inputs&>(all) = inputs.value();
  all.scenario = read.value();
  return all;
}

Result<sim::Family> read_family(const Places& places, const std::string& name) {
  const fs::path own = name;
  if (own.extension() == ".toml") {
    return sim::load_family(own.parent_path(), own.stem().string());
  }
  return sim::load_family(places.root / "scenarios" / "families", name);
}

Result<sim::Splits> read_splits(const Places& places) {
  return sim::load_splits(places.root / "scenarios" / "splits.toml");
}

}  // namespace saca::app
