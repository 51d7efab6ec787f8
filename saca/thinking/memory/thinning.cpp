#include "saca/thinking/memory/thinning.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "saca/onboard/match/feature_index.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/experience.h"

namespace saca::memory {
namespace {

bool may_go(const Case& one) {
  return one.trust == Trust::trusted && one.origin != Origin::own && one.origin != Origin::expert;
}

/// How near a case is to the one that would stand for it.
struct Redundancy {
  double difference = 0.0;
  std::size_t place = 0;  ///< of the case
};

/// What goes later: first the nearest goes, of equals the newest.
bool later(const Redundancy& a, const Redundancy& b) {
  return a.difference != b.difference ? a.difference > b.difference : a.place < b.place;
}

/// Trusted cases, those that speak for the same policies together, if they were worked out with the
/// same car and harm: by another car they are not trusted.
class Alike {
 public:
  void add(const Case& one) { group_of(one).add(one.id, one.scene); }
  void remove(const Case& one) { group_of(one).pass_over(one.id); }

  /// How far the nearest is that is left beside the case itself; nullopt: there is none.
  [[nodiscard]] std::optional<double> nearest_other(const Case& one) {
    return group_of(one).nearest_other(match::features(one.scene), one.id);
  }

 private:
  match::FeatureIndex& group_of(const Case& one) {
    // Exact, however many: a graph in which most places are passed over would find nobody.
    constexpr auto any_number = std::numeric_limits<std::size_t>::max();
    return groups_
        .try_emplace({as_good_as_best(one).to_ulong(), car_and_harm(one.made_with)}, any_number)
        .first->second;
  }

  std::map<std::pair<unsigned long, std::string>, match::FeatureIndex> groups_;
};

}  // namespace

std::vector<match::CaseId> most_redundant(std::span<const Case> cases, std::size_t most) {
  std::vector<match::CaseId> gone;
  if (cases.size() <= most) {
    return gone;
  }
  Alike alike;
  for (const Case& one : cases) {
    if (one.trust == Trust::trusted) {
      alike.add(one);
    }
  }
  std::priority_queue<Redundancy, std::vector<Redundancy>, decltype(&later)> waiting(later);
  for (std::size_t place = 0; place < cases.size(); ++place) {
    if (may_go(cases[place])) {
      if (const auto nearest = alike.nearest_other(cases[place])) {
        waiting.push({*nearest, place});
      }
    }
  }
  while (cases.size() - gone.size() > most && !waiting.empty()) {
    const Redundancy next = waiting.top();
    waiting.pop();
    const Case& one = cases[next.place];
    // Who would have stood for it may have gone: then it waits for its turn anew.
    const auto nearest = alike.nearest_other(one);
    if (nearest && *nearest > next.difference) {
      waiting.push({*nearest, next.place});
    } else if (nearest) {
      alike.remove(one);
      gone.push_back(one.id);
    }
  }
  return gone;
}

std::vector<Case> cases_of(std::span<const match::CaseId> ids, std::span<const Case> cases) {
  const std::set<match::CaseId> wanted(ids.begin(), ids.end());
  std::vector<Case> found;
  found.reserve(wanted.size());
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(found),
               [&](const Case& one) { return wanted.count(one.id) > 0; });
  return found;
}

Result<std::size_t> keep_within(Store& memory, std::size_t most, match::CaseId newest) {
  const std::size_t margin = std::max<std::size_t>(1, most / 20);
  if (memory.size() <= most || (memory.size() - most - 1) % margin != 0) {
    return std::size_t{0};
  }
  const auto cases = memory.all();
  if (!cases.has_value()) {
    return cases.error();
  }
  const std::size_t kept = most - most / 20;
  std::vector<match::CaseId> gone = most_redundant(cases.value(), kept);
  if (std::find(gone.begin(), gone.end(), newest) != gone.end()) {  // another goes in its place
    gone = most_redundant(cases.value(), std::max<std::size_t>(kept, 1) - 1);
    std::erase(gone, newest);
  }
  const auto stay = memory.forget(cases_of(gone, cases.value()));
  return stay.has_value() ? Result(gone.size() - stay.value()) : stay;
}

}  // namespace saca::memory
