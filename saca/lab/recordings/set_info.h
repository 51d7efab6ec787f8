#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/recordings/recorded_set.h"

namespace saca::recordings {

/// What a set holds, over all and by site: the document saca.traffic_info/1 of docs/formats.md.
[[nodiscard]] nlohmann::json set_json(const RecordedSet& set);

/// Likewise for people, with what was left out.
[[nodiscard]] std::string set_text(const RecordedSet& set);

}  // namespace saca::recordings
