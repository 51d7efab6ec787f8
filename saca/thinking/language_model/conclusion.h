#pragma once

#include <optional>
#include <string_view>

#include "saca/onboard/manoeuvre/plan.h"

namespace saca::language_model {

/// The policy whose name stands first in a text, in upper or lower case; nullopt: there is none.
[[nodiscard]] std::optional<manoeuvre::PolicyId> first_named(std::string_view text);

/// What a reasoning comes to: whom the last of its lines that names a policy names first.
[[nodiscard]] std::optional<manoeuvre::PolicyId> concluded(std::string_view reasoning);

}  // namespace saca::language_model
