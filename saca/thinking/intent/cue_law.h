#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"

namespace saca::intent {

/// What a cue stands for: somebody who is not seen yet, or a road that is slippery.
struct Unseen {
  std::optional<world::ActorKind> who;  ///< who would come; nullopt: nobody, it is slippery there
  double probability = 0.0;             ///< that it is so in one encounter, in [0, 1]
  double speed = 2.0;                   ///< at which it would come across [m/s], > 0
  double grip_share = 1.0;  ///< of the grip that is left where it is slippery, in (0, 1]
};

/// What is reckoned with where there is a cue; by world::CueKind. nullopt: nothing.
struct CueLaw {
  std::array<std::optional<Unseen>, world::num_cue_kinds> unseen;

  [[nodiscard]] const std::optional<Unseen>& of(world::CueKind kind) const {
    return unseen[static_cast<std::size_t>(kind)];
  }
};

/// Reads what cues stand for (TOML, schema saca.cues/1: docs/formats.md).
/// @param source  name for messages, usually the path
/// @return        Error::Code::malformed or out_of_range, naming source, line, key, wanted and got
[[nodiscard]] Result<CueLaw> read_cue_law(std::string_view text, std::string_view source);
/// @return  likewise, or Error::Code::unreadable
[[nodiscard]] Result<CueLaw> load_cue_law(const std::filesystem::path& path);

/// The file that read_cue_law reads.
/// @param sources  by world::CueKind: where the entry comes from, one line of printable text
[[nodiscard]] std::string cue_law_text(
    const CueLaw& law, const std::array<std::string, world::num_cue_kinds>& sources);

/// Names what a law says, by all its numbers (FNV-1a).
[[nodiscard]] std::uint64_t digest(const CueLaw& law);

}  // namespace saca::intent
