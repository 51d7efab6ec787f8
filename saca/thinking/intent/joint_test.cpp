#include "saca/thinking/intent/joint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::intent::joint_test {
namespace {

using testing::ElementsAre;

/// Every hypothesis there is, by counting through them; sorted by probability.
std::vector<Hypothesis> enumerated(const std::vector<Choices>& choices) {
  std::vector<Hypothesis> all{{}};
  for (const Choices& each : choices) {
    std::vector<Hypothesis> longer;
    for (const Hypothesis& before : all) {
      for (const Choice& choice : each) {
        Hypothesis one = before;
        one.probability *= choice.probability;
        one.intentions.push_back(choice.intention);
        longer.push_back(one);
      }
    }
    all = longer;
  }
  std::stable_sort(all.begin(), all.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.probability > b.probability;
  });
  return all;
}

std::vector<Choices> drawn(std::mt19937& rng, std::size_t actors) {
  std::vector<Choices> all(actors);
  for (Choices& choices : all) {
    IntentPosterior posterior{};
    double sum = 0.0;
    for (double& p : posterior) {
      // Cubed: some are near 1, many near 0.
      p = std::pow(std::uniform_real_distribution<double>(0.0, 1.0)(rng), 3.0);
      sum += p;
    }
    for (double& p : posterior) {
      p /= sum;
    }
    choices = choices_of(posterior, rng() % 3 == 0 ? 0.0 : 0.1);
    if (choices.empty()) {
      choices.push_back({likeliest(posterior), 1.0});
    }
  }
  return all;
}

TEST(Hypotheses, AreTheLikeliestOfAllThatThereAre) {
  std::mt19937 rng(4);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Choices> choices = drawn(rng, 1 + static_cast<std::size_t>(round) % 4);
    const std::vector<Hypothesis> all = enumerated(choices);
    const std::vector<Hypothesis> found = likeliest_hypotheses(choices, 24);
    ASSERT_EQ(found.size(), std::min<std::size_t>(24, all.size()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].probability, all[i].probability) << round << ' ' << i;
      EXPECT_EQ(found[i].intentions, all[i].intentions) << round << ' ' << i;  // no ties are drawn
    }
  }
}

TEST(Hypotheses, AreAllOfThemOnceWhereMoreAreWantedThanThereAre) {
  std::mt19937 rng(5);
  const std::vector<Choices> choices = drawn(rng, 3);
  std::vector<Hypothesis> found = likeliest_hypotheses(choices, 100'000);
  const std::size_t number = choices[0].size() * choices[1].size() * choices[2].size();
  ASSERT_EQ(found.size(), number);
  std::sort(found.begin(), found.end(),
            [](const Hypothesis& a, const Hypothesis& b) { return a.intentions < b.intentions; });
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end(),
                               [](const Hypothesis& a, const Hypothesis& b) {
                                 return a.intentions == b.intentions;
                               }),
            found.end());
}

TEST(Hypotheses, SumToOneWhereEveryChoiceIsThere) {
  IntentPosterior posterior{};
  posterior.fill(1.0 / num_intentions);
  const std::vector<Choices> choices(3, choices_of(posterior, 0.0));
  double sum = 0.0;
  for (const Hypothesis& each : likeliest_hypotheses(choices, 1'000)) {
    sum += each.probability;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(Hypotheses, OfEqualOnesThoseOfEarlierRoadUsersComeFirst) {
  Choices even;
  even.push_back({Intention::brake, 0.5});
  even.push_back({Intention::maintain, 0.5});
  const std::vector<Choices> two(2, even);
  const std::vector<Hypothesis> found = likeliest_hypotheses(two, 4);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_THAT(found[0].intentions, ElementsAre(Intention::brake, Intention::brake));
  EXPECT_THAT(found[1].intentions, ElementsAre(Intention::maintain, Intention::brake));
  EXPECT_THAT(found[2].intentions, ElementsAre(Intention::brake, Intention::maintain));
  EXPECT_THAT(found[3].intentions, ElementsAre(Intention::maintain, Intention::maintain));
}

TEST(Hypotheses, WhoHasOneChoiceMakesIt) {
  Choices one;
  one.push_back({Intention::lane_left, 1.0});
  Choices two;
  two.push_back({Intention::maintain, 0.3});
  two.push_back({Intention::brake, 0.7});
  const std::vector<Hypothesis> found =
      likeliest_hypotheses(std::vector<Choices>{one, two, one}, 24);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(found[0].intentions,
              ElementsAre(Intention::lane_left, Intention::brake, Intention::lane_left));
  EXPECT_EQ(found[0].probability, 0.7);
  EXPECT_EQ(found[1].probability, 0.3);
}

// 8 choices of 32 road users are 8^32 hypotheses.
TEST(Hypotheses, OfAFullSceneAreFoundWithoutLookingAtAllOfThem) {
  std::mt19937 rng(6);
  const std::vector<Choices> choices = drawn(rng, 32);
  const std::vector<Hypothesis> found = likeliest_hypotheses(choices, 24);
  ASSERT_EQ(found.size(), 24U);
  EXPECT_TRUE(std::is_sorted(
      found.begin(), found.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.probability > b.probability; }));
}

TEST(Hypotheses, OfNobodyAreOneThatSaysNothing) {
  const std::vector<Hypothesis> found = likeliest_hypotheses({}, 24);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].probability, 1.0);
  EXPECT_TRUE(found[0].intentions.empty());
  EXPECT_TRUE(likeliest_hypotheses({}, 0).empty());
}

TEST(Hypotheses, RefuseWhoHasNoChoiceAndWhatIsNoProbability) {
  std::vector<Choices> choices(1);
  EXPECT_THROW((void)likeliest_hypotheses(choices, 1), ContractViolation);
  choices[0].push_back({Intention::maintain, std::nan("")});
  EXPECT_THROW((void)likeliest_hypotheses(choices, 1), ContractViolation);
  choices[0][0].probability = 1.5;
  EXPECT_THROW((void)likeliest_hypotheses(choices, 1), ContractViolation);
}

TEST(Choices, AreThoseThatAreLikelyEnough) {
  const Choices choices = choices_of({0.6, 0.05, 0.04, 0.31}, 0.05);
  ASSERT_EQ(choices.size(), 3U);
  EXPECT_EQ(choices[1].intention, Intention::lane_left);
  EXPECT_EQ(choices[2].intention, Intention::brake);
  EXPECT_EQ(choices[2].probability, 0.31);
}

}  // namespace
}  // namespace saca::intent::joint_test
