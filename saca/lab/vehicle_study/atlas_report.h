#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "saca/lab/eval/atlas_check.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::vehicle_study {

/// An atlas' file as it was found.
struct AtlasFile {
  std::string file;  ///< its name
  std::string car;   ///< name of the car that it was looked for
  atlas::AtlasInfo info;
  std::optional<std::string> problem;  ///< why that car cannot use it; nullopt: it can
};

/// The document of `saca atlas info --json`, schema saca.atlas_info/1: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const AtlasFile& file);
/// The same for people: a line for the file, one for each kind of manoeuvre, and whether the car
/// can use it.
[[nodiscard]] std::string text_of(const AtlasFile& file);

/// The figures of `saca atlas check --json`, under names for programs: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const eval::AtlasFigures& figures);
/// The same for people.
[[nodiscard]] std::string text_of(const eval::AtlasFigures& figures);

}  // namespace saca::vehicle_study
