#pragma once

#include <optional>
#include <span>
#include <vector>

#include "apps/saca/places.h"
#include "saca/memory/case.h"
#include "saca/memory/store.h"

namespace saca::app {

/// The cases that are shipped (data/memory/seed.jsonl.gz). One that was worked out with another car
/// or other harm than these is unchecked.
/// @param now  loop::made_with
[[nodiscard]] Result<std::vector<memory::Case>> shipped_cases(
    const Places& places, std::span<const memory::MadeWith> now);

/// Puts them into an empty bank.
[[nodiscard]] std::optional<Error> add_shipped_cases(memory::Store& memory, const Places& places,
                                                     std::span<const memory::MadeWith> now);

}  // namespace saca::app
