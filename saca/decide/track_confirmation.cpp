#include "saca/decide/track_confirmation.h"

#include <algorithm>
#include <bit>

namespace saca::decide {
namespace {

constexpr double rounding = 1e-6;      // [s]
constexpr double slowest_looks = 0.1;  // [s], 10 Hz: a scene after this is a look in any case
constexpr int looks_needed = 2;
constexpr double same_place = 2.0;  // [m], half a car's length: bodies do not stand in each other

double measured_at(const world::Scene& scene, const world::Actor& actor) {
  return scene.time - actor.age;
}

void add_look(std::uint8_t& looks, bool seen) {
  constexpr unsigned last_three = 7;  // as bits
  looks = static_cast<std::uint8_t>(((static_cast<unsigned>(looks) << 1U) | (seen ? 1U : 0U)) &
                                    last_three);
}

}  // namespace

TrackConfirmation::Track* TrackConfirmation::named(const world::Actor& actor) noexcept {
  auto* const found = std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& track) {
    return track.kind == actor.kind && track.id == actor.id;
  });
  return found == tracks_.end() ? nullptr : found;
}

TrackConfirmation::Track* TrackConfirmation::find(const world::Actor& actor,
                                                  const world::Scene& scene) noexcept {
  if (Track* const track = named(actor)) {
    return track;
  }
  const auto is_gone = [&](const Track& track) {
    return std::none_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& other) {
      return other.kind == track.kind && other.id == track.id;
    });
  };
  auto* const found = std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& track) {
    const Vec2 p_W = track.p_W + (scene.time - track.present) * track.v_W;
    return track.looks != 0 && norm(actor.X_WA.p - p_W) <= same_place && is_gone(track);
  });
  return found == tracks_.end() ? nullptr : found;
}

bool TrackConfirmation::is_look(const world::Scene& scene) noexcept {
  return scene.actors.empty() || scene.time >= looked_at_ + slowest_looks - rounding ||
         std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& actor) {
           const Track* const track = named(actor);
           return track == nullptr || measured_at(scene, actor) > track->measured + rounding;
         });
}

void TrackConfirmation::look(const world::Scene& scene) noexcept {
  const bool begins = !(scene.time >= newest_ && scene.time <= newest_ + longest_gap);
  if (begins) {
    tracks_.clear();
  }
  const bool is_new = begins || is_look(scene);
  const bool is_slow = scene.time > looked_at_ + longest_wait + rounding;
  StaticVector<Track, 2 * world::max_actors> tracks;
  confirmed_.reset();
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    Track* const known = find(actor, scene);
    Track track = known != nullptr ? *known : Track{};
    const bool seen = known == nullptr || measured_at(scene, actor) > track.measured + rounding;
    if (seen || scene.time >= track.looked_at + slowest_looks - rounding) {
      add_look(track.looks, seen);
      track.looked_at = scene.time;
    }
    track.kind = actor.kind;
    track.id = actor.id;
    track.measured = seen ? measured_at(scene, actor) : track.measured;
    track.p_W = actor.X_WA.p;
    track.v_W = actor.v_W;
    track.present = scene.time;
    const bool is_believed = known == nullptr && is_slow && actor.existence >= likely;
    track.confirmed =
        track.confirmed || begins || is_believed || std::popcount(track.looks) >= looks_needed;
    confirmed_.set(i, track.confirmed);
    tracks.push_back(track);
    if (known != nullptr) {
      known->looks = 0;  // taken over
    }
  }
  for (Track& gone : tracks_) {
    if (is_new) {
      add_look(gone.looks, false);
    }
    if (gone.looks != 0 && !tracks.full()) {
      tracks.push_back(gone);
    }
  }
  tracks_ = tracks;
  newest_ = scene.time;
  looked_at_ = is_new ? scene.time : looked_at_;
}

}  // namespace saca::decide
