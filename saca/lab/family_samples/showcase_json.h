#pragma once

#include <nlohmann/json.hpp>

#include "saca/lab/family_samples/showcase_search.h"

namespace saca::family_samples {

/// One of "found" of schema saca.showcase/1 (docs/formats.md).
[[nodiscard]] nlohmann::json json_of(const ShowcaseScene& one, manoeuvre::PolicyId policy);

}  // namespace saca::family_samples
