#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/thinking/intent/intention.h"
#include "saca/thinking/intent/model.h"

namespace saca::intent {

/// What a road user is thought to intend, now and soon.
struct Belief {
  std::array<IntentPosterior, horizons.size()> at;  ///< at[h]: `horizons[h]` from now

  [[nodiscard]] const IntentPosterior& now() const { return at.front(); }

  bool operator==(const Belief&) const = default;
};

/// One per actor of a scene, in its order. Trivially copyable: it crosses between the planes with
/// its scene.
using Beliefs = StaticVector<Belief, world::max_actors>;

/// Watches a drive, scene by scene, and tells what each road user intends.
///
/// A road user is known by its kind and id. Whoever is seen for the first time is judged at once,
/// then every 0.1 s of scene time; in between, its last belief stands. Who has been gone for 2 s is
/// forgotten. Vehicles are judged by the model, VRUs by `vru_posterior`; who stands, and
/// every obstacle, maintains. Fixed in size: copyable, and allocates nothing.
class Observer {
 public:
  static constexpr double step = look_step;  ///< between judgements [s]
  static constexpr double memory = 2.0;      ///< [s]

  /// @param model  outlives the observer
  explicit Observer(const Model& model) : model_(&model) {}

  /// The newest scene. The same instant again changes nothing but adds who is new; an earlier one
  /// begins a new drive: all is forgotten.
  /// @return  valid until the next look
  /// @throws ContractViolation  if the scene breaks a rule of `world::broken_rule`
  const Beliefs& look(const world::Scene& scene);
  /// Of the last look; empty before the first.
  [[nodiscard]] const Beliefs& beliefs() const { return beliefs_; }

  /// How many road users it remembers, at most world::max_actors. Where there is no room for
  /// somebody new, who has been gone longest is forgotten early.
  [[nodiscard]] std::size_t num_known() const { return known_.size(); }

 private:
  /// One road user.
  struct RoadUser {
    world::ActorKind kind = world::ActorKind::car;
    std::uint8_t id = 0;
    double seen = 0.0;  ///< last [s]
    double due = 0.0;   ///< when it is judged next [s]
    Stream stream;      ///< of a vehicle
    Belief belief;
  };

  /// @param i  index into scene.actors
  [[nodiscard]] Belief judged(const world::Scene& scene, std::size_t i, Stream& stream) const;
  [[nodiscard]] RoadUser* find(const world::Actor& actor);
  [[nodiscard]] RoadUser& begin(const world::Actor& actor, double time);
  void forget_before(double time);

  const Model* model_;
  StaticVector<RoadUser, world::max_actors> known_;
  Beliefs beliefs_;
  double time_ = 0.0;  ///< of the last look [s]
};

/// What a fresh observer believes at its first look: for those who have one scene only.
[[nodiscard]] Beliefs beliefs_at_sight(const Model& model, const world::Scene& scene);

}  // namespace saca::intent
