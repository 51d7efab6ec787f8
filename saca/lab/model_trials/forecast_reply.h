#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/thinking/arbitration/check.h"
#include "saca/thinking/arbitration/event.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::model_trials {

/// Told of text that a reply grows by, on the thread that asks.
/// @param number  which preview of the question
using TextListener = std::function<void(std::size_t number, std::string_view text)>;

/// Asks about previews.
/// @param patience  from the question to the last answer
/// @param clock     of the model
/// @return          one reply for each, answers dated from the question; or the model's error
[[nodiscard]] Result<std::vector<language_model::Reply>> replies_about(
    const std::vector<arbitration::Preview>& previews, language_model::LanguageModel& model,
    Clock::Time patience, const Clock& clock, const TextListener& listener);

/// One forecast, and what was said of it.
struct ForecastReply {
  const arbitration::Preview* preview = nullptr;  ///< outlives this
  language_model::Reply reply;
  language_model::Truth truth;
  std::optional<arbitration::Check> check;                 ///< of what was last chosen
  std::optional<language_model::Explanation> explanation;  ///< of that, where it can be driven
};

/// Holds what was said against what is computed, and asks the model again where its reasons do not
/// hold.
/// @param said   a reply for each preview
/// @param tools  with car and harm, for the check
[[nodiscard]] std::vector<ForecastReply> considered(
    const std::vector<arbitration::Preview>& previews, std::vector<language_model::Reply> said,
    const preview::ForecastTools& tools, language_model::LanguageModel& model, const Clock& clock);

}  // namespace saca::model_trials
