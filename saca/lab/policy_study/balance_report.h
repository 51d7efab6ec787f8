#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "saca/lab/eval/survey.h"

namespace saca::policy_study {

/// The figures of `saca balance --json` under names for programs, balance.SUITE.*, shares with
/// their 95 % intervals (.lo, .hi): docs/formats.md.
/// @param balance  of one encounter at least
[[nodiscard]] nlohmann::json json_of(const eval::Balance& balance, const std::string& suite);

/// The same for people: what encounters teach, and how often each policy is best.
/// @param balance  of one encounter at least
[[nodiscard]] std::string text_of(const eval::Balance& balance);

}  // namespace saca::policy_study
