#include "saca/thinking/language_model/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::language_model::truth_test {
namespace {

using manoeuvre::PolicyId;

// truck1: 16 m ahead, 6.4 m left, moving right at 7.5 m/s; pedestrian1: 6.0 m ahead, 4.0 m left.
// AEB is clear by 0.6 m; both drifts are refused; all others hit truck1, policy k at 8 + k m/s.
Truth judge(const std::string& reasoning, std::optional<PolicyId> choice = PolicyId::aeb) {
  const preview::Situation situation = example_situation();
  return truth_of(reasoning, scene_part(situation, std::nullopt, 0.0), situation, choice);
}

/// What is wrong, in one line.
std::string wrong(const std::string& reasoning, std::optional<PolicyId> choice = PolicyId::aeb) {
  std::string all;
  for (const FalseStatement& each : judge(reasoning, choice).wrong) {
    all += (each.load_bearing ? "! " : "") + each.why + ';';
  }
  return all;
}

TEST(Truth, OfATrueReasoningIsWhole) {
  const Truth truth = judge(
      "Scenario Analysis\n"
      "1. The ego drives at 14.0 m/s; grip is 0.90.\n"
      "2. truck1 is 16 m ahead and moves right at 7.5 m/s. pedestrian1 stands 4.0 m left.\n"
      "3. Policies 1, 3 and 5 are blocked, T-D-R is not possible.\n"
      "4. AES-R hits truck1 with its front at 10.0 m/s.\n"
      "5. AEB is clear by 0.6 m with no harm: the least harm.\n"
      "Response to user: 0");
  for (const FalseStatement& each : truth.wrong) {
    ADD_FAILURE() << each.text << " -> " << each.why;
  }
  EXPECT_GE(truth.num_checked, 6);
  EXPECT_EQ(truth.score(), 1.0);
  EXPECT_FALSE(truth.is_choice_unfounded());
}

// A reply may be cut anywhere.
TEST(Truth, OfATrueReplyStaysTrueHoweverItIsCut) {
  const std::string text =
      "Scenario Analysis\n"
      "1. The ego drives at 14.0 m/s; grip is 0.90.\n"
      "2. truck1 is 16.0 m ahead and moves right at 7.5 m/s. pedestrian1 stands 4.0 m left.\n"
      "3. AES-R hits truck1 at 10.0 m/s, harm 0.013. AEB is clear by 0.6 m.\n";
  const preview::Situation situation = example_situation();
  const std::string prompt = scene_part(situation, std::nullopt, 0.0);
  Reply reply{.answers = {{.probability = {1.0}, .kind = Answer::Kind::forced}}};
  for (const char letter : text) {
    reply.reasoning += letter;
    const Truth truth = truth_of(reply, prompt, situation);
    for (const FalseStatement& each : truth.wrong) {
      ADD_FAILURE() << reply.reasoning << " -> " << each.why;
    }
  }
  EXPECT_GE(truth_of(reply, prompt, situation).num_checked, 5);
  reply.reasoning = "AEB hits truck1.\n";
  EXPECT_TRUE(truth_of(reply, prompt, situation).is_choice_unfounded());
  reply.answers.clear();
  EXPECT_FALSE(truth_of(reply, prompt, situation).is_choice_unfounded());
}

TEST(Truth, OfWhatSaysNothingIsNotKnown) {
  EXPECT_EQ(judge("Scenario Analysis\n1. Be careful.\nResponse to user: 0").score(), std::nullopt);
  EXPECT_EQ(judge("").score(), std::nullopt);
}

TEST(Truth, NumbersStandInALineAboutTheirSubject) {
  EXPECT_EQ(wrong("truck1 is 6.4 m left."), "");
  EXPECT_EQ(wrong("truck1 is 4.0 m left."), "4.0 m stands nowhere;");  // that is the pedestrian
  EXPECT_EQ(wrong("Somebody is 4.0 m left."), "");
  EXPECT_EQ(wrong("truck1 moves at 7.5 m."), "7.5 m stands nowhere;");  // the unit is another
  EXPECT_EQ(wrong("truck1 moves at 8 m/s."), "8 m/s stands nowhere;");  // too coarse for 7.5
  EXPECT_EQ(wrong("truck1 moves at 8.0 m/s."), "8.0 m/s stands nowhere;");
  EXPECT_EQ(wrong("truck1 is 16 m ahead."), "");
  EXPECT_EQ(wrong("Risk is 1."), "1 stands nowhere;");  // of 0.94
}

TEST(Truth, NumbersStandWhereAndForWhatIsSaid) {
  EXPECT_EQ(wrong("truck1 is 6.4 m ahead."), "6.4 m stands nowhere;");
  EXPECT_EQ(wrong("truck1 is 16.0 m left."), "16.0 m stands nowhere;");
  EXPECT_EQ(wrong("truck1 is 16.0 m away."), "") << "no direction is told";
  EXPECT_EQ(wrong("truck1 is 16.0 m away, trees."), "16.0 m stands nowhere;");
  EXPECT_EQ(wrong("truck1: risk 0.94."), "");
  EXPECT_EQ(wrong("truck1: brake 0.94."), "0.94 stands nowhere;");
}

// left edge 5.2 m, kerb; right edge 1.8 m
TEST(Truth, EdgesAreThoseOfTheirSide) {
  EXPECT_EQ(wrong("Beyond the left edge, 5.2 m away, is a kerb."), "");
  EXPECT_EQ(wrong("The left edge is 5.2 m away, the right edge 1.8 m."), "");
  EXPECT_EQ(wrong("Beyond the left edge, 1.8 m away, is a kerb."), "1.8 m stands nowhere;");
  EXPECT_EQ(wrong("Right edge 5.2 m."), "5.2 m stands nowhere;");
  EXPECT_EQ(wrong("On the left the edge 1.8 m."), "1.8 m stands nowhere;");
  EXPECT_EQ(wrong("An edge is 1.8 m away."), "");
}

TEST(Truth, WhatLiesBeyondAnEdgeLiesThere) {
  const std::string so = "beyond the left edge: kerb, beyond the right edge: open ground;";
  EXPECT_EQ(wrong("Beyond the left edge, 5.2 m away, are trees."), so);
  EXPECT_EQ(wrong("Beyond the left edge, 5.2 m away, is a barrier."), so);
  EXPECT_EQ(wrong("Beyond the right edge is a kerb."), so);
  EXPECT_EQ(wrong("Beyond the right edge is open ground."), "");
  EXPECT_EQ(wrong("Beyond one edge is a kerb."), "");
  EXPECT_EQ(wrong("Beyond the right edge is no kerb."), "");
}

// What follows a claim is of whom that names: "harm 0.013" after "NI hits truck1" is NI's.
TEST(Truth, NumbersBehindAClaimAreOfItsSubject) {
  preview::Situation situation = example_situation();
  situation.facts[2].outcome().harm = 0.02;
  const std::string prompt = scene_part(situation, std::nullopt, 0.0);
  const auto why = [&](const std::string& text) {
    const Truth truth = truth_of(text, prompt, situation, PolicyId::aeb);
    return truth.wrong.empty() ? "" : truth.wrong.front().why;
  };
  EXPECT_EQ(why("NI hits truck1 at 15.0 m/s, harm 0.013."), "");
  EXPECT_EQ(why("NI hits truck1 at 15.0 m/s, harm 0.020."), "0.020 stands nowhere");
  EXPECT_EQ(why("NI hits truck1, which is bad, harm 0.020."), "0.020 stands nowhere");
  EXPECT_EQ(why("NI hits truck1 at 9.0 m/s."), "9.0 m/s stands nowhere") << "AES-L does";
  EXPECT_EQ(why("truck1, 16 m ahead: AES-R hits it, harm 0.020."), "");
  EXPECT_EQ(why("NI hits truck1, AES-R has harm 0.020."), "");
  EXPECT_EQ(why("AEB is clear, the left edge is 5.2 m away."), "") << "the road is nobody's";
}

TEST(Truth, QuotientsAreComputed) {
  EXPECT_EQ(wrong("Time: 16.0 m / 14.0 m/s = 1.14 s."), "");
  EXPECT_EQ(wrong("Time: 16.0 m / 14.0 m/s = 1.23 s."), "1.23 s stands nowhere;");
}

TEST(Truth, NamesAreThoseOfTheScene) {
  EXPECT_EQ(wrong("car3 comes."), "there is no car3;");
  EXPECT_EQ(wrong("truck1 and pedestrian1 come."), "");
  EXPECT_EQ(wrong("truck12 comes."), "there is no truck12;");
}

TEST(Truth, ClaimsAboutPoliciesAreTheirForecasts) {
  EXPECT_EQ(wrong("Policy 2 is clear."), "2 AES-R: hits truck1 with its front at 10.0 m/s;");
  EXPECT_EQ(wrong("AEB hits truck1."), "! 0 AEB: clear by 0.6 m;");
  EXPECT_EQ(wrong("AES-L is not possible."), "1 AES-L: hits truck1 with its front at 9.0 m/s;");
  EXPECT_EQ(wrong("T-D-L is not possible."), "");
  EXPECT_EQ(wrong("Action 7 has the least harm."), "7 NI: hits truck1 with its front at 15.0 m/s;");
  EXPECT_EQ(wrong("Action 0 avoids contact."), "");
  EXPECT_EQ(wrong("AEB does not hit truck1."), "");
  EXPECT_EQ(wrong("AEB: harm 0.0000."), "");
  EXPECT_EQ(wrong("AES-L: harm 0."), "0 stands nowhere;");
}

TEST(Truth, WhoIsHitIsWhomThePolicyIsForecastToHit) {
  EXPECT_EQ(wrong("AES-R hits truck1."), "");
  EXPECT_EQ(wrong("AES-R hits pedestrian1."), "2 AES-R: hits truck1 with its front at 10.0 m/s;");
  EXPECT_EQ(wrong("AES-R does not hit pedestrian1."), "");
  EXPECT_EQ(wrong("AES-R is clear of truck1."), "2 AES-R: hits truck1 with its front at 10.0 m/s;");
  EXPECT_EQ(wrong("T-D-R is clear of truck1."), "6 T-D-R: not possible;");
}

TEST(Truth, PoliciesHaveTheirOwnNumbers) {
  EXPECT_EQ(wrong("6 T-D-R is not possible."), "");
  EXPECT_EQ(wrong("8 T-D-R is not possible."), "T-D-R is policy 6;");
  EXPECT_EQ(wrong("0 AEB is clear, 12 AES-L hits truck1."), "AES-L is policy 1;");
  EXPECT_EQ(wrong("1. AEB is clear."), "");  // the line's number
  EXPECT_EQ(wrong("The grip is 0.90 AEB is clear."), "");
  EXPECT_EQ(wrong("So 0 AEB: it is clear"), "");  // its own number is no figure
  EXPECT_EQ(wrong("the best is 0 AEB"), "");
  EXPECT_EQ(wrong("the best is 3 AEB"), "! AEB is policy 0;");
}

// As the prompt says it where what is met first is no road user.
TEST(Truth, WhoLeavesTheRoadIsForecastTo) {
  EXPECT_EQ(wrong("AES-L leaves the road."), "1 AES-L: hits truck1 with its front at 9.0 m/s;");
  EXPECT_EQ(wrong("AEB leaves the road."), "! 0 AEB: clear by 0.6 m;");
  EXPECT_EQ(wrong("T-D-L leaves the road."), "5 T-D-L: not possible;");
  preview::Situation situation = example_situation();
  situation.facts[1].outcome().contact->actor.reset();
  situation.facts[1].outcome().contact->edge = collision::Side::left;
  const Truth truth = truth_of("AES-L leaves the road, harm 0.013.",
                               scene_part(situation, std::nullopt, 0.0), situation, PolicyId::aeb);
  EXPECT_EQ(truth.num_checked, 2);
  EXPECT_TRUE(truth.wrong.empty());
}

// By forecast: AEB, NI, then ES-B-L and ES-B-R, which are equals, then AES-L and AES-R likewise.
TEST(Truth, WhatIsNextIsTheBestOfTheOthers) {
  EXPECT_EQ(wrong("So AEB: least harm, next NI"), "");
  EXPECT_EQ(wrong("So AEB: least harm, next NI, harm 0.013"), "");
  EXPECT_EQ(wrong("So AEB: least harm, next ES-B-L"), "NI is better than ES-B-L;");
  EXPECT_EQ(wrong("So AEB: least harm, next is 3 ES-B-L"), "NI is better than ES-B-L;");
  EXPECT_EQ(wrong("So AEB: least harm, next T-D-L"), "5 T-D-L: not possible;");
  EXPECT_EQ(wrong("So AEB: least harm, next to truck1"), "");
  preview::Situation situation = example_situation();
  situation.facts[7].end = preview::Refusal{"somebody else drives"};
  for (const char* equal : {"So AEB: least harm, next ES-B-L", "So AEB: least harm, next ES-B-R"}) {
    const Truth truth = truth_of(equal, scene_part(situation, std::nullopt, 0.0), situation, {});
    EXPECT_TRUE(truth.wrong.empty()) << equal;
    EXPECT_EQ(truth.num_checked, 2) << equal;
  }
}

// What denies or excepts is not understood well enough to accuse anybody.
TEST(Truth, DenialsAndExceptionsAreNotJudged) {
  for (const char* text :
       {"AEB is not blocked.", "Policy 0 hits nothing.", "All policies but AEB hit truck1.",
        "Unlike AEB, policy 1 hits truck1.", "AEB never hits truck1.", "AEB isn't blocked.",
        "Nobody but truck1 is hit by policy 0.", "All except AEB are blocked."}) {
    EXPECT_EQ(wrong(text), "") << text;
  }
}

TEST(Truth, RangesOfPoliciesAreLists) {
  EXPECT_EQ(wrong("Policies 1-4 are blocked."), "");
  EXPECT_EQ(wrong("Policies 1 to 4 hit truck1."), "");
  EXPECT_EQ(wrong("Policies 0 to 4 hit truck1."), "! 0 AEB: clear by 0.6 m;");
  EXPECT_EQ(wrong("Policies 1-4 are blocked.", PolicyId::es_b_left),
            "! and yet 3 ES-B-L was chosen;");
}

TEST(Truth, ClaimsAboutASideAreThoseOfItsThreePolicies) {
  EXPECT_EQ(wrong("The left is blocked."), "");
  EXPECT_EQ(wrong("The right is clear."), "of the three policies to the right none is so;");
  EXPECT_EQ(wrong("Left is not possible."), "of the three policies to the left one is so;");
}

TEST(Truth, NobodyChoosesWhatHeCallsBlocked) {
  EXPECT_EQ(wrong("The left is blocked.", PolicyId::aes_left), "! and yet 1 AES-L was chosen;");
  EXPECT_EQ(wrong("The left is blocked.", PolicyId::aes_right), "");
  EXPECT_EQ(wrong("Policies 1 and 2 are blocked.", PolicyId::aes_right),
            "! and yet 2 AES-R was chosen;");
  EXPECT_TRUE(judge("Action 1 is blocked.", PolicyId::aes_left).is_choice_unfounded());
  EXPECT_FALSE(judge("Action 2 is clear.", PolicyId::aes_left).is_choice_unfounded());
}

// AEB is clear, AES-R hits the truck: they can be told apart, until AES-R harms as little.
TEST(Truth, ComparisonsAreSo) {
  preview::Situation situation = example_situation();
  const auto why = [&](const std::string& text, PolicyId choice) {
    const Truth truth = truth_of(text, scene_part(situation, std::nullopt, 0.0), situation, choice);
    EXPECT_EQ(truth.num_checked, 1) << text;
    return truth.wrong.empty() ? "" : truth.wrong.front().why;
  };
  const std::string little = "So AEB: AES-R harms about as little, and this is milder";
  EXPECT_THAT(why(little, PolicyId::aeb), testing::StartsWith("2 AES-R: hits truck1"));
  situation.facts[2].outcome().harm = situation.facts[0].outcome().harm;
  EXPECT_EQ(why(little, PolicyId::aeb), "");
  EXPECT_EQ(why("So AEB: as good as AES-R, and milder", PolicyId::aeb), "");
  EXPECT_EQ(why("So AES-R: AEB harms about as little, and this is milder", PolicyId::aes_right),
            "AES-R is not milder than AEB");
  EXPECT_EQ(why("So AES-R: as good as AEB, and milder", PolicyId::aes_right),
            "AES-R is not milder than AEB");
  EXPECT_EQ(why("So AES-R: as good as AES-L", PolicyId::aes_right),
            "1 AES-L: hits truck1 with its front at 9.0 m/s");
  EXPECT_EQ(why("So AES-R: AES-L harms about as little, and this is milder", PolicyId::aes_right),
            "1 AES-L: hits truck1 with its front at 9.0 m/s");
  situation.scene_at_trigger.road.oncoming_left = true;
  situation.facts[1].outcome().harm = situation.facts[0].outcome().harm;
  const std::string oncoming = " harms about as little, and this stays out of the oncoming lane";
  EXPECT_EQ(why("So AES-R: AES-L" + oncoming, PolicyId::aes_right), "");
  EXPECT_NE(why("So AES-L: AES-R" + oncoming, PolicyId::aes_left), "");
  EXPECT_EQ(why("I choose AEB: it alone is possible", PolicyId::aeb), "6 policies are possible");
  EXPECT_EQ(truth_of("AES-R is milder.", "", situation, std::nullopt).num_checked, 0)
      << "than what?";
  // Whatever is answered then: "this" is what the sentence speaks of.
  EXPECT_EQ(why("So AES-R: AEB harms about as little, and this is milder", PolicyId::aeb),
            "AES-R is not milder than AEB");
}

// A siren "of an emergency vehicle that is not seen" denies nothing.
TEST(Truth, NamesOfCuesDenyNothing) {
  preview::Situation situation = example_situation();
  situation.facts[2].outcome().harm = situation.facts[0].outcome().harm;
  situation.scene_at_trigger.cues.push_back({world::CueKind::emergency_vehicle, {12.0, -3.5}});
  const std::string prompt = scene_part(situation, std::nullopt, 0.0);
  const std::string away =
      ", and keeps away from the siren of an emergency vehicle that is not seen";
  const Truth so = truth_of("So AEB: as good as AES-R" + away, prompt, situation, PolicyId::aeb);
  EXPECT_EQ(so.num_checked, 1);
  EXPECT_TRUE(so.wrong.empty());
  const Truth not_so =
      truth_of("So AEB: as good as AES-L" + away, prompt, situation, PolicyId::aeb);
  EXPECT_TRUE(not_so.is_choice_unfounded());
}

TEST(Truth, OfALikeCaseIsWhatThePromptTells) {
  const preview::Situation situation = example_situation();
  memory::Case nearest;
  nearest.plan.policy = PolicyId::aeb;
  nearest.best = PolicyId::es_b_left;
  const auto why = [&](const std::string& text, const std::optional<memory::Case>& told) {
    const Truth truth =
        truth_of(text, scene_part(situation, told, 0.9), situation, PolicyId::es_b_left);
    EXPECT_EQ(truth.num_checked, 1) << text;
    return truth.wrong.empty() ? "" : truth.wrong.front().why;
  };
  EXPECT_EQ(why("In the most alike case ES-B-L was best in hindsight, though AEB was carried out",
                nearest),
            "");
  EXPECT_EQ(why("In the nearest case AEB was best in hindsight", nearest),
            "in the most alike case it was ES-B-L");
  EXPECT_EQ(why("So ES-B-L: and this was best in the most alike case", nearest), "");
  EXPECT_EQ(why("ES-B-L was best in hindsight", std::nullopt), "no like case tells it");
}

// AEB is forecast to do no harm, and ES-B-L to do 0.013.
TEST(Truth, OfALikeCaseItsFiguresMayBeQuoted) {
  const preview::Situation situation = example_situation();
  memory::Case nearest;
  nearest.plan.policy = PolicyId::aeb;
  nearest.harm = 0.072;
  nearest.best = PolicyId::es_b_left;
  const std::string prompt = scene_part(situation, nearest, 0.83);
  const auto why = [&](const std::string& text) {
    const Truth truth = truth_of(text, prompt, situation, PolicyId::es_b_left);
    EXPECT_GT(truth.num_checked, 0) << text;
    return truth.wrong.empty() ? "" : truth.wrong.front().why;
  };
  const std::string line = prompt.substr(prompt.find("A case 83 % alike"));
  ASSERT_EQ(line,
            "A case 83 % alike: carried out 0 AEB, harm 0.072; best in hindsight 3 ES-B-L, no "
            "harm\n");
  EXPECT_EQ(why("1. " + line), "");
  EXPECT_EQ(why("A case 84 % alike: carried out 0 AEB"), "84 % stands nowhere");
  EXPECT_EQ(why("A case 83 % alike: carried out 0 AEB, no harm"),
            "the most alike case does not tell it");
  EXPECT_EQ(why("AEB does no harm"), "") << "as is forecast, whatever the case did";
  EXPECT_EQ(why("AEB: harm 0.072"), "0.072 stands nowhere") << "that is the case's";
}

TEST(Truth, IsKeptInOrderAndCounted) {
  const Truth truth = judge("car9 comes.\n\nAEB is clear. The right is clear.\n- x");
  EXPECT_EQ(truth.num_checked, 3);
  ASSERT_EQ(truth.wrong.size(), 2U);
  EXPECT_EQ(truth.wrong[0].text, "car9 comes.");
  EXPECT_DOUBLE_EQ(*truth.score(), 1.0 / 3.0);
}

TEST(Truth, AnythingCanBeJudged) {
  std::mt19937 random(11);
  const std::vector<std::string> words{
      "policy", "1",  ",",    "and", "left", "blocked", "clear",    "AEB",   "car",  "7",
      ".",      "\n", "16.0", "m/s", "=",    "\xff",    "\xc3\xa4", "T-D-R", "hits", " "};
  std::uniform_int_distribution<std::size_t> word(0, words.size() - 1);
  for (int i = 0; i < 2'000; ++i) {
    std::string text;
    for (int k = i % 40; k > 0; --k) {
      text += words[word(random)] + (k % 3 == 0 ? "" : " ");
    }
    const Truth truth = judge(text, manoeuvre::all_policies[static_cast<std::size_t>(i) % 8]);
    EXPECT_LE(truth.wrong.size(), static_cast<std::size_t>(truth.num_checked)) << text;
  }
}

}  // namespace
}  // namespace saca::language_model::truth_test
