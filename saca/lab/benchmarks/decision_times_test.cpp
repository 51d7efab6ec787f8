#include "saca/lab/benchmarks/decision_times.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "saca/lab/benchmarks/counted_clock_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::benchmarks::decision_times_test {
namespace {

TEST(DecisionTimes, EveryFigureIsThereForEachCrowd) {
  const CountedClock clock;
  const collision::HarmModel harm = prepare::read_harm("data/harm.toml").value();
  const nlohmann::json figures = decision_times({.car = &atlas::small_atlas_car(),
                                                 .harm = &harm,
                                                 .intent = &intent::shipped_model(),
                                                 .atlas = &atlas::small_atlas()},
                                                clock, 1);
  // Five kinds of times with four percentiles and a count, and two shares with and without a
  // verdict.
  EXPECT_EQ(figures.size(), 6U * (5U * 5U + 2U * 2U));
  for (const std::string name :
       {"decide.reflex_us", "decide.machine_us", "decide.atlas_judge_us", "decide.verdict_us"}) {
    for (const std::string percentile : {".p50", ".p99", ".p99.9", ".max"}) {
      EXPECT_NEAR(figures.at(name + percentile + ".actors8").get<double>(), 1.0, 1e-9) << name;
    }
    EXPECT_EQ(figures.at(name + ".n.actors32.followed"), 1) << name;
  }
  const double share = figures.at("decide.reflex_us.triggered_share.fresh.actors1").get<double>();
  EXPECT_TRUE(share == 0.0 || share == 1.0);
}

}  // namespace
}  // namespace saca::benchmarks::decision_times_test
