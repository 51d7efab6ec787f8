#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/thinking/language_model/explanation.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {

/// So often a model may try to give reasons that hold, its first reply among them; then the facts
/// are told.
constexpr int most_tries = 3;

/// While what is shown comes from the facts, asks the model again, each time with another sampling
/// seed. For when no deadline waits for it: another reply takes as long as the first, two minutes
/// at most.
///
/// @param prompt     what the first reply was to
/// @param first      what is shown by the first reply
/// @param shown_by   what would be shown by the whole sentences of a reply
/// @param options    of these questions; their seeds are chosen here
/// @return           the model's error, but that what it says holds no answer is a try like others;
///                   where a stop is asked for, what is shown until then
[[nodiscard]] Result<Explanation> told_again(
    LanguageModel& model, const Clock& clock, const std::string& prompt, Explanation first,
    const std::function<Explanation(std::string_view)>& shown_by, AskOptions options = {});

}  // namespace saca::language_model
