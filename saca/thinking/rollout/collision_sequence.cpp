#include "saca/thinking/rollout/collision_sequence.h"

#include <span>
#include <vector>

#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/forecast/prepared_motion.h"
#include "saca/thinking/rollout/story.h"

namespace saca::rollout {
namespace {

using manoeuvre::EgoMotion;
using world::Scene;
using world::Track;

// A bound on the work: after so many impacts the story breaks off.
constexpr std::size_t most_impacts = 32;

/// Tells a story to its end.
/// @param again  called whenever anybody has begun to move otherwise
template <class Again>
void tell(Story& story, Again&& again) {
  for (std::size_t i = 0; i < most_impacts; ++i) {
    const std::optional<Event> event = story.next();
    if (!event) {
      break;
    }
    if (story.happen(*event)) {
      again();
    }
  }
}

std::vector<const collision::Mover*> each_of(std::span<const collision::Mover> movers) {
  std::vector<const collision::Mover*> all;
  all.reserve(movers.size());
  for (const collision::Mover& mover : movers) {
    all.push_back(&mover);
  }
  return all;
}

/// The others' tracks, as long as they were not struck. A story refers to them.
struct OthersMotion {
  std::vector<Track> tracks;
  std::vector<collision::Mover> movers;
};
OthersMotion tell(Story& story, const Scene& scene, const collision::Others& others) {
  OthersMotion told;
  const auto ask = [&] {
    told.tracks = others(story.ego());
    told.movers = forecast::movers_of(scene, told.tracks);
    story.expect(each_of(told.movers));
  };
  ask();
  tell(story, ask);
  return told;
}

}  // namespace

CollisionSequence collision_sequence(const EgoMotion& motion, const Scene& scene,
                                     const collision::Others& others,
                                     const collision::HarmModel& harm, double grip) {
  forecast::PreparedMotion prepared(motion, scene);
  Story story(prepared, harm, grip);
  const OthersMotion told = tell(story, scene, others);
  return {story.outcome(), story.ego(), story.others()};
}

collision::Outcome judge(const EgoMotion& motion, const Scene& scene, std::span<const Track> tracks,
                         const collision::HarmModel& harm, double grip) {
  forecast::PreparedMotion prepared(motion, scene);
  const std::vector<collision::Mover> movers = forecast::movers_of(scene, tracks);
  Story story(prepared, harm, grip);
  story.expect(each_of(movers));
  tell(story, [] {});
  // NOLINTNEXTLINE(clang-analyzer-core.StackAddressEscape): an outcome refers to nothing
  return story.outcome();
}

collision::Outcome judge_contacts(const EgoMotion& motion, const Scene& scene,
                                  const collision::Others& others,
                                  const collision::HarmModel& harm) {
  forecast::PreparedMotion prepared(motion, scene);
  Story story(prepared, harm, scene.grip, only_contacts);
  const OthersMotion told = tell(story, scene, others);
  // NOLINTNEXTLINE(clang-analyzer-core.StackAddressEscape): an outcome refers to nothing
  return story.outcome();
}

collision::Outcome judge_contacts(const EgoMotion& motion, const Scene& scene,
                                  std::span<const Track> tracks, const collision::HarmModel& harm) {
  forecast::PreparedMotion prepared(motion, scene);
  return judge_contacts(prepared, forecast::movers_of(scene, tracks), harm);
}

collision::Outcome judge_contacts(forecast::PreparedMotion& motion,
                                  std::span<const collision::Mover> others,
                                  const collision::HarmModel& harm, const Reaction& reaction) {
  Story story(motion, harm, motion.scene().grip, only_contacts);
  std::vector<const collision::Mover*> all = each_of(others);
  const auto react = [&] {
    if (reaction) {
      const auto struck = story.struck();
      reaction(story.ego_track(), {struck.begin(), struck.size()}, all);
    }
    story.expect(all);
  };
  react();
  tell(story, react);
  return story.outcome();
}

CollisionSequence collision_sequence(const EgoMotion& motion, const Scene& scene,
                                     const collision::Others& others,
                                     const collision::HarmModel& harm) {
  return collision_sequence(motion, scene, others, harm, scene.grip);
}

collision::Outcome judge(const EgoMotion& motion, const Scene& scene,
                         const collision::Others& others, const collision::HarmModel& harm) {
  return collision_sequence(motion, scene, others, harm).outcome;
}

collision::Outcome judge(const EgoMotion& motion, const Scene& scene, std::span<const Track> tracks,
                         const collision::HarmModel& harm) {
  return judge(motion, scene, tracks, harm, scene.grip);
}

}  // namespace saca::rollout
