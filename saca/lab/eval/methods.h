#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "saca/lab/encounter/method.h"
#include "saca/lab/eval/imitator.h"
#include "saca/lab/eval/yardstick.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/memory/experience.h"

namespace saca::eval {

/// What a method leaves out or asks, so that without it there is no such row.
enum class Needs : std::uint8_t { nothing, memory, model, untuned, danger, imitator };

/// One row of a table: something that decides.
struct MethodInfo {
  std::string_view name;     ///< as commands and files have it
  std::string_view title;    ///< for readers
  std::string_view what;     ///< one sentence: how it decides
  bool knows_truth = false;  ///< a yardstick: it looks at what nobody on a road can know
  Needs needs = Needs::nothing;
};

/// All that there are, in the order of tables.
[[nodiscard]] std::span<const MethodInfo> methods();
/// nullptr: there is none of that name.
[[nodiscard]] const MethodInfo* find_method(std::string_view name);

/// The setup for the methods of one encounter, one after the other: verdicts that several would
/// work out alike are worked out once (arbitration::memoised).
[[nodiscard]] runtime::PlanesSetup with_shared_verdicts(runtime::PlanesSetup saca);

/// What methods are made with, for one encounter. What it points to outlives them.
struct MethodTools {
  runtime::PlanesSetup saca;       ///< of SACA, with its memory and model, which are only asked;
                                   ///< forecasts and thresholds are everybody's
  Hindsight* hindsight = nullptr;  ///< of this encounter
  const intent::Model* intent = nullptr;
  const learned_danger::Network* danger = nullptr;   ///< V_h learnt of the car; for who needs it
  const memory::Experience* experience = nullptr;    ///< of the memory; for who needs it
  const Imitators* imitators = nullptr;              ///< with those of who needs one
  language_model::LanguageModel* untuned = nullptr;  ///< in place of SACA's model; for who needs it
  std::uint64_t seed = 0;  ///< of who chooses at random, and of this encounter
};

/// @param name  of `methods()`
/// @throws ContractViolation  if what it needs is not there
[[nodiscard]] std::unique_ptr<encounter::Method> make_method(std::string_view name,
                                                             const MethodTools& tools);

}  // namespace saca::eval
