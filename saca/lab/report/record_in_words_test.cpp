#include "saca/lab/report/record_in_words.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace saca::report::record_in_words_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json plan(int policy, const char* name, const json& harm, const json& contact) {
  return {{"policy", policy},
          {"name", name},
          {"target_speed_mps", nullptr},
          {"harm", harm},
          {"contact", contact}};
}

json lived(int policy, const char* name, double harm) {
  json one = plan(policy, name, harm, nullptr);
  one["text"] = harm > 0.0 ? "hits car7" : "clear by 0.8 m";
  return one;
}

/// Braking hits, the lane to the left is free, the drift cannot be driven.
json record() {
  json decision = plan(1, "AES-L", nullptr, nullptr);
  decision.update({{"source", "arbiter"},
                   {"similarity", 0.61},
                   {"not_admissible", false},
                   {"time_s", 2.5},
                   {"by_atlas", false},
                   {"verdict",
                    {{"t_s", 2.45},
                     {"admissible_harm", 0.0123},
                     {"plans",
                      {plan(0, "AEB", 0.35, 0.875), plan(1, "AES-L", 0.0111, 0.0625),
                       plan(2, "AES-R", 0.0122, 0.125), plan(5, "T-D-L", nullptr, nullptr),
                       plan(7, "NI", 0.77, 1.0)}}}}});
  return {
      {"schema", "saca.record/1"},
      {"thresholds", {{"trigger_s", 1.3}, {"preview_s", 5.5}}},
      {"frames", {{{"t_s", 2.5}, {"ego", {{"speed_mps", 17.3}}}}}},
      {"intentions",
       {{{"actor", "car7"},
         {"of", {"M", "FB"}},
         {"times_s", {2.4, 2.6}},
         {"now_permille", {"912 88", "1 999"}}}}},
      {"events", {{{"t_s", 2.5}, {"plane", "reflex"}, {"kind", "trigger"}, {"text", "T1: car7"}}}},
      {"decision", decision},
      {"switches", json::array()},
      {"result", {{"text", "clear by 0.7 m"}, {"harm", 0.0}}},
      {"driver", nullptr},
      {"best", 1},
      {"hindsight", {lived(0, "AEB", 0.41), lived(1, "AES-L", 0.0)}}};
}

std::string told(const json& record, const std::string& about) {
  const auto paragraphs = explanation(record.dump(), "r.json");
  if (!paragraphs.has_value()) {
    return paragraphs.error().message;
  }
  std::string text;
  for (const Paragraph& paragraph : paragraphs.value()) {
    for (const std::string& sentence : paragraph.sentences) {
      text += paragraph.about == about ? sentence + "\n" : "";
    }
  }
  return text;
}

TEST(Explanation, TellsWhatWasExpectedOfEachPlanAndWhyItWasNotChosen) {
  const std::string expected = told(record(), "What each plan was expected to end in");
  EXPECT_THAT(expected,
              HasSubstr("AEB, emergency braking: expected harm 0.3500, chance of contact 88 %."));
  EXPECT_THAT(expected,
              HasSubstr("T-D-L, a drift to a stop, facing left: cannot be driven from there."));
  EXPECT_THAT(told(record(), "Which plans were admissible"), HasSubstr("at most 0.0123"));
  EXPECT_THAT(told(record(), "Which plans were admissible"),
              HasSubstr("Admissible were AES-L, AES-R."));
  EXPECT_EQ(told(record(), "Why not the others"),
            "AEB: its expected harm of 0.3500 is more than the admissible 0.0123.\n"
            "AES-R: admissible, but it is no milder than what was chosen.\n"
            "T-D-L: it cannot be driven.\n"
            "NI: its expected harm of 0.7700 is more than the admissible 0.0123.\n");
}

TEST(Explanation, TellsInShortWhatCameWhatWasWeighedAndWhy) {
  json other = record();
  other["decision"]["threat"] = "car7";
  other["frames"][0]["conflict_s"] = 1.28;
  other["hindsight"].push_back(lived(7, "NI", 0.5));
  EXPECT_EQ(told(other, "In short"),
            "At 2.50 s a conflict with car7 came near, 1.28 s away; the ego drove at 17.3 m/s. Had "
            "nothing been done, this would have come of it: hits car7 (harm 0.5000).\n"
            "Considered were 5 plans. These kinds had one whose expected harm is at most 0.0123, "
            "which the forecasts cannot tell from the best: a lane change to the left (0.0111), a "
            "lane change to the right (0.0122). Rejected as more harmful: emergency braking "
            "(0.3500), a drift to a stop, facing left (cannot be driven), doing nothing (0.7700).\n"
            "AES-L, a lane change to the left, was begun because doing nothing may end in contact, "
            "full braking is not admissible and no gentler braking harms less: it is the mildest "
            "of the admissible plans that leave the lane.\n");
  other["decision"] = nullptr;
  other["best"] = nullptr;
  EXPECT_THAT(told(other, "In short"), HasSubstr("nothing had to be decided"));
}

TEST(Explanation, TellsWhyItActedBeforeT1) {
  json early = record();
  EXPECT_THAT(told(early, "What threatened"), testing::Not(HasSubstr("more looks")));
  early["decision"]["waiting_cost"] = 0.0341;
  early["thresholds"]["waiting_cost"] = 0.01;
  EXPECT_THAT(told(early, "What threatened"),
              HasSubstr("before where to wait for two more looks is expected to harm by more than "
                        "0.0100 more; the ego drove at 17.3 m/s."));
}

TEST(Explanation, TellsTheRuleByWhichWasChosen) {
  const std::string about = "What was chosen, and by which rule";
  EXPECT_THAT(told(record(), about), HasSubstr("the mildest of the admissible plans"));
  EXPECT_THAT(told(record(), about), HasSubstr("like it to 61 %."));
  for (const auto& [source, words] :
       {std::pair("memory", "a case in memory"),
        std::pair("model", "the language model had chosen"), std::pair("forced", "the user asked"),
        std::pair("fallback", "emergency braking is the fallback")}) {
    json other = record();
    other["decision"]["source"] = source;
    EXPECT_THAT(told(other, about), HasSubstr(words));
  }
}

// Of a record in which braking was begun although only doing nothing is admissible.
TEST(Explanation, TellsTheReasonsOfAPlanThatWasReady) {
  json other = record();
  other["decision"]["source"] = "model";
  other["decision"]["preview"] = 1;
  const json none{{"explanation", nullptr}};
  other["previews"] = {
      none,
      {{"explanation",
        {{"text", "1. AEB hits car7.\n2. So AES-L.\n"}, {"from", "model_in_part"}}}}};
  EXPECT_THAT(told(other, "What was chosen, and by which rule"),
              HasSubstr("The model's reasons, checked: 1. AEB hits car7. 2. So AES-L.\n"));
  other["previews"][1]["explanation"]["from"] = "facts";
  EXPECT_THAT(told(other, "What was chosen, and by which rule"),
              HasSubstr("Reasons, by the figures: 1. AEB"));
  other["decision"]["preview"] = 0;
  EXPECT_THAT(told(other, "What was chosen, and by which rule"), testing::Not(HasSubstr("easons")));
}

TEST(Explanation, DoesNotCallBrakingAdmissibleWhereItIsNot) {
  const std::string about = "What was chosen, and by which rule";
  json other = record();
  other["decision"].update(plan(0, "AEB", nullptr, nullptr));
  other["decision"]["verdict"]["plans"][4]["harm"] = 0.004;  // of doing nothing
  other["decision"]["verdict"]["admissible_harm"] = 0.0105;
  EXPECT_THAT(told(other, about), HasSubstr("emergency braking was begun although it is not"));
  other["decision"]["verdict"]["admissible_harm"] = 0.4;
  EXPECT_THAT(told(other, about), HasSubstr("and braking is admissible:"));
}

TEST(Explanation, TellsWhyNothingIsDoneThoughItMayHarm) {
  json other = record();
  other["decision"].update(plan(7, "NI", nullptr, nullptr));
  other["decision"]["verdict"]["plans"][4]["harm"] = 0.004;
  while (other["hindsight"].size() < 8) {
    other["hindsight"].push_back(lived(7, "NI", 0.0));
  }
  EXPECT_THAT(told(other, "In short"), HasSubstr("NI, doing nothing, was begun because it is "
                                                 "admissible: no plan is expected to harm so"));
  EXPECT_THAT(told(other, "Why not the others"),
              HasSubstr("AES-R: admissible, but the forecasts cannot tell it from doing nothing"));
}

TEST(Explanation, TellsHowHardWasBrakedAndWhyNotHarder) {
  json other = record();
  json& plans = other["decision"]["verdict"]["plans"];
  json gentle = plan(0, "AEB", 0.0101, 0.0625);
  gentle["strength"] = 0.45;
  json middle = plan(0, "AEB", 0.0121, 0.125);
  middle["strength"] = 0.6;
  plans.insert(plans.begin() + 1, {gentle, middle});
  other["decision"].update({{"policy", 0}, {"name", "AEB"}, {"strength", 0.45}});
  EXPECT_THAT(told(other, "What was chosen, and by which rule"),
              HasSubstr("AEB at 45 % of the grip was begun"));
  EXPECT_THAT(told(other, "What was chosen, and by which rule"),
              HasSubstr("the hardest of those that harm as little"));
  const std::string why_not = told(other, "Why not the others");
  EXPECT_THAT(why_not, HasSubstr("AEB: its expected harm of 0.3500 is more than"));
  EXPECT_THAT(why_not, HasSubstr("AEB at 60 % of the grip: admissible, but it is expected to harm "
                                 "more, or to harm as much and brakes less hard."));
  EXPECT_THAT(why_not, HasSubstr("AES-L: admissible, but braking comes first."));
}

TEST(Explanation, TellsTheNewestBeliefBeforeTheTrigger) {
  EXPECT_EQ(told(record(), "What was believed of the others"),
            "At 2.40 s car7 was thought to intend: keeping lane and speed with 91.2 %, braking "
            "with 8.8 %.\n");
}

TEST(Explanation, TellsSwitchesEndAndHindsight) {
  json other = record();
  json change = plan(0, "AEB", 0.01, nullptr);
  change.update({{"t_s", 3.1}, {"reason", "better by far"}, {"text", "going on harms"}});
  other["switches"].push_back(change);
  other["best"] = 0;
  EXPECT_EQ(
      told(other, "What was switched"),
      "At 3.10 s the supervisor began AEB in place of AES-L, better by far: going on harms.\n");
  EXPECT_THAT(told(other, "What hindsight says"), HasSubstr("AEB would have been the best"));
  EXPECT_THAT(told(other, "What hindsight says"), HasSubstr("harm 0.4100"));
  EXPECT_THAT(told(record(), "What hindsight says"), HasSubstr("That is what was chosen."));
  EXPECT_THAT(told(record(), "How it ended"), HasSubstr("clear by 0.7 m; harm 0.0000"));
}

TEST(Explanation, OfARunWithoutDecisionSaysThatNothingHadToBeDecided) {
  json other = record();
  other["decision"] = nullptr;
  other["best"] = nullptr;
  other["hindsight"] = json::array();
  EXPECT_THAT(told(other, "What threatened"), HasSubstr("nothing had to be decided"));
}

TEST(Explanation, RefusesWhatIsNoRecord) {
  EXPECT_EQ(explanation("7", "r.json").error().message,
            "r.json: want the JSON of a record (saca.record/1), got something else");
  EXPECT_EQ(explanation(R"({"schema": "saca.tape/1"})", "r.json").error().message,
            "r.json: schema: want \"saca.record/1\", got \"saca.tape/1\"");
  const std::string deep(500'000, '[');
  EXPECT_EQ(explanation(deep, "r.json").error().message,
            "r.json: want the JSON of a record (saca.record/1): want JSON of at most 32 levels, "
            "got more at byte 32");
  EXPECT_LT(explanation("{\"schema\": \"" + deep + "\"}", "r.json").error().message.size(), 200U);
  json cut = record();
  cut.erase("switches");
  EXPECT_THAT(explanation(cut.dump(), "r.json").error().message, HasSubstr("'switches'"));
}

TEST(Explanation, TellsWhereARecordIsWrong) {
  const auto refused = [](const char* key, const json& value) {
    json wrong = record();
    wrong[json::json_pointer(key)] = value;
    return explanation(wrong.dump(), "r.json").error().message;
  };
  EXPECT_EQ(refused("/decision/policy", 99),
            "r.json: decision.policy: want a number below 2, got 99");
  EXPECT_EQ(refused("/best", -1), "r.json: best: want a number below 2, got -1");
  json of_model = record();
  of_model["decision"].update({{"source", "model"}, {"preview", 4}});
  of_model["previews"] = json::array();
  EXPECT_EQ(explanation(of_model.dump(), "r.json").error().message,
            "r.json: decision.preview: want a number below 0, got 4");
  EXPECT_THAT(refused("/thresholds/trigger_s", "soon"), HasSubstr("\"What threatened\": "));
  EXPECT_THAT(refused("/result/harm", nullptr), HasSubstr("\"How it ended\": "));
  EXPECT_THAT(refused("/decision/verdict/plans/0/contact", "x"), HasSubstr("\"the decision\": "));
}

TEST(RecordInWords, TellsWhatBecameOfTheSituationMostAlike) {
  const auto told = [](double similarity, bool not_admissible) {
    json one = record();
    one["decision"]["similarity"] = similarity;
    one["decision"]["not_admissible"] = not_admissible;
    std::string text;
    for (const Paragraph& paragraph : explanation(one.dump(), "r").value()) {
      for (const std::string& sentence : paragraph.sentences) {
        text += sentence + " ";
      }
    }
    return text;
  };
  EXPECT_THAT(told(0.61, false), testing::HasSubstr("was like it to 61 %. "));
  EXPECT_THAT(told(0.95, true),
              testing::HasSubstr("95 %, but that plan is expected to harm too much from here."));
  EXPECT_THAT(
      told(0.95, false),
      testing::HasSubstr("95 %, but doing nothing is expected to be as good as that plan."));
}

}  // namespace
}  // namespace saca::report::record_in_words_test
