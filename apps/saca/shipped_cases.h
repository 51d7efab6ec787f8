#pragma once

#include <optional>
#include <span>

#include "apps/saca/places.h"
#include "saca/memory/case.h"
#include "saca/memory/store.h"

namespace saca::app {

/// Puts the cases that are shipped (data/memory/seed.jsonl.gz) into an empty bank. One that was
/// worked out with another car or other harm than these is unchecked.
/// @param now  loop::made_with
[[nodiscard]] std::optional<Error> add_shipped_cases(memory::Store& memory, const Places& places,
                                                     std::span<const memory::MadeWith> now);

}  // namespace saca::app
