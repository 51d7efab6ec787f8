// Longer than 400 lines: one filter: how particles begin, move, are weighed and are drawn anew,
// which is one law of motion seen from four sides.
#include "saca/lab/eval/particle_filter.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/quintic.h"
#include "saca/lab/eval/way_clusters.h"
#include "saca/lab/scenario/chance.h"
#include "saca/thinking/intent/line.h"
#include "saca/thinking/intent/vru.h"

namespace saca::eval {
namespace {

using world::Actor;
using world::Road;
using world::Scene;

constexpr double time_rounding = 1e-6;   // [s]: times are sums of steps
constexpr double forgotten_after = 2.0;  // [s]
constexpr std::size_t num_fresh = ParticleFilter::num_particles / 5;  // fitted (docs/forecast.md)
// What a particle's motion is rougher than the road user's: no perception is thought to be better.
constexpr double least_place_sd = 0.06;  // [m]
constexpr double least_speed_sd = 0.1;   // [m/s]
constexpr double hardest_braking = 8.0;  // [m/s^2], as usual_driver's

double normal(std::mt19937_64& rng) {
  return std::normal_distribution<double>()(rng);
}

double uniform(std::mt19937_64& rng) {
  return std::uniform_real_distribution<double>()(rng);
}

double drawn(const Lognormal& law, std::mt19937_64& rng) {
  return law.median * std::exp(law.log_sd * normal(rng));
}

/// Begins within dt what begins with this rate.
bool happens(double rate, double dt, std::mt19937_64& rng) {
  return uniform(rng) < -std::expm1(-rate * dt);
}

bool follows_a_lane(const Scene& scene, const Actor& actor) {
  return actor.kind != world::ActorKind::obstacle && !intent::is_vru(actor.kind) &&
         norm(actor.v_W) >= intent::rest_speed && intent::line_of(scene, actor).along_lane;
}

/// Its course along the road: 1, or -1 against it.
double direction_of(const Scene& scene, const Actor& actor) {
  const double course = std::atan2(actor.v_W.y, actor.v_W.x);
  return std::cos(world::to_lane(scene.road, {actor.X_WA.p, course}).heading) < 0.0 ? -1.0 : 1.0;
}

/// Road in the direction of somebody's travel: from `first` on the right to `second` on the left.
std::pair<double, double> edges(const Road& road, double direction) {
  return direction > 0.0 ? std::pair(road.right_edge, road.left_edge)
                         : std::pair(-road.left_edge, -road.right_edge);
}

}  // namespace

double ParticleFilter::Particle::d() const {
  return keeps + aside * quintic(aside_since / aside_takes);
}

double ParticleFilter::Particle::lateral_speed() const {
  return aside * quintic_slope(aside_since / aside_takes) / aside_takes;
}

ParticleFilter::ParticleFilter(const scenario::PerceptionModel& errors, std::uint64_t seed,
                               const DriverPrior& prior)
    : errors_(errors), seed_(seed), prior_(prior) {}

ParticleFilter::RoadUser* ParticleFilter::find(const Actor& actor) {
  const auto found = std::find_if(watched_.begin(), watched_.end(), [&](const RoadUser& one) {
    return one.kind == actor.kind && one.id == actor.id;
  });
  return found == watched_.end() ? nullptr : &*found;
}

const ParticleFilter::RoadUser* ParticleFilter::find(const Actor& actor) const {
  const auto found = std::find_if(watched_.begin(), watched_.end(), [&](const RoadUser& one) {
    return one.kind == actor.kind && one.id == actor.id;
  });
  return found == watched_.end() ? nullptr : &*found;
}

std::vector<ParticleFilter::Body> ParticleFilter::bodies_about(const Scene& scene,
                                                               const Actor& actor,
                                                               double direction) {
  std::vector<Body> bodies;
  const auto add = [&](const Pose& X_WA, Vec2 v_W, const world::Footprint& footprint) {
    const world::LanePose at = world::to_lane(scene.road, X_WA);
    const double lane_yaw = X_WA.yaw - at.heading;
    const Vec2 half = world::half_axes(footprint);
    const double c = std::abs(std::cos(at.heading));
    const double s = std::abs(std::sin(at.heading));
    bodies.push_back({direction * at.s, direction * at.d, direction * rotated(v_W, -lane_yaw).x,
                      c * half.x + s * half.y, s * half.x + c * half.y});
  };
  for (const Actor& other : scene.actors) {
    if (other.kind != actor.kind || other.id != actor.id) {
      add(other.X_WA, other.v_W, other.footprint);
    }
  }
  add(scene.ego.X_WB, rotated(scene.ego.v_B, scene.ego.X_WB.yaw), scene.ego_footprint);
  return bodies;
}

ParticleFilter::Measurement ParticleFilter::measured_of(const Scene& scene, const Actor& actor,
                                                        double direction) {
  // What is perceived was carried on from its measurement at constant velocity and turning rate.
  const double turned = actor.yaw_rate * actor.age;
  const Vec2 v_W = rotated(actor.v_W, -turned);
  const Vec2 p_W = actor.X_WA.p - actor.age * rotated(actor.v_W, -0.5 * turned);
  const world::LanePose at = world::to_lane(scene.road, {p_W, 0.0});
  const Vec2 v_L = rotated(v_W, at.heading);  // a yaw of 0 has this heading against the lane
  return {scene.time - actor.age, direction * Vec2{at.s, at.d}, direction * v_L};
}

drivers::DriverLaw ParticleFilter::drawn_law(double speed, std::mt19937_64& rng) const {
  drivers::DriverLaw law;
  law.desired_speed = std::max(1.0, speed) * drawn(prior_.desired_speed, rng);
  law.time_gap = drawn(prior_.time_gap, rng);
  law.least_gap = drawn(prior_.least_gap, rng);
  law.acceleration = drawn(prior_.acceleration, rng);
  law.comfortable = drawn(prior_.comfortable, rng);
  law.hardest = hardest_braking;
  return law;
}

void ParticleFilter::begin_aside(Particle& particle, const Road& road, double direction,
                                 std::mt19937_64& rng) const {
  const double width = road.lane_width;
  const double side = uniform(rng) < 0.5 ? 1.0 : -1.0;
  const double here = particle.d();
  const bool elsewhere = uniform(rng) < prior_.elsewhere_share;
  const double anywhere = 1.5 * width * uniform(rng);
  const auto end_to = [&](double to) {
    return elsewhere ? here + to * anywhere : width * (std::round(here / width) + to);
  };
  const auto [right, left] = edges(road, direction);
  double end = end_to(side);
  if (end > left || end < right) {
    end = end_to(-side);
  }
  particle.aside_takes = drawn(prior_.change_time, rng);
  if (end <= left && end >= right) {
    particle.keeps = here;
    particle.aside = end - here;
    particle.aside_since = 0.0;
  }
}

std::vector<ParticleFilter::Particle> ParticleFilter::at_sight(RoadUser& watched, const Road& road,
                                                               const std::vector<Body>& bodies,
                                                               const Measurement& measured,
                                                               std::size_t count) const {
  std::mt19937_64& rng = watched.rng;
  const double place_sd = std::hypot(errors_.position_sd, least_place_sd);
  const double speed_sd = std::hypot(errors_.velocity_sd, least_speed_sd);
  // As often as not a move to the side is under way, which is far oftener than it is likely: so
  // that there are particles for what is seen. Weights make up for it.
  constexpr double tried_aside = 0.5;
  const double mean_time = prior_.change_time.median *
                           std::exp(0.5 * prior_.change_time.log_sd * prior_.change_time.log_sd);
  const double is_aside = prior_.change_rate * mean_time / (1.0 + prior_.change_rate * mean_time);
  const double brakes = prior_.braking_rate / (prior_.braking_rate + prior_.braking_end_rate);
  std::vector<Particle> particles(count);
  double sum = 0.0;
  for (Particle& one : particles) {
    one.place_error = {place_sd * normal(rng), place_sd * normal(rng)};
    one.speed_error.x = speed_sd * normal(rng);
    one.s = measured.p.x - one.place_error.x;
    one.keeps = measured.p.y - one.place_error.y;
    one.speed = std::max(0.0, measured.v.x - one.speed_error.x);
    one.law = drawn_law(one.speed, rng);
    one.beyond = prior_.beyond.sd * normal(rng);
    one.weight = (1.0 - is_aside) / (1.0 - tried_aside);
    if (uniform(rng) < tried_aside) {
      one.weight = is_aside / tried_aside;
      begin_aside(one, road, watched.direction, rng);
      one.aside_since = one.aside_takes * uniform(rng);
      one.keeps -= one.d() - one.keeps;  // so that it is now where it is
    }
    if (uniform(rng) < brakes) {
      one.braking = drawn(prior_.braking, rng);
      one.braking_since = prior_.braking_rise * uniform(rng);
    }
    // Who keeps less than the model's gap when it is first seen is content with it.
    one.law = drivers::content_with(one.law, one.speed, ahead_of(one, watched, bodies).gap);
    one.speed_error.y = measured.v.y - one.lateral_speed();
    one.weight *= std::exp(-0.5 * std::pow(one.speed_error.y / speed_sd, 2.0));
    sum += one.weight;
  }
  for (Particle& one : particles) {
    one.weight = sum > 0.0 ? one.weight / sum : 1.0 / static_cast<double>(count);
  }
  return particles;
}

drivers::Ahead ParticleFilter::ahead_of(const Particle& particle, const RoadUser& watched,
                                        const std::vector<Body>& bodies) {
  const double here = particle.d();
  const double end = particle.keeps + particle.aside;
  const double low = std::min(here, end) - watched.half_width;
  const double high = std::max(here, end) + watched.half_width;
  drivers::Ahead ahead;
  for (const Body& body : bodies) {
    constexpr double comes_towards = -1.0;  // [m/s]: nobody is followed who does
    const double gap = body.s - body.half_length - particle.s - watched.half_length;
    if (body.s > particle.s && gap < ahead.gap && body.speed > comes_towards &&
        body.d + body.half_width > low && body.d - body.half_width < high) {
      ahead = {gap, body.speed};
    }
  }
  return ahead;
}

void ParticleFilter::drive(Particle& particle, const RoadUser& watched, const Road& road,
                           const std::vector<Body>& bodies, double dt, std::mt19937_64& rng) const {
  const drivers::Ahead ahead = ahead_of(particle, watched, bodies);
  const double kept = std::exp(-dt / prior_.beyond.time);
  particle.beyond =
      kept * particle.beyond + prior_.beyond.sd * std::sqrt(1.0 - kept * kept) * normal(rng);
  double acceleration = std::clamp(drivers::idm_acceleration(particle.law, particle.speed, ahead),
                                   -hardest_braking, hardest_braking) +
                        particle.beyond;
  if (particle.braking > 0.0) {
    particle.braking_since += dt;
    acceleration =
        std::min(acceleration,
                 -particle.braking * std::min(1.0, particle.braking_since / prior_.braking_rise));
    if (happens(prior_.braking_end_rate, dt, rng)) {
      particle.braking = 0.0;
    }
  } else if (happens(prior_.braking_rate, dt, rng)) {
    particle.braking = drawn(prior_.braking, rng);
    particle.braking_since = 0.0;
  }
  const double before = particle.speed;
  particle.speed = std::max(0.0, before + acceleration * dt);
  const double scale = 1.0 - road.curvature * watched.direction * particle.d();
  particle.s += 0.5 * (before + particle.speed) * dt / scale;
  particle.keeps += prior_.wander * std::sqrt(dt) * normal(rng);
  if (particle.aside != 0.0) {
    particle.aside_since += dt;
    if (particle.aside_since >= particle.aside_takes) {
      particle.keeps += particle.aside;
      particle.aside = 0.0;
    }
  } else if (happens(prior_.change_rate, dt, rng)) {
    begin_aside(particle, road, watched.direction, rng);
  }
}

bool ParticleFilter::weigh(RoadUser& watched, const Measurement& measured, double dt) const {
  const double kept =
      errors_.correlation_time > 0.0 ? std::exp(-dt / errors_.correlation_time) : 0.0;
  const double fresh = std::sqrt(1.0 - kept * kept);
  const double place_sd = std::hypot(fresh * errors_.position_sd, least_place_sd);
  const double speed_sd = std::hypot(fresh * errors_.velocity_sd, least_speed_sd);
  std::vector<double> log_likelihood;
  log_likelihood.reserve(watched.particles.size());
  for (Particle& one : watched.particles) {
    const Vec2 place_error = measured.p - Vec2{one.s, one.d()};
    const Vec2 speed_error = measured.v - Vec2{one.speed, one.lateral_speed()};
    const Vec2 place = (1.0 / place_sd) * (place_error - kept * one.place_error);
    const Vec2 speed = (1.0 / speed_sd) * (speed_error - kept * one.speed_error);
    log_likelihood.push_back(-0.5 * (dot(place, place) + dot(speed, speed)));
    one.place_error = place_error;
    one.speed_error = speed_error;
  }
  const double best = *std::max_element(log_likelihood.begin(), log_likelihood.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < watched.particles.size(); ++i) {
    watched.particles[i].weight *= std::exp(log_likelihood[i] - best);
    sum += watched.particles[i].weight;
  }
  constexpr double lost = -20.0;  // the nearest is more than 6 standard deviations off
  if (best < lost || sum <= 0.0) {
    return false;
  }
  for (Particle& one : watched.particles) {
    one.weight /= sum;
  }
  return true;
}

bool ParticleFilter::is_gathered(const RoadUser& watched) {
  double squares = 0.0;
  for (const Particle& one : watched.particles) {
    squares += one.weight * one.weight;
  }
  return squares * num_particles >= 2.0;  // they count for half of their number or less
}

std::vector<ParticleFilter::Particle> ParticleFilter::systematic_draws(RoadUser& watched,
                                                                       std::size_t count) {
  std::vector<Particle> chosen;
  chosen.reserve(num_particles);
  const double step_of_sum = 1.0 / static_cast<double>(count);
  const double first = uniform(watched.rng) * step_of_sum;
  double sum = 0.0;
  for (const Particle& one : watched.particles) {
    sum += one.weight;
    while (chosen.size() < count &&
           first + static_cast<double>(chosen.size()) * step_of_sum < sum) {
      chosen.push_back(one);
    }
  }
  while (chosen.size() < count) {  // rounding
    chosen.push_back(watched.particles.back());
  }
  return chosen;
}

void ParticleFilter::disperse(Particle& one, std::mt19937_64& rng) {
  constexpr double jitter = 0.05;        // of the logarithm of a parameter
  constexpr double aside_jitter = 0.05;  // [m]
  constexpr double place_jitter = 0.03;  // [m]
  constexpr double speed_jitter = 0.03;  // [m/s]
  for (double* each : {&one.law.desired_speed, &one.law.time_gap, &one.law.least_gap,
                       &one.law.acceleration, &one.law.comfortable, &one.braking}) {
    *each *= std::exp(jitter * normal(rng));
  }
  if (one.aside != 0.0) {
    const double here = one.d();
    const double share = one.aside_since / one.aside_takes;
    one.aside += aside_jitter * normal(rng);
    one.aside_takes *= std::exp(jitter * normal(rng));
    one.aside_since = share * one.aside_takes;
    one.keeps += here - one.d();
  }
  const Vec2 moved{place_jitter * normal(rng), place_jitter * normal(rng)};
  one.s += moved.x;
  one.keeps += moved.y;
  one.place_error = one.place_error - moved;
  const double faster = std::max(-one.speed, speed_jitter * normal(rng));
  one.speed += faster;
  one.speed_error.x -= faster;
}

void ParticleFilter::resample(RoadUser& watched, const std::vector<Particle>& fresh) {
  const double each_weight = 1.0 / num_particles;
  std::vector<Particle> chosen = systematic_draws(watched, num_particles - fresh.size());
  for (Particle& one : chosen) {
    one.weight = each_weight;
    disperse(one, watched.rng);
  }
  for (Particle one : fresh) {
    one.weight *= static_cast<double>(fresh.size()) * each_weight;
    chosen.push_back(one);
  }
  watched.particles = std::move(chosen);
}

void ParticleFilter::look(const Scene& scene) {
  if (scene.time < due_ - time_rounding) {
    return;
  }
  due_ = scene.time + step;
  for (const Actor& actor : scene.actors) {
    if (!follows_a_lane(scene, actor)) {
      continue;
    }
    const double direction = direction_of(scene, actor);
    RoadUser* watched = find(actor);
    if (watched == nullptr) {
      const std::uint64_t name = (static_cast<std::uint64_t>(actor.kind) << 8U) | actor.id;
      const Vec2 half = world::half_axes(actor.footprint);
      watched_.push_back({.kind = actor.kind,
                          .id = actor.id,
                          .half_length = half.x,
                          .half_width = half.y,
                          .rng = scenario::generator(seed_, name),
                          .particles = {}});
      watched = &watched_.back();
    }
    watched->seen = scene.time;
    const Measurement measured = measured_of(scene, actor, direction);
    const std::vector<Body> bodies = bodies_about(scene, actor, direction);
    if (watched->particles.empty() || watched->direction != direction) {
      watched->direction = direction;
      watched->measured = measured.time;
      watched->particles = at_sight(*watched, scene.road, bodies, measured, num_particles);
      continue;
    }
    const double dt = measured.time - watched->measured;
    if (dt < time_rounding) {
      continue;  // nothing new
    }
    for (Particle& one : watched->particles) {
      drive(one, *watched, scene.road, bodies, dt, watched->rng);
    }
    watched->measured = measured.time;
    if (!weigh(*watched, measured, dt)) {
      watched->particles = at_sight(*watched, scene.road, bodies, measured, num_particles);
    } else if (is_gathered(*watched)) {
      const auto fresh = at_sight(*watched, scene.road, bodies, measured, num_fresh);
      resample(*watched, fresh);
    }
  }
  std::erase_if(watched_,
                [&](const RoadUser& one) { return one.seen < scene.time - forgotten_after; });
}

LikelyPlaces ParticleFilter::places_of(const Scene& scene, const Actor& actor) const {
  const RoadUser* const watched = find(actor);
  if (watched == nullptr || watched->seen < scene.time - step - time_rounding ||
      !follows_a_lane(scene, actor)) {
    return going_straight(actor);
  }
  std::mt19937_64 rng = watched->rng;
  std::vector<Particle> particles = watched->particles;
  std::vector<Body> bodies = bodies_about(scene, actor, watched->direction);
  std::vector<SampledWay> ways(particles.size());
  std::vector<double> weights(particles.size());
  std::transform(particles.begin(), particles.end(), weights.begin(),
                 [](const Particle& one) { return one.weight; });
  double now = watched->measured;
  const auto drive_until = [&](double time) {
    while (now < time - time_rounding) {
      const double dt = std::min(step, time - now);
      for (Particle& one : particles) {
        drive(one, *watched, scene.road, bodies, dt, rng);
      }
      if (now >= scene.time - time_rounding) {
        for (Body& body : bodies) {
          body.s += dt * body.speed;
        }
      }
      now += dt;
    }
  };
  drive_until(scene.time);
  for (std::size_t k = 0; k < forecast_times.size(); ++k) {
    drive_until(scene.time + forecast_times[k]);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      ways[i][k] = {particles[i].s, particles[i].d()};
    }
  }
  LikelyPlaces places = clustered_places(ways, weights, scene.road, watched->direction);
  const LikelyPlaces straight = going_straight(actor);
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (LikelyPlace& one : places[k]) {
      one.probability *= 1.0 - prior_.other_share;
    }
    places[k].push_back(straight[k].front());
    places[k].back().probability = prior_.other_share;
  }
  return places;
}

}  // namespace saca::eval
