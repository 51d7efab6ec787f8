#include "saca/onboard/reflex/track_confirmation.h"

#include <algorithm>
#include <bit>

namespace saca::reflex {
namespace {

constexpr double rounding = 1e-6;      // [s]
constexpr double slowest_looks = 0.1;  // [s], 10 Hz: a scene after this is a look in any case
constexpr int looks_needed = 2;
constexpr int looks_remembered = 3;
constexpr double same_place = 2.0;  // [m], half a car's length: bodies do not stand in each other
// How far a road user can be from where it would be, going on: a car's length, three standard
// deviations of its place, and what hard braking does while it is not measured.
constexpr double own_length = 5.0;          // [m]
constexpr double hard_acceleration = 10.0;  // [m/s^2]
constexpr double sure = 3.0;

double measured_at(const world::Scene& scene, const world::Actor& actor) {
  return scene.time - actor.age;
}

void add_look(std::uint8_t& looks, bool seen) {
  constexpr unsigned last_three = 7;  // as bits
  looks = static_cast<std::uint8_t>(((static_cast<unsigned>(looks) << 1U) | (seen ? 1U : 0U)) &
                                    last_three);
}

}  // namespace

double TrackConfirmation::from_expected(const Track& track, const world::Actor& actor,
                                        double time) noexcept {
  return norm(actor.X_WA.p - track.p_W - (time - track.present) * track.v_W);
}

bool TrackConfirmation::is(const Track& track, const world::Actor& actor, double time) noexcept {
  const double unseen = time - track.measured;
  return track.kind == actor.kind && track.id == actor.id &&
         from_expected(track, actor, time) <= own_length +
                                                  sure * (track.position_sd + actor.position_sd) +
                                                  0.5 * hard_acceleration * unseen * unseen;
}

std::optional<std::size_t> TrackConfirmation::find(const world::Actor& actor,
                                                   const world::Scene& scene) const noexcept {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (is(tracks_[i], actor, scene.time)) {
      return i;
    }
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    if (from_expected(track, actor, scene.time) > same_place) {
      continue;
    }
    if (std::none_of(scene.actors.begin(), scene.actors.end(),
                     [&](const world::Actor& other) { return is(track, other, scene.time); })) {
      return i;
    }
  }
  return std::nullopt;
}

bool TrackConfirmation::is_look(const world::Scene& scene) const noexcept {
  return scene.actors.empty() || scene.time >= looked_at_ + slowest_looks - rounding ||
         std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& actor) {
           return std::none_of(tracks_.begin(), tracks_.end(), [&](const Track& track) {
             return is(track, actor, scene.time) &&
                    measured_at(scene, actor) <= track.measured + rounding;
           });
         });
}

TrackConfirmation::Track TrackConfirmation::continued(const std::optional<Track>& known,
                                                      const world::Actor& actor,
                                                      const world::Scene& scene) noexcept {
  Track track = known.value_or(Track{});
  if (!known || track.absent > 0) {
    track.there_since = scene.time;
  }
  const bool seen = !known || measured_at(scene, actor) > track.measured + rounding;
  if (seen || scene.time >= track.looked_at + slowest_looks - rounding) {
    add_look(track.looks, seen);
    track.looked_at = scene.time;
  }
  track.kind = actor.kind;
  track.id = actor.id;
  track.absent = 0;
  track.measured = seen ? measured_at(scene, actor) : track.measured;
  track.p_W = actor.X_WA.p;
  track.v_W = actor.v_W;
  track.position_sd = actor.position_sd;
  track.present = scene.time;
  return track;
}

void TrackConfirmation::look(const world::Scene& scene) noexcept {
  const bool begins = !(scene.time >= newest_ && scene.time <= newest_ + longest_gap);
  if (begins) {
    tracks_.clear();
  }
  const bool is_new = begins || is_look(scene);
  const bool is_slow = scene.time > looked_at_ + longest_wait + rounding;
  StaticVector<Track, 2 * world::max_actors> tracks;
  std::bitset<2 * world::max_actors> present;  // of those before
  confirmed_.reset();
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    const std::optional<std::size_t> known = find(actor, scene);
    if (known) {
      present.set(*known);
    }
    Track track = continued(known ? std::optional(tracks_[*known]) : std::nullopt, actor, scene);
    const bool has_waited = is_slow || scene.time >= track.there_since + longest_wait - rounding;
    track.confirmed = track.confirmed || begins || std::popcount(track.looks) >= looks_needed ||
                      (has_waited && actor.existence >= likely);
    confirmed_.set(i, track.confirmed);
    tracks.push_back(track);
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track track = tracks_[i];
    if (present.test(i)) {
      continue;
    }
    if (is_new) {
      add_look(track.looks, false);
      ++track.absent;
    }
    if (track.absent < looks_remembered && !tracks.full()) {
      tracks.push_back(track);
    }
  }
  tracks_ = tracks;
  newest_ = scene.time;
  looked_at_ = is_new ? scene.time : looked_at_;
}

}  // namespace saca::reflex
