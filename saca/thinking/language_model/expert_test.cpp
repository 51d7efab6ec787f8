#include "saca/thinking/language_model/expert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/thinking/language_model/crowded_situation_for_test.h"
#include "saca/thinking/language_model/expert_choice.h"
#include "saca/thinking/language_model/left_is_open_for_test.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/statements.h"
#include "saca/thinking/language_model/token_bound.h"
#include "saca/thinking/language_model/truth.h"

namespace saca::language_model::expert_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::Not;

constexpr int ample = 170;  // tokens

std::string replied(const preview::Situation& situation, PolicyId choice, unsigned seed,
                    int most_tokens = ample) {
  std::mt19937_64 random(seed);
  return expert_reply(situation, scene_part(situation, std::nullopt, 0.8), std::nullopt, choice,
                      most_tokens, random);
}

TEST(Expert, SaysWhatThreatensWhatBrakingDoesAndWhy) {
  const preview::Situation situation = left_is_open();
  const std::string text = replied(situation, PolicyId::es_b_left, 3);
  EXPECT_THAT(text, testing::StartsWith("Scenario Analysis\n1. "));
  EXPECT_THAT(text, HasSubstr("truck1, 16 m ahead, 6.4 m left"));
  EXPECT_THAT(text, HasSubstr(": AEB hits it, harm 0.10"));
  EXPECT_THAT(text, HasSubstr("So ES-B-L: as good as AES-L"));
  EXPECT_THAT(text, testing::EndsWith("\nResponse to user: 3"));
}

// Not the one of the highest risk.
TEST(Expert, NamesWhoIsHitIfNothingIsDone) {
  preview::Situation situation = left_is_open();
  situation.risks[1].risk = 0.99;
  const std::string text = replied(situation, PolicyId::es_b_left, 3);
  EXPECT_THAT(text, HasSubstr("truck1, 16 m ahead"));
  EXPECT_THAT(text, Not(HasSubstr("pedestrian1")));
}

TEST(Expert, NamesTheRunnerUpsHarm) {
  preview::Situation situation = left_is_open();
  of(situation, PolicyId::aes_left).outcome().harm = 0.02;
  const std::string text = replied(situation, PolicyId::es_b_left, 1);
  EXPECT_THAT(text, HasSubstr("So ES-B-L: least harm, next NI, harm 0.013"));
}

// What it says holds, whatever the scene: it is true by construction.
TEST(Expert, SaysNothingFalse) {
  std::set<std::string> conclusions;
  for (unsigned seed = 0; seed < 400; ++seed) {
    const preview::Situation situation = seed % 4 == 0 ? left_is_open() : crowded_situation(seed);
    std::optional<memory::Case> nearest;
    if (seed % 3 == 0) {
      nearest.emplace();
      nearest->best = *manoeuvre::policy_from(static_cast<int>(seed % 8));
      nearest->harm = 0.2;
    }
    std::mt19937_64 random(seed);
    memory::PolicyHarms known;
    for (auto& harm : known) {
      harm = std::uniform_real_distribution<double>(0.0, 0.01)(random);
    }
    const std::string prompt = scene_part(situation, nearest, 0.8);
    const PolicyId choice = expert_choice(situation.facts, known);
    std::mt19937_64 same = random;
    const std::string text = expert_reply(situation, prompt, nearest, choice,
                                          seed % 2 == 0 ? ample : most_taught_tokens, random);
    EXPECT_EQ(stated_policy(text), choice) << text;
    const Truth truth = truth_of(text, prompt, situation, choice);
    EXPECT_GE(truth.num_checked, 2) << text;
    for (const FalseStatement& one : truth.wrong) {
      ADD_FAILURE() << one.text << ": " << one.why << '\n' << prompt << text;
    }
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), most_statements + 1) << text;
    const int least = tokens_at_most(expert_reply(situation, prompt, nearest, choice, 0, same));
    EXPECT_LE(tokens_at_most(text), seed % 2 == 0 ? ample : std::max(most_taught_tokens, least))
        << text;
    conclusions.insert(text.substr(text.rfind('\n', text.rfind("\nResponse") - 1)));
  }
  EXPECT_GE(conclusions.size(), 50U);
}

// Where few tokens are allowed, details are left out, never who threatens or why this one.
TEST(Expert, SaysLessWhereItHasLess) {
  const preview::Situation situation = left_is_open();
  std::set<std::string> texts;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const std::string text = replied(situation, PolicyId::es_b_left, seed, most_taught_tokens);
    EXPECT_LE(tokens_at_most(text), most_taught_tokens) << text;
    EXPECT_THAT(text, HasSubstr("truck1, 16 m ahead")) << text;
    EXPECT_THAT(text, HasSubstr(" hits it")) << text;
    EXPECT_THAT(text, HasSubstr("So ES-B-L: as good as AES-L")) << text;
    texts.insert(text);
  }
  EXPECT_GE(texts.size(), 2U);  // what is left out is drawn
  const std::string least = replied(situation, PolicyId::es_b_left, 1, 0);
  EXPECT_THAT(least, testing::StartsWith("Scenario Analysis\n1. truck1, 16 m ahead: "));
  EXPECT_EQ(std::count(least.begin(), least.end(), '\n'), 3);
}

TEST(Expert, SameSeedSaysTheSame) {
  const preview::Situation situation = left_is_open();
  EXPECT_EQ(replied(situation, PolicyId::aes_left, 5), replied(situation, PolicyId::aes_left, 5));
  std::set<std::string> texts;
  for (unsigned seed = 0; seed < 50; ++seed) {
    texts.insert(replied(situation, PolicyId::aes_left, seed));
  }
  EXPECT_GE(texts.size(), 10U);
}

TEST(Expert, DoesNothingWhereNothingThreatens) {
  preview::Situation situation = left_is_open();
  auto& end = of(situation, PolicyId::no_intervention).end.emplace<preview::ExpectedOutcome>();
  end.outcome.clearance = 3.0;
  ASSERT_EQ(expert_choice(situation.facts, {}), PolicyId::no_intervention);
  const std::string text = replied(situation, PolicyId::no_intervention, 1);
  EXPECT_THAT(text, Not(HasSubstr("threatens is")));
  EXPECT_THAT(text, testing::EndsWith("Response to user: 7"));
}

// Vans on the right: what may step out speaks against going there.
TEST(Expert, WarnsOfWhatIsNotSeen) {
  preview::Situation situation = left_is_open();
  of(situation, PolicyId::aes_left).outcome().harm = 0.05;
  of(situation, PolicyId::es_b_right).end.emplace<preview::ExpectedOutcome>().outcome.clearance =
      2.0;
  situation.scene_at_trigger.cues.push_back({world::CueKind::parked_vans, {12.0, -3.5}});
  std::set<std::string> texts;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::string text = replied(situation, PolicyId::es_b_left, seed);
    EXPECT_THAT(text, HasSubstr("The row of parked vans 12 m ahead, 3.5 m right may "));
    const std::string prompt = scene_part(situation, std::nullopt, 0.0);
    EXPECT_TRUE(truth_of(text, prompt, situation, PolicyId::es_b_left).wrong.empty()) << text;
    texts.insert(text);
  }
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [](const std::string& text) {
    return text.find("as good as ES-B-R, and keeps away from the row of parked vans") !=
           std::string::npos;
  }));
  // Of two alike the nearer one.
  situation.scene_at_trigger.cues.push_back({world::CueKind::parked_vans, {7.0, -3.5}});
  EXPECT_THAT(replied(situation, PolicyId::es_b_left, 1), HasSubstr("vans 7.0 m ahead"));
  for (world::Cue& cue : situation.scene_at_trigger.cues) {
    cue.p_W.x = -5.0;  // passed
  }
  EXPECT_THAT(replied(situation, PolicyId::es_b_left, 1), Not(HasSubstr("vans")));
}

TEST(Expert, RefusesAChoiceThatIsKnowinglyWorse) {
  const preview::Situation situation = left_is_open();
  EXPECT_THROW(replied(situation, PolicyId::aeb, 1), ContractViolation);
  EXPECT_THROW(replied(situation, PolicyId::t_drift_left, 1), ContractViolation);
}

}  // namespace
}  // namespace saca::language_model::expert_test
