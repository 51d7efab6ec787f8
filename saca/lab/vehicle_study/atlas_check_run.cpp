#include "saca/lab/vehicle_study/atlas_check_run.h"

#include <fmt/core.h>

#include <utility>

#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::vehicle_study {

std::optional<Error> why_not_seed(const families::Splits& splits,
                                  const std::optional<std::uint64_t>& asked) {
  if (asked != splits.seeds[static_cast<std::size_t>(families::Split::test)]) {
    return std::nullopt;
  }
  return Error{Error::Code::out_of_range,
               fmt::format("--seed: want any but the test split's, got {}", *asked)};
}

Result<SeededFamily> seeded(families::Family family, const std::string& name,
                            const families::Splits& splits,
                            const std::optional<std::uint64_t>& asked) {
  const auto seed = families::seed_for(splits, families::Split::calibration, name, std::nullopt);
  if (!seed.has_value()) {
    return seed.error();
  }
  return SeededFamily{std::move(family), asked.value_or(seed.value())};
}

std::optional<eval::AtlasFigures> check_atlas(const AtlasCheck& check, const atlas::Atlas& atlas,
                                              const manoeuvre::Car& car,
                                              const collision::HarmModel& harm) {
  long_work::watch_for_interrupt();
  const std::size_t num_families = check.families.size();
  std::vector<std::vector<eval::AtlasRow>> rows(static_cast<std::size_t>(check.scenes));
  in_parallel(rows.size(), check.threads, [&](std::size_t i) {
    if (!long_work::interrupted()) {
      const SeededFamily& one = check.families[i % num_families];
      rows[i] = eval::atlas_rows(one.family, one.seed, i / num_families, atlas, car, harm);
    }
  });
  if (long_work::interrupted()) {
    return std::nullopt;
  }
  return eval::atlas_figures(rows);
}

}  // namespace saca::vehicle_study
