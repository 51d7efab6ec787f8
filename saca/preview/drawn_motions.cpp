#include "saca/preview/drawn_motions.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "saca/core/contract.h"
#include "saca/intent/line.h"

namespace saca::preview {
namespace {

using intent::Forecast;
using intent::Intention;
using world::Actor;
using world::Scene;
using world::Track;

constexpr double drift_share = 0.5;   // of draws of who surely moves sideways
constexpr double drift_speed = 0.25;  // [m/s] sideways: less is told apart from none ever less

/// Values in (0, 1), one for each draw, one in each of as many equal parts.
class Strata {
 public:
  Strata(std::size_t count, std::mt19937_64& rng) : order_(count) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {  // std::shuffle differs between libraries
      std::swap(order_[i - 1], order_[rng() % i]);
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

Intention drawn(const intent::IntentPosterior& posterior, double u) {
  Intention last = Intention::maintain;
  for (const Intention intention : intent::all_intentions) {
    const double p = posterior[static_cast<std::size_t>(intention)];
    if (p <= 0.0) {
      continue;
    }
    last = intention;
    u -= p;
    if (u < 0.0) {
      break;
    }
  }
  return last;
}

/// A track that is off by `errors` along its travel and across, in standard deviations of its
/// spread.
/// @param mean    poses at least
/// @param course  of who does not move yet [rad]
/// @param spread  world::Spread of pose k
/// @param aside   way to the left at pose k besides [m]
template <class SpreadAt, class Aside>
void displace(std::vector<Pose>& mean, Vec2 errors, double course, const SpreadAt& spread,
              const Aside& aside) {
  for (std::size_t k = 0; k < mean.size(); ++k) {
    // Poses before are displaced already; the way from here to the next is not.
    if (k + 1 < mean.size()) {
      const Vec2 way = mean[k + 1].p - mean[k].p;
      course = norm(way) > 1e-4 ? std::atan2(way.y, way.x) : course;
    }
    const world::Spread now = spread(k);
    mean[k].p =
        mean[k].p + rotated({errors.x * now.along_sd, aside(k) + errors.y * now.across_sd}, course);
  }
}

/// From how a road user is named: what differs between two forecasts is what was seen.
std::mt19937_64 rng_of(const Actor& actor) {
  return std::mt19937_64(256U * static_cast<unsigned>(actor.kind) + actor.id);
}

/// Without its change of lane.
Intention along_lane(Intention intention) {
  return intent::is_braking(intention) ? Intention::brake : Intention::maintain;
}

/// The motions of one road user in all draws.
class Draws {
 public:
  Draws(const Scene& scene, const Actor& actor, const intent::Belief& belief,
        const intent::MotionLaw& law, std::size_t count)
      : scene_(scene),
        actor_(actor),
        belief_(belief),
        law_(law),
        rng_(rng_of(actor)),
        intention_(count, rng_),
        along_(count, rng_),
        across_(count, rng_),
        drifts_(count, rng_),
        drift_ends_(count, rng_) {
    const bool may_drift = actor.kind != world::ActorKind::obstacle &&
                           !intent::is_walker(actor.kind) && norm(actor.v_W) > intent::rest_speed;
    if (may_drift) {
      lateral_ = intent::line_of(scene, actor).lateral;
      drift_probability_ = drift_share * (1.0 - std::exp(-std::pow(lateral_ / drift_speed, 2.0)));
    }
  }

  [[nodiscard]] Track track(std::size_t draw) {
    Intention intention = drawn(belief_.now(), intention_[draw]);
    const bool drifts = drifts_[draw] < drift_probability_;
    if (drifts) {
      intention = along_lane(intention);
    }
    Track track = forecast(intention).track;
    const double end = drifts ? longest_drift * drift_ends_[draw] : 0.0;
    const std::vector<world::Spread>& spread = forecast(intention).spread.at;
    displace(
        track.X_WA, {normal(along_[draw]), normal(across_[draw])},
        std::atan2(actor_.v_W.y, actor_.v_W.x), [&](std::size_t k) { return spread[k]; },
        [&](std::size_t k) {
          return lateral_ * std::min(end, static_cast<double>(k) * track.step);
        });
    return track;
  }

 private:
  const Forecast& forecast(Intention intention) {
    std::optional<Forecast>& known = forecasts_[static_cast<std::size_t>(intention)];
    if (!known) {
      known = intent::motion_under(scene_, actor_, intention, motion_horizon, law_);
    }
    return *known;
  }

  const Scene& scene_;
  const Actor& actor_;
  const intent::Belief& belief_;
  const intent::MotionLaw& law_;
  std::mt19937_64 rng_;
  Strata intention_;
  Strata along_;
  Strata across_;
  Strata drifts_;
  Strata drift_ends_;
  double lateral_ = 0.0;  ///< to the left of its lane [m/s]
  double drift_probability_ = 0.0;
  std::array<std::optional<Forecast>, intent::num_intentions> forecasts_;
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
    const Strata across(count, rng);
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
      displace(
          track.X_WA, {normal(along[draw]), normal(across[draw])}, course,
          [&](std::size_t k) {
            return spread_at(situation.spreads[i], mean.start + static_cast<double>(k) * mean.step);
          },
          [](std::size_t) { return 0.0; });
    }
  }
  return motions;
}

}  // namespace saca::preview
