#include "saca/lab/encounter/learnt_case.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "saca/onboard/match/example_scenes.h"

namespace saca::encounter::learnt_case_test {
namespace {

using manoeuvre::PolicyId;

TEST(PolicyHarms, AreThoseOfThePlanThatHarmsLeast) {
  reflex::Verdict verdict;
  verdict.plans.push_back({{PolicyId::aeb, std::nullopt}, true, 0.3, 1.0});
  verdict.plans.push_back({{PolicyId::aeb, std::nullopt, 0.6}, true, 0.2, 1.0});
  verdict.plans.push_back({{PolicyId::es_b_left, 5.0}, false, 0.0, 0.0});
  verdict.plans.push_back({{PolicyId::es_b_left, 9.0}, true, 0.4, 1.0});
  verdict.plans.push_back({{PolicyId::t_drift_left, std::nullopt}, false, 0.0, 0.0});
  const memory::PolicyHarms harms = forecast_harms(verdict);
  EXPECT_EQ(harms[0], 0.2);
  EXPECT_EQ(harms[3], 0.4);
  EXPECT_FALSE(harms[5].has_value());
  EXPECT_FALSE(harms[7].has_value());
}

/// Memory's word was followed, by this case, and harmed so much; full braking would have so much.
Record followed(match::CaseId id, double harm, double of_braking) {
  Record record;
  arbitration::Preview preview{.number = 3};
  preview.nearest.emplace();
  preview.nearest->found.id = id;
  record.previews.push_back(preview);
  record.decision = reflex::Decision{
      .plan = {PolicyId::aes_left}, .source = reflex::Source::memory, .preview = 3};
  record.result.harm = harm;
  record.hindsight.emplace();
  for (Hindsight& one : *record.hindsight) {
    one.facts.end = preview::RolledOutcome{{.harm = of_braking}};
  }
  return record;
}

TEST(ARefutedCase, IsTheOneThatDidMateriallyMoreHarmThanBraking) {
  EXPECT_EQ(refuted_case(followed(7, 0.30, 0.10)), 7);
  EXPECT_FALSE(refuted_case(followed(7, 0.105, 0.10)).has_value());
  EXPECT_FALSE(refuted_case(followed(7, 0.10, 0.30)).has_value());
  Record by_verdict = followed(7, 0.3, 0.1);
  by_verdict.decision->source = reflex::Source::arbiter;
  EXPECT_FALSE(refuted_case(by_verdict).has_value());
  Record forgotten = followed(7, 0.3, 0.1);
  forgotten.previews.clear();
  EXPECT_FALSE(refuted_case(forgotten).has_value());
}

// What was believed is asked no more, and what was learnt instead is.
TEST(Learning, QuarantinesWhatItRefutes) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saca_refuted.sqlite";
  std::filesystem::remove(file);
  memory::Store memory = memory::Store::open(file).value();
  memory::Case wrong;
  wrong.scene = match::empty_road();
  wrong.happened = memory::PolicyHarms{0.5, 0.0};
  const match::CaseId id = memory.add(wrong).value();
  memory::Case right = wrong;
  right.happened = memory::PolicyHarms{0.0, 0.5};
  const memory::LearningResult learnt = learn(memory, right, id).value();
  EXPECT_EQ(learnt.how, memory::LearningResult::How::added) << "nobody is left to contradict";
  EXPECT_EQ(memory.find(id).value().value().trust, memory::Trust::quarantined);
  const memory::Match match = memory.recall(right.scene).value().value();
  EXPECT_EQ(match.found.id, learnt.id);
  EXPECT_EQ(match.policy, PolicyId::aeb);
  EXPECT_TRUE(learn(memory, right, 99).has_value()) << "whoever deleted it need not be told";
  std::filesystem::remove(file);
}

TEST(Learning, KeepsABankWithinItsBound) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saca_bound.sqlite";
  std::filesystem::remove(file);
  memory::Store memory = memory::Store::open(file).value();
  memory::Case one;
  one.origin = memory::Origin::simulation;
  std::mt19937 rng(2);
  for (int i = 0; i < 12; ++i) {
    one.scene = match::random_scene(rng, 1);
    ASSERT_TRUE(learn(memory, one, std::nullopt, 10).has_value());
    EXPECT_LE(memory.size(), 10U);
  }
  EXPECT_EQ(memory.size(), 10U) << "a twentieth of so few is none";
  std::filesystem::remove(file);
}

TEST(Lessons, AreKeptWhereAllThatCanBeCheckedIsTrue) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saca_lessons.sqlite";
  std::filesystem::remove(file);
  memory::Store memory = memory::Store::open(file).value();
  memory::Case one;
  std::mt19937 rng(1);
  one.scene = match::random_scene(rng, 2);
  one.harm = 0.25;
  const match::CaseId id = memory.add(one).value();
  const auto lessons = [&] { return memory.find(id).value().value().lessons; };
  using From = language_model::Explanation::From;
  EXPECT_FALSE(
      keep_lesson(memory, id, {.text = "is wrong", .shown = {"figures", From::facts}}).has_value());
  EXPECT_TRUE(lessons().empty());
  EXPECT_FALSE(
      keep_lesson(memory, id,
                  {.text = "is true, and wrong", .shown = {"is true", From::model_in_part}})
          .has_value());
  EXPECT_EQ(lessons(), std::vector<std::string>{"is true"});
  EXPECT_EQ(memory.find(id).value().value().harm, 0.25);
  EXPECT_FALSE(keep_lesson(memory, id + 1, {.shown = {"x", From::model}}).has_value())
      << "whoever deleted the case wants no lesson";
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace saca::encounter::learnt_case_test
