#include "saca/lab/encounter/provenance.h"

#include <nlohmann/json.hpp>

#include "saca/base/core/fnv.h"
#include "saca/base/core/simd_level.h"
#include "saca/runtime/tape_header.h"

namespace saca::encounter {

using nlohmann::json;

namespace {

json input_json(const char* what, const std::string& name, const json& digest) {
  return {{"what", what}, {"name", name}, {"digest", digest}};
}

}  // namespace

json inputs_json(const preview::ForecastTools& tools, const intent::Model& intent,
                 const std::string& car) {
  const runtime::TapeHeader digests = runtime::tape_header({.forecast = tools}, intent);
  const json atlas = digests.atlas ? json(*digests.atlas) : json(nullptr);
  json inputs = {input_json("car", car, digests.car_digest),
                 input_json("harm", "data/harm.toml", digests.harm_digest),
                 input_json("intentions", "models/intent/model.safetensors", digests.intent_digest),
                 input_json("atlas", car, atlas)};
  if (digests.cues) {
    inputs.push_back(input_json("cues", "data/cues.toml", *digests.cues));
  }
  return inputs;
}

json made_json(const Setup& setup, const Provenance& provenance) {
  json inputs =
      inputs_json({.car = setup.car, .harm = setup.harm, .atlas = setup.atlas, .cues = setup.cues},
                  *setup.intent, setup.scenario->car);
  inputs.insert(inputs.begin(), input_json("scenario", provenance.file, provenance.digest));
  return {{"program", provenance.program},
          {"commit", provenance.commit},
          {"level", name(best_level())},
          {"date", provenance.date},
          {"command", provenance.command},
          {"seed", setup.seed ? json(*setup.seed) : json(nullptr)},
          {"inputs", inputs}};
}

std::string content_digest(const json& record) {
  Fnv hash;
  for (const auto& [key, value] : record.items()) {
    if (key != "made" && key != "timing") {
      hash.add(key);
      hash.add(value.dump(-1, ' ', false, json::error_handler_t::replace));
    }
  }
  return runtime::digest_text(hash);
}

}  // namespace saca::encounter
