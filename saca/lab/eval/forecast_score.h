#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/eval/likely_places.h"
#include "saca/lab/eval/mixture_lstm.h"
#include "saca/lab/eval/shadow_judge.h"
#include "saca/thinking/intent/observer.h"

namespace saca::eval {

/// Ways of saying where a road user will be.
enum class MotionModel : std::uint8_t {
  constant_velocity,  ///< straight on at the measured speed
  constant_turn,      ///< on along the measured arc, with the measured acceleration until rest
  lane_following,     ///< maintaining as intent::motion_under has it
  law,                ///< the intentions that are believed, each as the law has it
  particle_filter,    ///< drivers who follow others and change lanes (ParticleFilter)
  mixture_lstm,       ///< what was learnt of where vehicles go (MixtureModel)
  shipped,            ///< intent::likely_motions: what the forecaster draws from
};
constexpr std::array<MotionModel, 7> motion_models{MotionModel::constant_velocity,
                                                   MotionModel::constant_turn,
                                                   MotionModel::lane_following,
                                                   MotionModel::law,
                                                   MotionModel::particle_filter,
                                                   MotionModel::mixture_lstm,
                                                   MotionModel::shipped};
[[nodiscard]] std::string_view name(MotionModel model);

/// What a model says of an actor of the scene. Constant turn has the error of constant velocity
/// (going_straight).
/// @throws ContractViolation  if the model watches road users over time (particle_filter,
///                            mixture_lstm)
[[nodiscard]] LikelyPlaces places_of(MotionModel model, const world::Scene& scene,
                                     const world::Actor& actor, const intent::Belief& belief);

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

/// What models that watch road users over time need.
struct WatchingModels {
  const MixtureModel* mixture = nullptr;  ///< outlives what uses it
  std::uint64_t seed = 1;                 ///< of what the particle filter draws
};

/// Where a perceived actor truly is; nullopt: it is not there.
[[nodiscard]] std::optional<Vec2> true_place(const world::Scene& truth, const world::Actor& actor);

/// Whether a forecast that is made now counts: within the window, of who is on its road, and whose
/// way from a little before to forecast_times from now is known.
/// @param truly_now  where it is [m]
/// @param before     from when on its way must be known [s]
/// @param now        [s]
[[nodiscard]] bool can_be_judged(const encounter::Stage& stage, const ForecastWindow& window,
                                 const world::Actor& actor, Vec2 truly_now, double before,
                                 double now);

/// Plays an encounter in which the ego does nothing, and holds forecasts every 0.5 s against what
/// happens: of each vehicle, cyclist and pedestrian that is perceived, moves, and is there 3 s
/// later, where it is recorded by its recording. Forecasts are made from what is perceived and
/// believed, as SACA's are; models that watch road users do so from their first appearance on.
/// @return  what is wrong with the encounter's scenes
/// @throws ContractViolation  if there is no mixture model
[[nodiscard]] Result<std::vector<ForecastSample>> forecast_samples(
    const encounter::Stage& stage, const WatchingModels& models, const ForecastWindow& window = {});

}  // namespace saca::eval
