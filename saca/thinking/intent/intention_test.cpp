#include "saca/thinking/intent/intention.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string_view>

namespace saca::intent::intention_test {
namespace {

using testing::ElementsAre;
using world::ActorKind;

TEST(Intention, TheFirstSixAreThePapersInItsOrder) {
  EXPECT_THAT(vehicle_intentions,
              ElementsAre(Intention::maintain, Intention::lane_left, Intention::lane_right,
                          Intention::brake, Intention::brake_left, Intention::brake_right));
  for (std::size_t i = 0; i < num_intentions; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(all_intentions[i]), i);
  }
}

TEST(Intention, HasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const Intention intention : all_intentions) {
    names.insert(name(intention));
  }
  EXPECT_EQ(names.size(), num_intentions);
  EXPECT_EQ(name(Intention::brake_left), "LB");
  EXPECT_EQ(name(Intention::cross), "cross");
}

TEST(Intention, WhoMayHaveItIsAMatterOfKind) {
  EXPECT_EQ(intentions_of(ActorKind::motorcycle).size(), 6U);
  EXPECT_THAT(intentions_of(ActorKind::bicycle),
              ElementsAre(Intention::maintain, Intention::stop, Intention::cross));
  EXPECT_THAT(intentions_of(ActorKind::obstacle), ElementsAre(Intention::maintain));
  EXPECT_TRUE(is_vru(ActorKind::pedestrian));
  EXPECT_FALSE(is_vru(ActorKind::motorcycle));
}

TEST(Intention, OfEqualOnesTheFirstIsLikeliest) {
  EXPECT_EQ(likeliest({0.2, 0.3, 0.2, 0.3}), Intention::lane_left);
}

}  // namespace
}  // namespace saca::intent::intention_test
