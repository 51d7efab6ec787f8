#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/runtime/charged_model.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/intent/model.h"

namespace saca::runtime {

/// Everything besides the steps that what stands on a tape depends on.
struct TapeHeader {
  std::string program;                    ///< version of SACA
  std::string level;                      ///< instruction set of the inner loops
  std::string car;                        ///< its name or file
  std::string car_digest;                 ///< parameters and tuning
  std::string intent_digest;              ///< weights of the model of intentions
  std::string harm_digest;                ///< data/harm.toml
  std::optional<std::string> atlas;       ///< digest; nullopt: none
  std::optional<std::string> cues;        ///< digest of what they stand for; nullopt: nothing
  bool danger = false;                    ///< risks were read from solved tables
  std::string model = "off";              ///< the language model's description
  bool memory = false;                    ///< was there one?
  std::uint64_t num_draws = 0;            ///< of a verdict
  bool guarded = true;                    ///< reflex::Guard::never_worse_than_braking
  std::optional<manoeuvre::Plan> forced;  ///< carried out at the trigger, whatever was thought
  reflex::Thresholds thresholds;
  Pace pace = Pace::lockstep;
  ThinkingCosts costs;
  std::string scenario;               ///< its name; empty: none
  std::optional<std::uint64_t> seed;  ///< of what the scenario leaves to chance
};

/// How a digest stands in a tape.
[[nodiscard]] std::string digest_text(const Fnv& hash);

/// What follows from what the planes and their observer are made of; the program's version, the
/// car's name, scenario and seed are left as they stand in TapeHeader.
[[nodiscard]] TapeHeader tape_header(const PlanesSetup& setup, const intent::Model& intent);

/// The first thing by which `here` would work out something else than what was recorded; nullopt:
/// nothing. Scenario, pace, thinking's costs, model and memory do not count: what they led to
/// stands on the tape.
/// @return  Error::Code::out_of_range, naming the key, what the tape has and what there is here
[[nodiscard]] std::optional<Error> mismatch(const TapeHeader& tape, const TapeHeader& here);

}  // namespace saca::runtime
