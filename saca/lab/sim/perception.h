#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/lab/scenario/perception_model.h"

namespace saca::sim {

/// What the ego's sensors and tracker make of the truth, look by look.
///
/// Position, velocity and heading of each actor err as Ornstein-Uhlenbeck processes, each by
/// itself; the errors of acceleration and yaw rate are those of velocity and heading, differenced
/// over the time over which a true scene's accelerations are. What was measured is carried on to
/// now at constant velocity and turning rate; one that is not seen goes on so, until it is
/// forgotten. Sizes and masses are known, and so is the ego's own motion.
///
/// An actor's errors come from the seed and its name alone, whoever else is there. Copyable: a copy
/// perceives what the original would.
class Perception {
 public:
  static constexpr double step = 0.01;         ///< between looks [s]
  static constexpr double most_latency = 2.0;  ///< [s]

  /// @throws ContractViolation  if a number of the model is outside the range stated there
  Perception(const scenario::PerceptionModel& model, std::uint64_t seed);

  /// One look; allocates nothing. Until the first latency has passed the oldest look is used.
  ///
  /// @param truth   the true scene, one `step` after the last
  /// @param ghosts  who is not there but may be seen, with an existence < 1 that stays what it is
  ///                thought to be at best; they hide nobody
  /// @return        who is perceived, in the order of truth and ghosts, then who has left the
  ///                truth and is not forgotten; errors' sizes, age, existence as the ego knows them
  /// @throws ContractViolation  if truth with ghosts breaks a rule of a scene, or the step is not
  ///                            kept
  [[nodiscard]] world::Scene look(const world::Scene& truth,
                                  std::span<const world::Actor> ghosts = {});

 private:
  /// What there was to see at one look: the truth, its actors followed by the ghosts.
  struct Snapshot {
    world::Scene scene;
    std::size_t num_real = 0;
  };
  struct Errors {
    Vec2 p_W;              ///< [m]
    Vec2 v_W;              ///< [m/s]
    double heading = 0.0;  ///< [rad]
  };
  /// What the ego knows of one actor.
  struct Belief {
    std::uint8_t id = 0;
    world::ActorKind kind = world::ActorKind::car;
    std::mt19937_64 rng;
    std::normal_distribution<double> normal;
    Errors errors;              ///< at the moment measured now
    Errors smoothed;            ///< the same through a low-pass
    world::Actor last;          ///< as last measured, errors included
    double measured = 0.0;      ///< when [s]
    double certainty = 0.0;     ///< that it is there, for how long it was seen; 0: it is not known
    double at_best = 0.0;       ///< certainty when it was last seen
    int num_missed = 0;         ///< looks since then
    std::size_t num_looks = 0;  ///< that there were when it was last in the truth
  };

  void store(const world::Scene& truth, std::span<const world::Actor> ghosts);
  [[nodiscard]] const Snapshot& measured_now() const;
  [[nodiscard]] std::span<Belief> begun_beliefs() { return {beliefs_.data(), num_beliefs_}; }
  [[nodiscard]] Belief& belief_of(const world::Actor& actor);
  [[nodiscard]] Belief& free_place();
  void update(Belief& belief, const Snapshot& snapshot, const world::Actor& actor) const;
  [[nodiscard]] Errors draw(Belief& belief) const;
  void wander(Belief& belief) const;
  [[nodiscard]] bool within_view(const Snapshot& snapshot, const world::Actor& actor) const;
  void measure(Belief& belief, const world::Actor& actor, double time) const;
  void miss(Belief& belief) const;
  [[nodiscard]] world::Actor as_known(const Belief& belief, double time) const;

  scenario::PerceptionModel model_;
  std::uint64_t seed_;
  double kept_ = 0.0;                ///< share of an error that is left at the next look
  std::vector<Snapshot> snapshots_;  ///< a ring, as long as the latency
  std::size_t num_looks_ = 0;
  std::vector<Belief> beliefs_;  ///< room for max_actors
  std::size_t num_beliefs_ = 0;  ///< of them in use
};

}  // namespace saca::sim
