#pragma once

#include <functional>
#include <utility>

#include "saca/loop/method.h"
#include "saca/preview/threat.h"

namespace saca::eval {

/// Decides once: when the nearest conflict with somebody who is confirmed, all going on as they do,
/// is within T1. The rule of SACA's reflex plane, for all who differ from it in nothing but the
/// choice.
class AtTrigger final : public loop::Method {
 public:
  using Choose = std::function<loop::Action(const loop::View&)>;

  AtTrigger(const preview::Thresholds& thresholds, Choose choose)
      : thresholds_(thresholds), choose_(std::move(choose)) {}

  [[nodiscard]] std::optional<loop::Action> step(const loop::View& view) override {
    if (decided_ || !view.driven ||
        !preview::triggering_threat(view.scene, thresholds_, view.confirmed)) {
      return std::nullopt;
    }
    decided_ = true;
    return choose_(view);
  }

 private:
  preview::Thresholds thresholds_;
  Choose choose_;
  bool decided_ = false;
};

}  // namespace saca::eval
