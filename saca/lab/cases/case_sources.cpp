#include "saca/lab/cases/case_sources.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "saca/lab/crash_records/record_family.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::cases {
namespace {

using crash_records::CrashFamily;
using crash_records::FarsCrash;

CrashCount& count_of(CaseSources& sources, CrashFamily family) {
  return sources.counts.at(static_cast<std::size_t>(family));
}

/// Counts a crash, and makes a prospect of it where one can be made.
void take_crash(CaseSources& sources, std::size_t index, const crash_records::BaseFamilies& base) {
  const FarsCrash& crash = sources.release.crashes[index];
  const auto its_family = crash_records::crash_family_of(crash);
  if (!its_family) {
    return;
  }
  CrashCount& count = count_of(sources, *its_family);
  ++count.crashes;
  const auto roles = crash_records::roles_of(crash, sources.codes);
  if (const auto* const why = std::get_if<crash_records::NoRoles>(&roles)) {
    ++(*why == crash_records::NoRoles::ego_is_no_car ? count.ego_is_no_car : count.other_unknown);
    return;
  }
  const auto& known = std::get<crash_records::Roles>(roles);
  auto family = crash_records::family_of(crash, known, sources.codes, base);
  if (!family.has_value()) {
    ++count.not_playable;
    return;
  }
  sources.prospects.push_back(
      {.crash = index, .roles = known, .family = std::move(family).value()});
}

/// One of each family after the other, in the order of the records, until there are so many.
std::vector<CrashProspect> in_turn(std::vector<CrashProspect> all, std::size_t most) {
  std::array<std::vector<CrashProspect>, crash_records::num_crash_families> by_family;
  for (CrashProspect& one : all) {
    by_family.at(static_cast<std::size_t>(one.roles.family)).push_back(std::move(one));
  }
  std::vector<CrashProspect> chosen;
  chosen.reserve(std::min(most, all.size()));
  for (std::size_t turn = 0; turn < all.size() && chosen.size() < most; ++turn) {
    for (std::vector<CrashProspect>& family : by_family) {
      if (turn < family.size() && chosen.size() < most) {
        chosen.push_back(std::move(family[turn]));
      }
    }
  }
  return chosen;
}

std::optional<Error> take_events(CaseSources& sources, const std::string& folder) {
  auto outcomes = importers::import_hundred_cars(
      folder, {}, [](std::size_t, std::size_t) { return !long_work::interrupted(); });
  if (!outcomes.has_value()) {
    return outcomes.error();
  }
  std::vector<importers::HundredCarOutcome> all = std::move(outcomes).value();
  for (importers::HundredCarOutcome& outcome : all) {
    if (outcome.rebuilt() != nullptr) {
      sources.events.push_back(std::move(outcome));
    }
  }
  return std::nullopt;
}

}  // namespace

Result<CaseSources> open_case_sources(const std::filesystem::path& root,
                                      const std::vector<std::string>& folders,
                                      const std::string& hundred_car,
                                      const std::optional<int>& count) {
  auto codes = crash_records::FarsCodes::load(root / "data" / "crash_records" / "fars_codes.toml");
  if (!codes.has_value()) {
    return codes.error();
  }
  const auto base = crash_records::load_base_families(root / "scenarios" / "families");
  if (!base.has_value()) {
    return base.error();
  }
  std::vector<crash_records::FarsRelease> releases;
  releases.reserve(folders.size());
  for (const std::string& folder : folders) {
    auto release = crash_records::read_fars(folder);
    if (!release.has_value()) {
      return release.error();
    }
    releases.push_back(std::move(release).value());
  }
  auto all = crash_records::joined(std::move(releases));
  if (!all.has_value()) {
    return all.error();
  }
  CaseSources sources{.release = std::move(all).value(),
                      .codes = std::move(codes).value(),
                      .prospects = {},
                      .counts = {},
                      .events = {}};
  for (std::size_t i = 0; i < sources.release.crashes.size(); ++i) {
    take_crash(sources, i, base.value());
  }
  if (count) {
    sources.prospects = in_turn(std::move(sources.prospects), static_cast<std::size_t>(*count));
  }
  if (!hundred_car.empty()) {
    if (auto problem = take_events(sources, hundred_car)) {
      return *problem;
    }
  }
  return sources;
}

}  // namespace saca::cases
