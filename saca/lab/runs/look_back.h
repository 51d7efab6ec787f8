#pragma once

#include <optional>
#include <stop_token>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/lab/runs/story.h"

namespace saca::runs {

/// Has the setup's model tell its reasons anew where they did not hold, and look back at what was
/// played; the story hears it, and memory keeps the lesson where it learnt the case.
/// @param record  gets what came of it: `retold`, `review`, `not_stored`
/// @param stop    asks for none of it any more
/// @return        why there is no review, though a model was asked for one
[[nodiscard]] std::optional<Error> look_back(const encounter::Setup& setup,
                                             encounter::Record& record, Story& story,
                                             const std::stop_token& stop = {});

/// Likewise until an interrupt that is watched for.
[[nodiscard]] std::optional<Error> look_back_until_interrupted(const encounter::Setup& setup,
                                                               encounter::Record& record,
                                                               Story& story);

}  // namespace saca::runs
