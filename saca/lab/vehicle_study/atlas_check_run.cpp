#include "saca/lab/vehicle_study/atlas_check_run.h"

#include <fmt/core.h>

#include <utility>

#include "saca/base/core/parallel.h"
#include "saca/lab/installation/shipped_files.h"
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

Result<std::vector<SeededFamily>> families_to_check(const installation::Installation& here,
                                                    const std::optional<std::uint64_t>& asked) {
  const auto splits = installation::read_splits(here);
  if (!splits.has_value()) {
    return splits.error();
  }
  if (const auto problem = why_not_seed(splits.value(), asked)) {
    return *problem;
  }
  std::vector<SeededFamily> families;
  for (const char* const name : atlas_check_families) {
    auto family = installation::read_family(here, name);
    if (!family.has_value()) {
      return family.error();
    }
    auto one = seeded(std::move(family).value(), name, splits.value(), asked);
    if (!one.has_value()) {
      return one.error();
    }
    families.push_back(std::move(one).value());
  }
  return families;
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
