#pragma once

#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/cue_forecast.h"
#include "saca/lab/eval/suite_source.h"

namespace saca::family_samples {

/// The cues of the first encounters of a suite.
/// @param suite  its name, for messages
/// @param count  > 0
/// @return  Error::Code::out_of_range where the first has none, or as SuiteSource::sample
[[nodiscard]] Result<std::vector<eval::DrawnCues>> drawn_cues(const eval::SuiteSource& source,
                                                              const std::string& suite, int count);

}  // namespace saca::family_samples
