#include "saca/lab/report/verdicts_in_words.h"

#include <gtest/gtest.h>

namespace saca::report::verdicts_in_words_test {
namespace {

using nlohmann::json;
using Sentences = std::vector<std::string>;

json plan(int policy, const char* name, const json& speed, const json& harm, const json& contact) {
  return {{"policy", policy},
          {"name", name},
          {"target_speed_mps", speed},
          {"harm", harm},
          {"contact", contact}};
}

/// Of braking, of two braked swerves whose target speed falls with the ego's, and of doing nothing;
/// `going_on` [-] with what is under way.
json verdict(double time, double speed, const json& swerve, const json& nothing,
             const json& going_on) {
  return {
      {"t_s", time},
      {"received_s", time + 0.05},
      {"by_atlas", false},
      {"admissible_harm", 0.002},
      {"plans",
       {plan(0, "AEB", nullptr, 0.31, 0.5), plan(3, "ES-B-L", speed, 0.9, 1.0),
        plan(3, "ES-B-L", 0.5 * speed, swerve, 0.25),
        plan(7, "NI", nullptr, nothing, nothing > 0.0 ? 0.75 : 0.0)}},
      {"speaks_for", swerve < 0.1 ? plan(3, "ES-B-L", 0.5 * speed, swerve, 0.25)
                                  : plan(0, "AEB", nullptr, 0.31, 0.5)},
      {"under_way", going_on.is_null() ? json(nullptr) : plan(0, "AEB", nullptr, going_on, 0.5)}};
}

/// Decided at 2.0 s; verdicts every tenth of a second from 2.1 s on with these harms.
json record(const std::vector<std::array<double, 3>>& swerve_nothing_going_on) {
  json in_hand = json::array({verdict(1.95, 10.0, 0.2, 0.8, nullptr)});
  double time = 2.1;
  double speed = 9.0;
  for (const auto& [swerve, nothing, going_on] : swerve_nothing_going_on) {
    in_hand.push_back(verdict(time, speed, swerve, nothing, going_on));
    time += 0.1;
    speed -= 1.0;
  }
  return {{"decision", {{"time_s", 2.0}}},
          {"switches", json::array()},
          {"verdicts", {{"left_out", 0}, {"in_hand", in_hand}}}};
}

json change(double time, const json& plan, const char* reason) {
  json one = plan;
  one["t_s"] = time;
  one["reason"] = reason;
  return one;
}

TEST(VerdictsInWords, SayFromWhenOnTheOtherPlanHarmsLess) {
  json told = record({{0.3, 0.8, 0.2}, {0.15, 0.8, 0.25}, {0.05, 0.8, 0.3}});
  // Speeds are 9, 8 and 7 m/s then: the second swerve is to half of it.
  const json swerve = change(2.36, plan(3, "ES-B-L", 3.5, 0.05, nullptr), "better by far");
  told["switches"].push_back(swerve);
  EXPECT_EQ(
      why_then(told, swerve),
      (Sentences{
          "By the verdict of 2.10 s ES-B-L to 3.5 m/s was not yet expected to harm "
          "less: 0.3000, and going on 0.2000.",
          "From the verdict of 2.20 s on ES-B-L to 3.5 m/s was expected to harm less: "
          "0.1500, and going on 0.2500.",
          "The verdicts spoke for it from that of 2.30 s on; that of 2.20 s still spoke for AEB.",
          "By that of 2.30 s, when it was switched, it was 0.0500 and 0.3000."}));
}

TEST(VerdictsInWords, LookNoFurtherBackThanThePlanThatWasLeft) {
  json told = record({{0.05, 0.8, 0.3}, {0.06, 0.8, 0.3}, {0.07, 0.8, 0.3}});
  const json first = change(2.15, plan(0, "AEB", nullptr, 0.31, nullptr), "better by far");
  const json second = change(2.36, plan(3, "ES-B-L", 3.5, 0.07, nullptr), "better by far");
  told["switches"] = {first, second};
  EXPECT_EQ(why_then(told, second),
            (Sentences{"From the verdict of 2.20 s on ES-B-L to 3.5 m/s was expected to harm less: "
                       "0.0600, and going on 0.3000.",
                       "The verdicts spoke for it from that of 2.20 s on.",
                       "By that of 2.30 s, when it was switched, it was 0.0700 and 0.3000."}));
}

TEST(VerdictsInWords, SayFromWhenOnNothingHarmsNobody) {
  json told = record({{0.3, 0.8, 0.2}, {0.3, 0.0, 0.2}, {0.3, 0.0, 0.2}});
  // A shorter verdict: braking is nearly harmless, and only doing nothing is held beside it.
  json& last = told["verdicts"]["in_hand"].back();
  last["plans"].erase(1);
  last["plans"].erase(1);
  const json nothing = change(2.36, plan(7, "NI", nullptr, 0.0, nullptr), "no longer needed");
  told["switches"].push_back(nothing);
  EXPECT_EQ(
      why_then(told, nothing),
      (Sentences{"By the verdict of 2.10 s doing nothing still had a chance of contact of 75 %.",
                 "From the verdict of 2.20 s on doing nothing was expected to harm nobody under "
                 "any draw."}));
}

TEST(VerdictsInWords, SayWhatMadeSomethingNeededAfterAll) {
  json told = record({{0.3, 0.8, 0.0}, {0.04, 0.8, 0.7}});
  const json swerve = change(2.26, plan(3, "ES-B-L", 4.0, 0.04, nullptr), "needed after all");
  told["switches"].push_back(swerve);
  EXPECT_EQ(why_then(told, swerve),
            (Sentences{"By the verdict of 2.10 s going on was expected to harm 0.0000.",
                       "By that of 2.20 s it was 0.7000, and ES-B-L to 4.0 m/s was expected to "
                       "harm 0.0400."}));
}

TEST(VerdictsInWords, SayWhatAnotherPlanPromisedWhereNothingWasSwitched) {
  EXPECT_EQ(why_not_switched(record({{0.295, 0.8, 0.3}, {0.29, 0.8, 0.302}})),
            (Sentences{"The most that another plan promised was by the verdict of 2.20 s: ES-B-L "
                       "to 4.0 m/s was expected to harm 0.2900, and going on 0.3020."}));
  EXPECT_EQ(why_not_switched(record({{0.4, 0.8, 0.3}})),
            (Sentences{"In no verdict after it was another plan expected to harm less than going "
                       "on."}));
}

TEST(VerdictsInWords, SayNothingWhereTheRecordHoldsNoVerdict) {
  json old = record({{0.05, 0.8, 0.3}});
  const json swerve = change(2.36, plan(3, "ES-B-L", 4.5, 0.05, nullptr), "better by far");
  EXPECT_FALSE(why_then(old, swerve).empty());
  json elsewhere = old;
  elsewhere["verdicts"]["in_hand"] = json::array();
  EXPECT_TRUE(why_then(elsewhere, swerve).empty());
  EXPECT_TRUE(why_not_switched(elsewhere).empty());
  old.erase("verdicts");
  EXPECT_TRUE(why_then(old, swerve).empty());
  EXPECT_TRUE(why_not_switched(old).empty());
}

}  // namespace
}  // namespace saca::report::verdicts_in_words_test
