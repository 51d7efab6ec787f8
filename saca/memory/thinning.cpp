#include "saca/memory/thinning.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <queue>

#include "saca/memory/experience.h"
#include "saca/memory/feature_index.h"
#include "saca/memory/similarity.h"

namespace saca::memory {
namespace {

bool may_go(const Case& one) {
  return one.trust == Trust::trusted && one.origin != Origin::own && one.origin != Origin::expert;
}

/// How near a case is to the one that would stand for it.
struct Redundancy {
  double difference = 0.0;
  CaseId id = 0;
  std::size_t place = 0;  ///< of the case
};

/// What goes later: first the nearest goes, of equals the newest.
bool later(const Redundancy& a, const Redundancy& b) {
  return a.difference != b.difference ? a.difference > b.difference : a.id < b.id;
}

/// Trusted cases that speak for the same policies, to be thinned out together.
class Alike {
 public:
  void add(CaseId id, const world::Scene& scene) { index_.add(id, scene); }
  void remove(CaseId id) { index_.pass_over(id); }

  /// The nearest that is left beside the case itself.
  [[nodiscard]] std::optional<FeatureIndex::Hit> other(CaseId id, const Features& scene) const {
    std::array<FeatureIndex::Hit, 2> hits;
    const std::size_t found = index_.nearest(scene, hits);
    for (std::size_t i = 0; i < found; ++i) {
      if (hits.at(i).id != id) {
        return hits.at(i);
      }
    }
    return std::nullopt;
  }

 private:
  // Exact, however many: a graph in which most places are passed over would find nobody.
  FeatureIndex index_{std::numeric_limits<std::size_t>::max()};
};

}  // namespace

std::vector<CaseId> most_redundant(std::span<const Case> cases, std::size_t most) {
  const std::size_t too_many = cases.size() - std::min(cases.size(), most);
  std::map<unsigned long, Alike> groups;
  const auto group_of = [&groups](const Case& one) -> Alike& {
    return groups[as_good_as_best(one).to_ulong()];
  };
  for (const Case& one : cases) {
    if (one.trust == Trust::trusted) {
      group_of(one).add(one.id, one.scene);
    }
  }
  std::priority_queue<Redundancy, std::vector<Redundancy>, decltype(&later)> waiting(later);
  const auto wait = [&](std::size_t place) {
    const Case& one = cases[place];
    if (const auto other = group_of(one).other(one.id, features(one.scene))) {
      waiting.push({other->difference, one.id, place});
    }
  };
  for (std::size_t place = 0; too_many > 0 && place < cases.size(); ++place) {
    if (may_go(cases[place])) {
      wait(place);
    }
  }
  std::vector<CaseId> gone;
  while (gone.size() < too_many && !waiting.empty()) {
    const Redundancy next = waiting.top();
    waiting.pop();
    const Case& one = cases[next.place];
    // Who would have stood for it may have gone: then it waits for its turn anew.
    const auto other = group_of(one).other(one.id, features(one.scene));
    if (!other || other->difference > next.difference) {
      wait(next.place);
      continue;
    }
    group_of(one).remove(one.id);
    gone.push_back(one.id);
  }
  return gone;
}

}  // namespace saca::memory
