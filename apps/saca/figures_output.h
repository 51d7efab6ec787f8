#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "apps/saca/json_output.h"
#include "apps/saca/version.h"

namespace saca::app {

/// What `--json` prints of figures: they, and who made them.
/// @param command  without the program's name
inline void print_with_meta(nlohmann::json figures, const std::string& command) {
  figures["meta.command"] = "saca " + command;
  figures["meta.version"] = SACA_VERSION;
  app::print_json(std::move(figures));
}

}  // namespace saca::app
