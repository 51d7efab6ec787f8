#pragma once

#include "saca/runtime/replay.h"
#include "saca/runtime/tape_json.h"

namespace saca::runs {

/// A tape of three steps, and what came of replaying it; all is the same.
inline runtime::TapeFile small_tape() {
  runtime::TapeFile tape;
  tape.header.scenario = "one_way";
  tape.header.car = "compact";
  tape.content.steps.resize(3);
  return tape;
}
inline runtime::Replay small_replay() {
  return {.beliefs = {.recorded = 3, .same = 3},
          .verdicts = {.recorded = 2, .same = 2},
          .answers = {.recorded = 3, .same = 3},
          .decisions = {.recorded = 1, .same = 1},
          .switches = {.recorded = 0, .same = 0},
          .first = std::nullopt};
}

/// What was worked out otherwise.
inline runtime::Difference small_difference() {
  return {
      .scene = 2, .time = 0.25, .what = "verdict.plans[3].harm", .recorded = "0.5", .got = "null"};
}

}  // namespace saca::runs
