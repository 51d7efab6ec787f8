#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/cases/reply_score.h"

namespace saca::cases {

/// Figures of `saca cases eval --json` (docs/formats.md), but for who made them.
/// @param failed  cases that could not be played or asked about
[[nodiscard]] nlohmann::json score_json(const ReplyScore& score, std::size_t failed);

/// The same for readers: a table of all ways to choose, then what is said of the replies.
/// @param set    of which the examples are, as commands call it
/// @param model  what it says that it is
[[nodiscard]] std::string score_text(const ReplyScore& score, const std::string& set,
                                     const std::string& model);

}  // namespace saca::cases
