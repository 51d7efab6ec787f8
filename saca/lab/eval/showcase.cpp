#include "saca/lab/eval/showcase.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/thinking/rollout/describe.h"

namespace saca::eval {
namespace {

using manoeuvre::PolicyId;

/// How convincing a finding is: meets nobody, and the margin; nullopt: not at all.
using Promise = std::pair<bool, double>;
std::optional<Promise> promise(const Finding& finding, PolicyId policy) {
  const bool clear = !finding.contact[manoeuvre::index(policy)];
  const Taught taught = lesson_of(finding);
  if (policy != PolicyId::no_intervention) {
    return taught.alone == policy ? std::optional(Promise{clear, taught.margin}) : std::nullopt;
  }
  if (taught.lesson != Lesson::nothing_needed) {
    return std::nullopt;
  }
  return Promise{clear, *finding.harm[manoeuvre::index(PolicyId::aeb)]};
}

std::string figure(const Oracle& oracle, PolicyId policy) {
  const Verdict& verdict = oracle.of(policy);
  const auto& harm = verdict.expected.harm;
  return fmt::format("{} {:.4f} ({:.4f} to {:.4f}; as written: {})", name(policy), harm.value,
                     harm.low, harm.high,
                     rollout::describe(verdict.written.facts.outcome(), oracle.scene));
}

}  // namespace

std::vector<Finding> candidates(std::span<const Finding> findings, PolicyId policy) {
  std::vector<std::pair<Promise, const Finding*>> promising;
  for (const Finding& finding : findings) {
    if (const auto worth = promise(finding, policy)) {
      promising.emplace_back(*worth, &finding);
    }
  }
  std::stable_sort(promising.begin(), promising.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Finding> sorted;
  sorted.reserve(promising.size());
  for (const auto& [worth, finding] : promising) {
    sorted.push_back(*finding);
  }
  return sorted;
}

bool convinces(const Oracle& oracle, PolicyId policy, const ShowcaseRule& rule) {
  if (oracle.best() != policy) {
    return false;
  }
  if (policy == PolicyId::no_intervention) {
    return oracle.of(policy).expected.harm.value < rule.clear &&
           std::all_of(oracle.ranking.begin(), oracle.ranking.end(),
                       [&](PolicyId other) { return oracle.of(other).behind.value >= 0.0; });
  }
  return std::all_of(oracle.ranking.begin(), oracle.ranking.end(), [&](PolicyId other) {
    const forecast::Mean& behind = oracle.of(other).behind;
    return other == policy || (behind.value >= rule.clear && behind.low > 0.0);
  });
}

std::string why_right(const Oracle& oracle, PolicyId policy) {
  std::string text = "Expected harm: " + figure(oracle, policy);
  for (const PolicyId other : oracle.ranking) {
    if (other != policy) {
      text += "; the next best " + figure(oracle, other);
      break;
    }
  }
  if (policy != PolicyId::aeb && oracle.ranking.size() > 1 && oracle.ranking[1] != PolicyId::aeb) {
    text += "; " + figure(oracle, PolicyId::aeb);
  }
  return text + ".";
}

}  // namespace saca::eval
