#pragma once

#include <optional>

#include "saca/intent/model.h"
#include "saca/loop/method.h"
#include "saca/runtime/avoider.h"

namespace saca::loop {

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

 private:
  Avoider avoider_;
  std::optional<decide::Decision> first_;    ///< decision
  std::optional<ThinkingFigures> thinking_;  ///< of its encounter, which is over
};

}  // namespace saca::loop
