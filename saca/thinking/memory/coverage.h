#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "saca/thinking/memory/case.h"

namespace saca::memory {

/// Whom the ego meets: the road user whose absence would change a scene most
/// (ActorFeatures::threat), by kind and, of cars, vans and trucks, by the way it goes.
enum class Situation : std::uint8_t {
  nobody,
  same_direction,  ///< heads within 45 deg of the ego's lane
  oncoming,        ///< within 45 deg of the other way
  crossing,
  two_wheeler,
  pedestrian,
  obstacle,
};
inline constexpr std::array all_situations{
    Situation::nobody,      Situation::same_direction, Situation::oncoming, Situation::crossing,
    Situation::two_wheeler, Situation::pedestrian,     Situation::obstacle};
[[nodiscard]] std::string_view name(Situation situation);

/// @throws ContractViolation  if the scene breaks a rule of `world::broken_rule`
[[nodiscard]] Situation situation_of(const world::Scene& scene);

/// The ego's speed: below the first of these, between two, from the last on [m/s]. About 30, 50 and
/// 80 km/h.
inline constexpr std::array speed_classes{8.0, 14.0, 22.0};

/// The cases of one situation and class of speed.
struct CoverageCell {
  Situation situation = Situation::nobody;
  std::size_t speed_class = 0;  ///< in [0, speed_classes.size()]
  std::size_t cases = 0;
  std::size_t braking_as_good = 0;  ///< in which full braking is as good as the best
  std::size_t slippery = 0;         ///< at a grip below 0.4
  /// To the nearest other case, the median (match::difference); NaN where there is none.
  double to_nearest = 0.0;
};

/// What a bank has seen of the space of scenes: all cells, empty ones too, by situation, then
/// speed. Who is quarantined does not count.
/// @param cases  by ascending id; no scene breaks a rule of `world::broken_rule`
[[nodiscard]] std::vector<CoverageCell> coverage(std::span<const Case> cases);

}  // namespace saca::memory
