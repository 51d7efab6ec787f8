#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::eval {

/// Plays an encounter, nobody having acted, until SACA's trigger first fires.
/// @return  there; nullopt: it never fires; out_of_range: the encounter cannot be played
[[nodiscard]] Result<std::optional<encounter::ClosedLoop>> played_to_trigger(
    const encounter::Stage& stage);

/// What an encounter teaches memory: the scene as it is perceived when SACA's trigger first fires,
/// nobody having acted; what every policy is expected to harm then, and what it truly would have.
/// As carried out counts the best in hindsight.
///
/// @param stage  with perception and draws, as it is played
/// @param tools  plans are held against draws with these
/// @param draws  that the expectation is the mean of, >= 1
/// @param made_with  encounter::made_with of these: the same for all encounters
/// @return       nullopt: the trigger never fires; out_of_range: the encounter cannot be played
[[nodiscard]] Result<std::optional<memory::Case>> case_at_trigger(
    const encounter::Stage& stage, const preview::ForecastTools& tools, std::size_t draws,
    const std::vector<memory::MadeWith>& made_with);

}  // namespace saca::eval
