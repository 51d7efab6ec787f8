#pragma once

#include <cstdint>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/learned_danger/check.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/long_work/progress.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::danger_study {

/// How many situations of which draw are worked on, and who hears of it.
struct SituationsTask {
  int situations = 0;
  std::uint64_t seed = 1;
  int threads = 1;  ///< they change nothing that comes of it
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// The car driven by the network's Q and by others, with progress on the error stream.
/// @return  Error::Code::too_late: interrupted, which is to be watched for
[[nodiscard]] Result<std::vector<learned_danger::CheckedCase>> checked_situations(
    const manoeuvre::Car& car, const learned_danger::Network& network, const SituationsTask& task);

/// How long a value takes, of 32 that are asked for at once [us].
[[nodiscard]] double microseconds_of_value(const learned_danger::Network& network,
                                           const Clock& clock);

}  // namespace saca::danger_study
