#include "saca/lab/cases/told_cases.h"

#include <utility>

#include "saca/onboard/match/similarity.h"

namespace saca::cases {

ToldCases::ToldCases(std::vector<memory::Case> cases)
    : cases_(std::move(cases)), experience_(cases_) {}

std::optional<ToldCase> ToldCases::in(const world::Scene& scene) const {
  const auto recalled = experience_.recall(match::features(scene));
  if (!recalled) {
    return std::nullopt;
  }
  return ToldCase{cases_[static_cast<std::size_t>(recalled->nearest - 1)], recalled->similarity};
}

}  // namespace saca::cases
