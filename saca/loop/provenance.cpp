#include "saca/loop/provenance.h"

#include <nlohmann/json.hpp>

#include "saca/core/fnv.h"
#include "saca/runtime/tape_header.h"

namespace saca::loop {

using nlohmann::json;

json made_json(const Setup& setup, const Provenance& provenance) {
  const runtime::TapeHeader digests =
      runtime::tape_header({.forecast = {setup.car, setup.harm, setup.atlas}}, *setup.intent);
  const auto input = [](const char* what, const std::string& name, const json& digest) {
    return json{{"what", what}, {"name", name}, {"digest", digest}};
  };
  const json atlas = digests.atlas ? json(*digests.atlas) : json(nullptr);
  return {{"program", provenance.program},
          {"commit", provenance.commit},
          {"level", digests.level},
          {"date", provenance.date},
          {"command", provenance.command},
          {"seed", setup.seed ? json(*setup.seed) : json(nullptr)},
          {"inputs",
           {input("scenario", provenance.file, provenance.digest),
            input("car", setup.scenario->car, digests.car_digest),
            input("harm", "data/harm.toml", digests.harm_digest),
            input("intentions", "models/intent/model.safetensors", digests.intent_digest),
            input("atlas", setup.scenario->car, atlas)}}};
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

}  // namespace saca::loop
