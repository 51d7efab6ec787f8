#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"

namespace saca::intention_scoring {

/// Of an event (a run of one label) what was found by the head for now, and how old the event was
/// then: labels look ahead, so the first tenths of a second of an event are the hardest.
struct ManoeuvreEventsFound {
  /// An age from which on frames are counted together, to the next one [s].
  static constexpr std::array<double, 5> ages{0.0, 0.3, 0.6, 1.0, 2.0};

  struct Share {
    std::size_t num = 0;
    std::size_t found = 0;
    [[nodiscard]] std::optional<double> share() const;  ///< nullopt: there is none
  };
  struct OfClass {
    Share events;  ///< with a scored frame; found: at one of these at least
    std::array<Share, ages.size()> frames;
  };
  std::array<OfClass, num_vehicle_classes> of;  ///< nothing is counted of M: it is no event

  ManoeuvreEventsFound& operator+=(const ManoeuvreEventsFound& other);
};

/// @throws ContractViolation  as expect_whole and expect_forecasts_of
[[nodiscard]] ManoeuvreEventsFound manoeuvre_events_found(const Sequence& sequence,
                                                          const Forecasts& forecasts);

}  // namespace saca::intention_scoring
