#pragma once

#include <optional>

#include "saca/lab/encounter/method.h"
#include "saca/runtime/avoider.h"
#include "saca/thinking/intent/model.h"
#include "saca/thinking/memory/case.h"

namespace saca::encounter {

/// SACA as a method: the avoider that ships, in lockstep. It asks memory and model where the setup
/// has them, and teaches memory nothing.
class SacaMethod final : public Method {
 public:
  /// @param intent  outlives this
  SacaMethod(const runtime::PlanesSetup& setup, const intent::Model& intent)
      : avoider_({.planes = setup, .intent = &intent}) {}

  [[nodiscard]] std::optional<Action> step(const View& view) override;
  [[nodiscard]] Avoider* avoider() override { return &avoider_; }
  /// In the encounter of the first decision; without one, in that under way.
  [[nodiscard]] std::optional<ThinkingFigures> thinking() const override;
  /// The case by which memory spoke for the first decision; nullopt: memory did not decide.
  [[nodiscard]] std::optional<match::CaseId> followed() const { return followed_; }

 private:
  Avoider avoider_;
  std::optional<reflex::Decision> first_;    ///< decision
  std::optional<match::CaseId> followed_;    ///< by it
  std::optional<ThinkingFigures> thinking_;  ///< of its encounter, which is over
};

}  // namespace saca::encounter
