#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/atlas_check.h"
#include "saca/lab/families/family.h"
#include "saca/lab/families/splits.h"
#include "saca/lab/installation/installation.h"

namespace saca::vehicle_study {

/// Families whose encounters an atlas is checked over: all but those that are kept for the test
/// split.
constexpr std::array<const char*, 7> atlas_check_families{
    "crossing", "cut_in", "cut_out", "head_on", "lead_brakes", "one_way", "pedestrian"};

/// Why encounters may not be drawn with a seed that was asked for; nullopt: they may.
/// @return  Error::Code::out_of_range: it is the test split's
[[nodiscard]] std::optional<Error> why_not_seed(const families::Splits& splits,
                                                const std::optional<std::uint64_t>& asked);

/// A family, and the seed that its encounters are drawn with.
struct SeededFamily {
  families::Family family;
  std::uint64_t seed = 0;
};

/// @param asked  nullopt: the calibration split's seed
/// @return       Error::Code::out_of_range: a family of the test split
[[nodiscard]] Result<SeededFamily> seeded(families::Family family, const std::string& name,
                                          const families::Splits& splits,
                                          const std::optional<std::uint64_t>& asked);

/// All of them, read, with their seeds.
/// @return  likewise, and what cannot be read
[[nodiscard]] Result<std::vector<SeededFamily>> families_to_check(
    const installation::Installation& here, const std::optional<std::uint64_t>& asked);

/// The encounters that an atlas is checked over.
struct AtlasCheck {
  std::vector<SeededFamily> families;  ///< in turn; at least one
  int scenes = 0;                      ///< > 0
  int threads = 1;                     ///< they do not change the figures
};

/// The atlas of a car beside full physics. Watches for an interrupt.
/// @return  nullopt: interrupted
[[nodiscard]] std::optional<eval::AtlasFigures> check_atlas(const AtlasCheck& check,
                                                            const atlas::Atlas& atlas,
                                                            const manoeuvre::Car& car,
                                                            const collision::HarmModel& harm);

}  // namespace saca::vehicle_study
