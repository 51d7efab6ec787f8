#include "saca/lab/family_samples/showcase_search.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::family_samples::showcase_search_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::StartsWith;

class ShowcaseSearchTest : public testing::Test {
 protected:
  [[nodiscard]] ShowcaseSearch search() const {
    return {.source = &source_,
            .car = &car_,
            .harm = &harm_,
            .rule = {.draws = 4},
            .tries = 2,
            .threads = 2,
            .display = long_work::ProgressDisplay::silent};
  }
  /// What the first encounters come to as they are written.
  [[nodiscard]] std::vector<eval::Finding> findings(int count) const {
    std::vector<eval::Finding> all;
    for (int k = 0; k < count; ++k) {
      const auto number = static_cast<std::uint64_t>(k);
      const auto sample = source_.sample(number).value();
      all.push_back(eval::look_into({&sample.scenario, 1}, car_, harm_, 2).front());
      all.back().family = source_.family_of(number);
      all.back().number = number;
    }
    return all;
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
  eval::SuiteSource source_ = eval::SuiteSource::open({.scenarios = "scenarios",
                                                       .suite = "balanced",
                                                       .test_log = std::nullopt,
                                                       .car = "compact_rwd_ev",
                                                       .footprint = manoeuvre::footprint(car_),
                                                       .other_names = {}})
                                  .value();
};

TEST_F(ShowcaseSearchTest, OfDoingNothingThreeAreWanted) {
  EXPECT_EQ(wanted(PolicyId::no_intervention), 3);
  EXPECT_EQ(wanted(PolicyId::aeb), 1);
}

TEST_F(ShowcaseSearchTest, WhatIsFoundConvincesAndHasANameOfItsOwn) {
  const std::vector<eval::Finding> all = findings(30);
  int num_found = 0;
  for (const PolicyId policy : manoeuvre::all_policies) {
    const auto found = showcase_scenes(search(), all, policy);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    ASSERT_TRUE(found.value().has_value());
    EXPECT_LE(static_cast<int>(found.value()->size()), wanted(policy));
    double before = 0.0;
    for (const ShowcaseScene& one : *found.value()) {
      EXPECT_TRUE(convinces(one.oracle, policy, search().rule));
      EXPECT_THAT(one.scenario.name,
                  StartsWith("showcase_" + std::to_string(manoeuvre::index(policy))));
      EXPECT_THAT(one.scenario.title, HasSubstr(" is right: "));
      EXPECT_EQ(one.scenario.why, eval::why_right(one.oracle, policy));
      EXPECT_LE(before, one.contact_share());
      before = one.contact_share();
      ++num_found;
    }
  }
  EXPECT_GT(num_found, 0);
}

TEST_F(ShowcaseSearchTest, WithoutCandidatesNothingIsFound) {
  const auto none = showcase_scenes(search(), {}, PolicyId::aeb);
  ASSERT_TRUE(none.has_value());
  EXPECT_TRUE(none.value()->empty());
  ShowcaseSearch without_tries = search();
  without_tries.tries = 0;
  EXPECT_TRUE(showcase_scenes(without_tries, findings(3), PolicyId::aeb).value()->empty());
}

}  // namespace
}  // namespace saca::family_samples::showcase_search_test
