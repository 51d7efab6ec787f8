#include "saca/lab/cases/told_cases.h"

#include <utility>

#include "saca/onboard/match/similarity.h"

namespace saca::cases {

ToldCases::ToldCases(std::vector<memory::Case> cases)
    : cases_(std::move(cases)), experience_(cases_) {
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    place_of_[cases_[i].id] = i;
  }
}

std::optional<eval::ToldCase> ToldCases::in(const world::Scene& scene) const {
  const auto recalled = experience_.recall(match::features(scene));
  if (!recalled) {
    return std::nullopt;
  }
  return eval::ToldCase{cases_[place_of_.at(recalled->nearest)], recalled->similarity};
}

}  // namespace saca::cases
