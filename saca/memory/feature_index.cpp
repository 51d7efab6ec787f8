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

std::size_t FeatureIndex::place_of(CaseId id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  expects(found != ids_.end() && *found == id, "the id was added");
  return static_cast<std::size_t>(found - ids_.begin());
}

void FeatureIndex::pass_over(CaseId id) {
  egos_[place_of(id)].usable = false;  // it is like no other
}

template <class Limit, class Take>
void FeatureIndex::scan(const Features& wanted, const Limit& limit,
                        const Take& take) const noexcept {
  const std::span wanted_actors(wanted.actors.begin(), wanted.actors.size());
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const std::span actors(actors_.data() + first_actor_[i], first_actor_[i + 1] - first_actor_[i]);
    const double apart = difference(wanted.ego, wanted_actors, egos_[i], actors, limit());
    if (apart < limit()) {
      take(Hit{ids_[i], apart, i});
    }
  }
}

std::optional<FeatureIndex::Hit> FeatureIndex::nearest(const Features& wanted) const noexcept {
  std::optional<Hit> best;
  scan(
      wanted, [&] { return best ? best->difference : std::numeric_limits<double>::infinity(); },
      [&](const Hit& hit) { best = hit; });
  return best;
}

std::size_t FeatureIndex::nearest(const Features& wanted, std::span<Hit> hits) const noexcept {
  const auto nearer = [](const Hit& a, const Hit& b) { return a.difference < b.difference; };
  std::size_t found = 0;  // a heap, the farthest first
  scan(
      wanted,
      [&] {
        return hits.empty()          ? 0.0
               : found < hits.size() ? std::numeric_limits<double>::infinity()
                                     : hits.front().difference;
      },
      [&](const Hit& hit) {
        if (found == hits.size()) {
          std::pop_heap(hits.begin(), hits.end(), nearer);
          hits.back() = hit;
        } else {
          hits[found++] = hit;
        }
        std::push_heap(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(found), nearer);
      });
  std::sort_heap(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(found), nearer);
  return found;
}

}  // namespace saca::memory
