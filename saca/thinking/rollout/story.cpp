#include "saca/thinking/rollout/story.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/approach.h"
#include "saca/onboard/forecast/chain_harm.h"
#include "saca/thinking/rollout/concatenated.h"

namespace saca::rollout {
namespace {

using manoeuvre::EgoMotion;
using world::Beyond;
using world::Track;

using collision::at_rest;

// How long a collision lasts: bodies that crumple into each other for so long have met once. An
// assumption; crash pulses of cars take about a tenth of a second [s].
constexpr double impact_lasts = 0.1;

// Bodies that have met and stay together press on each other; slower than this they do not meet
// anew [m/s].
constexpr double least_closing = 0.1;

bool moves_at_end(const Track& track) {
  const auto& poses = track.X_WA;
  return poses.size() > 1 &&
         norm(poses.back().p - poses[poses.size() - 2].p) > at_rest * track.step;
}

std::optional<Event> at(std::optional<double> time) {
  return time ? std::optional(Event{.time = *time}) : std::nullopt;
}

// The first time that two who have met meet again, or press on.
// @param look_again   between two looks at bodies that stay together [s]
// @param first_touch  when they first touch at or after a time, if they do
// @param closing      how fast they approach where they touch, at a time
template <class FirstTouch, class Closing>
std::optional<Event> meet_again(double from, double until, double look_again,
                                FirstTouch&& first_touch, Closing&& closing) {
  bool together = true;
  double time = from;
  while (time <= until) {
    const std::optional<double> contact = first_touch(time);
    if (!contact) {
      return std::nullopt;
    }
    together = together && *contact <= time + 1e-9;
    if (closing(*contact) > least_closing) {
      return Event{.time = *contact, .presses_on = together};
    }
    time = *contact + look_again;
  }
  return std::nullopt;
}

}  // namespace

Story::Story(forecast::PreparedMotion& motion, const collision::HarmModel& harm, double grip,
             const StoryDetail& detail)
    : motion_(motion),
      scene_(motion.scene()),
      harm_(harm),
      grip_(grip),
      since_(motion.given().track.start),
      clearance_(detail.clearance),
      steps_(detail.slides),
      look_again_(detail.look_again),
      others_(motion.scene().actors.size()) {}

EgoMotion Story::ego() const {
  EgoMotion all = motion_.intended();
  for (const EgoMotion& slide : ego_slides_) {
    all = concatenated(all, slide);
  }
  return all;
}

const Track& Story::ego_track() {
  for (; num_concatenated_ < ego_slides_.size(); ++num_concatenated_) {
    const Track& slide = ego_slides_[num_concatenated_].track;
    concatenated_ = concatenated(
        num_concatenated_ == 0 ? motion_.in_steps_of(slide.step) : concatenated_, slide);
  }
  return num_concatenated_ == 0 ? motion_.intended().track : concatenated_;
}

void Story::expect(std::span<const collision::Mover* const> all) {
  expects(all.size() == others_.size(), "one track per actor");
  for (std::size_t i = 0; i < all.size(); ++i) {
    others_[i].expected = all[i];
  }
}

std::vector<Track> Story::others() const {
  std::vector<Track> all;
  for (const Other& other : others_) {
    all.push_back(other.expected->track());
    for (const EgoMotion& slide : other.slides) {
      all.back() = concatenated(all.back(), slide.track);
    }
  }
  return all;
}

StaticVector<bool, world::max_actors> Story::struck() const {
  StaticVector<bool, world::max_actors> all;
  for (const Other& other : others_) {
    all.push_back(!other.slides.empty());
  }
  return all;
}

const collision::Mover& Story::ego_mover() {
  if (!was_struck()) {
    return motion_.mover();
  }
  return ego_slides_on_ ? *ego_slides_on_
                        : ego_slides_on_.emplace(scene_.ego_footprint, now().track);
}

const collision::Mover& Story::mover(std::size_t i) {
  Other& other = others_[i];
  if (other.slides.empty()) {
    return *other.expected;
  }
  return other.slides_on
             ? *other.slides_on
             : other.slides_on.emplace(scene_.actors[i].footprint, other.slides.back().track);
}

bool Story::other_moves_at_end(std::size_t i) const {
  const Other& other = others_[i];
  return other.slides.empty() ? moves_at_end(other.track())
                              : collision::moves_at_end(other.slides.back());
}

double Story::last_time() const {
  const EgoMotion& ego = now();
  double time = end_time(ego.track);
  if (ego.ended && !collision::moves_at_end(ego)) {
    for (std::size_t i = 0; i < others_.size(); ++i) {
      time = std::max(time, end_time(track(i)));
    }
  }
  return time;
}

std::optional<Event> Story::next_at(collision::Side side) {
  const Beyond what = collision::beyond(scene_.road, side);
  const Dealings& before = dealings(side);
  if (before.over) {
    return std::nullopt;
  }
  const Track& track = now().track;
  const double interest = was_struck() || what == Beyond::unmarked ? 0.0 : clearance_;
  const auto first_touch = [&](double time) {
    return collision::edge_approach(scene_.road, side, scene_.ego_footprint, track, interest, time)
        .crossing;
  };
  if (before.last_impact) {
    return meet_again(std::max(since_, *before.last_impact + impact_lasts), end_time(track),
                      look_again_, first_touch, [&](double time) {
                        return collision::closing_speed(scene_, side,
                                                        collision::instant_at(now(), time), harm_);
                      });
  }
  if (interest == 0.0 && !was_struck() && since_ == track.start) {
    return at(motion_.crossing(side));
  }
  const collision::EdgeApproach edge =
      collision::edge_approach(scene_.road, side, scene_.ego_footprint, track, interest, since_);
  if (what != Beyond::unmarked) {
    pass(std::max(0.0, edge.clearance), {.edge = side, .time = edge.nearest_at});
  }
  return at(edge.crossing);
}

// @param first  nothing is known yet that ends the search before `until`
std::optional<Event> Story::next_with(std::size_t i, double until, bool first) {
  const Dealings& before = others_[i].dealings;
  const double from = std::max(since_, track(i).start);
  const double known = other_moves_at_end(i) ? std::min(until, end_time(track(i))) : until;
  if (before.over || known < from) {
    return std::nullopt;
  }
  const collision::Mover& ego = ego_mover();
  const collision::Mover& other = mover(i);
  if (before.last_impact) {
    const double rest = std::max(end_time(now().track), end_time(track(i)));
    return meet_again(
        std::max(since_, *before.last_impact + impact_lasts), std::min(known, rest), look_again_,
        [&](double time) { return collision::approach(ego, other, time, known, 0.0).contact; },
        [&](double time) {
          return collision::closing_speed(scene_, i, collision::instant_at(now(), time),
                                          other_at(i, time), harm_);
        });
  }
  const double interest = first && !was_struck() ? clearance_ : 0.0;
  const collision::Approach found = collision::approach(ego, other, from, known, interest);
  if (interest > 0.0) {
    pass(found.distance, {.actor = i, .time = found.nearest_at});
  }
  return at(found.contact);
}

std::optional<Event> Story::next() {
  std::optional<Event> soonest;
  double until = last_time();
  bool stops = false;
  const auto consider = [&](std::optional<Event> event) {
    if (event && event->time <= until && (!soonest || event->time < until)) {
      until = event->time;
      soonest = event;
      stops = event->actor || world::is_hard(collision::beyond(scene_.road, *event->edge));
    }
  };
  for (const collision::Side side : {collision::Side::left, collision::Side::right}) {
    std::optional<Event> event = next_at(side);
    if (event) {
      event->edge = side;
    }
    consider(event);
  }
  for (std::size_t i = 0; i < others_.size(); ++i) {
    std::optional<Event> event = next_with(i, until, !stops);
    if (event) {
      event->actor = i;
    }
    consider(event);
  }
  return soonest;
}

EgoMotion Story::slide_of(const world::Footprint& footprint, double mass,
                          const collision::Instant& after, double time) const {
  collision::ImpactBody body = collision::free_body(mass, footprint);
  body.v_W = after.v_W;
  body.yaw_rate = after.yaw_rate;
  return slide(footprint, body, after.X_WB, time, grip_, steps_);
}

void Story::note(const collision::Impact& impact, const Event& event) {
  if (event.presses_on) {
    const auto last =
        std::find_if(impacts_.rbegin(), impacts_.rend(), [&](const collision::Impact& one) {
          return one.contact.actor == event.actor && one.contact.edge == event.edge;
        });
    *last = collision::pressed_on(*last, impact, harm_);
    return;
  }
  impacts_.push_back(impact);
}

bool Story::happen(const Event& event) {
  const collision::Instant ego = collision::instant_at(now(), event.time);
  since_ = event.time;
  collision::Impact impact;
  bool strikes = true;
  if (event.actor) {
    const std::size_t i = *event.actor;
    const world::Actor& actor = scene_.actors[i];
    impact = collision::meet(scene_, i, ego, other_at(i, event.time), event.time, harm_);
    if (actor.kind != world::ActorKind::obstacle) {
      others_[i].slides_on.reset();
      others_[i].slides.push_back(
          slide_of(actor.footprint, actor.mass, impact.other_after, event.time));
    }
    others_[i].dealings = {event.time, collision::unprotected(actor.kind)};
  } else {
    const Beyond what = collision::beyond(scene_.road, *event.edge);
    impact = collision::leave(scene_, *event.edge, ego, event.time, harm_);
    strikes = world::is_hard(what);
    dealings(*event.edge) = {event.time, what != Beyond::barrier};
  }
  if (strikes) {
    ego_slides_on_.reset();
    ego_slides_.push_back(
        slide_of(scene_.ego_footprint, scene_.ego_mass, impact.ego_after, event.time));
    first_ = first_.value_or(impacts_.size());
  }
  note(impact, event);
  return strikes;
}

collision::Outcome Story::outcome() const {
  collision::Outcome outcome;
  outcome.harm = forecast::expected_harm(impacts_, scene_, harm_);
  outcome.clearance = 0.0;
  outcome.end_time = end_time(was_struck() ? now().track : motion_.given().track);
  if (impacts_.empty()) {
    outcome.clearance = clearance_;
    outcome.nearest = nearest_;
    return outcome;
  }
  const std::size_t first = first_.value_or(0);
  outcome.contact = impacts_[first].contact;
  outcome.collision_loss = impacts_[first].loss;
  for (std::size_t i = first + 1; i < impacts_.size() && !outcome.later.full(); ++i) {
    outcome.later.push_back(impacts_[i].contact);
  }
  outcome.end_time = std::max(outcome.end_time, impacts_[first].contact.time);
  return outcome;
}

}  // namespace saca::rollout
