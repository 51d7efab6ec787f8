#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "saca/base/core/vec2.h"
#include "saca/base/world/scene.h"
#include "saca/lab/eval/likely_places.h"
#include "saca/lab/scenario/perception_model.h"
#include "saca/onboard/drivers/driver.h"
#include "saca/thinking/intent/motion.h"

namespace saca::eval {

/// A positive number that differs from driver to driver: its logarithm is normal.
struct Lognormal {
  double median = 1.0;  ///< > 0
  double log_sd = 0.0;  ///< >= 0
};

/// How drivers differ, before anything is seen of one.
///
/// Medians of the Intelligent Driver Model's parameters lie between those of its two standard sets:
/// table I of Treiber, Hennecke, Helbing, Phys. Rev. E 62 (2000) 1805 (time gap 1.6 s, acceleration
/// 0.73, comfortable deceleration 1.67 m/s^2, least gap 2 m), and table 11.2 of Treiber, Kesting,
/// Traffic Flow Dynamics, 2013 (1.0 s, 1.0, 1.5 m/s^2, 2 m). How widely they differ is an
/// assumption, and so is everything below that names no source.
struct DriverPrior {
  Lognormal desired_speed{1.05, 0.15};  ///< over the speed when it is first seen [-]
  Lognormal time_gap{1.3, 0.35};        ///< [s]
  Lognormal least_gap{2.0, 0.3};        ///< [m]
  Lognormal acceleration{0.85, 0.35};   ///< [m/s^2]
  Lognormal comfortable{1.6, 0.3};      ///< deceleration [m/s^2]
  /// What a driver does beyond the model: measured of vehicles that maintain (intent/motion.h).
  intent::OrnsteinUhlenbeck beyond = intent::MotionLaw{}.driving;

  /// Who brakes for a reason that the model does not know: how often that begins [1/s], and ends
  /// [1/s]; how hard [m/s^2], built up linearly within `braking_rise` [s].
  double braking_rate = 0.06;
  double braking_end_rate = 0.2;
  Lognormal braking{3.5, 0.5};
  double braking_rise = 1.0;

  /// How often a move to the side begins [1/s]. In NGSIM a lane is crossed every 78 s of driving
  /// (docs/traffic.md); the suites hold emergencies.
  double change_rate = 0.1;
  /// How long it takes [s]: 4.6 s on average with a standard deviation of 2.3 s. Source: Toledo,
  /// Zohar, Modeling duration of lane changes, Transportation Research Record 1999 (2007) 71.
  Lognormal change_time{4.11, 0.47};
  /// Share of the moves that end not in the middle of the next lane but anywhere within one and a
  /// half lanes.
  double elsewhere_share = 0.3;
  double wander = 0.05;  ///< of the place that it keeps in its lane, after 1 s [m]
  /// Who is none of these drivers: goes straight, its acceleration unknown (going_straight).
  double other_share = 0.05;
};

/// Predicts vehicles that follow a lane by a particle filter over their drivers.
///
/// A particle is one driver who may be at the wheel: its parameters of the Intelligent Driver
/// Model, whether it moves to the side (where to, since when, for how long) and whether it brakes
/// for a reason of its own, with place and speed. At each look a particle drives on; its weight is
/// multiplied by the likelihood of what is perceived, and where the weights have gathered on few
/// particles they are drawn anew in proportion to them (systematic resampling, parameters jittered
/// by 5 %); one in five is then begun afresh as at first sight, for what none of them has thought
/// of. To predict, all of them drive on, with what they may yet begin; six ways on are the
/// clusters of where they get to, and a seventh is that of who is none of these drivers.
///
/// Perception errs as an Ornstein-Uhlenbeck process, so its errors at successive looks are alike.
/// Given a particle's motion the error e_k is what is perceived less where the particle is, and
/// the likelihood is exact: e_k given e_k-1 is normal about rho e_k-1 with the variance
/// sd^2 (1 - rho^2), rho = exp(-dt / correlation time).
///
/// Afresh: Lenser, Veloso, Sensor resetting localization for poorly modelled mobile robots, ICRA
/// 2000. Sources: Gordon, Salmond, Smith, Novel approach to nonlinear/non-Gaussian Bayesian state
/// estimation, IEE Proceedings F 140 (1993) 107; over parameters of the Intelligent Driver Model:
/// Hoermann, Stumper, Dietmayer, Probabilistic long-term prediction for autonomous vehicles, IEEE
/// Intelligent Vehicles Symposium 2017.
///
/// Everybody else (on foot, on bicycles, across the lanes, at rest) goes straight at the measured
/// velocity (going_straight).
class ParticleFilter {
 public:
  static constexpr std::size_t num_particles = 500;
  static constexpr double step = 0.1;  ///< between looks that count [s]

  /// @param errors  how perception errs
  /// @param seed    of all that is drawn; each road user has draws of its own
  ParticleFilter(const scenario::PerceptionModel& errors, std::uint64_t seed,
                 const DriverPrior& prior = {});

  /// Watches one instant; call it at every look. Who has not been seen for 2 s is forgotten.
  void look(const world::Scene& scene);

  /// Where an actor of the scene of the last look will be; probabilities sum to 1.
  [[nodiscard]] LikelyPlaces places_of(const world::Scene& scene, const world::Actor& actor) const;

 private:
  struct Particle {
    double s = 0.0;      ///< along the road in its own direction [m]
    double speed = 0.0;  ///< [m/s], >= 0
    double keeps = 0.0;  ///< d that it keeps, or begins a move to the side from, to its left [m]
    double aside =
        0.0;  ///< way of the move to the side that is under way, to the left [m]; 0: none
    double aside_since = 0.0;    ///< [s]
    double aside_takes = 1.0;    ///< [s], > 0
    double braking = 0.0;        ///< [m/s^2], >= 0; 0: it does not
    double braking_since = 0.0;  ///< [s]
    double beyond = 0.0;         ///< acceleration beyond the model [m/s^2]
    drivers::DriverLaw law;
    Vec2 place_error;     ///< of what was perceived last, along and to the left [m]
    Vec2 speed_error;     ///< likewise [m/s]
    double weight = 0.0;  ///< of all particles sums to 1

    [[nodiscard]] double d() const;
    [[nodiscard]] double lateral_speed() const;
  };
  /// A body on the road as a driver sees it, in the driver's direction.
  struct Body {
    double s = 0.0, d = 0.0;  ///< of its centre [m]
    double speed = 0.0;       ///< along the road [m/s]
    double half_length = 0.0, half_width = 0.0;
  };
  /// What was measured, without having been carried on to now.
  struct Measurement {
    double time = 0.0;
    Vec2 p;  ///< s and d in the driver's direction [m]
    Vec2 v;  ///< along and to the left [m/s]
  };
  /// One road user under watch.
  struct RoadUser {
    world::ActorKind kind = world::ActorKind::car;
    std::uint8_t id = 0;
    double direction = 1.0;  ///< along the road, or -1 against it
    double half_length = 0.0, half_width = 0.0;
    double seen = 0.0;      ///< [s]
    double measured = 0.0;  ///< what the particles have seen last [s]
    std::mt19937_64 rng;
    std::vector<Particle> particles;
  };

  [[nodiscard]] RoadUser* find(const world::Actor& actor);
  [[nodiscard]] const RoadUser* find(const world::Actor& actor) const;
  [[nodiscard]] static std::vector<Body> bodies_about(const world::Scene& scene,
                                                      const world::Actor& actor, double direction);
  [[nodiscard]] static Measurement measured_of(const world::Scene& scene, const world::Actor& actor,
                                               double direction);
  [[nodiscard]] drivers::DriverLaw drawn_law(double speed, std::mt19937_64& rng) const;
  void begin_aside(Particle& particle, const world::Road& road, double direction,
                   std::mt19937_64& rng) const;
  /// Drivers as they may be when somebody is first seen; their weights sum to 1.
  [[nodiscard]] std::vector<Particle> at_sight(RoadUser& watched, const world::Road& road,
                                               const std::vector<Body>& bodies,
                                               const Measurement& measured,
                                               std::size_t count) const;
  /// What a particle follows: the nearest body in the lanes that it sweeps.
  [[nodiscard]] static drivers::Ahead ahead_of(const Particle& particle, const RoadUser& watched,
                                               const std::vector<Body>& bodies);
  void drive(Particle& particle, const RoadUser& watched, const world::Road& road,
             const std::vector<Body>& bodies, double dt, std::mt19937_64& rng) const;
  /// @return  whether any particle is near what was measured
  [[nodiscard]] bool weigh(RoadUser& watched, const Measurement& measured, double dt) const;
  /// Have the weights gathered on few particles?
  [[nodiscard]] static bool is_gathered(const RoadUser& watched);
  /// So many of its particles, each as often as its weight says (systematic resampling).
  static std::vector<Particle> systematic_draws(RoadUser& watched, std::size_t count);
  /// Moves one a little, so that those drawn several times differ.
  static void disperse(Particle& one, std::mt19937_64& rng);
  /// @param fresh  as at_sight: they take the place of as many
  static void resample(RoadUser& watched, const std::vector<Particle>& fresh);

  scenario::PerceptionModel errors_;
  std::uint64_t seed_;
  DriverPrior prior_;
  std::vector<RoadUser> watched_;
  double due_ = 0.0;  ///< the next look that counts [s]
};

}  // namespace saca::eval
