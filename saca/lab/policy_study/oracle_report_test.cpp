#include "saca/lab/policy_study/oracle_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/lab/policy_study/oracle_for_test.h"

namespace saca::policy_study::oracle_report_test {
namespace {

using nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const OracleQuestion question{"a_scene", 8, 3};

TEST(OracleReport, TheDocumentNamesQuestionRankingAndMargin) {
  const json all = json_of(oracle_by_hand(), question);
  EXPECT_EQ(all.at("schema"), "saca.oracle/1");
  EXPECT_EQ(all.at("scenario"), "a_scene");
  EXPECT_EQ(all.at("time_s"), 2.5);
  EXPECT_EQ(all.at("draws"), 8);
  EXPECT_EQ(all.at("seed"), 3);
  EXPECT_EQ(all.at("policies").size(), 8U);
  EXPECT_EQ(all.at("ranking"), json({0, 7}));
  EXPECT_EQ(all.at("margin"), json({{"mean", 0.4}, {"low", 0.3}}));
}

TEST(OracleReport, APolicyHasItsPlanAndWhatItEndsIn) {
  const json all = json_of(oracle_by_hand(), question);
  const json& aeb = all.at("policies").at(0);
  EXPECT_EQ(aeb.at("name"), "AEB");
  EXPECT_EQ(aeb.at("strength"), 0.8);
  EXPECT_TRUE(aeb.at("target_speed_mps").is_null());
  EXPECT_TRUE(aeb.at("refusal").is_null());
  EXPECT_EQ(aeb.at("harm"), json({{"mean", 0.01}, {"low", 0.005}, {"high", 0.015}}));
  EXPECT_EQ(aeb.at("contact_share"), json({{"mean", 0.125}, {"low", 0.0}, {"high", 0.5}}));
  EXPECT_EQ(aeb.at("as_written").at("clearance_m"), 1.5);
  EXPECT_FALSE(aeb.at("as_written").contains("contact"));
  const json& contact = all.at("policies").at(7).at("as_written").at("contact");
  EXPECT_EQ(contact.at("time_s"), 4.0);
  EXPECT_EQ(contact.at("with"), "car1");
  EXPECT_EQ(contact.at("ego_face"), "front");
  EXPECT_EQ(contact.at("impact_speed_mps"), 12.0);
  EXPECT_EQ(contact.at("ego_delta_v_mps"), 5.0);
  EXPECT_EQ(contact.at("other_delta_v_mps"), 6.0);
}

TEST(OracleReport, WhatIsRefusedHasNothingButTheReason) {
  const json drift = json_of(oracle_by_hand(), question).at("policies").at(5);
  EXPECT_EQ(drift.at("refusal"), "no room");
  EXPECT_FALSE(drift.contains("harm"));
  EXPECT_FALSE(drift.contains("as_written"));
}

TEST(OracleReport, AContactWithTheRoadsEdgeIsWithNobody) {
  eval::Oracle oracle = oracle_by_hand();
  collision::Outcome& outcome = oracle.verdicts[7].written.facts.outcome();
  outcome.contact->actor.reset();
  outcome.contact->edge = collision::Side::left;
  const json contact =
      json_of(oracle, question).at("policies").at(7).at("as_written").at("contact");
  EXPECT_TRUE(contact.at("with").is_null());
}

TEST(OracleReport, TheTextRanksTellsRefusalsAndTheBest) {
  const std::string text = text_of(oracle_by_hand(), question);
  EXPECT_THAT(text, StartsWith("At 2.50 s, 20.0 m/s; 8 draws of what nobody knows, seed 3.\n\n"));
  EXPECT_THAT(text,
              HasSubstr("\n0 AEB at 80 % of the grip   0.0100 (0.0050 to 0.0150)   0.50   12 %   "
                        "clear by 1.5 m\n"));
  EXPECT_THAT(text, HasSubstr("100 %   hits car1 with its front at 12.0 m/s\n"));
  EXPECT_THAT(text, HasSubstr("\n5 T-D-L                     no room\n"));
  EXPECT_THAT(text, EndsWith("\nBest: AEB at 80 % of the grip, alone (by 0.4000 harm, at least "
                             "0.3000).\n"));
}

TEST(OracleReport, AMarginThatMayBeNoneIsToldSo) {
  eval::Oracle oracle = oracle_by_hand();
  oracle.verdicts[7].behind = {0.1, -0.1, 0.3};
  EXPECT_THAT(text_of(oracle, question), HasSubstr(", not clearly alone (by 0.1000 harm"));
}

}  // namespace
}  // namespace saca::policy_study::oracle_report_test
