#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "saca/lab/encounter/encounter.h"

namespace saca::encounter {

/// Who made a record, by what; none of it changes what happens.
struct Provenance {
  std::string program;  ///< with its version
  std::string commit;   ///< of its sources
  std::string date;     ///< UTC, ISO 8601
  std::string command;  ///< that was typed
  std::string file;     ///< of the scenario, as it was named
  std::string digest;   ///< of that file: FNV-1a, 16 hexadecimal digits
};

/// What a run reads besides its scenario: a list of { "what", "name", "digest": or null, there is
/// none }; what cues stand for is among it where they are reckoned with.
/// @param car  its name or file
[[nodiscard]] nlohmann::json inputs_json(const preview::ForecastTools& tools,
                                         const intent::Model& intent, const std::string& car);

/// As a record's `made` holds it, but for its `content`: with the seed and digests of everything
/// that was read.
[[nodiscard]] nlohmann::json made_json(const Setup& setup, const Provenance& provenance);

/// Digest of everything in a record but its `made`, and `timing`, which clocks measured: two runs
/// of the same command at pace lockstep have the same.
[[nodiscard]] std::string content_digest(const nlohmann::json& record);

}  // namespace saca::encounter
