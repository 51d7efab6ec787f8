#include "saca/runtime/tape_header.h"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "saca/base/core/simd_level.h"
#include "saca/onboard/atlas/atlas_identity.h"
#include "saca/thinking/arbitration/forecaster.h"

namespace saca::runtime {
namespace {

std::string digest_of(const atlas::Atlas& atlas) {
  Fnv hash;
  hash.add(atlas::grid_hash(atlas.grid()));
  for (const std::byte byte : std::as_bytes(atlas.nodes())) {
    hash.add(std::to_integer<std::uint64_t>(byte));
  }
  return digest_text(hash);
}

}  // namespace

std::string digest_text(const Fnv& hash) {
  return fmt::format("{:016x}", hash.value());
}

TapeHeader tape_header(const PlanesSetup& setup, const intent::Model& intent) {
  const auto hash_of = [](auto&& add) {
    Fnv hash;
    add(hash);
    return digest_text(hash);
  };
  const preview::ForecastTools& tools = setup.forecast;
  return {.program = {},
          .level = std::string(name(best_level())),
          .car = {},
          .car_digest = hash_of([&](Fnv& hash) { hash.add(atlas::car_hash(*tools.car)); }),
          .intent_digest = hash_of([&](Fnv& hash) { hash.add(intent::digest(intent)); }),
          .harm_digest = hash_of([&](Fnv& hash) { hash.add_doubles(*tools.harm); }),
          .atlas = tools.atlas == nullptr ? std::nullopt : std::optional(digest_of(*tools.atlas)),
          .cues = tools.cues == nullptr ? std::nullopt : std::optional(hash_of([&](Fnv& hash) {
            hash.add(intent::digest(*tools.cues));
          })),
          .danger = tools.danger != nullptr,
          .model = setup.model == nullptr ? "off" : setup.model->description(),
          .memory = setup.memory != nullptr,
          .num_draws = arbitration::usual_draws,
          .guarded = setup.guard != reflex::Guard::none,
          .forced = setup.forced,
          .thresholds = setup.thresholds,
          .pace = setup.pace,
          .costs = setup.costs,
          .scenario = {},
          .seed = {}};
}

std::optional<Error> mismatch(const TapeHeader& tape, const TapeHeader& here) {
  constexpr std::array<std::pair<const char*, std::string TapeHeader::*>, 5> same{{
      {"program", &TapeHeader::program},
      {"level", &TapeHeader::level},
      {"car_digest", &TapeHeader::car_digest},
      {"intent_digest", &TapeHeader::intent_digest},
      {"harm_digest", &TapeHeader::harm_digest},
  }};
  const auto other = [](std::string_view key, std::string_view recorded, std::string_view got) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: recorded with {}, here it is {}: what was worked out then cannot "
                             "come back bit by bit",
                             key, recorded, got)};
  };
  for (const auto& [key, member] : same) {
    if (tape.*member != here.*member) {
      return other(key, tape.*member, here.*member);
    }
  }
  constexpr std::array<std::pair<const char*, std::optional<std::string> TapeHeader::*>, 2>
      same_or_none{{{"atlas_digest", &TapeHeader::atlas}, {"cues_digest", &TapeHeader::cues}}};
  for (const auto& [key, member] : same_or_none) {
    if (tape.*member != here.*member) {
      return other(key, (tape.*member).value_or("none"), (here.*member).value_or("none"));
    }
  }
  return std::nullopt;
}

}  // namespace saca::runtime
