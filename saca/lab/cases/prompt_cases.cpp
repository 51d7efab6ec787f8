#include "saca/lab/cases/prompt_cases.h"

#include <utility>

#include "saca/onboard/match/similarity.h"

namespace saca::cases {

PromptCases::PromptCases(std::vector<memory::Case> cases)
    : cases_(std::move(cases)), experience_(cases_) {}

std::optional<PromptCase> PromptCases::in(const world::Scene& scene) const {
  const auto recalled = experience_.recall(match::features(scene));
  if (!recalled) {
    return std::nullopt;
  }
  return PromptCase{cases_[static_cast<std::size_t>(recalled->nearest - 1)], recalled->similarity};
}

}  // namespace saca::cases
