#include "saca/lab/eval/shadow_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/scenario/motion.h"

namespace saca::eval {
namespace {

constexpr double braking_window = 0.5;     // [s]
constexpr double steering_half = 0.5;      // of its second [s]
constexpr double judged_step = 0.05;       // [s]
constexpr double hardest_tried = 12.0;     // above what tyres can do [m/s^2]
constexpr double deceleration_step = 0.1;  // [m/s^2]
constexpr double rounding_of_time = 1e-9;  // [s]

struct ReasonWords {
  ShadowReason reason;
  std::string_view name;
  std::string_view meaning;
  bool danger;
};

constexpr std::array<ReasonWords, 8> all_reasons{{
    {ShadowReason::driver_braked, "driver_braked", "the driver braked with 4 m/s^2 or more", true},
    {ShadowReason::driver_steered, "driver_steered", "the driver steered with 3 m/s^2 or more",
     true},
    {ShadowReason::track_ends, "track_ends",
     "who threatens was only just, or not much longer, recorded", false},
    {ShadowReason::other_braked, "other_braked", "the other braked with 4 m/s^2 or more", true},
    {ShadowReason::crash, "crash", "the bodies touch when normal driving is over", true},
    {ShadowReason::bodies_touch, "bodies_touch",
     "the bodies overlap, which is an error of the recording", false},
    {ShadowReason::braking_needed, "braking_needed",
     "only braking with 4 m/s^2 or more would have kept the bodies apart", true},
    {ShadowReason::nothing_needed, "nothing_needed", "less than 4 m/s^2 was needed and used",
     false},
}};

const ReasonWords& words_of(ShadowReason reason) {
  return all_reasons.at(static_cast<std::size_t>(reason));
}

double speed_at(const scenario::Recording& recording, double time) {
  const auto after = std::lower_bound(
      recording.begin(), recording.end(), time,
      [](const scenario::Sample& sample, double wanted) { return sample.time < wanted; });
  if (after == recording.begin()) {
    return recording.front().speed;
  }
  if (after == recording.end()) {
    return recording.back().speed;
  }
  const scenario::Sample& before = *(after - 1);
  const double share = (time - before.time) / (after->time - before.time);
  return before.speed + share * (after->speed - before.speed);
}

/// Hardest mean deceleration over braking_window, as far as there is a recording.
double hardest_deceleration(const scenario::Recording& recording, double time) {
  const double last = std::min(time + judged_for, recording.back().time) - braking_window;
  double hardest = 0.0;
  for (int k = 0;; ++k) {
    const double from = std::max(recording.front().time, time - braking_window) + k * judged_step;
    if (from > last + rounding_of_time) {
      return hardest;
    }
    hardest =
        std::max(hardest, (speed_at(recording, from) - speed_at(recording, from + braking_window)) /
                              braking_window);
  }
}

/// Largest second difference of the offset from the lane, over a second.
double hardest_steering(const scenario::Scenario& scenario, double recorded, double time) {
  const auto offset = [&](double at) {
    return world::to_lane(scenario.road, scenario::ego_at(scenario, at).X_WB).d;
  };
  double hardest = 0.0;
  for (int k = 0;; ++k) {
    const double middle = std::max(time, steering_half) + k * judged_step;
    if (middle > std::min(time + judged_for, recorded) - steering_half + rounding_of_time) {
      return hardest;
    }
    const double bend =
        offset(middle - steering_half) - 2.0 * offset(middle) + offset(middle + steering_half);
    hardest = std::max(hardest, std::abs(bend) / (steering_half * steering_half));
  }
}

/// The way that the driver took from a time on, by the metres made.
class RecordedWay {
 public:
  RecordedWay(const scenario::Scenario& scenario, double from, double to) {
    for (int k = 0;; ++k) {
      const double time = std::min(to, from + k * judged_step);
      const Pose X_WB = scenario::ego_at(scenario, time).X_WB;
      made_.push_back(poses_.empty() ? 0.0 : made_.back() + norm(X_WB.p - poses_.back().p));
      poses_.push_back(X_WB);
      if (time >= to) {
        return;
      }
    }
  }

  /// Beyond its end it goes on straight.
  [[nodiscard]] Pose at(double metres) const {
    if (metres >= made_.back()) {
      return poses_.back() * Pose{{metres - made_.back(), 0.0}, 0.0};
    }
    const auto after = std::upper_bound(made_.begin(), made_.end(), metres);
    const auto i = static_cast<std::size_t>(after - made_.begin());
    const double share = (metres - made_[i - 1]) / (made_[i] - made_[i - 1]);
    return between(poses_[i - 1], poses_[i], share);
  }

 private:
  std::vector<Pose> poses_;
  std::vector<double> made_;  ///< [m]
};

/// Everybody over the time that is judged.
struct TimeWindow {
  const world::Footprint& ego;
  const world::Footprint& other;
  std::vector<Pose> X_WO;  ///< of the other, judged_step apart
  RecordedWay way;
  double speed = 0.0;  ///< of the ego at the trigger [m/s]
};

bool is_avoided_by(double deceleration, const TimeWindow& judged) {
  for (std::size_t k = 0; k < judged.X_WO.size(); ++k) {
    const double t = static_cast<double>(k) * judged_step;
    const double braked = deceleration > 0.0 ? std::min(t, judged.speed / deceleration) : t;
    const double made = (judged.speed - 0.5 * deceleration * braked) * braked;
    const Pose X_WB = judged.way.at(made);
    if (world::separation(judged.ego, X_WB, judged.other, judged.X_WO[k]).distance <= 0.0) {
      return false;
    }
  }
  return true;
}

std::optional<double> needed_deceleration(const TimeWindow& judged) {
  const auto most = static_cast<int>(std::lround(hardest_tried / deceleration_step));
  for (int k = 0; k <= most; ++k) {
    if (is_avoided_by(k * deceleration_step, judged)) {
      return k * deceleration_step;
    }
  }
  return std::nullopt;
}

/// How near the bodies come while both are recorded.
struct Nearest {
  double gap = std::numeric_limits<double>::infinity();  ///< [m]
  std::optional<double> touch;                           ///< when they first do [s]
};

Nearest nearest_of(const scenario::Scenario& scenario, const TimeWindow& judged, double time,
                   double last) {
  Nearest nearest;
  for (std::size_t k = 0; k < judged.X_WO.size(); ++k) {
    const double t = time + static_cast<double>(k) * judged_step;
    if (k > 0 && t > last + rounding_of_time) {
      break;
    }
    const Pose X_WB = scenario::ego_at(scenario, t).X_WB;
    const double gap = world::separation(judged.ego, X_WB, judged.other, judged.X_WO[k]).distance;
    nearest.gap = std::min(nearest.gap, gap);
    if (gap <= 0.0 && !nearest.touch) {
      nearest.touch = t;
    }
  }
  return nearest;
}

ShadowReason reason_of_judgement(const ShadowJudgement& told, bool settled, bool crash) {
  if (told.driver_deceleration >= hard_braking) {
    return ShadowReason::driver_braked;
  }
  if (told.driver_lateral_acceleration >= hard_steering) {
    return ShadowReason::driver_steered;
  }
  if (!settled) {
    return ShadowReason::track_ends;
  }
  if (told.other_deceleration >= hard_braking) {
    return ShadowReason::other_braked;
  }
  if (told.least_gap <= 0.0) {
    return crash ? ShadowReason::crash : ShadowReason::bodies_touch;
  }
  return told.needed_deceleration.value_or(hardest_tried) >= hard_braking
             ? ShadowReason::braking_needed
             : ShadowReason::nothing_needed;
}

}  // namespace

bool is_settled(const scenario::ScenarioActor& actor, double time, const Settling& settling) {
  const auto* recording = std::get_if<scenario::Recording>(&actor.motion);
  if (recording == nullptr) {
    return true;
  }
  const double first = recording->front().time;
  return (first <= 0.0 || time - first >= settling.after_start) &&
         recording->back().time - time >= settling.before_end;
}

std::string_view name(ShadowReason reason) {
  return words_of(reason).name;
}

std::string_view meaning(ShadowReason reason) {
  return words_of(reason).meaning;
}

bool is_danger(ShadowReason reason) {
  return words_of(reason).danger;
}

std::optional<ShadowReason> shadow_reason_from(std::string_view name) {
  for (const ReasonWords& words : all_reasons) {
    if (words.name == name) {
      return words.reason;
    }
  }
  return std::nullopt;
}

std::size_t actor_index(const scenario::Scenario& scenario, const world::Actor& actor) {
  const auto found =
      std::find_if(scenario.actors.begin(), scenario.actors.end(),
                   [&](const auto& one) { return one.kind == actor.kind && one.id == actor.id; });
  expects(found != scenario.actors.end(), "an actor of the scenario");
  return static_cast<std::size_t>(found - scenario.actors.begin());
}

ShadowJudgement judged(const scenario::Scenario& scenario, const world::Footprint& ego,
                       std::size_t actor, double time, const ShadowWindow& window) {
  expects(actor < scenario.actors.size(), "actor < number of actors");
  const auto* recorded = std::get_if<scenario::Recording>(&scenario.ego);
  expects(recorded != nullptr && recorded->size() >= 2, "the ego has a recording");
  const scenario::Recording& drive = *recorded;
  const scenario::ScenarioActor& other = scenario.actors[actor];
  const double end = std::max(time, std::min(time + judged_for, drive.back().time));
  TimeWindow around{ego,
                    other.footprint,
                    {},
                    RecordedWay(scenario, time, end),
                    scenario::ego_at(scenario, time).v_B.x};
  const auto num_steps = static_cast<int>(std::lround(judged_for / judged_step));
  for (int k = 0; k <= num_steps; ++k) {
    around.X_WO.push_back(scenario::actor_pose(scenario, actor, time + k * judged_step, {}));
  }
  ShadowJudgement told;
  double seen_until = end;
  told.driver_deceleration = hardest_deceleration(drive, time);
  if (const auto* recording = std::get_if<scenario::Recording>(&other.motion)) {
    told.other_deceleration = hardest_deceleration(*recording, time);
    seen_until = recording->back().time;
  }
  told.driver_lateral_acceleration = hardest_steering(scenario, drive.back().time, time);
  told.needed_deceleration = needed_deceleration(around);
  const Nearest nearest = nearest_of(scenario, around, time, std::min(end, seen_until));
  told.least_gap = nearest.gap;
  told.reason =
      reason_of_judgement(told, is_settled(other, time, window.settling),
                          nearest.touch && window.until && *nearest.touch > *window.until);
  return told;
}

}  // namespace saca::eval
