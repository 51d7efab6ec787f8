#include "saca/lab/family_samples/family_request.h"

#include <fmt/core.h>

#include <optional>
#include <utility>

#include "saca/lab/eval/suite_source.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::family_samples {

using installation::Installation;

namespace {

Result<families::Family> open_family(const Installation& here, const FamilyRequest& request) {
  auto family = installation::read_family(here, request.name);
  if (!family.has_value() || request.cues.empty()) {
    return family;
  }
  auto cues = eval::cues_of_suite(here.root / "scenarios" / "families", request.cues);
  if (!cues.has_value()) {
    return Error{cues.error().code, "--cues: " + cues.error().message};
  }
  families::Family with_cues = std::move(family).value();
  with_cues.cues = std::move(cues).value();
  return with_cues;
}

Result<std::uint64_t> seed_of(const Installation& here, const FamilyRequest& request,
                              const std::string& family) {
  const auto splits = installation::read_splits(here);
  if (!splits.has_value()) {
    return splits.error();
  }
  std::optional<families::TestLog> log;
  if (!request.test_log.empty()) {
    log = families::TestLog{request.test_log,
                            fmt::format("saca family {} --first {} --sample {}", request.name,
                                        request.first, request.count)};
  }
  auto seed = families::seed_for(splits.value(), *families::split_from(request.split), family, log);
  if (!seed.has_value() && request.split == "test") {
    return Error{seed.error().code, seed.error().message + " (--test-log FILE)"};
  }
  return seed;
}

}  // namespace

Result<DrawnFamily> drawn_family(const Installation& here, const FamilyRequest& request) {
  const auto inputs = installation::read_inputs(here, request.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  const auto family = open_family(here, request);
  if (!family.has_value()) {
    return family.error();
  }
  const auto seed = seed_of(here, request, family.value().name);
  if (!seed.has_value()) {
    return seed.error();
  }
  DrawnFamily drawn{.name = family.value().name,
                    .seed = seed.value(),
                    .scenarios = {},
                    .sheet = empty_sheet(family.value())};
  const manoeuvre::Car& car = inputs.value().car;
  const SampleSide side = request.twins ? SampleSide::twin : SampleSide::risk;
  for (int k = request.first; k < request.first + request.count; ++k) {
    const auto sample = families::sample(family.value(), drawn.seed, static_cast<std::uint64_t>(k),
                                         inputs.value().car_name, manoeuvre::footprint(car));
    if (!sample.has_value()) {
      return sample.error();
    }
    drawn.scenarios.push_back(chosen(sample.value(), side));
    drawn.sheet.scenes.push_back(picture_of(sample.value(), side, car, inputs.value().harm));
  }
  return drawn;
}

}  // namespace saca::family_samples
