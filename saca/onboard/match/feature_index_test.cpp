#include "saca/onboard/match/feature_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <span>

#include "saca/base/core/contract.h"
#include "saca/onboard/match/example_scenes.h"

namespace saca::match::feature_index_test {
namespace {

constexpr double rounding = 1e-5;  // features are kept as float

/// The scene that differs least; nullopt when there is none.
std::optional<FeatureIndex::Hit> nearest(const FeatureIndex& index, const world::Scene& wanted) {
  std::array<FeatureIndex::Hit, 1> hit;
  return index.nearest(features(wanted), hit) == 0 ? std::nullopt : std::optional(hit.front());
}

TEST(FeatureIndex, IsEmptyAtFirst) {
  const FeatureIndex index;
  EXPECT_EQ(index.size(), 0U);
  EXPECT_EQ(index.last_id(), 0);
  EXPECT_FALSE(nearest(index, crossing_truck()).has_value());
}

// Oracle: compare the scenes themselves, one by one.
TEST(FeatureIndex, FindsWhatComparingAllScenesFinds) {
  std::mt19937 rng(1);
  std::vector<world::Scene> scenes;
  FeatureIndex index;
  for (int i = 0; i < 200; ++i) {
    scenes.push_back(random_scene(rng, i % 7));
    index.add(10 + i, scenes.back());
  }
  EXPECT_EQ(index.size(), 200U);
  EXPECT_EQ(index.last_id(), 209);
  for (int i = 0; i < 50; ++i) {
    const world::Scene wanted = random_scene(rng, i % 7);
    std::size_t best = 0;
    for (std::size_t j = 1; j < scenes.size(); ++j) {
      best = similarity(wanted, scenes[j]) > similarity(wanted, scenes[best]) ? j : best;
    }
    const FeatureIndex::Hit hit = nearest(index, wanted).value();
    EXPECT_EQ(hit.id, 10 + static_cast<CaseId>(best));
    EXPECT_NEAR(similarity_at(hit.difference), similarity(wanted, scenes[best]), rounding);
  }
}

TEST(FeatureIndex, FindsAsManyOfTheNearestAsThereIsRoomFor) {
  std::mt19937 rng(2);
  FeatureIndex index;
  std::vector<std::pair<double, CaseId>> all;
  const world::Scene wanted = random_scene(rng, 3);
  for (CaseId id = 1; id <= 100; ++id) {
    const world::Scene scene = random_scene(rng, 3);
    index.add(id, scene);
    all.emplace_back(-similarity(wanted, scene), id);
  }
  index.pass_over(std::min_element(all.begin(), all.end())->second);
  all.erase(std::min_element(all.begin(), all.end()));
  std::sort(all.begin(), all.end());
  std::array<FeatureIndex::Hit, 7> some;
  ASSERT_EQ(index.nearest(features(wanted), some), 7U);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(some[i].id, all[i].second);
    EXPECT_NEAR(similarity_at(some[i].difference), -all[i].first, rounding);
  }
  std::array<FeatureIndex::Hit, 200> many;
  EXPECT_EQ(index.nearest(features(wanted), many), 99U);
  EXPECT_EQ(index.nearest(features(wanted), std::span<FeatureIndex::Hit>()), 0U);
}

// Cells and their bounds: scenes at all speeds, grips and kinds of road, asked at their edges too.
TEST(FeatureIndex, MissesNothingAtTheEdgesOfItsCells) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto somewhere = [&] {
    world::Scene scene = random_scene(rng, static_cast<int>(rng() % 3));
    scene.ego.v_B.x =
        -20.0 + 0.7 * static_cast<double>(rng() % 140) + (rng() % 2 == 0 ? 0.0 : share(rng));
    scene.grip = std::exp(-3.2 + 0.15 * static_cast<double>(rng() % 22) + 0.1 * share(rng));
    scene.grip = std::clamp(scene.grip, 0.04, 1.2);
    scene.road.topology = static_cast<world::Topology>(rng() % 3);
    scene.road.oncoming_left = rng() % 2 == 0;
    scene.road.oncoming_right = rng() % 4 == 0;
    return scene;
  };
  FeatureIndex index;
  std::vector<Features> all;
  for (CaseId id = 1; id <= 1500; ++id) {
    const world::Scene scene = somewhere();
    index.add(id, scene);
    all.push_back(features(scene));
  }
  const auto span_of = [](const Features& one) {
    return std::span(one.actors.begin(), one.actors.size());
  };
  for (int i = 0; i < 200; ++i) {
    const Features wanted = features(somewhere());
    std::vector<std::pair<double, CaseId>> sorted;
    for (std::size_t k = 0; k < all.size(); ++k) {
      sorted.emplace_back(difference(wanted.ego, span_of(wanted), all[k].ego, span_of(all[k])),
                          static_cast<CaseId>(k + 1));
    }
    std::sort(sorted.begin(), sorted.end());
    std::array<FeatureIndex::Hit, 5> hits;
    ASSERT_EQ(index.nearest(wanted, hits), 5U);
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_EQ(hits[k].id, sorted[k].second) << i << ", " << k;
      EXPECT_NEAR(hits[k].difference, sorted[k].first, rounding * sorted[k].first);
    }
  }
}

// Of many: beyond the threshold it goes from neighbour to neighbour.
TEST(FeatureIndex, OfManyFindsNearlyAllThatAnExactSearchFinds) {
  std::mt19937 rng(4);
  FeatureIndex exact;
  FeatureIndex many(100);
  for (CaseId id = 1; id <= 3'000; ++id) {
    const world::Scene scene = random_scene(rng, static_cast<int>(rng() % 4));
    exact.add(id, scene);
    many.add(id, scene);
  }
  std::set<CaseId> passed_over;
  for (CaseId id = 1; id <= 3'000; id += 100) {
    exact.pass_over(id);
    many.pass_over(id);
    many.pass_over(id);
    passed_over.insert(id);
  }
  int first_found = 0;
  int found = 0;
  constexpr int queries = 100;
  for (int i = 0; i < queries; ++i) {
    const Features wanted = features(random_scene(rng, static_cast<int>(rng() % 4)));
    std::array<FeatureIndex::Hit, 50> right;
    std::array<FeatureIndex::Hit, 50> hits;
    ASSERT_EQ(exact.nearest(wanted, right), 50U);
    ASSERT_EQ(many.nearest(wanted, hits), 50U);
    first_found += right[0].id == hits[0].id ? 1 : 0;
    for (const FeatureIndex::Hit& hit : hits) {
      EXPECT_FALSE(passed_over.contains(hit.id));
      EXPECT_EQ(many.place_of(hit.id), hit.place);
      found += hit.difference <= right[49].difference ? 1 : 0;
    }
  }
  EXPECT_GE(first_found, 0.99 * queries);
  EXPECT_GE(found, 0.98 * 50 * queries);
  EXPECT_GT(many.bytes(), exact.bytes());
}

TEST(FeatureIndex, PrefersTheOldestOfEquals) {
  FeatureIndex index;
  index.add(3, crossing_truck());
  index.add(4, crossing_truck());
  index.add(5, crossing_truck());
  EXPECT_EQ(nearest(index, crossing_truck()).value().id, 3);
  std::array<FeatureIndex::Hit, 2> two;
  ASSERT_EQ(index.nearest(features(crossing_truck()), two), 2U);
  EXPECT_EQ(two[0].id, 3);
  EXPECT_EQ(two[1].id, 4);
}

TEST(FeatureIndex, RefusesWhatIsOutOfOrderOrNoScene) {
  FeatureIndex index;
  index.add(3, crossing_truck());
  EXPECT_THROW(index.add(3, crossing_truck()), ContractViolation);
  world::Scene broken = crossing_truck();
  broken.grip = 0.0;
  EXPECT_THROW(index.add(4, broken), ContractViolation);
}

}  // namespace
}  // namespace saca::match::feature_index_test
