// Longer than 400 lines: every rule by which a statement is judged stands here.
#include "saca/thinking/language_model/truth.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/language_model/claim.h"
#include "saca/thinking/language_model/conclusion.h"
#include "saca/thinking/language_model/number_check.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/prompt_lines.h"
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

bool hits(const PolicyFacts& facts) {
  return facts.drivable() && facts.outcome().contact.has_value();
}
/// As the prompt tells it: what is met first is no road user.
bool leaves_the_road(const PolicyFacts& facts) {
  return hits(facts) && !facts.outcome().contact->actor;
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
    case Claim::leaves:
      return leaves_the_road(facts);
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

/// A part of a sentence being judged.
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

/// A part of a sentence that claims one thing.
struct Part {
  std::string_view text;
  Subject subject;
  Subject of_numbers;             ///< what its numbers are about
  std::optional<PolicyId> first;  ///< the policy that the sentence names first
};

/// A part that names neither a road user nor a policy has numbers of what the part before it is
/// about, unless they are of the road or of a cue.
std::vector<Part> parts(std::string_view sentence, const Situation& situation) {
  std::vector<Part> all;
  Subject before;
  for (const std::string_view clause : clauses(sentence)) {
    const std::string low = lowered(clause);
    const Subject subject = subject_of(low, situation);
    if (subject.names_anything()) {
      before = subject;
    }
    Subject of_numbers = is_of_an_edge(low) || without_cues(low) != low ? subject : before;
    of_numbers.side = subject.side;
    of_numbers.of_case = of_numbers.of_case || subject.of_case;
    all.push_back({clause, subject, std::move(of_numbers), first_named(sentence)});
  }
  return all;
}

void judge_numbers(std::string_view text, std::string_view prompt, const Subject& subject,
                   const Situation& situation, Verdict& verdict) {
  const std::vector<QuotedNumber> said = numbers_said(text, subject.side);
  if (said.empty()) {
    return;
  }
  verdict.says_something = true;
  const auto none = unfounded(said, lines_about(prompt, subject, situation));
  if (none) {
    verdict.wrong(fmt::format("{}{}{} stands nowhere", none->text, none->unit.empty() ? "" : " ",
                              none->unit));
  }
}

/// Whether a prompt has a figure for a policy's harm: a review's has more decimals than others.
bool has_harm_of(PolicyId policy, std::string_view prompt, const Situation& situation) {
  Subject alone;
  alone.policies.push_back(policy);
  return lines_about(prompt, alone, situation).find(", harm ") != std::string::npos;
}

/// "No harm" that is said of the most alike case: the prompt tells it of a policy that is named.
void judge_harmless_case(std::string_view prompt, const Subject& subject, Verdict& verdict) {
  verdict.says_something = true;
  const std::string_view told = rest_of_line(prompt, "A case ");
  if (std::none_of(subject.policies.begin(), subject.policies.end(), [told](PolicyId policy) {
        return told.find(fmt::format("{}, no harm", name(policy))) != std::string_view::npos;
      })) {
    verdict.wrong("the most alike case does not tell it");
  }
}

void judge_claim(Claim claim, std::string_view prompt, const Subject& subject,
                 const Situation& situation, Verdict& verdict) {
  const auto& facts = situation.facts;
  if (claim == Claim::no_harm && subject.of_case && !subject.policies.empty()) {
    judge_harmless_case(prompt, subject, verdict);
    return;
  }
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

/// The policy that a text calls the next best: "next NI", "next is 7 NI"; nullopt: none.
std::optional<PolicyId> called_next(std::string_view low) {
  for (const PolicyId policy : manoeuvre::all_policies) {
    for (const std::string_view words : {"next ", "next best ", "next is ", "next best is "}) {
      const std::string called = lowered(name(policy));
      if (has_phrase(low, fmt::format("{}{}", words, called)) ||
          has_phrase(low, fmt::format("{}{} {}", words, manoeuvre::index(policy), called))) {
        return policy;
      }
    }
  }
  return std::nullopt;
}

/// Whom the text calls the next best after the policy that its sentence names first: of the others
/// none is forecast better (`Statements::next_best` names the first of equals).
void judge_next(std::string_view low, const std::optional<PolicyId>& first,
                const Situation& situation, Verdict& verdict) {
  const std::optional<PolicyId> next = called_next(low);
  if (!next || !first || next == first || is_denied(low)) {
    return;
  }
  verdict.says_something = true;
  const PolicyFacts& its = situation.facts[manoeuvre::index(*next)];
  if (!its.drivable()) {
    verdict.wrong(told(its, situation));
  }
  for (const PolicyId other : manoeuvre::all_policies) {
    if (other != first && preview::better(situation.facts[manoeuvre::index(other)], its)) {
      verdict.wrong(fmt::format("{} is better than {}", name(other), name(*next)));
    }
  }
}

/// What a text says to lie beyond an edge of the road: "trees". Where it names no side, or both, it
/// has to be so at one of them.
void judge_beyond(std::string_view low, const Subject& subject, const Situation& situation,
                  Verdict& verdict) {
  if (is_denied(low) || !has_any(low, std::array<std::string_view, 2>{"edge", "beyond"})) {
    return;
  }
  const world::Road& road = situation.scene_at_trigger.road;
  for (const world::Beyond beyond : {world::Beyond::unmarked, world::Beyond::kerb,
                                     world::Beyond::barrier, world::Beyond::trees}) {
    const std::string_view text = beyond_text(beyond);
    if (!has_phrase(low, text) || has_phrase(low, fmt::format("no {}", text))) {
      continue;
    }
    verdict.says_something = true;
    if (!(subject.side >= 0 && road.left_beyond == beyond) &&
        !(subject.side <= 0 && road.right_beyond == beyond)) {
      verdict.wrong(fmt::format("beyond the left edge: {}, beyond the right edge: {}",
                                beyond_text(road.left_beyond), beyond_text(road.right_beyond)));
    }
  }
}

/// Whether the sentence is about what was chosen.
bool is_about(const Subject& subject, PolicyId choice) {
  return std::find(subject.policies.begin(), subject.policies.end(), choice) !=
             subject.policies.end() ||
         (subject.policies.empty() && subject.side != 0 && subject.side == manoeuvre::side(choice));
}

Verdict judged(const Part& part, std::string_view prompt, const Situation& situation,
               const std::optional<PolicyId>& choice) {
  const std::string low = lowered(part.text);
  const Subject& subject = part.subject;
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
  judge_numbers(part.text, prompt, part.of_numbers, situation, verdict);
  const std::optional<Claim> claim = claim_of(low);
  if (claim) {
    judge_claim(*claim, prompt, subject, situation, verdict);
  }
  judge_alike_case(low, prompt, subject, verdict);
  judge_comparison(low, subject, situation, verdict);
  judge_next(low, part.first, situation, verdict);
  judge_beyond(low, subject, situation, verdict);
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
    for (const Part& part : parts(sentence, situation)) {
      Verdict verdict = judged(part, prompt, situation, choice);
      truth.num_checked += verdict.says_something ? 1 : 0;
      if (!verdict.why.empty()) {
        truth.wrong.push_back({.text = quote(part.text, ""),
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
