#include "saca/thinking/memory/learning.h"

#include <algorithm>
#include <limits>

#include "saca/thinking/memory/experience.h"

namespace saca::memory {
namespace {

/// Of two means of so many each; no sum of numbers and of counts leaves their range.
double mean_of(double older, int of_older, double newer, int of_newer) {
  const double share = 1.0 / (1.0 + static_cast<double>(of_older) / of_newer);
  return older * (1.0 - share) + newer * share;
}

int sum_of(int a, int b) {
  constexpr int most = std::numeric_limits<int>::max();
  return a > most - b ? most : a + b;
}

std::optional<PolicyHarms> mean_of(const std::optional<PolicyHarms>& older, int of_older,
                                   const std::optional<PolicyHarms>& newer, int of_newer) {
  if (!older || !newer) {
    return older ? older : newer;
  }
  PolicyHarms mean;
  for (std::size_t p = 0; p < mean.size(); ++p) {
    const auto& a = (*older)[p];
    const auto& b = (*newer)[p];
    mean[p] = a && b ? std::optional(mean_of(*a, of_older, *b, of_newer)) : a ? a : b;
  }
  return mean;
}

}  // namespace

bool contradict(const Case& a, const Case& b) noexcept {
  const Policies of_a = as_good_as_best(a);
  const Policies of_b = as_good_as_best(b);
  return of_a.any() && of_b.any() && (of_a & of_b).none();
}

void add_lessons(Case& one, std::span<const std::string> lessons) {
  one.lessons.insert(one.lessons.end(), lessons.begin(), lessons.end());
  if (one.lessons.size() > most_texts) {
    one.lessons.erase(one.lessons.begin(), one.lessons.end() - most_texts);
  }
}

Case merged(const Case& older, const Case& newer) {
  if (is_hearsay(newer) || is_hearsay(older)) {
    Case one = is_hearsay(newer) ? older : newer;
    if (!one.told) {
      one.told = is_hearsay(newer) ? newer.told : older.told;
    }
    one.id = older.id;
    one.scene = older.scene;
    one.intentions = older.intentions;
    one.risks = older.risks;
    one.trust = older.trust;
    one.lessons = older.lessons;
    add_lessons(one, newer.lessons);
    return one;
  }
  Case one = older;
  one.origin = newer.origin == Origin::own ? Origin::own : older.origin;
  const auto mean = [&](double Case::*harm) {
    return mean_of(older.*harm, older.count, newer.*harm, newer.count);
  };
  one.harm = mean(&Case::harm);
  one.best_harm = mean(&Case::best_harm);
  one.collision_loss = mean(&Case::collision_loss);
  one.worst_harm =
      std::max(older.worst_harm.value_or(older.harm), newer.worst_harm.value_or(newer.harm));
  one.told = mean_of(older.told, older.count, newer.told, newer.count);
  one.happened = mean_of(older.happened, older.count, newer.happened, newer.count);
  one.count = sum_of(older.count, newer.count);
  add_lessons(one, newer.lessons);
  if (one.happened) {
    const Policies good = as_good_as_best(*one.happened);
    const auto does = [&](manoeuvre::PolicyId policy) {
      return good.test(manoeuvre::index(policy));
    };
    // Of those as good as each other the one that either encounter had as its best.
    if (!does(one.best)) {
      const auto* const first =
          std::find_if(manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(), does);
      one.best = does(newer.best)                         ? newer.best
                 : first != manoeuvre::all_policies.end() ? *first
                                                          : one.best;
    }
  }
  return one;
}

}  // namespace saca::memory
