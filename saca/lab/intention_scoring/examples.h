#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/labels.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/lab/recordings/recorded_set.h"

namespace saca::intention_scoring {

/// What can be seen of a recorded vehicle, sample by sample, as a tracker beside the road would
/// know it: accelerations, turning rates and lateral speeds are differences to what was 0.5 s
/// before. Nothing looks ahead.
[[nodiscard]] std::vector<intent::Observation> observations_of(
    const recordings::RecordedVehicle& vehicle, double step);

/// What a recorded vehicle truly did, smoothed with all that came before and after: by its
/// accelerometer where it has one, else from its speeds.
[[nodiscard]] TrueMotion true_motion(const recordings::RecordedVehicle& vehicle, double step);

/// Shorter tracks tell too little.
constexpr std::size_t fewest_frames = 20;

/// What a recorded vehicle is split by: its recording's group and a block of a hundred vehicle ids.
/// No vehicle is in two of them.
[[nodiscard]] std::string group_of(const recordings::Recording& recording,
                                   const recordings::RecordedVehicle& vehicle);

/// Every recorded vehicle of at least `fewest_frames` samples as a sequence; labels by `labels_of`
/// on its true motion, groups by `group_of`.
/// @throws ContractViolation  if a recording has another step than frame_step
[[nodiscard]] std::vector<Sequence> examples_of(const recordings::RecordedSet& set);

}  // namespace saca::intention_scoring
