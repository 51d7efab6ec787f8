#include "saca/thinking/intent/joint.h"

#include <algorithm>
#include <cstdint>
#include <queue>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::intent {
namespace {

/// A hypothesis as the rank of what each road user does among its own choices, likeliest first.
struct RankedHypothesis {
  double probability = 1.0;
  std::vector<std::uint8_t> ranks;
  std::size_t last = 0;  ///< the last road user whose rank is not 0
};

/// Less likely, or as likely and later.
bool comes_after(const RankedHypothesis& a, const RankedHypothesis& b) {
  if (a.probability != b.probability) {
    return a.probability < b.probability;
  }
  return std::lexicographical_compare(b.ranks.rbegin(), b.ranks.rend(), a.ranks.rbegin(),
                                      a.ranks.rend());
}

// Always multiplied in the same order. Rounding never turns a smaller factor into a larger product,
// so the order of hypotheses is exact in floating point as well.
double probability_of(std::span<const Choices> choices, const std::vector<std::uint8_t>& ranks) {
  double probability = 1.0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    probability *= choices[i][ranks[i]].probability;
  }
  return probability;
}

}  // namespace

Choices choices_of(const IntentPosterior& posterior, double least) {
  Choices choices;
  for (const Intention intention : all_intentions) {
    const double probability = posterior[static_cast<std::size_t>(intention)];
    if (probability >= least) {
      choices.push_back({intention, probability});
    }
  }
  return choices;
}

// Best first. A hypothesis is reached from the one in which the last road user that is not at rank
// 0 has the rank before: so each has one parent, and is put into the queue once. The parent is at
// least as likely, and as likely it comes earlier; hence, when a hypothesis is due, its parent has
// been taken out before and it is in the queue: nothing outside the queue comes before what is
// taken out.
std::vector<Hypothesis> likeliest_hypotheses(std::span<const Choices> choices, std::size_t most) {
  std::vector<Choices> sorted(choices.begin(), choices.end());
  for (Choices& each : sorted) {
    expects(!each.empty(), "everybody has a choice");
    expects(std::all_of(each.begin(), each.end(),
                        [](const Choice& choice) {
                          return choice.probability >= 0.0 && choice.probability <= 1.0;
                        }),
            "probabilities in [0, 1]");
    std::stable_sort(each.begin(), each.end(), [](const Choice& a, const Choice& b) {
      return a.probability > b.probability;
    });
  }
  std::priority_queue<RankedHypothesis, std::vector<RankedHypothesis>, decltype(&comes_after)>
      queue(&comes_after);
  RankedHypothesis first{.ranks = std::vector<std::uint8_t>(sorted.size(), 0)};
  first.probability = probability_of(sorted, first.ranks);
  queue.push(std::move(first));
  std::vector<Hypothesis> found;
  while (!queue.empty() && found.size() < most) {
    const RankedHypothesis next = queue.top();
    queue.pop();
    Hypothesis hypothesis{next.probability, {}};
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      hypothesis.intentions.push_back(sorted[i][next.ranks[i]].intention);
    }
    found.push_back(std::move(hypothesis));
    for (std::size_t i = next.last; i < sorted.size(); ++i) {
      if (next.ranks[i] + std::size_t{1} < sorted[i].size()) {
        RankedHypothesis child{.ranks = next.ranks, .last = i};
        ++child.ranks[i];
        child.probability = probability_of(sorted, child.ranks);
        queue.push(std::move(child));
      }
    }
  }
  return found;
}

}  // namespace saca::intent
