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
        rng_(256U * static_cast<unsigned>(actor.kind) + actor.id),
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
    const double z_along = normal(along_[draw]);
    const double z_across = normal(across_[draw]);
    const std::vector<world::Spread>& spread = forecast(intention).spread.at;
    const std::vector<Pose>& mean = forecast(intention).track.X_WA;
    double course = std::atan2(actor_.v_W.y, actor_.v_W.x);
    for (std::size_t k = 0; k < mean.size(); ++k) {
      const Vec2 way = mean[std::min(k + 1, mean.size() - 1)].p - mean[k].p;
      if (norm(way) > 1e-4) {
        course = std::atan2(way.y, way.x);
      }
      const double drift = lateral_ * std::min(end, static_cast<double>(k) * track.step);
      track.X_WA[k].p =
          mean[k].p +
          rotated({z_along * spread[k].along_sd, drift + z_across * spread[k].across_sd}, course);
    }
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

}  // namespace saca::preview
