#include "apps/saca/inputs.h"

#include <utility>

#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/runtime/tape_header.h"

namespace saca::app {

namespace fs = std::filesystem;

Result<Inputs> read_inputs(const std::string& car) {
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  const auto found = find_car(places.value(), car);
  if (!found.has_value()) {
    return found.error();
  }
  const fs::path& file = found.value();
  const auto read = prepare::read_car(file);
  if (!read.has_value()) {
    return read.error();
  }
  const auto harm = prepare::read_harm(places.value().root / "data" / "harm.toml");
  if (!harm.has_value()) {
    return harm.error();
  }
  auto intent = intent::read_model(places.value().root / "models" / "intent" / "model.safetensors");
  if (!intent.has_value()) {
    return intent.error();
  }
  const auto cues = intent::load_cue_law(places.value().root / "data" / "cues.toml");
  if (!cues.has_value()) {
    return cues.error();
  }
  return Inputs{.places = places.value(),
                .car_name = file.stem().string(),
                .car = read.value(),
                .harm = harm.value(),
                .intent = std::move(intent).value(),
                .cues = cues.value()};
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
  const auto found = find_scenario(places.value(), scenario);
  if (!found.has_value()) {
    return found.error();
  }
  const fs::path& file = found.value();
  const auto first = scenario::load_scenario(file);
  if (!first.has_value()) {
    return first.error();
  }
  if (const auto car = find_car(places.value(), first.value().car); !car.has_value()) {
    return Error{car.error().code, file.string() + ": car: " + car.error().message};
  }
  const auto inputs = read_inputs(first.value().car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  // Again, now that the body of its car is known.
  const auto read = scenario::load_scenario(file, manoeuvre::footprint(inputs.value().car));
  if (!read.has_value()) {
    return read.error();
  }
  ScenarioInputs all;
  static_cast<Inputs&>(all) = inputs.value();
  all.scenario = read.value();
  return all;
}

Result<std::string> scenario_digest(const Places& places, const std::string& scenario) {
  const auto file = find_scenario(places, scenario);
  if (!file.has_value()) {
    return file.error();
  }
  Fnv hash;
  if (auto problem = read_file(file.value(), [&](std::string_view bytes) { hash.add(bytes); })) {
    return *std::move(problem);
  }
  return runtime::digest_text(hash);
}

Result<families::Family> read_family(const Places& places, const std::string& name) {
  const auto file = find_family(places, name);
  return file.has_value()
             ? families::load_family(file.value().parent_path(), file.value().stem().string())
             : file.error();
}

Result<families::Splits> read_splits(const Places& places) {
  return families::load_splits(places.root / "scenarios" / "splits.toml");
}

}  // namespace saca::app
