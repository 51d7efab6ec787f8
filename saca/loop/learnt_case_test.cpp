#include "saca/loop/learnt_case.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "saca/memory/example_scenes.h"

namespace saca::loop::learnt_case_test {
namespace {

using manoeuvre::PolicyId;

TEST(PolicyHarms, AreThoseOfThePlanThatHarmsLeast) {
  decide::Verdict verdict;
  verdict.plans.push_back({{PolicyId::aeb, std::nullopt}, true, 0.3, 1.0});
  verdict.plans.push_back({{PolicyId::aeb, std::nullopt, 0.6}, true, 0.2, 1.0});
  verdict.plans.push_back({{PolicyId::es_b_left, 5.0}, false, 0.0, 0.0});
  verdict.plans.push_back({{PolicyId::es_b_left, 9.0}, true, 0.4, 1.0});
  verdict.plans.push_back({{PolicyId::t_drift_left, std::nullopt}, false, 0.0, 0.0});
  const memory::PolicyHarms harms = told_harms(verdict);
  EXPECT_EQ(harms[0], 0.2);
  EXPECT_EQ(harms[3], 0.4);
  EXPECT_FALSE(harms[5].has_value());
  EXPECT_FALSE(harms[7].has_value());
}

TEST(Lessons, AreKeptWhereAllThatCanBeCheckedIsTrue) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saca_lessons.sqlite";
  std::filesystem::remove(file);
  memory::Store memory = memory::Store::open(file).value();
  memory::Case one;
  std::mt19937 rng(1);
  one.scene = memory::random_scene(rng, 2);
  one.harm = 0.25;
  const memory::CaseId id = memory.add(one).value();
  const auto lessons = [&] { return memory.find(id).value().value().lessons; };
  EXPECT_FALSE(keep_lesson(memory, id, {.text = "says nothing"}).has_value());
  EXPECT_FALSE(keep_lesson(memory, id,
                           {.text = "is wrong",
                            .truth = {.num_checked = 2, .wrong = {{.text = "is", .why = "no"}}}})
                   .has_value());
  EXPECT_TRUE(lessons().empty());
  EXPECT_FALSE(
      keep_lesson(memory, id, {.text = "is true", .truth = {.num_checked = 2}}).has_value());
  EXPECT_EQ(lessons(), std::vector<std::string>{"is true"});
  EXPECT_EQ(memory.find(id).value().value().harm, 0.25);
  EXPECT_FALSE(keep_lesson(memory, id + 1, {.text = "x", .truth = {.num_checked = 1}}).has_value())
      << "whoever deleted the case wants no lesson";
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace saca::loop::learnt_case_test
