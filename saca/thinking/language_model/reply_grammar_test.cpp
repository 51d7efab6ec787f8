#include "saca/thinking/language_model/reply_grammar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "saca/thinking/language_model/conclusion.h"
#include "saca/thinking/language_model/crowded_situation_for_test.h"
#include "saca/thinking/language_model/expert.h"
#include "saca/thinking/language_model/explanation.h"
#include "saca/thinking/language_model/gbnf_for_test.h"
#include "saca/thinking/language_model/left_is_open_for_test.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/truth.h"

namespace saca::language_model::reply_grammar_test {
namespace {

using manoeuvre::PolicyId;

constexpr std::string_view asks_for_answer = "\nResponse to user:";

/// A forecast as replies are about: what is asked, and the grammar of what is true.
struct Asked {
  preview::Situation situation;
  std::optional<memory::Case> nearest;
  std::string prompt;

  [[nodiscard]] Gbnf grammar(const std::optional<PolicyId>& choice = {}) const {
    return Gbnf(reply_grammar(situation, prompt, nearest, choice));
  }
  [[nodiscard]] std::vector<PolicyId> may() const {
    std::vector<PolicyId> all;
    for (const PolicyId policy : manoeuvre::all_policies) {
      if (admissible(situation.facts).test(manoeuvre::index(policy))) {
        all.push_back(policy);
      }
    }
    return all;
  }
};

/// Every fourth scene sparse, the others crowded; in some, several policies harm alike, or one
/// leaves the road; some have cues, or a case.
Asked asked(unsigned seed) {
  Asked one{.situation = seed % 4 == 0 ? left_is_open() : crowded_situation(seed),
            .nearest = {},
            .prompt = {}};
  if (seed % 2 == 1) {
    for (preview::PolicyFacts& facts : one.situation.facts) {
      facts.outcome().harm = facts.outcome().harm < 10.0 ? 0.02 : 0.3;
    }
  }
  if (seed % 3 == 0) {
    one.nearest.emplace();
    one.nearest->best = *manoeuvre::policy_from(static_cast<int>(seed % 8));
    one.nearest->harm = 0.2;
    one.nearest->origin = seed % 6 == 0 ? memory::Origin::expert : memory::Origin::own;
  }
  if (seed % 5 == 0) {
    one.situation.scene_at_trigger.cues.push_back({world::CueKind::parked_vans, {12.0, -3.5}});
  }
  if (seed % 5 == 1) {
    one.situation.scene_at_trigger.cues.push_back(
        {world::CueKind::emergency_vehicle, {12.0, -3.5}});
  }
  if (seed % 7 == 3) {
    one.situation.facts[2].outcome().contact->actor.reset();
    one.situation.facts[2].outcome().contact->edge = collision::Side::right;
  }
  one.prompt = scene_part(one.situation, one.nearest, 0.8);
  return one;
}

/// What is false or says nothing, of a text that comes to a policy.
void expect_true(const std::string& text, const Asked& about) {
  const auto choice = concluded(text.substr(0, text.rfind(asks_for_answer)));
  ASSERT_TRUE(choice) << text;
  const Truth truth = truth_of(text, about.prompt, about.situation, choice);
  EXPECT_GE(truth.num_checked, 1) << text;
  for (const FalseStatement& one : truth.wrong) {
    ADD_FAILURE() << one.text << ": " << one.why << '\n' << about.prompt << text;
  }
  // Nor is it refused: what it comes to can be checked.
  EXPECT_TRUE(true_part(text, about.prompt, about.situation, choice)) << about.prompt << text;
}

TEST(ReplyGrammar, AllowsNothingFalse) {
  std::set<std::string> texts;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Asked about = asked(seed);
    const Gbnf grammar = about.grammar();
    std::mt19937_64 random(seed);
    for (int k = 0; k < 20; ++k) {
      const std::string text = grammar.drawn(random);
      EXPECT_TRUE(text.ends_with(asks_for_answer)) << text;
      expect_true(text, about);
      texts.insert(text);
    }
  }
  EXPECT_GE(texts.size(), 2000U);  // and much that is true
}

TEST(ReplyGrammar, AllowsWhatExpertsSay) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Asked about = asked(seed);
    const Gbnf any = about.grammar();
    for (const PolicyId choice : about.may()) {
      const Gbnf grammar = about.grammar(choice);
      for (const int most_tokens : {170, most_taught_tokens, 0}) {
        std::mt19937_64 random(seed);
        const std::string reply =
            expert_reply(about.situation, about.prompt, about.nearest, choice, most_tokens, random);
        const std::string text = reply.substr(0, reply.size() - 2);  // without the answer
        EXPECT_TRUE(grammar.accepts(text)) << about.prompt << text;
        // What rules a side out is no longer to be said where it may be chosen.
        const bool of_a_side =
            text.find("blocked") != std::string::npos || text.find("to the") != std::string::npos;
        EXPECT_TRUE(of_a_side || any.accepts(text)) << about.prompt << text;
      }
    }
  }
}

TEST(ReplyGrammar, ComesToTheChoice) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Asked about = asked(seed);
    std::set<PolicyId> open;
    std::mt19937_64 random(seed);
    for (int k = 0; k < 60; ++k) {
      const std::string text = about.grammar().drawn(random);
      open.insert(*concluded(text.substr(0, text.rfind(asks_for_answer))));
    }
    const std::vector<PolicyId> may = about.may();
    EXPECT_EQ(open, std::set<PolicyId>(may.begin(), may.end()));
    const std::string text = about.grammar(may.back()).drawn(random);
    EXPECT_EQ(concluded(text.substr(0, text.rfind(asks_for_answer))), may.back()) << text;
  }
}

// What replies of the shipped weights get wrong where nobody holds them to it.
TEST(ReplyGrammar, RefusesWhatIsFalse) {
  const Asked about = asked(0);
  const Gbnf grammar = about.grammar();
  const auto reply = [](const std::string& statement) {
    return "Scenario Analysis\n1. truck1, 16 m ahead: NI hits it.\n2. " + statement +
           ".\nResponse to user:";
  };
  EXPECT_TRUE(grammar.accepts(reply("So ES-B-L: as good as AES-L, and milder")));
  EXPECT_FALSE(grammar.accepts(reply("So AES-L: as good as ES-B-L, and milder")));
  EXPECT_FALSE(grammar.accepts(reply("So ES-B-L: as good as ES-B-L, and milder")));
  EXPECT_FALSE(grammar.accepts(reply("So ES-B-L: least harm, next AES-L")));
  EXPECT_FALSE(grammar.accepts(reply("So AEB: as good as AES-L, and milder")));  // it hits
  EXPECT_FALSE(
      grammar.accepts("Scenario Analysis\n1. truck1, 17 m ahead: NI hits it.\n"
                      "2. So ES-B-L: as good as AES-L, and milder.\nResponse to user:"));
}

TEST(ReplyGrammar, SaysNothingOfRisksThatAreNotTold) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Asked about = asked(seed);
    about.prompt = without_risks(about.prompt);
    std::mt19937_64 random(seed);
    for (int k = 0; k < 20; ++k) {
      const std::string text = about.grammar().drawn(random);
      EXPECT_EQ(text.find(", risk "), std::string::npos) << text;
      expect_true(text, about);
    }
  }
}

TEST(ReplyGrammar, IsNoneWhereNothingIsKnownToBeTrue) {
  Asked about = asked(0);
  EXPECT_EQ(reply_grammar(about.situation, without_facts(about.prompt), std::nullopt), "");
  EXPECT_EQ(reply_grammar(about.situation, about.prompt, std::nullopt, PolicyId::aeb), "");
  EXPECT_EQ(reply_grammar(about.situation, "", std::nullopt), "");
  for (preview::PolicyFacts& facts : about.situation.facts) {
    facts.end = preview::Refusal{"the road is too slippery"};
  }
  about.prompt = scene_part(about.situation, std::nullopt, 0.0);
  EXPECT_EQ(reply_grammar(about.situation, about.prompt, std::nullopt), "");
}

TEST(ReplyGrammar, SaysWhatAloneIsPossible) {
  Asked about = asked(0);
  for (preview::PolicyFacts& facts : about.situation.facts) {
    if (facts.plan.policy != PolicyId::aeb) {
      facts.end = preview::Refusal{"the road is too slippery"};
    }
  }
  about.prompt = scene_part(about.situation, std::nullopt, 0.0);
  std::mt19937_64 random(1);
  const std::string text = about.grammar().drawn(random);
  EXPECT_THAT(text, testing::HasSubstr("So AEB: it alone is possible.\nResponse to user:"));
  expect_true(text, about);
}

}  // namespace
}  // namespace saca::language_model::reply_grammar_test
