#pragma once

#include <functional>
#include <utility>

#include "saca/lab/encounter/method.h"
#include "saca/onboard/reflex/trigger.h"

namespace saca::eval {

/// Decides once: when the nearest conflict with somebody who is confirmed, all going on as they do,
/// is within T1. The rule of SACA's reflex plane, for all who differ from it in nothing but the
/// choice.
class AtTrigger final : public encounter::Method {
 public:
  using Choose = std::function<encounter::Action(const encounter::View&)>;

  AtTrigger(const reflex::Thresholds& thresholds, Choose choose)
      : thresholds_(thresholds), choose_(std::move(choose)) {}

  [[nodiscard]] std::optional<encounter::Action> step(const encounter::View& view) override {
    if (decided_ || !view.driven ||
        !reflex::triggering_threat(view.scene, thresholds_, view.confirmed)) {
      return std::nullopt;
    }
    decided_ = true;
    return choose_(view);
  }

 private:
  reflex::Thresholds thresholds_;
  Choose choose_;
  bool decided_ = false;
};

}  // namespace saca::eval
