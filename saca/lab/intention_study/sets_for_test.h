#pragma once

#include <string>
#include <vector>

#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"

namespace saca::intention_study {

/// A recorded sequence at 10 m/s in the middle of a lane.
/// @param letters  its labels: M, L, R, B, l, r
inline intention_scoring::Sequence recorded_sequence(const std::string& name,
                                                     const std::string& site,
                                                     const std::string& letters) {
  intention_scoring::Sequence sequence = intention_scoring::labelled(letters);
  sequence.name = name;
  sequence.group = name;
  sequence.site = site;
  for (auto& seen : sequence.observations) {
    seen.speed = 10.0;
    seen.offset = seen.lateral_speed = seen.heading = 0.0;
    seen.lane_width = 3.5;
  }
  return sequence;
}

/// Two recorded sequences of two sites, and three simulated ones, one of them to test with.
inline intention_scoring::SequenceSet small_set() {
  const std::string steady(40, 'M');
  const std::string braking = std::string(20, 'M') + std::string(20, 'B');
  intention_scoring::SequenceSet set{
      .sequences = {recorded_sequence("a", "us101", steady),
                    recorded_sequence("b", "lankershim", braking),
                    recorded_sequence("c", "", std::string(20, 'l')),
                    recorded_sequence("d", "", std::string(20, 'r') + steady)},
      .splits = {"part-0", "part-1", "simulated", "test"}};
  set.sequences[2].simulated = set.sequences[3].simulated = true;
  return set;
}

}  // namespace saca::intention_study
