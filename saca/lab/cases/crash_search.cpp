#include "saca/lab/cases/crash_search.h"

#include <array>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::cases {
namespace {

constexpr std::array<std::string_view, num_crash_ends> crash_end_names{
    "happens", "cannot_be_drawn", "never_triggers", "does_not_happen"};

/// Of two ends the one that came nearer to a crash.
bool is_nearer(CrashEnd a, CrashEnd b) {
  return a == CrashEnd::happens || (b != CrashEnd::happens && a > b);
}

CrashEnd end_of(const std::optional<eval::WrittenTrigger>& as_written,
                std::optional<collision::Face> struck) {
  if (!as_written) {
    return CrashEnd::never_triggers;
  }
  const auto& contact = as_written->contact;
  const bool is_met = contact && contact->first_actor && (!struck || contact->ego_face == *struck);
  return is_met ? CrashEnd::happens : CrashEnd::does_not_happen;
}

}  // namespace

std::string_view name(CrashEnd end) {
  return name_of(end, crash_end_names);
}
std::optional<CrashEnd> crash_end_from(std::string_view name) {
  return value_from<CrashEnd>(name, crash_end_names);
}

CrashFound find_crash(const families::Family& family, std::optional<collision::Face> struck,
                      const std::string& car_name, const manoeuvre::Car& car,
                      const collision::HarmModel& harm, const SampleTries& tries) {
  expects(tries.most >= 1, "tries >= 1");
  CrashFound found;
  for (std::uint64_t number = 0; number < tries.most && found.end != CrashEnd::happens; ++number) {
    found.sample = number;
    auto sample = families::sample(family, tries.seed, number, car_name, manoeuvre::footprint(car));
    if (!sample.has_value()) {
      continue;
    }
    found.scenario = std::move(sample).value().scenario;
    const auto as_written = eval::trigger_as_written(found.scenario, car, harm);
    found.as_written = as_written.value_or(eval::WrittenTrigger{});
    const CrashEnd end = end_of(as_written, struck);
    found.end = is_nearer(end, found.end) ? end : found.end;
  }
  return found;
}

}  // namespace saca::cases
