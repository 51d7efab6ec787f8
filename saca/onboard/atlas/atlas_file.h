#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/atlas/atlas_identity.h"

namespace saca::atlas {

/// An atlas' file: docs/formats.md.
/// @param nodes  num_nodes(grid) of them
[[nodiscard]] std::string atlas_bytes(const manoeuvre::Car& car, const AtlasGrid& grid,
                                      const std::vector<AtlasNode>& nodes);

/// Reads a file into memory and makes sure that it is whole and belongs to this car and this
/// program: the checksums, the numbers, the car's hash, and a few manoeuvres driven anew (some
/// 50 ms). What becomes of the file afterwards does not matter.
/// @return  Error::Code::unreadable, malformed (no atlas, another version, cut short, altered) or
///          out_of_range (another car, other controllers), naming the file, wanted and got
[[nodiscard]] Result<Atlas> read_atlas(const std::filesystem::path& path,
                                       const manoeuvre::Car& car);
/// Likewise, from the bytes of such a file, which the atlas keeps.
/// @param source  name for messages, usually the path
[[nodiscard]] Result<Atlas> parse_atlas(std::string bytes, const std::string& source,
                                        const manoeuvre::Car& car);

/// What a file says of itself, whosever it is; checksums hold.
struct AtlasInfo {
  std::uint64_t car = 0;  ///< hash
  AtlasGrid grid;
  std::uint64_t bytes = 0;
  Behaviour driven{};
};
[[nodiscard]] Result<AtlasInfo> read_atlas_info(const std::filesystem::path& path);

}  // namespace saca::atlas
