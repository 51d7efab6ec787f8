#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "saca/manoeuvre/plan.h"
#include "saca/world/scene.h"

namespace saca::memory {

using CaseId = std::int64_t;

/// What memory keeps of an encounter: the scene at the trigger, what was done, what came of it.
struct Case {
  CaseId id = 0;  ///< given by the store
  world::Scene scene;
  manoeuvre::Plan plan;                                 ///< carried out
  manoeuvre::PolicyId best = manoeuvre::PolicyId::aeb;  ///< in hindsight
  double harm = 0.0;                                    ///< of what was carried out
  double best_harm = 0.0;                               ///< of the best in hindsight
  double collision_loss = 0.0;                          ///< of what was carried out
  std::string review;  ///< one line on what happened against what was forecast
  std::string source;  ///< scenario and run it came from
};

}  // namespace saca::memory
