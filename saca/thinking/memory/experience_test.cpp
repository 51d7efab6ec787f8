#include "saca/thinking/memory/experience.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "saca/onboard/match/example_scenes.h"
#include "saca/onboard/match/similarity.h"
#include "tests/support/count_allocations.h"

namespace saca::memory::experience_test {
namespace {

/// Told 0.1 of every policy, and this much more happened.
Case wrong_by(const world::Scene& scene, double error) {
  Case one;
  one.scene = scene;
  one.told.emplace();
  one.happened.emplace();
  for (std::size_t p = 0; p < manoeuvre::num_policies; ++p) {
    (*one.told)[p] = 0.1;
    (*one.happened)[p] = 0.1 + error;
  }
  return one;
}

TEST(Experience, OfNothingCorrectsNothing) {
  const Experience none;
  EXPECT_EQ(none.size(), 0U);
  EXPECT_EQ(none.corrections(match::crossing_truck()), Corrections{});
}

// The same scene 60 times: 60 of 80 parts of the error, as 20 more erred by nothing.
TEST(Experience, IsShrunkAsIfSomeHadNotErred) {
  const std::vector<Case> cases(60, wrong_by(match::crossing_truck(), 0.2));
  const Experience experience(cases);
  EXPECT_EQ(experience.size(), 60U);
  for (const double one : experience.corrections(match::crossing_truck())) {
    EXPECT_NEAR(one, 0.2 * 60.0 / 80.0, 1e-12);
  }
}

TEST(Experience, FadesWithTheDifference) {
  const std::vector<Case> cases(20, wrong_by(match::empty_road(), -0.08));
  const Experience experience(cases);
  world::Scene faster = match::empty_road();
  faster.ego.v_B.x += 3.0 * 0.7;  // differs by 3, which is the reach
  const double weight = 20.0 * std::exp(-0.5);
  EXPECT_NEAR(experience.corrections(faster)[0], -0.08 * weight / (weight + 20.0), 1e-12);
  faster.ego.v_B.x += 60.0;
  EXPECT_NEAR(experience.corrections(faster)[0], 0.0, 1e-12);
}

TEST(Experience, CountsOneCrashByNoMoreThanTheBound) {
  const std::vector<Case> cases{wrong_by(match::empty_road(), 40.0)};
  EXPECT_NEAR(Experience(cases).corrections(match::empty_road())[3], 0.5 / 21.0, 1e-12);
}

TEST(Experience, KnowsOfEachPolicyWhatIsKnownOfIt) {
  Case one = wrong_by(match::empty_road(), 0.2);
  (*one.told)[5] = std::nullopt;
  (*one.happened)[6] = std::nullopt;
  const Corrections learnt = Experience(std::span(&one, 1)).corrections(match::empty_road());
  EXPECT_EQ(learnt[5], 0.0);
  EXPECT_EQ(learnt[6], 0.0);
  EXPECT_NEAR(learnt[7], 0.2 / 21.0, 1e-12);
}

TEST(Experience, LearnsNothingFromWhoIsQuarantinedOrKnowsTooLittle) {
  Case distrusted = wrong_by(match::empty_road(), 0.2);
  distrusted.trust = Trust::quarantined;
  Case untold = wrong_by(match::empty_road(), 0.2);
  untold.told.reset();
  Case old = wrong_by(match::empty_road(), 0.2);
  old.happened.reset();
  const std::vector<Case> cases{distrusted, untold, old};
  EXPECT_EQ(Experience(cases).corrections(match::empty_road()), Corrections{});
}

// Oracle: all cases, sorted.
TEST(Experience, IsThatOfTheNearest) {
  std::mt19937 rng(1);
  std::normal_distribution<double> error(0.0, 0.1);
  std::vector<Case> cases;
  for (int i = 0; i < 500; ++i) {
    world::Scene scene = match::random_scene(rng, 2);
    cases.push_back(wrong_by(scene, error(rng)));
  }
  const Experience experience(cases);
  for (int i = 0; i < 10; ++i) {
    const world::Scene scene = match::random_scene(rng, 2);
    std::vector<std::pair<double, double>> by_difference;
    for (const Case& one : cases) {
      const double apart =
          std::log(match::similarity(one.scene, scene)) / std::log(0.9);  // from 0.9^d
      by_difference.emplace_back(apart, (*one.happened)[0].value() - 0.1);
    }
    std::sort(by_difference.begin(), by_difference.end());
    by_difference.resize(Experience::most_corrected);
    double sum = 0.0;
    double weights = Experience::prior_cases;
    for (const auto& [apart, wrong] : by_difference) {
      const double weight = std::exp(-0.5 * apart * apart / 9.0);
      sum += weight * wrong;
      weights += weight;
    }
    EXPECT_NEAR(experience.corrections(scene)[0], sum / weights, 1e-7);
  }
}

TEST(Experience, IsNothingInASceneThatIsNone) {
  const std::vector<Case> cases(5, wrong_by(match::crossing_truck(), 0.2));
  world::Scene broken = match::crossing_truck();
  broken.ego.v_B.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Experience(cases).corrections(broken), Corrections{});
}

// ---- What cases speak for

/// Told and happened: this policy harms nobody, every other by 0.1.
Case best_is(manoeuvre::PolicyId policy, const world::Scene& scene) {
  Case one = wrong_by(scene, 0.0);
  (*one.told)[manoeuvre::index(policy)] = 0.0;
  (*one.happened)[manoeuvre::index(policy)] = 0.0;
  return one;
}

world::Scene faster_by(double difference) {
  world::Scene scene = match::empty_road();
  scene.ego.v_B.x += 0.7 * difference;
  return scene;
}

using manoeuvre::PolicyId;

TEST(AsGoodAsTheBest, AreThoseWithinTwoThousandths) {
  EXPECT_EQ(as_good_as_best(PolicyHarms{0.1, 0.1019, 0.1021, std::nullopt, 0.3}), Policies(0b11));
  EXPECT_TRUE(as_good_as_best(PolicyHarms{}).none());
}

TEST(AsGoodAsTheBest, HoldsByWhatWasToldAndByWhatHappened) {
  Case one;
  one.best = PolicyId::t_drift_left;
  EXPECT_EQ(as_good_as_best(one), Policies(0b100000)) << "nothing else is known";
  one.told = PolicyHarms{0.0, 0.0, 0.5};
  EXPECT_EQ(as_good_as_best(one), Policies(0b011));
  one.happened = PolicyHarms{0.5, 0.0, 0.0};
  EXPECT_EQ(as_good_as_best(one), Policies(0b010));
  one.happened = PolicyHarms{0.5, 0.5, 0.0};
  EXPECT_TRUE(as_good_as_best(one).none()) << "it went otherwise than told: it speaks for nothing";
}

TEST(Recall, IsWhatMostOfTheWeightSpeaksFor) {
  const std::vector<Case> cases{best_is(PolicyId::aes_left, faster_by(2.0)),
                                best_is(PolicyId::aeb, faster_by(-1.0)),
                                best_is(PolicyId::aes_left, faster_by(0.5))};
  const Recall recall = Experience(cases).recall(match::features(match::empty_road())).value();
  const auto weight = [](double d) { return std::exp(-0.5 * d * d / 4.0); };
  const double left = weight(2.0) + weight(0.5);
  EXPECT_EQ(recall.policy, PolicyId::aes_left);
  EXPECT_NEAR(recall.share, left / (left + weight(1.0) + 0.3), 1e-12);
  EXPECT_EQ(recall.trusted_share, recall.share);
  EXPECT_EQ(recall.nearest, 3);
  EXPECT_NEAR(recall.similarity, std::pow(0.9, 0.5), 1e-12);
}

TEST(Recall, TellsWhatTrustedCasesAloneSpeakFor) {
  std::vector<Case> cases{best_is(PolicyId::aeb, match::empty_road()),
                          best_is(PolicyId::aeb, match::empty_road())};
  cases[1].trust = Trust::unchecked;
  const Recall recall = Experience(cases).recall(match::features(match::empty_road())).value();
  EXPECT_NEAR(recall.share, 2.0 / 2.3, 1e-12);
  EXPECT_NEAR(recall.trusted_share, 1.0 / 2.3, 1e-12);
}

// Else a bank that was checked with a second car would hold each scene twice, and be half trusted.
TEST(Recall, AsksTheCarsOwnCaseInsteadOfAnothersOfTheSameScene) {
  const auto made_with = [](const char* car) {
    return std::vector<MadeWith>{{"car", "car", car}, {"harm", "harm", "h"}};
  };
  std::vector<Case> cases;
  for (match::CaseId id = 1; id <= 40; ++id) {
    Case one = best_is(PolicyId::aeb, faster_by(0.05 * static_cast<double>(id)));
    one.id = id;
    one.made_with = made_with("theirs");
    cases.push_back(one);
  }
  Experience both = Experience::for_car(made_with("ours"));
  Experience alone = Experience::for_car(made_with("ours"));
  for (const Case& one : cases) {
    both.add(one);
  }
  const match::Features wanted = match::features(match::empty_road());
  EXPECT_EQ(both.recall(wanted).value().trusted_share, 0.0) << "theirs are asked, not trusted";
  for (Case& one : cases) {
    one.made_with = made_with("ours");
    one.id += 100;
    both.add(one);
    alone.add(one);
  }
  const Recall recall = both.recall(wanted).value();
  EXPECT_EQ(recall.trusted_share, alone.recall(wanted).value().share);
  EXPECT_EQ(recall.share, recall.trusted_share);
  EXPECT_GT(recall.nearest, 100);
}

TEST(Recall, IsOfEqualsTheFirstPolicy) {
  std::vector<Case> cases{best_is(PolicyId::es_b_left, match::empty_road()),
                          best_is(PolicyId::aes_right, match::empty_road())};
  const auto policy = [&] {
    return Experience(cases).recall(match::features(match::empty_road())).value().policy;
  };
  EXPECT_EQ(policy(), PolicyId::aes_right);
  std::swap(cases[0], cases[1]);
  EXPECT_EQ(policy(), PolicyId::aes_right) << "in whatever order they were met";
}

TEST(Experience, KnowsWhetherACaseSaysSomethingElseSince) {
  Case one = best_is(PolicyId::aeb, match::empty_road());
  one.id = 4;
  Experience experience;
  experience.add(one);
  EXPECT_TRUE(experience.is_known_as(one));
  Case changed = one;
  changed.review = "in other words";
  EXPECT_TRUE(experience.is_known_as(changed)) << "it speaks for the same";
  changed.trust = Trust::unchecked;
  EXPECT_FALSE(experience.is_known_as(changed));
  experience.relearn(changed);
  EXPECT_TRUE(experience.is_known_as(changed));
  EXPECT_FALSE(experience.is_known_as(one));
  changed.happened.reset();
  EXPECT_FALSE(experience.is_known_as(changed));
}

TEST(Recall, AsksNeitherWhoIsQuarantinedNorWhoIsExcepted) {
  std::vector<Case> cases{best_is(PolicyId::aeb, match::empty_road()),
                          best_is(PolicyId::aes_right, match::empty_road()),
                          best_is(PolicyId::es_b_left, faster_by(3.0))};
  cases[0].trust = Trust::quarantined;
  const Experience experience(cases);
  const match::CaseId second = 2;
  const Recall recall =
      experience.recall(match::features(match::empty_road()), std::span(&second, 1)).value();
  EXPECT_EQ(recall.policy, PolicyId::es_b_left);
  EXPECT_NEAR(recall.share, 1.0 / (1.0 + 0.3 * std::exp(0.5 * 9.0 / 4.0)), 1e-12);
  EXPECT_EQ(experience.recall(match::features(match::empty_road())).value().policy,
            PolicyId::aes_right);
}

TEST(Recall, IsNoneWhereThereIsNothingToSpeakForAnything) {
  EXPECT_FALSE(Experience().recall(match::features(match::empty_road())).has_value());
  Case blocked = wrong_by(match::empty_road(), 0.0);
  blocked.told = blocked.happened = PolicyHarms{};
  EXPECT_FALSE(
      Experience(std::span(&blocked, 1)).recall(match::features(match::empty_road())).has_value());
  const Case good = best_is(PolicyId::aeb, match::empty_road());
  world::Scene broken = match::empty_road();
  broken.grip = -1.0;
  EXPECT_FALSE(Experience(std::span(&good, 1)).recall(match::features(broken)).has_value());
}

TEST(Confidence, RisesFromNothingToOne) {
  EXPECT_EQ(confidence_at(0.0), 0.0);
  EXPECT_EQ(confidence_at(1.0), 1.0);
  EXPECT_EQ(confidence_at(std::numeric_limits<double>::quiet_NaN()), 0.0);
  double before = 0.0;
  for (int i = 1; i <= 100; ++i) {
    const double now = confidence_at(0.01 * i);
    EXPECT_GT(now, before);
    before = now;
  }
}

TEST(Experience, AllocatesNothingWhenAsked) {
  std::mt19937 rng(2);
  std::vector<Case> cases;
  cases.reserve(300);
  for (int i = 0; i < 300; ++i) {
    cases.push_back(wrong_by(match::random_scene(rng, 4), 0.1));
  }
  const Experience experience(cases);
  const world::Scene scene = match::random_scene(rng, 4);
  const std::size_t before = num_allocations;
  const double asked =
      experience.corrections(scene)[0] + experience.recall(match::features(scene))->share;
  EXPECT_EQ(num_allocations, before);
  EXPECT_GE(asked, 0.0);
}

}  // namespace
}  // namespace saca::memory::experience_test
