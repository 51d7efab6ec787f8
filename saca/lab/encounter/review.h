#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "saca/lab/encounter/encounter.h"

namespace saca::encounter {

/// Asks `setup.model` to look back at an encounter that was played with it. Takes as long as the
/// model needs, two minutes at most.
/// @param on_text  hears the text while it is written
/// @param stop     asks for none any more
/// @return         nullopt where there is no model or nothing was triggered; the model's error;
///                 too_late where it was withdrawn
[[nodiscard]] Result<std::optional<language_model::Review>> review(
    const Setup& setup, const Record& record, const std::function<void(std::string_view)>& on_text,
    const std::stop_token& stop = {});

}  // namespace saca::encounter
