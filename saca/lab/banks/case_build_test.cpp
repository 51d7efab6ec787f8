#include "saca/lab/banks/case_build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/banks/banks_for_test.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::banks::case_build_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;

/// Only the left helps in the first encounter; in the second nobody is near; the third is none.
Result<eval::SuiteEncounter> three_encounters(std::uint64_t number) {
  if (number == 2) {
    return Error{Error::Code::out_of_range, "encounter 2 is none"};
  }
  return eval::SuiteEncounter{
      .number = number,
      .family = "family",
      .scenario = number == 0 ? eval::only_left_helps() : eval::standing_car(10.0, 500.0),
      .twin = number == 0 ? std::optional(eval::only_left_helps()) : std::nullopt};
}

class CaseBuildTest : public testing::Test {
 protected:
  EmptyFolder folder_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
  CaseTools tools_{.forecast = {&car_, &harm_},
                   .intent = &intent::shipped_model(),
                   .made_with = encounter::made_with({&car_, &harm_}, intent::shipped_model(), "c"),
                   .draws = 4};
  CaseSource source_{.at = three_encounters, .count = 3, .play = {.seed = 1, .exact = true}};
  CaseWork work_{.journal = folder_.file("journal"),
                 .title = "cases of three encounters",
                 .progress = "cases",
                 .display = long_work::ProgressDisplay::silent};
};

TEST_F(CaseBuildTest, MakesACaseOfEachEncounterAndItsTwin) {
  const CaseBuild build = build_cases(source_, tools_, work_).value().value();
  EXPECT_EQ(build.num_encounters, 3U);
  ASSERT_EQ(build.cases.size(), 2U) << "in the second nothing triggers";
  EXPECT_EQ(build.cases[0].id, 1);
  EXPECT_EQ(build.cases[1].id, 2);
  EXPECT_TRUE(build.cases[0].best == PolicyId::aes_left ||
              build.cases[0].best == PolicyId::es_b_left)
      << name(build.cases[0].best);
  EXPECT_EQ(build.cases[0].made_with, tools_.made_with);
  EXPECT_THAT(build.problems, testing::ElementsAre("encounter 2 is none"));
}

TEST_F(CaseBuildTest, GoesOnFromTheJournalAndLeavesTwinsOut) {
  source_.twins = TwinCases::left_out;
  work_.threads = 2;
  const CaseBuild first = build_cases(source_, tools_, work_).value().value();
  EXPECT_EQ(first.cases.size(), 1U);
  source_.at = [](std::uint64_t) -> Result<eval::SuiteEncounter> {
    return Error{Error::Code::out_of_range, "it is asked again"};
  };
  const CaseBuild again = build_cases(source_, tools_, work_).value().value();
  EXPECT_EQ(memory::cases_text(again.cases), memory::cases_text(first.cases));
  EXPECT_EQ(again.problems, first.problems);
  work_.title = "other cases";
  EXPECT_FALSE(build_cases(source_, tools_, work_).has_value()) << "the journal is of others";
}

TEST(CaseBuild, CountsTheBestPolicies) {
  const CaseBuild build{
      .num_encounters = 3,
      .cases = {best_is(PolicyId::aeb, 10.0, "a"), best_is(PolicyId::no_intervention, 10.0, "b"),
                best_is(PolicyId::aeb, 20.0, "c")},
      .problems = {"one that cannot be played"}};
  EXPECT_EQ(text_of(build, "cases.jsonl"),
            "cases.jsonl: 3 cases of 3 encounters; best AEB 2 AES-L 0 AES-R 0 ES-B-L 0 ES-B-R 0 "
            "T-D-L 0 T-D-R 0 NI 1\n");
  const nlohmann::json out = json_of(build, "memory build balanced", "1.2.3");
  EXPECT_EQ(out.at("meta.command"), "saca memory build balanced");
  EXPECT_EQ(out.at("meta.version"), "1.2.3");
  EXPECT_EQ(out.at("memory.num_encounters"), 3);
  EXPECT_EQ(out.at("memory.num_cases"), 3);
  EXPECT_EQ(out.at("memory.num_failed"), 1);
  EXPECT_EQ(out.at("memory.best.AEB"), 2);
  EXPECT_EQ(out.at("memory.best.NI"), 1);
  EXPECT_EQ(out.at("memory.best.T-D-L"), 0);
}

}  // namespace
}  // namespace saca::banks::case_build_test
