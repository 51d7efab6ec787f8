#include "saca/memory/feature_index.h"

#include <gtest/gtest.h>

#include "saca/core/contract.h"
#include "saca/memory/example_scenes.h"

namespace saca::memory::feature_index_test {
namespace {

TEST(FeatureIndex, IsEmptyAtFirst) {
  const FeatureIndex index;
  EXPECT_EQ(index.size(), 0U);
  EXPECT_EQ(index.last_id(), 0);
  EXPECT_FALSE(index.nearest(features(crossing_truck())).has_value());
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
    const FeatureIndex::Hit hit = index.nearest(features(wanted)).value();
    EXPECT_EQ(hit.id, 10 + static_cast<CaseId>(best));
    EXPECT_DOUBLE_EQ(similarity_at(hit.difference), similarity(wanted, scenes[best]));
  }
}

TEST(FeatureIndex, PrefersTheOldestOfEquals) {
  FeatureIndex index;
  index.add(3, crossing_truck());
  index.add(4, crossing_truck());
  EXPECT_EQ(index.nearest(features(crossing_truck())).value().id, 3);
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
}  // namespace saca::memory::feature_index_test
