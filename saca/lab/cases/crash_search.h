#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "saca/lab/eval/judged_encounter.h"
#include "saca/lab/families/family.h"

namespace saca::cases {

/// How the search for a crash in a family ended, or why it found none.
enum class CrashEnd : std::uint8_t {
  happens,          ///< without avoidance the recorded crash happens
  cannot_be_drawn,  ///< the family gives no sensible encounter (families::sample)
  never_triggers,   ///< in no sample does anybody come into conflict with the ego
  does_not_happen,  ///< in no sample is the other one met, or on another side than recorded
};
constexpr std::size_t num_crash_ends = 4;
[[nodiscard]] std::string_view name(CrashEnd end);
[[nodiscard]] std::optional<CrashEnd> crash_end_from(std::string_view name);

struct CrashFound {
  CrashEnd end = CrashEnd::cannot_be_drawn;
  std::uint64_t sample = 0;         ///< the last that was tried; where it happens, that one
  scenario::Scenario scenario;      ///< of that sample
  eval::WrittenTrigger as_written;  ///< of it; without meaning where nothing triggers
};

/// Which samples of a family are tried.
struct SampleTries {
  std::uint64_t seed = 1;
  std::uint64_t most = 1;  ///< >= 1
};

/// Tries samples 0, 1, 2, ... of a record's family until without avoidance its first actor is met,
/// on the given side of the ego.
/// @param struck   the ego's face; nullopt: any
[[nodiscard]] CrashFound find_crash(const families::Family& family,
                                    std::optional<collision::Face> struck,
                                    const std::string& car_name, const manoeuvre::Car& car,
                                    const collision::HarmModel& harm, const SampleTries& tries);

}  // namespace saca::cases
