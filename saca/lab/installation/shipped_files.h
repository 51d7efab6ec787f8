#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/families/family.h"
#include "saca/lab/families/splits.h"
#include "saca/lab/installation/installation.h"

namespace saca::installation {

/// A scenario by its path, or by the name of a shipped one.
/// @return  Error::Code::unreadable where there is neither, with the name that was likely meant
[[nodiscard]] Result<std::filesystem::path> find_scenario(const Installation& here,
                                                          const std::string& name);
/// A case of `data/reach` likewise.
[[nodiscard]] Result<std::filesystem::path> find_reach_case(const Installation& here,
                                                            const std::string& name);
/// A car's file likewise.
[[nodiscard]] Result<std::filesystem::path> find_car(const Installation& here,
                                                     const std::string& name);
/// A family likewise: a shipped one, or a file of the user's own (*.toml), read.
[[nodiscard]] Result<families::Family> read_family(const Installation& here,
                                                   const std::string& name);

/// The shipped ones' files, by name.
/// @throws std::filesystem::filesystem_error  where their folder is not there
[[nodiscard]] std::vector<std::filesystem::path> shipped_scenarios(const Installation& here);

/// The seeds of the splits.
[[nodiscard]] Result<families::Splits> read_splits(const Installation& here);

/// Where the file of a regulation would be.
[[nodiscard]] std::filesystem::path regulation_place(const Installation& here,
                                                     const std::string& name);

/// Names the bytes of a scenario's file: FNV-1a, 16 hexadecimal digits.
/// @param scenario  its file, or the name of a shipped one
[[nodiscard]] Result<std::string> scenario_digest(const Installation& here,
                                                  const std::string& scenario);

}  // namespace saca::installation
