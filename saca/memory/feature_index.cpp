#include "saca/memory/feature_index.h"

#include <algorithm>
#include <limits>
#include <span>

#include "saca/core/contract.h"

namespace saca::memory {

void FeatureIndex::add(CaseId id, const world::Scene& scene) {
  expects(id > last_id(), "id > last_id()");
  const Features known = features(scene);
  expects(known.ego.usable, "the scene breaks no rule");
  ids_.push_back(id);
  egos_.push_back(known.ego);
  actors_.insert(actors_.end(), known.actors.begin(), known.actors.end());
  first_actor_.push_back(actors_.size());
}

void FeatureIndex::pass_over(CaseId id) {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  expects(found != ids_.end() && *found == id, "the id was added");
  egos_[static_cast<std::size_t>(found - ids_.begin())].usable = false;  // it is like no other
}

std::optional<FeatureIndex::Hit> FeatureIndex::nearest(const Features& wanted) const noexcept {
  const std::span wanted_actors(wanted.actors.begin(), wanted.actors.size());
  std::optional<Hit> best;
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const std::span actors(actors_.data() + first_actor_[i], first_actor_[i + 1] - first_actor_[i]);
    const double apart = difference(wanted.ego, wanted_actors, egos_[i], actors, limit);
    if (apart < limit) {
      limit = apart;
      best = {ids_[i], apart};
    }
  }
  return best;
}

}  // namespace saca::memory
