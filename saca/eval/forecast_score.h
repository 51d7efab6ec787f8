#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/core/result.h"
#include "saca/eval/shadow_judge.h"
#include "saca/intent/observer.h"
#include "saca/loop/closed_loop.h"
#include "saca/world/scene.h"
#include "saca/world/track.h"

namespace saca::eval {

/// Ways of saying where a road user will be.
enum class MotionModel : std::uint8_t {
  constant_velocity,  ///< straight on at the measured speed
  constant_turn,      ///< on along the measured arc, with the measured acceleration until rest
  lane_following,     ///< maintaining as intent::motion_under has it
  law,                ///< the intentions that are believed, each as the law has it
  shipped,            ///< intent::likely_motions: what the forecaster draws from
};
constexpr std::array<MotionModel, 5> motion_models{
    MotionModel::constant_velocity, MotionModel::constant_turn, MotionModel::lane_following,
    MotionModel::law, MotionModel::shipped};
[[nodiscard]] std::string_view name(MotionModel model);

/// After which places are held against what happened [s].
constexpr std::array<double, 4> forecast_times{0.5, 1.0, 2.0, 3.0};

/// Somebody is there with this probability, but for a normal error along its course and across.
struct LikelyPlace {
  double probability = 1.0;
  Vec2 p_W;             ///< [m]
  double course = 0.0;  ///< [rad]
  world::Spread spread;
};
/// At each of forecast_times; the same way on has the same index in each.
using LikelyPlaces = std::array<std::vector<LikelyPlace>, forecast_times.size()>;

/// What a model says of an actor of the scene. Constant velocity and turn have an error that grows
/// as 0.5 a t^2, a = 1 m/s^2 along and across, beside that of perception; no error is below 0.1 m.
[[nodiscard]] LikelyPlaces places_of(MotionModel model, const world::Scene& scene,
                                     const world::Actor& actor, const intent::Belief& belief);

/// How well a forecast of one time predicted a place.
struct PlaceScore {
  double nll = 0.0;         ///< negative logarithm of the density there [ln m^2]
  double miss = 0.0;        ///< to the nearest of the six likeliest [m]
  double pit_along = 0.0;   ///< probability of less far along the course, in [0, 1]
  double pit_across = 0.0;  ///< of less far to the left of it
};
/// @param places  at least one; their probabilities sum to 1
[[nodiscard]] PlaceScore score(std::span<const LikelyPlace> places, Vec2 truth);

/// Mean distance over forecast_times of the nearest of the `most` likeliest ways on [m].
[[nodiscard]] double least_mean_miss(const LikelyPlaces& places,
                                     const std::array<Vec2, forecast_times.size()>& truth,
                                     std::size_t most);

/// One road user at one instant, and how well each model predicted where it went.
struct ForecastSample {
  std::string who;
  double time = 0.0;   ///< [s]
  bool acts = false;   ///< after 2 s it is more than 1 m from where it would be, straight on
  bool aside = false;  ///< it follows a lane and is seen to move across it by more than 0.5 m/s
  std::array<std::array<PlaceScore, forecast_times.size()>, motion_models.size()> scores{};
  std::array<double, motion_models.size()> mean_miss_of_6{};
  std::array<double, motion_models.size()> mean_miss_of_12{};
};

/// Which forecasts of an encounter count. As it stands, all.
struct ForecastWindow {
  double from = 0.0;                                       ///< when they are made [s]
  double until = std::numeric_limits<double>::infinity();  ///< likewise, the last [s]
  /// How far the road of the scenario is the road that was there, behind and ahead of its origin
  /// along the lane [m]: road users beyond do not count.
  double lane_behind = std::numeric_limits<double>::infinity();
  double lane_ahead = std::numeric_limits<double>::infinity();
  Settling settling{.after_start = 0.0, .before_end = 0.0};  ///< of recorded road users
};

/// Plays an encounter in which the ego does nothing, and holds forecasts every 0.5 s against what
/// happens: of each vehicle, cyclist and pedestrian that is perceived, moves, and is there 3 s
/// later, where it is recorded by its recording. Forecasts are made from what is perceived and
/// believed, as SACA's are.
/// @return  what is wrong with the encounter's scenes
[[nodiscard]] Result<std::vector<ForecastSample>> forecast_samples(
    const loop::Stage& stage, const ForecastWindow& window = {});

}  // namespace saca::eval
