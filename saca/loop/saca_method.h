#pragma once

#include <optional>

#include "saca/loop/method.h"
#include "saca/runtime/planes.h"

namespace saca::loop {

/// SACA as a method: the planes that ship, in lockstep. It asks memory and model where the setup
/// has them, and teaches memory nothing.
class SacaMethod final : public Method {
 public:
  /// @param looks  how often `step` will be called at most
  SacaMethod(const runtime::PlanesSetup& setup, std::size_t looks) : planes_(setup, {}, looks) {}

  [[nodiscard]] std::optional<Action> step(const View& view) override;
  [[nodiscard]] std::optional<ThinkingFigures> thinking() const override;

 private:
  runtime::Planes planes_;
};

}  // namespace saca::loop
