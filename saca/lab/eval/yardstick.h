#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "saca/lab/encounter/closed_loop.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::eval {

/// What a yardstick knows when it tries plans from an instant on.
enum class Knowledge : std::uint8_t {
  motions,     ///< how the others will truly move and react; not the grip, nor how the real car
               ///< differs from what it is taken for
  everything,  ///< these as well
};

/// Every plan that can be chosen, begun at this instant of an encounter and rolled out with full
/// dynamics against what the others truly do.
/// @return  in the order of forecast::all_plans
[[nodiscard]] std::vector<preview::RolledOut> try_all(const encounter::ClosedLoop& now,
                                                      const manoeuvre::Car& car,
                                                      const collision::HarmModel& harm,
                                                      Knowledge knowledge);

/// Index of the best of those that can be driven, by the one ordering (collision/ordering.h).
/// @param tried    holds full braking, which can always be driven
/// @param braking  full: among the paper's eight policies, so that what other strengths are worth
///                 can be told
[[nodiscard]] std::size_t best_of(const std::vector<preview::RolledOut>& tried,
                                  forecast::Braking braking = forecast::Braking::any_strength);

/// Tries all plans once for each instant of one encounter, whoever asks.
class Hindsight {
 public:
  Hindsight(const manoeuvre::Car& car, const collision::HarmModel& harm) : car_(car), harm_(harm) {}

  /// Knowing everything. Whoever asks has not acted yet: until then all are in the same world.
  [[nodiscard]] const std::vector<preview::RolledOut>& at(const encounter::ClosedLoop& now);

 private:
  const manoeuvre::Car& car_;
  const collision::HarmModel& harm_;
  std::optional<double> time_;
  std::vector<preview::RolledOut> tried_;
};

}  // namespace saca::eval
