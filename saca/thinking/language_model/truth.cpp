#include "saca/thinking/language_model/truth.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/language_model/claim.h"
#include "saca/thinking/language_model/conclusion.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/quote.h"
#include "saca/thinking/language_model/quoted_number.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/sentence_subject.h"
#include "saca/thinking/language_model/words.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;
using preview::PolicyFacts;
using preview::Situation;

bool agree(const QuotedNumber& said, const QuotedNumber& known) {
  const bool same_unit = said.unit.empty() || known.unit.empty() || said.unit == known.unit;
  constexpr double rounding = 1e-9;
  constexpr double coarsest = 0.1;  // of the number: 1 is not a rounded 0.9
  const bool may_be_rounded = said.resolution <= coarsest * said.value;
  const double off = may_be_rounded ? 0.5 * said.resolution : 0.0;
  const bool same_place = said.where.empty() || said.where == known.where;
  const bool same_kind = said.of_what.empty() || said.of_what == known.of_what;
  return same_unit && same_place && same_kind &&
         std::abs(said.value - known.value) <= off + rounding;
}

/// "16 / 14 = 1.14": to the decimals that are quoted.
bool is_quotient(const std::vector<QuotedNumber>& numbers, std::size_t i) {
  return i >= 2 && numbers[i].after_equals && numbers[i - 1].value != 0.0 &&
         std::abs(numbers[i - 2].value / numbers[i - 1].value - numbers[i].value) <=
             0.5 * numbers[i].resolution + 1e-9;
}

bool hits(const PolicyFacts& facts) {
  return facts.drivable() && facts.outcome().contact.has_value();
}
bool is_blocked(const PolicyFacts& facts) {
  return !facts.drivable() || hits(facts);
}

bool is_so(Claim claim, const PolicyFacts& facts, const Situation& situation) {
  switch (claim) {
    case Claim::not_possible:
      return !facts.drivable();
    case Claim::blocked:
      return is_blocked(facts);
    case Claim::hits:
      return hits(facts);
    case Claim::no_harm:
      return facts.drivable() && facts.outcome().harm < prompt_no_harm;
    case Claim::least_harm:
      return facts.drivable() &&
             facts.outcome().harm <= preview::least_harm(situation.facts) + collision::harm_tie;
    case Claim::clear:
      return facts.drivable() && !facts.outcome().contact;
  }
  return true;
}

/// Is somebody among those that a policy is forecast to meet?
bool meets(const PolicyFacts& facts, std::size_t actor) {
  if (!hits(facts)) {
    return false;
  }
  const collision::Outcome& ends = facts.outcome();
  return ends.contact->actor == actor ||
         std::any_of(ends.later.begin(), ends.later.end(),
                     [&](const collision::Contact& one) { return one.actor == actor; });
}

/// Likewise, where it names road users: what it hits, or is clear of, is these.
bool is_so_of(Claim claim, const PolicyFacts& facts, const Situation& situation,
              const std::vector<std::size_t>& actors) {
  const bool of_whom = claim == Claim::hits || claim == Claim::clear;
  if (actors.empty() || !of_whom || !facts.drivable()) {
    return is_so(claim, facts, situation);
  }
  return std::all_of(actors.begin(), actors.end(), [&](std::size_t actor) {
    return meets(facts, actor) == (claim == Claim::hits);
  });
}

std::string told(const PolicyFacts& facts, const Situation& situation) {
  return fmt::format("{} {}: {}", manoeuvre::index(facts.plan.policy), name(facts.plan.policy),
                     facts.drivable()
                         ? rollout::describe(facts.outcome(), situation.scene_at_trigger)
                         : "not possible");
}

/// A sentence being judged.
struct Verdict {
  bool says_something = false;
  std::string why;  ///< empty: nothing is wrong
  bool load_bearing = false;

  void wrong(std::string reason) {
    if (why.empty()) {
      why = std::move(reason);
    }
  }
};

void judge_numbers(std::string_view sentence, std::string_view prompt, const Subject& subject,
                   const Situation& situation, Verdict& verdict) {
  std::vector<QuotedNumber> said = quoted_numbers(sentence);
  if (said.empty()) {
    return;
  }
  verdict.says_something = true;
  const bool of_an_edge = has_any(
      lowered(sentence), std::array<std::string_view, 4>{"edge", "trees", "barrier", "kerb"});
  for (QuotedNumber& one : said) {
    if (one.where == "away") {
      one.where.clear();
      one.of_what = of_an_edge ? "edge" : one.of_what;
    }
  }
  const std::string lines = lines_about(prompt, subject, situation);
  std::vector<QuotedNumber> known = quoted_numbers(lines);
  if (has_phrase(lines, "no harm")) {
    // Nothing but a number without a unit.
    known.push_back({.text = "0", .unit = "of harm", .where = {}, .of_what = "harm"});
  }
  for (std::size_t i = 0; i < said.size(); ++i) {
    const bool stands = std::any_of(known.begin(), known.end(),
                                    [&](const QuotedNumber& each) { return agree(said[i], each); });
    if (!stands && !is_quotient(said, i)) {
      verdict.wrong(fmt::format("{}{}{} stands nowhere", said[i].text,
                                said[i].unit.empty() ? "" : " ", said[i].unit));
    }
  }
}

/// Whether a prompt has a figure for a policy's harm: a review's has more decimals than others.
bool has_harm_of(PolicyId policy, std::string_view prompt, const Situation& situation) {
  Subject alone;
  alone.policies.push_back(policy);
  return lines_about(prompt, alone, situation).find(", harm ") != std::string::npos;
}

void judge_claim(Claim claim, std::string_view prompt, const Subject& subject,
                 const Situation& situation, Verdict& verdict) {
  const auto& facts = situation.facts;
  if (!subject.policies.empty()) {
    verdict.says_something = true;
    for (const PolicyId policy : subject.policies) {
      const PolicyFacts& one = facts[manoeuvre::index(policy)];
      if (!is_so_of(claim, one, situation, subject.actors) ||
          (claim == Claim::no_harm && has_harm_of(policy, prompt, situation))) {
        verdict.wrong(told(one, situation));
      }
    }
    return;
  }
  const bool of_a_side =
      claim == Claim::not_possible || claim == Claim::blocked || claim == Claim::clear;
  if (subject.side == 0 || !of_a_side || !subject.actors.empty()) {
    return;
  }
  verdict.says_something = true;
  const auto matches = [&](const PolicyFacts& one) {
    return manoeuvre::side(one.plan.policy) == subject.side && is_so(claim, one, situation);
  };
  const auto num = std::count_if(facts.begin(), facts.end(), matches);
  constexpr std::ptrdiff_t policies_of_a_side = 3;
  if (claim == Claim::clear ? num == 0 : num < policies_of_a_side) {
    verdict.wrong(fmt::format("of the three policies to the {} {} so",
                              subject.side > 0 ? "left" : "right",
                              num == 0   ? "none is"
                              : num == 1 ? "one is"
                                         : "two are"));
  }
}

/// What was done and what was best in the case that the prompt tells of.
struct AlikeCase {
  std::optional<PolicyId> done;
  std::optional<PolicyId> best;
};

AlikeCase alike_case(std::string_view prompt) {
  const auto policy_after = [prompt](std::string_view words) -> std::optional<PolicyId> {
    const std::size_t at = prompt.find(words);
    if (at == std::string_view::npos || at + words.size() >= prompt.size()) {
      return std::nullopt;
    }
    return manoeuvre::policy_from(prompt[at + words.size()] - '0');
  };
  const auto done = policy_after(": carried out ");
  const auto best = policy_after(" best in hindsight ");
  return {done ? done : best, best};
}

void judge_alike_case(std::string_view low, std::string_view prompt, const Subject& subject,
                      Verdict& verdict) {
  const AlikeCase alike = alike_case(prompt);
  const std::optional<PolicyId> it = first_named(low);
  const auto says = [&](PolicyId policy, std::string_view what,
                        const std::optional<PolicyId>& known) {
    const bool of_it = has_phrase(low, lowered(name(policy)) + std::string(what)) ||
                       (policy == it && has_phrase(low, "this" + std::string(what)));
    if (!of_it) {
      return;
    }
    verdict.says_something = true;
    if (known != policy) {
      verdict.wrong(known ? fmt::format("in the most alike case it was {}", name(*known))
                          : "no like case tells it");
    }
  };
  for (const PolicyId policy : subject.policies) {
    says(policy, " was best", alike.best);
    says(policy, " was carried out", alike.done);
  }
}

/// What is said of a policy ("this") beside another one.
void judge_beside(std::string_view low, PolicyId it, PolicyId other, const Situation& situation,
                  Verdict& verdict) {
  const PolicyFacts& mine = situation.facts[manoeuvre::index(it)];
  const PolicyFacts& theirs = situation.facts[manoeuvre::index(other)];
  const auto must_be = [&](bool so, const std::string& why) {
    verdict.says_something = true;
    if (!so) {
      verdict.wrong(why);
    }
  };
  const auto both = [&](std::string_view how) {
    return fmt::format("{} {} {}", name(it), how, name(other));
  };
  if (has_phrase(low, "harms about as little") || has_phrase(low, "as good as")) {
    const auto may = admissible(situation.facts);
    must_be(may.test(manoeuvre::index(it)) && may.test(manoeuvre::index(other)),
            told(theirs, situation));
  }
  if (has_phrase(low, "milder")) {
    must_be(collision::milder(it, other), both("is not milder than"));
  }
  if (has_phrase(low, "less often")) {
    must_be(mine.drivable() && theirs.drivable() &&
                mine.contact_probability() < theirs.contact_probability(),
            both("touches somebody as often as"));
  }
  if (has_phrase(low, "out of the oncoming lane")) {
    const world::Road& road = situation.scene_at_trigger.road;
    must_be(!leads_into_oncoming(road, it) && leads_into_oncoming(road, other),
            both("is where oncoming traffic is, or as far from it as"));
  }
}

/// What is said of the policy that is named first ("this", "it"), alone or beside one other.
void judge_comparison(std::string_view low, const Subject& subject, const Situation& situation,
                      Verdict& verdict) {
  const std::optional<PolicyId> it = first_named(low);
  if (!it || is_denied(low)) {
    return;
  }
  if (has_phrase(low, "alone is possible")) {
    verdict.says_something = true;
    const auto num = std::count_if(situation.facts.begin(), situation.facts.end(),
                                   [](const PolicyFacts& one) { return one.drivable(); });
    if (num != 1) {
      verdict.wrong(fmt::format("{} policies are possible", num));
    }
  }
  std::vector<PolicyId> others = subject.policies;
  std::erase(others, *it);
  if (others.size() == 1) {
    judge_beside(low, *it, others.front(), situation, verdict);
  }
}

/// Whether the sentence is about what was chosen.
bool is_about(const Subject& subject, PolicyId choice) {
  return std::find(subject.policies.begin(), subject.policies.end(), choice) !=
             subject.policies.end() ||
         (subject.policies.empty() && subject.side != 0 && subject.side == manoeuvre::side(choice));
}

Verdict judged(std::string_view sentence, std::string_view prompt, const Situation& situation,
               const std::optional<PolicyId>& choice) {
  const std::string low = lowered(sentence);
  const Subject subject = subject_of(low, situation);
  Verdict verdict;
  if (!subject.unknown.empty()) {
    verdict.says_something = true;
    verdict.wrong("there is no " + subject.unknown.front());
  }
  if (subject.misnumbered) {
    verdict.says_something = true;
    verdict.wrong(fmt::format("{} is policy {}", name(*subject.misnumbered),
                              manoeuvre::index(*subject.misnumbered)));
  }
  judge_numbers(sentence, prompt, subject, situation, verdict);
  const std::optional<Claim> claim = claim_of(low);
  if (claim) {
    judge_claim(*claim, prompt, subject, situation, verdict);
  }
  judge_alike_case(low, prompt, subject, verdict);
  judge_comparison(low, subject, situation, verdict);
  if (choice && is_about(subject, *choice)) {
    verdict.load_bearing = true;
    const bool rules_out = claim == Claim::not_possible || claim == Claim::blocked;
    if (rules_out && (subject.actors.empty() || !subject.policies.empty())) {
      verdict.says_something = true;
      verdict.wrong(
          fmt::format("and yet {} {} was chosen", manoeuvre::index(*choice), name(*choice)));
    }
  }
  return verdict;
}

}  // namespace

std::optional<double> Truth::score() const {
  return num_checked == 0 ? std::nullopt
                          : std::optional(1.0 - static_cast<double>(wrong.size()) / num_checked);
}

bool Truth::is_choice_unfounded() const {
  return !wrong_reason().empty();
}

std::string Truth::wrong_reason() const {
  const auto found = std::find_if(wrong.begin(), wrong.end(),
                                  [](const FalseStatement& each) { return each.load_bearing; });
  return found == wrong.end() ? "" : found->why;
}

Truth truth_of(std::string_view reasoning, std::string_view prompt, const Situation& situation,
               const std::optional<PolicyId>& choice) {
  Truth truth;
  for (const std::string_view sentence : sentences(reasoning)) {
    for (const std::string_view clause : clauses(sentence)) {
      Verdict verdict = judged(clause, prompt, situation, choice);
      truth.num_checked += verdict.says_something ? 1 : 0;
      if (!verdict.why.empty()) {
        truth.wrong.push_back({.text = quote(clause, ""),
                               .why = std::move(verdict.why),
                               .load_bearing = verdict.load_bearing});
      }
    }
  }
  return truth;
}

Truth truth_of(const Reply& reply, std::string_view prompt, const Situation& situation) {
  return truth_of(
      finished_part(reply), prompt, situation,
      reply.answers.empty() ? std::nullopt : std::optional(likeliest_policy(reply.answers.back())));
}

}  // namespace saca::language_model
