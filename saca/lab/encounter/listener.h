#pragma once

#include <cstdint>
#include <string_view>

#include "saca/thinking/arbitration/event.h"

namespace saca::encounter {

/// Hears the story while it happens, one call at a time. At pace `real` a thread of its own calls
/// it, and neither driving nor thinking waits for it (dispatcher.h); in lockstep the world does.
class Listener {
 public:
  Listener() = default;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  virtual ~Listener() = default;
  virtual void on_event(const arbitration::Event& event) = 0;
  virtual void on_reasoning(std::int32_t preview, std::string_view text) = 0;
};

/// Hears nothing.
class Silence final : public Listener {
 public:
  void on_event(const arbitration::Event&) override {}
  void on_reasoning(std::int32_t, std::string_view) override {}
};

}  // namespace saca::encounter
