#include "saca/lab/eval/curriculum.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>

#include "saca/base/formats/json_text.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/onboard/match/example_scenes.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/memory/experience.h"

namespace saca::eval::curriculum_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;
using memory::PolicyHarms;

// 95 % intervals of Student's t with 2 degrees of freedom: 4.3027 standard errors (any table).
TEST(MeanOverSeeds, HasTheIntervalOfStudentsT) {
  const Estimate three = mean_over_seeds(std::array{1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(three.value, 2.0);
  EXPECT_NEAR(three.high - three.value, 4.3027 / std::sqrt(3.0), 1e-4);
  EXPECT_NEAR(three.value - three.low, 4.3027 / std::sqrt(3.0), 1e-4);
  EXPECT_EQ(three.n, 3);
  const Estimate one = mean_over_seeds(std::array{0.5});
  EXPECT_EQ(one.low, 0.5);
  EXPECT_EQ(one.high, 0.5);
}

TEST(UpsideDown, TellsTheWorstAsTheBest) {
  memory::Case one{.best = PolicyId::aes_left, .best_harm = 0.1};
  one.told = PolicyHarms{0.2, 0.1, std::nullopt, 0.4};
  one.happened = PolicyHarms{0.3, 0.1, std::nullopt, 0.8};
  const memory::Case lie = upside_down(one);
  EXPECT_NEAR(lie.happened->at(0).value(), 0.6, 1e-12);
  EXPECT_NEAR(lie.happened->at(1).value(), 0.8, 1e-12);
  EXPECT_EQ(lie.happened->at(2), std::nullopt);
  EXPECT_NEAR(lie.happened->at(3).value(), 0.1, 1e-12);
  EXPECT_EQ(lie.told, lie.happened);
  EXPECT_EQ(lie.best, PolicyId::es_b_left);
  EXPECT_NEAR(lie.best_harm, 0.1, 1e-12);
  // Where nothing is known but which was best, there is nothing to turn round.
  EXPECT_EQ(upside_down({.best = PolicyId::aeb}).best, PolicyId::aeb);
}

/// Braking is too late for a standing car; to the left the lane is free.
class CurriculumTest : public testing::Test {
 protected:
  Curriculum begin(double lies, std::vector<memory::Case> start = {}) {
    auto made = Curriculum::begin({.saca = {.forecast = {&car_, &harm_}, .clock = &clock_},
                                   .intent = &intent::shipped_model(),
                                   .made_with = {},
                                   .seed = 3,
                                   .exact = true,
                                   .lies = lies,
                                   .judging = {.told_draws = 16, .draws = 4}},
                                  start, folder_);
    EXPECT_TRUE(made.has_value());
    return std::move(made).value();
  }
  [[nodiscard]] static SuiteEncounter encounter(std::uint64_t number) {
    return {.number = number, .family = "made", .scenario = only_left_helps(), .twin = {}};
  }
  CurriculumTest() { std::filesystem::create_directories(folder_); }
  ~CurriculumTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      fmt::format("saca_curriculum_{}_{}", getpid(),
                  testing::UnitTest::GetInstance()->current_test_info()->name());
  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
};

// The second time memory knows what to do, and only where it was told the truth.
TEST_F(CurriculumTest, RemembersWhatItMet) {
  Curriculum curriculum = begin(1.0);
  const Episode first = curriculum.play(encounter(0));
  ASSERT_EQ(first.row.fault, "");
  ASSERT_EQ(first.row.risk.runs.size(), curriculum_methods.size());
  ASSERT_TRUE(first.one.has_value());
  EXPECT_TRUE(first.is_lie);
  for (std::size_t i = 0; i < num_learners; ++i) {
    EXPECT_EQ(first.row.risk.runs[i].thinking->recalled, 0) << i;
    EXPECT_EQ(first.row.risk.runs[i].harm, first.row.risk.runs[0].harm) << i;
  }
  EXPECT_EQ(manoeuvre::side(first.one->best), 1);
  EXPECT_EQ(curriculum.learn(first), std::nullopt);
  EXPECT_THAT(curriculum.sizes(), testing::ElementsAre(0, 1, 1));

  const memory::Case truth = taught(first, Learner::learning);
  EXPECT_EQ(truth.origin, memory::Origin::own);
  EXPECT_EQ(truth.plan, first.row.risk.runs[1].plan.value());
  EXPECT_EQ(truth.harm, first.row.risk.runs[1].harm);
  EXPECT_THAT(truth.review, testing::HasSubstr("; best "));
  const memory::Case lie = taught(first, Learner::poisoned);
  EXPECT_NE(manoeuvre::side(lie.best), 1);
  EXPECT_GT(lie.happened->at(index(truth.best)).value(), truth.best_harm + 0.1);

  EXPECT_TRUE(misleads(first));

  // The same again: who remembers has a case to go by, and counts it twice.
  const Episode second = curriculum.play(encounter(1));
  EXPECT_EQ(second.row.risk.runs[0].thinking->recalled, 0);
  EXPECT_EQ(curriculum.learn(second), std::nullopt);
  EXPECT_EQ(curriculum.sizes()[1], 1U);
  auto bank = memory::Store::open_existing((folder_ / "learning.sqlite").string());
  ASSERT_TRUE(bank.has_value());
  memory::Store known = std::move(bank).value();
  EXPECT_EQ(known.find(1).value()->count, 2);
}

// What it was told of the same encounter 40 times is what it believes: the truth, or the lie.
TEST_F(CurriculumTest, BelievesWhatItIsTold) {
  Curriculum curriculum = begin(1.0);
  const Episode episode = curriculum.play(encounter(0));
  const memory::Case truth = taught(episode, Learner::learning);
  const std::vector<memory::Case> truths(40, truth);
  const std::vector<memory::Case> lies(40, taught(episode, Learner::poisoned));
  const auto recalled = [&](const std::vector<memory::Case>& known) {
    return memory::Experience(known).recall(match::features(truth.scene));
  };
  const memory::Policies good = memory::as_good_as_best(truth);
  EXPECT_TRUE(good.test(index(recalled(truths)->policy)));
  EXPECT_FALSE(good.test(index(recalled(lies)->policy)));
}

TEST_F(CurriculumTest, WhereAllHarmsAreAlikeALieMisleadsNobody) {
  Curriculum curriculum = begin(1.0);
  Episode episode = curriculum.play(encounter(0));
  episode.one->happened = PolicyHarms{0.1, 0.1, 0.1};
  episode.one->told = episode.one->happened;
  EXPECT_FALSE(misleads(episode));
  episode.one.reset();
  EXPECT_FALSE(misleads(episode));
}

TEST_F(CurriculumTest, BeginsWithWhatIsKnown) {
  Curriculum first = begin(0.0);
  const Episode episode = first.play(encounter(0));
  const std::vector<memory::Case> known(60, taught(episode, Learner::learning));
  Curriculum second = begin(0.0, known);
  EXPECT_THAT(second.sizes(), testing::ElementsAre(60, 60, 60));
  const Episode again = second.play(encounter(1));
  EXPECT_GT(again.row.risk.runs[0].thinking->from_memory, 0);
}

TEST_F(CurriculumTest, WithoutATriggerThereIsNothingToBeLearnt) {
  Curriculum curriculum = begin(0.0);
  SuiteEncounter free = encounter(0);
  free.scenario.actors.clear();
  const Episode episode = curriculum.play(free);
  EXPECT_EQ(episode.row.fault, "");
  EXPECT_FALSE(episode.one.has_value());
  EXPECT_EQ(curriculum.learn(episode), std::nullopt);
  EXPECT_THAT(curriculum.sizes(), testing::Each(0));
}

// It has done harm, whether or not the trigger fires where nobody acts.
TEST_F(CurriculumTest, QuarantinesWhatIsRefutedWhereThereIsNothingToBeLearnt) {
  memory::Case known;
  known.scene = match::empty_road();
  Curriculum curriculum = begin(0.0, {known});
  Episode episode;
  episode.refuted = {1, 1, std::nullopt};
  const auto trust_of = [&](const char* file) {
    memory::Store bank = memory::Store::open_existing((folder_ / file).string()).value();
    return bank.find(1).value().value().trust;
  };
  episode.row.fault = "a method threw";
  EXPECT_EQ(curriculum.learn(episode), std::nullopt);
  EXPECT_EQ(trust_of("learning.sqlite"), memory::Trust::trusted) << "it is left out";
  episode.row.fault.clear();
  EXPECT_EQ(curriculum.learn(episode), std::nullopt);
  EXPECT_EQ(trust_of("learning.sqlite"), memory::Trust::quarantined);
  EXPECT_EQ(trust_of("poisoned.sqlite"), memory::Trust::trusted);
  EXPECT_EQ(trust_of("frozen.sqlite"), memory::Trust::trusted) << "it learns nothing";
}

// Half of the encounters are their twins, drawn by seed and number: the same ones again.
TEST_F(CurriculumTest, PlaysTwinsToo) {
  Curriculum curriculum = begin(0.0);
  int twins = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    SuiteEncounter one = encounter(number);
    one.twin = one.scenario;
    one.twin->actors.clear();
    twins += curriculum.play(one).one ? 0 : 1;
  }
  EXPECT_GE(twins, 2);
  EXPECT_LE(twins, 10);
}

TEST_F(CurriculumTest, ALineComesBack) {
  Curriculum curriculum = begin(0.5);
  Episode episode = curriculum.play(encounter(0));
  episode.refuted[1] = 7;
  const auto back = episode_from_json(to_json(episode));
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(to_json(back.value()).dump(), to_json(episode).dump());
  EXPECT_EQ(back.value().refuted[1], 7);
  EXPECT_EQ(back.value().refuted[0], std::nullopt);
  EXPECT_EQ(back.value().one->happened, episode.one->happened);
  for (const char* const spoilt : {"", "{", "[]", R"({"row": 1})", R"({"lie": false})"}) {
    const auto read = formats::parse_json(spoilt);
    EXPECT_FALSE(read.has_value() && episode_from_json(read.value()).has_value()) << spoilt;
  }
}

}  // namespace
}  // namespace saca::eval::curriculum_test
