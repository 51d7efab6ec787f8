#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/lab/eval/survey.h"
#include "saca/lab/long_work/progress.h"

namespace saca::policy_study {

/// eval::survey with progress on the error stream, which ends soon after an interrupt. The
/// journal's folder is made.
/// @param suite  its name, for the line of progress
/// @return       nullopt: interrupted. Errors as those of eval::survey, and
///               Error::Code::unwritable: the journal's folder
[[nodiscard]] Result<std::optional<std::vector<eval::Finding>>> interruptible_survey(
    const eval::SurveyWork& work, const std::string& suite, long_work::ProgressDisplay display);

}  // namespace saca::policy_study
