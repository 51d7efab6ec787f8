#include "saca/thinking/memory/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "saca/onboard/match/example_scenes.h"
#include "saca/onboard/match/feature_index.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/memory/store.h"

namespace saca::memory::thinning_test {
namespace {

using manoeuvre::PolicyId;

Case a_case(match::CaseId id, const world::Scene& scene, PolicyId best) {
  Case one;
  one.id = id;
  one.scene = scene;
  one.best = best;
  one.origin = Origin::simulation;
  return one;
}

std::vector<MadeWith> made_with(const char* car) {
  return {{"car", "car", car}, {"harm", "harm", "h"}};
}

/// The definition, looked up anew for each that goes: every pair is compared.
std::vector<match::CaseId> by_brute_force(std::vector<Case> cases, std::size_t most) {
  std::vector<match::CaseId> gone;
  while (cases.size() > most) {
    double least = std::numeric_limits<double>::infinity();
    auto next = cases.end();
    for (auto one = cases.begin(); one != cases.end(); ++one) {
      if (one->trust != Trust::trusted || one->origin == Origin::own ||
          one->origin == Origin::expert) {
        continue;
      }
      for (const Case& other : cases) {
        if (other.id == one->id || other.trust != Trust::trusted ||
            as_good_as_best(other) != as_good_as_best(*one) || other.made_with != one->made_with) {
          continue;
        }
        const match::Features a = match::features(one->scene);
        const match::Features b = match::features(other.scene);
        const double apart = match::difference(a.ego, {a.actors.begin(), a.actors.size()}, b.ego,
                                               {b.actors.begin(), b.actors.size()});
        if (apart < least || (apart == least && next != cases.end() && one->id > next->id)) {
          least = apart;
          next = one;
        }
      }
    }
    if (next == cases.end()) {
      break;
    }
    gone.push_back(next->id);
    cases.erase(next);
  }
  return gone;
}

TEST(Thinning, IsWhatComparingAllPairsAnewWouldDo) {
  std::mt19937 rng(3);
  std::vector<Case> cases;
  for (match::CaseId id = 1; id <= 80; ++id) {
    Case one = a_case(id, match::random_scene(rng, static_cast<int>(rng() % 3)),
                      manoeuvre::all_policies.at(rng() % 3));
    one.trust = rng() % 5 == 0 ? Trust::unchecked : Trust::trusted;
    one.origin = rng() % 5 == 0 ? Origin::own : Origin::simulation;
    one.made_with = made_with(rng() % 3 == 0 ? "a" : "b");
    cases.push_back(one);
  }
  for (const std::size_t most : {0U, 20U, 50U, 79U}) {
    EXPECT_EQ(most_redundant(cases, most), by_brute_force(cases, most)) << most;
  }
}

// Among so many a search from neighbour to neighbour would meet only those that are gone.
TEST(Thinning, GoesOnToTheEndOfMany) {
  std::mt19937 rng(4);
  std::vector<Case> cases;
  const world::Scene scene = match::random_scene(rng, 1);
  constexpr auto many = static_cast<match::CaseId>(match::FeatureIndex::usually_exact + 500);
  std::uniform_real_distribution<double> speed(10.0, 30.0);
  for (match::CaseId id = 1; id <= many; ++id) {
    cases.push_back(a_case(id, scene, PolicyId::aeb));
    cases.back().scene.ego.v_B.x = speed(rng);
  }
  EXPECT_EQ(most_redundant(cases, 20).size(), cases.size() - 20);
}

TEST(Thinning, TakesNobodyWhereThereIsRoom) {
  const std::vector<Case> cases{a_case(1, match::empty_road(), PolicyId::aeb),
                                a_case(2, match::empty_road(), PolicyId::aeb)};
  EXPECT_TRUE(most_redundant(cases, 2).empty());
  EXPECT_TRUE(most_redundant(cases, 1'000).empty());
  EXPECT_TRUE(most_redundant({}, 0).empty());
}

TEST(Thinning, OfTheSameTheNewerGoesAndTheLastStays) {
  const std::vector<Case> cases{a_case(1, match::empty_road(), PolicyId::aeb),
                                a_case(2, match::empty_road(), PolicyId::aeb),
                                a_case(5, match::empty_road(), PolicyId::aeb)};
  EXPECT_EQ(most_redundant(cases, 1), (std::vector<match::CaseId>{5, 2}));
  EXPECT_EQ(most_redundant(cases, 0), (std::vector<match::CaseId>{5, 2})) << "alike to nothing";
}

TEST(Thinning, KeepsWhatSpeaksForSomethingElse) {
  const std::vector<Case> cases{a_case(1, match::empty_road(), PolicyId::aeb),
                                a_case(2, match::empty_road(), PolicyId::es_b_left)};
  EXPECT_TRUE(most_redundant(cases, 1).empty());
}

// It is not trusted by the other car, so it does not stand for the other's case.
TEST(Thinning, KeepsWhatAnotherCarAloneStandsFor) {
  std::vector<Case> cases{a_case(1, match::empty_road(), PolicyId::aeb),
                          a_case(2, match::empty_road(), PolicyId::aeb)};
  cases[0].made_with = made_with("a");
  cases[1].made_with = made_with("b");
  EXPECT_TRUE(most_redundant(cases, 1).empty());
  cases[1].made_with = made_with("a");
  cases[1].made_with.push_back({"atlas", "atlas", "another"});
  EXPECT_EQ(most_redundant(cases, 1), std::vector<match::CaseId>{2});
}

TEST(Thinning, FindsTheCasesOfIds) {
  const std::vector<Case> cases{a_case(1, match::empty_road(), PolicyId::aeb),
                                a_case(4, match::empty_road(), PolicyId::aeb),
                                a_case(5, match::empty_road(), PolicyId::aeb)};
  const std::vector<Case> found = cases_of(std::array<match::CaseId, 3>{5, 1, 9}, cases);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, 1);
  EXPECT_EQ(found[1].id, 5);
}

TEST(Thinning, KeepsWhatTheCarDroveWhatExpertsToldAndWhatIsInDoubt) {
  for (const auto keep : {+[](Case& one) { one.origin = Origin::own; },
                          +[](Case& one) { one.origin = Origin::expert; },
                          +[](Case& one) { one.trust = Trust::unchecked; },
                          +[](Case& one) { one.trust = Trust::quarantined; }}) {
    std::vector<Case> cases{a_case(1, match::empty_road(), PolicyId::aeb),
                            a_case(2, match::empty_road(), PolicyId::aeb)};
    std::for_each(cases.begin(), cases.end(), keep);
    EXPECT_TRUE(most_redundant(cases, 0).empty());
  }
}

TEST(Thinning, KeepsABankWithinItsBound) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saca_bounded.sqlite";
  std::filesystem::remove(file);
  Store memory = Store::open(file).value();
  std::mt19937 rng(5);
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(memory.add(a_case(0, match::random_scene(rng, 1), PolicyId::aeb)).has_value());
  }
  ASSERT_FALSE(memory.catch_up().has_value());
  const auto cases = memory.all().value();
  EXPECT_EQ(keep_within(memory, 40, 40).value(), 0U);
  ASSERT_TRUE(memory.add(a_case(0, cases[3].scene, PolicyId::aeb)).has_value());
  ASSERT_FALSE(memory.catch_up().has_value());
  EXPECT_EQ(keep_within(memory, 40, 1).value(), 3U) << "two are free then";
  EXPECT_EQ(memory.size(), 38U);
  EXPECT_FALSE(memory.find(41).value().has_value()) << "the newer of two that are the same";
  EXPECT_TRUE(memory.find(4).value().has_value());

  const match::CaseId twin = memory.add(a_case(0, cases[0].scene, PolicyId::aeb)).value();
  ASSERT_FALSE(memory.catch_up().has_value());
  EXPECT_EQ(keep_within(memory, 38, twin).value(), 2U) << "its twin, and another";
  EXPECT_TRUE(memory.find(twin).value().has_value()) << "what was just learnt stays";
  std::filesystem::remove(file);
}

TEST(Thinning, IsNotTriedForEachCaseWhereNothingMayGo) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saca_own_only.sqlite";
  std::filesystem::remove(file);
  Store memory = Store::open(file).value();
  Case own = a_case(0, match::empty_road(), PolicyId::aeb);
  own.origin = Origin::own;
  for (int i = 0; i < 42; ++i) {
    ASSERT_TRUE(memory.add(own).has_value());
  }
  ASSERT_TRUE(memory.add(a_case(0, match::empty_road(), PolicyId::aeb)).has_value());
  ASSERT_TRUE(memory.add(a_case(0, match::empty_road(), PolicyId::aeb)).has_value());
  ASSERT_FALSE(memory.catch_up().has_value());
  EXPECT_EQ(keep_within(memory, 40, 1).value(), 0U) << "44 of 40: the next try is with 45";
  ASSERT_TRUE(memory.add(own).has_value());
  ASSERT_FALSE(memory.catch_up().has_value());
  EXPECT_EQ(keep_within(memory, 40, 1).value(), 2U);
  EXPECT_EQ(memory.size(), 43U);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace saca::memory::thinning_test
