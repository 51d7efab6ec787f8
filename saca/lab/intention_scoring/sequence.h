#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "saca/thinking/intent/crf.h"
#include "saca/thinking/intent/features.h"
#include "saca/thinking/intent/intention.h"
#include "saca/thinking/intent/observation.h"

/// What training and judging the model of intentions needs.
namespace saca::intention_scoring {

/// Seconds from one frame of a sequence to the next.
constexpr double frame_step = intent::look_step;

/// The first intentions, which vehicles can have: eq. 5's six.
constexpr std::size_t num_vehicle_classes = intent::num_classes;

/// One road user seen at 10 Hz, with what it truly did.
struct Sequence {
  std::string name;        ///< unique in its set
  std::string site;        ///< where it was recorded
  std::string group;       ///< sequences of one group are never split
  bool simulated = false;  ///< else recorded
  std::vector<intent::Observation> observations;
  std::vector<std::uint8_t> labels;  ///< as `intent::Intention`, one per observation
  std::vector<bool> scored;          ///< likewise; false: the label is in doubt, it counts neither
                                     ///< in training nor in scores
  std::vector<double> crossing_times;  ///< the centre crosses a lane's bound [s] from the first
                                       ///< observation on, increasing
  std::vector<double> braking_times;   ///< the true acceleration falls below -2 m/s^2; likewise
};

}  // namespace saca::intention_scoring
