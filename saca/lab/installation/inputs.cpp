#include "saca/lab/installation/inputs.h"

#include <filesystem>
#include <utility>

#include "saca/base/core/file.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::installation {

namespace fs = std::filesystem;

Result<prepare::NamedCar> read_named_car(const Installation& here, const std::string& car) {
  const auto file = find_car(here, car);
  if (!file.has_value()) {
    return file.error();
  }
  auto read = prepare::read_car(file.value());
  if (!read.has_value()) {
    return read.error();
  }
  return prepare::NamedCar{file.value().stem().string(), std::move(read).value()};
}

Result<collision::HarmModel> read_harm(const Installation& here) {
  return prepare::read_harm(here.root / "data" / "harm.toml");
}

Result<Inputs> read_inputs(const Installation& here, const std::string& car) {
  auto named = read_named_car(here, car);
  if (!named.has_value()) {
    return named.error();
  }
  const auto harm = read_harm(here);
  if (!harm.has_value()) {
    return harm.error();
  }
  auto intent = intent::read_model(here.root / "models" / "intent" / "model.safetensors");
  if (!intent.has_value()) {
    return intent.error();
  }
  const auto cues = intent::load_cue_law(here.root / "data" / "cues.toml");
  if (!cues.has_value()) {
    return cues.error();
  }
  prepare::NamedCar of = std::move(named).value();
  return Inputs{.car_name = std::move(of.name),
                .car = of.car,
                .harm = harm.value(),
                .intent = std::move(intent).value(),
                .cues = cues.value()};
}

Result<ScenarioInputs> read_scenario_inputs(const Installation& here, const std::string& scenario) {
  const auto found = find_scenario(here, scenario);
  if (!found.has_value()) {
    return found.error();
  }
  const fs::path& file = found.value();
  const auto first = scenario::load_scenario(file);
  if (!first.has_value()) {
    return first.error();
  }
  if (const auto car = find_car(here, first.value().car); !car.has_value()) {
    return Error{car.error().code, file.string() + ": car: " + car.error().message};
  }
  auto inputs = read_inputs(here, first.value().car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  ScenarioInputs all{std::move(inputs).value(), {}};
  // Again, now that the body of its car is known.
  auto read = scenario::load_scenario(file, manoeuvre::footprint(all.car));
  if (!read.has_value()) {
    return read.error();
  }
  all.scenario = std::move(read).value();
  return all;
}

Result<runtime::ThinkingCosts> read_costs(const Installation& here) {
  const fs::path file = here.root / "data" / "thinking_costs.toml";
  const auto text = read_file(file);
  if (!text.has_value()) {
    return text.error();
  }
  return runtime::read_thinking_costs(text.value(), file.string());
}

}  // namespace saca::installation
