#pragma once

#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/lab/cases/reply_example.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/experience.h"

namespace saca::cases {

/// Cases that prompts tell of, as a run's memory would: asked by several threads.
class PromptCases {
 public:
  explicit PromptCases(std::vector<memory::Case> cases);

  /// The most alike of those that speak for what is recalled; nullopt: nothing is recalled.
  [[nodiscard]] std::optional<PromptCase> in(const world::Scene& scene) const;

 private:
  std::vector<memory::Case> cases_;
  memory::Experience experience_;  ///< numbers them from 1 on, whatever their ids are
};

}  // namespace saca::cases
