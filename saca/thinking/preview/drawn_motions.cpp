#include "saca/thinking/preview/drawn_motions.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/likely_motions.h"

namespace saca::preview {
namespace {

using intent::Forecast;
using world::Actor;
using world::Scene;
using world::Track;

// Of a lattice that fills three dimensions evenly: the ways on in equal steps, and with each the
// errors by 1 / g and 1 / g^2, where g^3 = g + 1.
constexpr double along_step = 0.7548776662466927;
constexpr double across_step = 0.5698402909980532;

/// Values in (0, 1), one for each draw, one in each of as many equal parts.
class Strata {
 public:
  /// In a random order.
  Strata(std::size_t count, std::mt19937_64& rng) : order_(count) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {  // std::shuffle differs between libraries
      std::swap(order_[i - 1], order_[rng() % i]);
    }
  }
  /// Spread evenly over those of another: in the order of the multiples of `step`, an irrational
  /// number, from some beginning on, in shares of 1.
  Strata(const Strata& other, double step, std::mt19937_64& rng) : order_(other.order_.size()) {
    const double begin = static_cast<double>(rng()) / static_cast<double>(std::mt19937_64::max());
    std::vector<std::pair<double, std::size_t>> places;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const double multiple = begin + step * static_cast<double>(k);
      places.emplace_back(multiple - std::floor(multiple), k);
    }
    std::sort(places.begin(), places.end());
    std::vector<std::size_t> rank(order_.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      rank[places[i].second] = i;
    }
    for (std::size_t draw = 0; draw < order_.size(); ++draw) {
      order_[draw] = rank[other.order_[draw]];
    }
  }
  [[nodiscard]] double operator[](std::size_t draw) const {
    return (static_cast<double>(order_[draw]) + 0.5) / static_cast<double>(order_.size());
  }

 private:
  std::vector<std::size_t> order_;
};

double normal(double probability) {
  return boost::math::quantile(boost::math::normal(), probability);
}

/// A track that is off by `errors` along its travel and across, in standard deviations of its
/// spread.
/// @param mean    poses at least
/// @param course  of who does not move yet [rad]
/// @param spread  world::Spread of pose k
template <class SpreadAt>
void displace(std::vector<Pose>& mean, Vec2 errors, double course, const SpreadAt& spread) {
  for (std::size_t k = 0; k < mean.size(); ++k) {
    // Poses before are displaced already; the way from here to the next is not.
    if (k + 1 < mean.size()) {
      const Vec2 way = mean[k + 1].p - mean[k].p;
      course = norm(way) > 1e-4 ? std::atan2(way.y, way.x) : course;
    }
    const world::Spread now = spread(k);
    mean[k].p = mean[k].p + rotated({errors.x * now.along_sd, errors.y * now.across_sd}, course);
  }
}

/// From how a road user is named: what differs between two forecasts is what was seen.
std::mt19937_64 rng_of(const Actor& actor) {
  return std::mt19937_64(256U * static_cast<unsigned>(actor.kind) + actor.id);
}

/// The motions of one road user in all draws.
class Draws {
 public:
  Draws(const Scene& scene, const Actor& actor, const intent::Belief& belief,
        const intent::MotionLaw& law, std::size_t count)
      : scene_(scene),
        actor_(actor),
        law_(law),
        motions_(intent::likely_motions(scene, actor, belief)),
        forecasts_(motions_.size()),
        rng_(rng_of(actor)),
        which_(count, rng_),
        along_(which_, along_step, rng_),
        across_(which_, across_step, rng_) {}

  [[nodiscard]] Track track(std::size_t draw) {
    const Forecast& drawn = forecast(which_[draw]);
    Track track = drawn.track;
    displace(track.X_WA, {normal(along_[draw]), normal(across_[draw])},
             std::atan2(actor_.v_W.y, actor_.v_W.x),
             [&](std::size_t k) { return drawn.spread.at[k]; });
    return track;
  }

 private:
  /// Of the motion up to which the probabilities sum to u.
  const Forecast& forecast(double u) {
    std::size_t i = 0;
    for (; i + 1 < motions_.size() && u >= motions_[i].probability; ++i) {
      u -= motions_[i].probability;
    }
    if (!forecasts_[i]) {
      forecasts_[i] = intent::forecast_of(motions_[i], scene_, actor_, motion_horizon, law_);
    }
    return *forecasts_[i];
  }

  const Scene& scene_;
  const Actor& actor_;
  const intent::MotionLaw& law_;
  std::vector<intent::LikelyMotion> motions_;
  std::vector<std::optional<Forecast>> forecasts_;  ///< of those that are drawn
  std::mt19937_64 rng_;
  Strata which_;
  Strata along_;
  Strata across_;
};

}  // namespace

std::vector<JointMotion> drawn_motions(const Scene& scene, const intent::Beliefs& beliefs,
                                       const intent::MotionLaw& law, std::size_t count) {
  expects(beliefs.size() == scene.actors.size(), "one belief per actor");
  expects(count >= 1, "at least one draw");
  std::vector<JointMotion> motions(count,
                                   {.probability = 1.0 / static_cast<double>(count), .tracks = {}});
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    Draws draws(scene, scene.actors[i], beliefs[i], law, count);
    for (std::size_t k = 0; k < count; ++k) {
      motions[k].tracks.push_back(draws.track(k));
    }
  }
  return motions;
}

std::vector<JointMotion> drawn_motions(const Situation& situation, std::size_t count) {
  const Scene& scene = situation.scene_at_trigger;
  expects(situation.tracks.size() == scene.actors.size() &&
              situation.spreads.size() == scene.actors.size(),
          "one track and one spread per actor");
  expects(count >= 1, "at least one draw");
  std::vector<JointMotion> motions(count,
                                   {.probability = 1.0 / static_cast<double>(count), .tracks = {}});
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const Actor& actor = scene.actors[i];
    std::mt19937_64 rng = rng_of(actor);
    const Strata along(count, rng);
    const Strata across(along, along_step, rng);
    Track mean{.start = scene.time, .step = intent::motion_step, .X_WA = {}};
    const long last = std::lround(motion_horizon / mean.step);
    for (long k = 0; k <= last; ++k) {
      const double time = mean.start + static_cast<double>(k) * mean.step;
      mean.X_WA.push_back(world::pose_at(situation.tracks[i], time));
    }
    const bool moves = norm(actor.v_W) > intent::rest_speed;
    const double course = moves ? std::atan2(actor.v_W.y, actor.v_W.x) : actor.X_WA.yaw;
    for (std::size_t draw = 0; draw < count; ++draw) {
      Track& track = motions[draw].tracks.emplace_back(mean);
      displace(track.X_WA, {normal(along[draw]), normal(across[draw])}, course, [&](std::size_t k) {
        return spread_at(situation.spreads[i], mean.start + static_cast<double>(k) * mean.step);
      });
    }
  }
  return motions;
}

}  // namespace saca::preview
