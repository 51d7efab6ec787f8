#include "saca/thinking/preview/follower_answers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::preview {
namespace {

using drivers::Ahead;
using drivers::LaneDriver;
using drivers::Present;
using world::Actor;
using world::Scene;
using world::Track;

/// Do the first `num` rest from the step before this one to the step after it?
bool stand_at(std::span<const Track> tracks, std::size_t num, std::size_t step) {
  return std::all_of(tracks.begin(), tracks.begin() + static_cast<std::ptrdiff_t>(num),
                     [&](const Track& track) {
                       const auto& poses = track.X_WA;
                       return poses[step - 1] == poses[step] && poses[step] == poses[step + 1];
                     });
}

/// At each follower's begin, as let_react has it: content with the gap to whom it looks at.
std::vector<LaneDriver> drivers_of(const Scene& scene, const reflex::Followers& followers,
                                   double step) {
  std::array<Present, world::max_actors + 1> now;
  std::size_t num = 0;
  now[num++] = drivers::present(scene.road, scene.ego_footprint, scene.ego.X_WB,
                                rotated(scene.ego.v_B, scene.ego.X_WB.yaw));
  std::vector<LaneDriver> drivers;
  for (const std::size_t follower : followers) {
    const Actor& actor = scene.actors[follower];
    const drivers::DriverLaw law = reflex::content_follower(scene, actor, {now.data(), num}, step);
    drivers.emplace_back(scene.road, actor.footprint, actor.X_WA,
                         drivers::Driver(law, norm(actor.v_W), scene.grip, step));
    now[num++] = drivers::present(scene.road, actor.footprint, actor.X_WA, actor.v_W);
  }
  return drivers;
}

}  // namespace

FollowerAnswers::FollowerAnswers(const Scene& scene, double until, double step)
    : scene_(scene),
      followers_(reflex::followers_of(scene)),
      step_(step),
      num_steps_(
          static_cast<std::size_t>(std::ceil(std::max(0.0, until - scene.time) / step - 1e-9))),
      drivers_(drivers_of(scene, followers_, step)) {}

/// In so many steps at least the ego's places and velocities are the same.
std::size_t FollowerAnswers::same_steps(const Track& a, const Track& b) const {
  if (a.start != b.start || a.step != b.step) {
    return 0;
  }
  const auto end = std::mismatch(a.X_WA.begin(), a.X_WA.end(), b.X_WA.begin(), b.X_WA.end());
  if (end.first == a.X_WA.end() && end.second == b.X_WA.end()) {
    return num_steps_;
  }
  // A velocity is that up to the next pose; half a pose more is left for what rounding does.
  const double poses = static_cast<double>(end.first - a.X_WA.begin()) - 2.5;
  const double steps = (a.start + poses * a.step - scene_.time) / step_;
  return static_cast<std::size_t>(std::clamp(steps, 0.0, static_cast<double>(num_steps_)));
}

/// Works out what one follower does from a step on, as drivers::reacting_track has it.
void FollowerAnswers::go_on(Answer& answer, std::size_t follower, std::size_t step) const {
  LaneDriver driver = drivers_[follower];
  Track& track = answer.tracks[follower];
  std::vector<Ahead>& seen = answer.seen[follower];
  seen.resize(step);
  for (const Ahead& ahead : seen) {
    driver.advance(ahead);
  }
  track.start = scene_.time;
  track.step = step_;
  track.X_WA.resize(step + 1);
  track.X_WA.front() = scene_.actors[followers_[follower]].X_WA;
  const double rests_from = world::end_time(answer.X_WB);
  bool stands = false;  // since the step before
  std::array<Present, world::max_actors + 1> now;
  for (std::size_t k = step; k < num_steps_; ++k) {
    const double time = scene_.time + static_cast<double>(k) * step_;
    if (stands && time - step_ > rests_from && stand_at(answer.tracks, follower, k)) {
      seen.push_back(seen.back());  // nobody has moved
    } else {
      const auto present = [&](const world::Footprint& footprint, const Track& X_WA) {
        return drivers::present(scene_.road, footprint, world::pose_at(X_WA, time),
                                world::velocity_at(X_WA, time));
      };
      now[0] = present(scene_.ego_footprint, answer.X_WB);
      for (std::size_t i = 0; i < follower; ++i) {
        now[i + 1] = present(scene_.actors[followers_[i]].footprint, answer.tracks[i]);
      }
      seen.push_back(driver.ahead({now.data(), follower + 1}));
    }
    const double before = driver.driver().speed();
    driver.advance(seen.back());
    stands = before == 0.0 && driver.driver().speed() == 0.0;
    track.X_WA.push_back(driver.pose());
  }
}

std::span<const Track> FollowerAnswers::to(const Track& X_WB, std::size_t num) {
  expects(num <= followers_.size(), "at most all followers");
  const Answer* nearest = &last_;
  std::size_t most = 0;
  const auto consider = [&](const Answer& answer) {
    const std::size_t steps = answer.num >= num ? same_steps(answer.X_WB, X_WB) : 0;
    if (steps > most) {
      nearest = &answer;
      most = steps;
    }
  };
  consider(last_);
  for (const Answer& answer : remembered_) {
    consider(answer);
  }
  if (most == num_steps_) {
    return {nearest->tracks.data(), num};
  }
  last_.tracks.resize(followers_.size());
  last_.seen.resize(followers_.size());
  for (std::size_t i = 0; i < num && nearest != &last_; ++i) {
    const auto steps = static_cast<std::ptrdiff_t>(most);
    last_.tracks[i].X_WA.assign(nearest->tracks[i].X_WA.begin(),
                                nearest->tracks[i].X_WA.begin() + steps + 1);
    last_.seen[i].assign(nearest->seen[i].begin(), nearest->seen[i].begin() + steps);
  }
  last_.X_WB = X_WB;
  last_.num = num;
  for (std::size_t i = 0; i < num; ++i) {
    go_on(last_, i, most);
  }
  return {last_.tracks.data(), num};
}

void FollowerAnswers::remember(const Track& X_WB) {
  if (to(X_WB, followers_.size()).data() == last_.tracks.data()) {
    remembered_.push_back(last_);
  }
}

}  // namespace saca::preview
