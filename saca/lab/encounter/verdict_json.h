#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>

#include "saca/lab/encounter/verdict_log.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/verdict.h"

namespace saca::encounter {

// The parts of a record that tell what plans were expected to end in; docs/formats.md.

[[nodiscard]] nlohmann::json plan_json(const manoeuvre::Plan& plan);

/// @param under_way  in the scene that was judged; nullopt: nothing was
[[nodiscard]] nlohmann::json verdict_json(const reflex::Verdict& verdict,
                                          const std::optional<manoeuvre::Plan>& under_way);

/// How many verdicts a record holds at most: half a megabyte. At pace `real` there are up to 40 a
/// second.
constexpr std::size_t most_verdicts = 240;

/// The verdicts over time. Where there are more than `most`, those of VerdictLog::judged are kept,
/// and of the others as many as there is room for, evenly.
/// @param most  > VerdictLog::most_judged
[[nodiscard]] nlohmann::json verdicts_json(const VerdictLog& log, std::size_t most = most_verdicts);

/// What the verdicts were made by by which a plan was begun.
[[nodiscard]] nlohmann::json hypotheses_json(const VerdictLog& log);

}  // namespace saca::encounter
