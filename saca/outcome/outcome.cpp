#include "saca/outcome/outcome.h"

namespace saca::outcome {

using manoeuvre::EgoMotion;
using world::Beyond;
using world::Scene;
using world::Track;

bool stops_the_ego(Beyond beyond) {
  return beyond == Beyond::barrier || beyond == Beyond::trees;
}

CollisionSequence collision_sequence(const EgoMotion& motion, const Scene& scene,
                                     const Others& others, const HarmModel& harm) {
  return collision_sequence(motion, scene, others, harm, scene.grip);
}

Outcome judge(const EgoMotion& motion, const Scene& scene, const Others& others,
              const HarmModel& harm) {
  return collision_sequence(motion, scene, others, harm).outcome;
}

Outcome judge(const EgoMotion& motion, const Scene& scene, std::span<const Track> tracks,
              const HarmModel& harm) {
  return judge(motion, scene, tracks, harm, scene.grip);
}

}  // namespace saca::outcome
