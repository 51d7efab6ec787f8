#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"

namespace saca::intention_scoring {

/// How long before each event it was predicted.
struct LeadTimes {
  /// [s], >= 0, one per event; 0: it was not predicted at the last frame before it.
  std::vector<double> times;
  std::size_t unlabelled = 0;  ///< events that are in none of `times`: their label names no side

  void add(const LeadTimes& other);

  [[nodiscard]] std::size_t events() const { return times.size(); }
  /// Share of the events with more than 0 s; nullopt: there is no event.
  [[nodiscard]] std::optional<double> share_predicted() const;
  /// Nearest-rank quantile over all events, who had no lead time counting 0 s; nullopt: no event.
  /// @param share  in [0, 1]; 0.5: the median
  [[nodiscard]] std::optional<double> quantile(double share) const;
};

/// Time from when a lane change is predicted until the centre crosses the lane's bound.
///
/// To which side a crossing goes is what the label says at the last frame before it. It is
/// predicted at a frame if what the head for now or that for 1 s ahead names changes to this side,
/// braking or not; it counts from the first frame from which that has lasted until the crossing, no
/// farther back than the crossing before.
///
/// @throws ContractViolation  as expect_whole and expect_forecasts_of
[[nodiscard]] LeadTimes lane_change_lead_times(const Sequence& sequence,
                                               const Forecasts& forecasts);

/// Time from when braking is predicted, by any head, whatever the side, without a break until the
/// acceleration falls below -2 m/s^2 (`Sequence::braking_times`), likewise.
[[nodiscard]] LeadTimes braking_lead_times(const Sequence& sequence, const Forecasts& forecasts);

/// Alarms that nothing followed. An alarm is a run of frames at which the head for now names a kind
/// of manoeuvre; it is false if no label within a second of it names that kind. Runs without a
/// scored frame are passed over.
struct FalseAlarms {
  std::size_t left = 0;     ///< lane changes: LC, LB
  std::size_t right = 0;    ///< RC, RB
  std::size_t braking = 0;  ///< FB, LB, RB
  double hours = 0.0;       ///< that vehicles were seen [h]

  FalseAlarms& operator+=(const FalseAlarms& other);
  /// Of all kinds, per vehicle and hour; nullopt: no time.
  [[nodiscard]] std::optional<double> per_hour() const;
};

[[nodiscard]] FalseAlarms false_alarms(const Sequence& sequence, const Forecasts& forecasts);

/// Whether one class may not follow another from frame to frame.   [from][to]
using ForbiddenSteps = std::array<std::array<bool, num_vehicle_classes>, num_vehicle_classes>;

/// How often the classes, frame by frame, take a forbidden step.
/// @param classes  each below num_vehicle_classes
[[nodiscard]] std::size_t illegal_steps(std::span<const std::uint8_t> classes,
                                        const ForbiddenSteps& forbidden);

}  // namespace saca::intention_scoring
