#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/thinking/intent/cue_law.h"

namespace saca::families {

/// What kind of encounter a family holds: which bodies there are and what they do.
enum class FamilyKind : std::uint8_t {
  crossing,     ///< a vehicle crosses on a straight path
  one_way,      ///< obstacles on a one-way road, a vehicle beside merges
  lead_brakes,  ///< the vehicle ahead brakes hard
  cut_in,       ///< a slower vehicle moves in from the next lane
  cut_out,      ///< the vehicle ahead moves out and uncovers a standing one
  pedestrian,   ///< somebody on foot crosses
  cyclist,      ///< somebody on a bicycle crosses, or swerves in from the roadside
  head_on,      ///< oncoming traffic drifts over
  merge,        ///< a vehicle beside runs out of its lane
  dart_out,     ///< somebody runs out from between parked cars
  slower_lead,  ///< the vehicle ahead stands, or drives slower at a constant speed
  sideswipe,    ///< a vehicle beside changes into our lane where we are
  turning,      ///< a vehicle turns across our lane, or into it
};

constexpr std::size_t num_family_kinds = 13;
[[nodiscard]] std::string_view name(FamilyKind kind);
[[nodiscard]] std::optional<FamilyKind> family_kind_from(std::string_view name);

/// Values that one number of a family may have, and who says so.
struct FamilyRange {
  double min = 0.0;
  double max = 0.0;  ///< >= min
  std::string source;
};

/// Cues that encounters have, and what comes of them.
struct FamilyCues {
  intent::CueLaw law;
  std::vector<world::CueKind> kinds;  ///< at least one, each once
};

/// A cue that an encounter has.
struct DrawnCue {
  world::CueKind kind = world::CueKind::parked_vans;
  bool comes = false;  ///< what it stands for
};

/// Encounters of one kind: the ranges of all that varies. Units stand in the keys, as in the file.
struct Family {
  std::string name;  ///< also the file's
  FamilyKind kind = FamilyKind::crossing;
  std::string title;
  std::string why;  ///< what it is there for, in one sentence
  std::map<std::string, FamilyRange, std::less<>> ranges;  ///< every key of its kind, no other
  std::optional<FamilyCues> cues;  ///< of a suite that has some; nullopt: none
};

/// The numbers that a family of a kind needs: its own, and those of the surroundings. A kind with
/// a `van_share` may have a `motorcycle_share` besides; without one nobody rides.
[[nodiscard]] std::span<const std::string_view> own_keys(FamilyKind kind);
[[nodiscard]] std::span<const std::string_view> surroundings_keys();

/// Reads a family (TOML, schema saca.family/1: scenarios/families/README.md).
///
/// @param text          of the family
/// @param source        its name for messages, usually the path
/// @param surroundings  what the family does not say itself: ranges of the surroundings, likewise
/// @return              Error::Code::malformed or out_of_range, naming source, line, key, wanted
///                      and got: an empty range, a number without a source, a key that is missing
///                      or unknown
[[nodiscard]] Result<Family> read_family(std::string_view text, std::string_view source,
                                         std::string_view surroundings,
                                         std::string_view surroundings_source);
/// The family `name` of a folder that holds `surroundings.toml`; or Error::Code::unreadable.
[[nodiscard]] Result<Family> load_family(const std::filesystem::path& folder,
                                         std::string_view name);

/// One encounter of a family, and the same without risk: the truck brakes, the obstacle is not
/// there, the vehicle beside stays in its lane. Its cues stand for nothing then.
struct FamilySample {
  scenario::Scenario scenario;
  scenario::Scenario twin;
  std::vector<DrawnCue> cues = {};  ///< in the scenario's order
};

/// Sample `number` of the series `seed`, for a car of this name and body.
///
/// Physically sensible: nobody touches anybody but for the conflict itself. Samples whose others
/// would run into each other, or touch the ego before things come to a head, are drawn again from
/// the same stream; so sample `number` is always the same.
/// @return  Error::Code::out_of_range when 100 tries give no such encounter
[[nodiscard]] Result<FamilySample> sample(const Family& family, std::uint64_t seed,
                                          std::uint64_t number, std::string_view car,
                                          const world::Footprint& ego);

}  // namespace saca::families
