#include "saca/loop/witness.h"

#include <algorithm>

#include "saca/core/contract.h"

namespace saca::loop {

std::optional<world::Scene> Witness::look(const sim::Stepper& stepper) {
  const world::Scene now = stepper.scene();
  if (!last_) {
    last_ = now;
    return std::nullopt;
  }
  const manoeuvre::EgoMotion motion{
      .track = {.start = last_->time,
                .step = now.time - last_->time,
                .X_WA = {last_->ego.X_WB, now.ego.X_WB}},
      .v_B = {last_->ego.v_B, now.ego.v_B},
      .yaw_rate = {last_->ego.yaw_rate, now.ego.yaw_rate},
      .ended = false};
  const bool first = outcome_.end_time == 0.0;
  const double clearance = outcome_.clearance;
  outcome_ = outcome::judge(motion, now, stepper.tracks(), harm_);
  if (outcome_.contact) {
    return now;
  }
  outcome_.clearance = first ? outcome_.clearance : std::min(clearance, outcome_.clearance);
  last_ = now;
  return std::nullopt;
}

}  // namespace saca::loop
