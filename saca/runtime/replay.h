#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "saca/runtime/planes.h"
#include "saca/runtime/tape.h"
#include "saca/thinking/intent/model.h"

namespace saca::runtime {

/// How many results of one kind stand on a tape, and how many of them came back to the last bit.
struct Reproduction {
  std::size_t recorded = 0;
  std::size_t same = 0;
};

/// Where what was worked out again first differs from what was recorded.
struct Difference {
  std::uint64_t scene = 0;  ///< number of the step
  double time = 0.0;        ///< of its scene [s]
  std::string what;         ///< "verdict.plans[3].harm": which result, and what of it
  std::string recorded;     ///< as JSON
  std::string got;          ///< likewise
};

/// What came of a replay.
struct Replay {
  Reproduction beliefs;                   ///< of all road users of one scene
  Reproduction verdicts;                  ///< handed over to the reflex plane
  Reproduction answers;                   ///< of the reflex plane: plan, threat, trigger
  Reproduction decisions;                 ///< at triggers
  Reproduction switches;                  ///< from one plan to another
  std::size_t beliefs_not_compared = 0;   ///< the tape does not reach back to where they come from
  std::size_t verdicts_not_compared = 0;  ///< the scene that was judged is not on the tape
  std::optional<Difference> first;        ///< nullopt: everything is the same
};

/// Works out again what stands on a tape: a fresh observer looks at its scenes, a fresh forecaster
/// judges those that were judged, and a fresh reflex plane is given, in each step, what it was
/// given then: plans and verdicts as recorded, so that each result is judged by itself. What the
/// thinking plane made of memory and model is taken from the tape.
///
/// @param setup      as recorded: thresholds, guard and forced plan count, and what is forecast
/// with
/// @param num_draws  of a verdict, >= 1
[[nodiscard]] Replay replay(const TapeContent& tape, const PlanesSetup& setup,
                            const intent::Model& intent, std::size_t num_draws);

}  // namespace saca::runtime
