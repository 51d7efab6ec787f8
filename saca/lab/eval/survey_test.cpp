#include "saca/lab/eval/survey.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::eval::survey_test {
namespace {

using manoeuvre::PolicyId;

/// All eight can be driven and do harm 0.5, but for those that a test changes.
Finding harmful() {
  Finding finding{.family = "crossing", .number = 12, .time = 5.2};
  finding.harm.fill(0.5);
  finding.contact.fill(true);
  return finding;
}

Finding with(PolicyId policy, double harm) {
  Finding finding = harmful();
  finding.harm[manoeuvre::index(policy)] = harm;
  finding.best = policy;
  return finding;
}

// An interruption after the first look; whatever was found is not looked for again.
TEST(Survey, GoesOnWhereItWasInterrupted) {
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const SuiteSource source = SuiteSource::open({.scenarios = "scenarios",
                                                .suite = "crossing",
                                                .test_log = std::nullopt,
                                                .car = "compact_rwd_ev",
                                                .footprint = manoeuvre::footprint(car)})
                                 .value();
  const auto path = std::filesystem::path(testing::TempDir()) / "saca_survey_test.journal";
  std::filesystem::remove(path);
  SurveyWork work{.source = &source,
                  .car = &car,
                  .harm = &harm,
                  .count = 2,
                  .journal = path,
                  .title = "a test"};
  EXPECT_EQ(survey(work, {.is_interrupted = [] { return true; }}).value(), std::nullopt);
  const auto first = survey(work).value().value();
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[1].number, 1U);
  EXPECT_EQ(first[1].family, "crossing");
  work.count = 3;
  std::vector<std::pair<int, int>> told;
  const auto all =
      survey(work, {.progress = [&](int done, int before) { told.emplace_back(done, before); }})
          .value()
          .value();
  EXPECT_THAT(told, testing::ElementsAre(std::pair(3, 2)));
  EXPECT_EQ(std::vector(all.begin(), all.begin() + 2), first);
  work.title = "another";
  EXPECT_EQ(survey(work).error().code, Error::Code::malformed);
  std::filesystem::remove(path);
}

TEST(Survey, ALineBringsTheFindingBackBitByBit) {
  Finding finding = with(PolicyId::t_drift_right, 0.1 + 0.2);
  finding.harm[2] = std::nullopt;
  finding.contact[4] = false;
  EXPECT_EQ(finding_from(line_of(finding)), finding);
  const Finding never{.family = "merge", .number = 18446744073709551615U};
  EXPECT_EQ(finding_from(line_of(never)), never);
}

TEST(Survey, OtherLinesAreNone) {
  const std::string line = line_of(harmful());
  EXPECT_EQ(finding_from(""), std::nullopt);
  EXPECT_EQ(finding_from(line + ",1"), std::nullopt);
  EXPECT_EQ(finding_from(line.substr(0, line.size() - 2)), std::nullopt);
  EXPECT_EQ(finding_from("crossing,x" + line.substr(line.find(',', 9))), std::nullopt);
  std::string nan = line;
  nan.replace(nan.find("0.5"), 3, "nan");
  EXPECT_EQ(finding_from(nan), std::nullopt);
  Finding hopeless = harmful();
  hopeless.harm[manoeuvre::index(PolicyId::aeb)] = std::nullopt;  // braking is always possible
  EXPECT_EQ(finding_from(line_of(hopeless)), std::nullopt);
  std::string half = line;
  half.replace(half.find(",7,"), 3, ",0.9,");
  EXPECT_EQ(finding_from(half), std::nullopt);
}

TEST(Survey, OneAloneHasALowerClassOfHarmThanEveryOther) {
  const Taught taught = lesson_of(with(PolicyId::es_b_left, 0.2));
  EXPECT_EQ(taught.lesson, Lesson::one_alone);
  EXPECT_EQ(taught.alone, PolicyId::es_b_left);
  EXPECT_DOUBLE_EQ(taught.margin, 0.3);
}

TEST(Survey, LessThanATieIsNotLess) {
  const double hair = 0.5 - 0.4 * collision::harm_tie;
  EXPECT_EQ(lesson_of(with(PolicyId::aeb, hair)).lesson, Lesson::nothing_helps);
}

TEST(Survey, WhatNothingHelpsAgainstAndWhatNeedsNothing) {
  EXPECT_EQ(lesson_of(harmful()).lesson, Lesson::nothing_helps);
  const Taught nothing = lesson_of(with(PolicyId::no_intervention, 0.0));
  EXPECT_EQ(nothing.lesson, Lesson::nothing_needed);
  EXPECT_EQ(nothing.alone, PolicyId::no_intervention);  // all others harm
  EXPECT_EQ(lesson_of({.family = "x"}).lesson, Lesson::never_triggers);
  Finding two = with(PolicyId::aeb, 0.1);
  two.harm[1] = 0.1;
  EXPECT_EQ(lesson_of(two).lesson, Lesson::several_as_good);
}

TEST(Survey, BalanceCountsEveryFindingOnce) {
  const std::vector<Finding> findings{harmful(),
                                      with(PolicyId::aeb, 0.1),
                                      with(PolicyId::aeb, 0.3),
                                      with(PolicyId::aes_left, 0.0),
                                      {.family = "x"}};
  const Balance counted = balance(findings);
  EXPECT_EQ(counted.count, 5);
  EXPECT_EQ(counted.alone[0], 2);
  EXPECT_EQ(counted.alone[1], 1);
  EXPECT_DOUBLE_EQ(counted.margin[0], 0.2);  // the nearest rank of 0.2 and 0.4
  EXPECT_EQ(counted.lessons[static_cast<std::size_t>(Lesson::never_triggers)], 1);
  EXPECT_EQ(counted.lessons[static_cast<std::size_t>(Lesson::nothing_helps)], 1);
  EXPECT_EQ(counted.lessons[static_cast<std::size_t>(Lesson::one_alone)], 3);
}

}  // namespace
}  // namespace saca::eval::survey_test
