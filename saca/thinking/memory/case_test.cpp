#include "saca/thinking/memory/case.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "saca/onboard/match/example_scenes.h"

namespace saca::memory::case_test {
namespace {

Case usable() {
  std::mt19937 rng(1);
  Case one;
  one.scene = match::random_scene(rng, 2);
  return one;
}

TEST(ACase, CanBeKeptAsItIsMade) {
  EXPECT_FALSE(broken_rule(usable()).has_value());
}

TEST(ACase, NamesWhatCannotBeKept) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto key_of = [](auto spoil) {
    Case one = usable();
    spoil(one);
    const auto problem = broken_rule(one);
    return problem ? problem->key : "nothing";
  };
  EXPECT_EQ(key_of([&](Case& c) { c.harm = -0.1; }), "harm");
  EXPECT_EQ(key_of([&](Case& c) { c.best_harm = nan; }), "best_harm");
  EXPECT_EQ(key_of([&](Case& c) { c.collision_loss = nan; }), "collision_loss");
  EXPECT_EQ(key_of([&](Case& c) { c.worst_harm = -1.0; }), "worst_harm");
  EXPECT_EQ(key_of([&](Case& c) { c.plan.target_speed = 3.0; }), "target_speed_mps");
  EXPECT_EQ(key_of([&](Case& c) {
              c.plan = {manoeuvre::PolicyId::es_b_left, nan};
            }),
            "target_speed_mps");
  EXPECT_EQ(key_of([&](Case& c) { c.plan.strength = 1.5; }), "strength");
  EXPECT_EQ(key_of([&](Case& c) { c.plan.strength = nan; }), "strength");
  EXPECT_EQ(key_of([&](Case& c) { c.count = 0; }), "count");
  EXPECT_EQ(key_of([&](Case& c) { c.draws = 0; }), "draws");
  EXPECT_EQ(key_of([&](Case& c) { c.risks = {0.5}; }), "risks");
  EXPECT_EQ(key_of([&](Case& c) { c.risks = {0.5, nan}; }), "risks");
  EXPECT_EQ(key_of([&](Case& c) { c.intentions.resize(3); }), "intentions");
  EXPECT_EQ(key_of([&](Case& c) {
              c.intentions.resize(2);
              c.intentions[1][3] = 1.5;
            }),
            "intentions");
  EXPECT_EQ(key_of([&](Case& c) { c.lessons.resize(101); }), "lessons");
  EXPECT_EQ(key_of([&](Case& c) { c.made_with.resize(101); }), "made_with");
  EXPECT_EQ(key_of([&](Case& c) { c.review = "a\xC3"; }), "review");
  EXPECT_EQ(key_of([&](Case& c) { c.source = "\x9B"; }), "source");
  EXPECT_EQ(key_of([&](Case& c) { c.lessons = {"a", "\xC0\x9B"}; }), "lessons");
  EXPECT_EQ(key_of([&](Case& c) { c.told = PolicyHarms{0.0, nan}; }), "told");
  EXPECT_EQ(key_of([&](Case& c) { c.happened = PolicyHarms{-1.0}; }), "happened");
  EXPECT_EQ(key_of([&](Case& c) { c.happened = PolicyHarms{std::nullopt, 0.0}; }), "nothing");
}

TEST(ACase, HasWordsForWhereItComesFromAndHowFarItIsTrusted) {
  for (const Origin one : {Origin::own, Origin::simulation, Origin::recording, Origin::expert}) {
    EXPECT_EQ(origin_from(name(one)), one);
  }
  for (const Trust one : {Trust::trusted, Trust::unchecked, Trust::quarantined}) {
    EXPECT_EQ(trust_from(name(one)), one);
  }
  EXPECT_FALSE(origin_from("trusted").has_value());
  EXPECT_FALSE(trust_from("").has_value());
}

TEST(ACase, IsOfTheSameCarAndHarmByTheirDigests) {
  const std::vector<MadeWith> now{{"car", "van", "1"}, {"harm", "h", "2"}, {"atlas", "van", "3"}};
  std::vector<MadeWith> then = now;
  then[2].digest = "4";
  then[0].name = "the van";
  EXPECT_TRUE(same_car_and_harm(then, now));
  then[1].digest = "5";
  EXPECT_FALSE(same_car_and_harm(then, now));
  EXPECT_FALSE(same_car_and_harm({}, now));
  EXPECT_FALSE(same_car_and_harm(now, {}));
  EXPECT_FALSE(same_car_and_harm({}, {}));
  const std::vector<MadeWith> unknown{{"car", "van", ""}, {"harm", "h", ""}};
  EXPECT_FALSE(same_car_and_harm(unknown, unknown)) << "nobody knows";
  EXPECT_EQ(car_and_harm(unknown), "");
  EXPECT_EQ(car_and_harm(now), "1\n2");
}

TEST(ACase, IsTrustedByAnotherWhereItIsKnownByWhom) {
  const std::vector<MadeWith> car{{"car", "van", "1"}, {"harm", "h", "2"}};
  const std::vector<MadeWith> other{{"car", "suv", "3"}, {"harm", "h", "2"}};
  Case one = usable();
  EXPECT_FALSE(is_trusted_by_another(car, one)) << "nobody knows by whom";
  one.made_with = other;
  EXPECT_TRUE(is_trusted_by_another(car, one));
  EXPECT_FALSE(is_trusted_by_another(other, one));
  one.trust = Trust::unchecked;
  EXPECT_FALSE(is_trusted_by_another(car, one));
}

TEST(ACase, IsHearsayAlsoWhereACheckToldWhatToExpect) {
  Case said = usable();
  said.origin = Origin::expert;
  EXPECT_TRUE(is_hearsay(said));
  said.told = PolicyHarms{0.1, 0.0};
  EXPECT_TRUE(is_hearsay(said)) << "nothing has happened";
  said.happened = PolicyHarms{0.1, 0.0};
  EXPECT_FALSE(is_hearsay(said));
  said.happened.reset();
  said.origin = Origin::own;
  EXPECT_FALSE(is_hearsay(said));
}

}  // namespace
}  // namespace saca::memory::case_test
