#include "saca/thinking/memory/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/percentile.h"
#include "saca/onboard/match/feature_index.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/experience.h"

namespace saca::memory {
namespace {

constexpr double slippery_grip = 0.4;

Situation way_of(const match::ActorFeatures& actor) {
  const double along = actor.forward_L.x;  // cosine of its heading against the lane
  constexpr double at_45_deg = 0.70710678118654752;
  if (along >= at_45_deg) {
    return Situation::same_direction;
  }
  return along <= -at_45_deg ? Situation::oncoming : Situation::crossing;
}

Situation situation_with(const match::ActorFeatures& actor) {
  switch (actor.kind) {
    case world::ActorKind::car:
    case world::ActorKind::van:
    case world::ActorKind::truck:
      return way_of(actor);
    case world::ActorKind::motorcycle:
    case world::ActorKind::bicycle:
      return Situation::two_wheeler;
    case world::ActorKind::pedestrian:
      return Situation::pedestrian;
    case world::ActorKind::obstacle:
      break;
  }
  return Situation::obstacle;
}

}  // namespace

std::string_view name(Situation situation) {
  switch (situation) {
    case Situation::nobody:
      return "nobody";
    case Situation::same_direction:
      return "same_direction";
    case Situation::oncoming:
      return "oncoming";
    case Situation::crossing:
      return "crossing";
    case Situation::two_wheeler:
      return "two_wheeler";
    case Situation::pedestrian:
      return "pedestrian";
    case Situation::obstacle:
      break;
  }
  return "obstacle";
}

Situation situation_of(const world::Scene& scene) {
  const match::Features found = match::features(scene);
  expects(found.ego.usable, "the scene breaks no rule");
  const auto most =
      std::max_element(found.actors.begin(), found.actors.end(),
                       [](const match::ActorFeatures& a, const match::ActorFeatures& b) {
                         return a.threat < b.threat;
                       });
  return most == found.actors.end() ? Situation::nobody : situation_with(*most);
}

std::vector<CoverageCell> coverage(std::span<const Case> cases) {
  constexpr std::size_t num_classes = speed_classes.size() + 1;
  std::vector<CoverageCell> cells;
  cells.reserve(all_situations.size() * num_classes);
  for (const Situation situation : all_situations) {
    for (std::size_t k = 0; k < num_classes; ++k) {
      cells.push_back({.situation = situation, .speed_class = k});
    }
  }
  match::FeatureIndex index;
  for (const Case& one : cases) {
    if (one.trust != Trust::quarantined) {
      index.add(one.id, one.scene);
    }
  }
  std::vector<std::vector<double>> differences(cells.size());
  for (const Case& one : cases) {
    if (one.trust == Trust::quarantined) {
      continue;
    }
    const double speed = norm(one.scene.ego.v_B);
    const auto speed_class = static_cast<std::size_t>(
        std::upper_bound(speed_classes.begin(), speed_classes.end(), speed) -
        speed_classes.begin());
    const std::size_t place =
        static_cast<std::size_t>(situation_of(one.scene)) * num_classes + speed_class;
    CoverageCell& cell = cells.at(place);
    ++cell.cases;
    const bool braking_does = as_good_as_best(one).test(manoeuvre::index(manoeuvre::PolicyId::aeb));
    cell.braking_as_good += braking_does ? 1 : 0;
    cell.slippery += one.scene.grip < slippery_grip ? 1 : 0;
    if (const auto difference = index.nearest_other(match::features(one.scene), one.id)) {
      differences.at(place).push_back(*difference);
    }
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].to_nearest = differences[i].empty() ? std::numeric_limits<double>::quiet_NaN()
                                                 : percentile(std::move(differences[i]), 0.5);
  }
  return cells;
}

}  // namespace saca::memory
