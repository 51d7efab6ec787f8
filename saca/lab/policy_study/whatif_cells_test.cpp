#include "saca/lab/policy_study/whatif_cells.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::policy_study::whatif_cells_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;

class WhatifCells : public testing::Test {
 protected:
  [[nodiscard]] std::string complaint(const std::vector<std::string>& texts) const {
    const auto axes = axes_of(texts, scenario_);
    return axes.has_value() ? "accepted" : axes.error().message;
  }
  [[nodiscard]] Result<std::optional<std::vector<eval::Cell>>> tried(
      const std::vector<std::string>& texts) const {
    const WhatifMap map{.scenario = &scenario_,
                        .car = &car_,
                        .time = 0.5,
                        .axes = axes_of(texts, scenario_).value(),
                        .cells = {}};
    return try_cells(map, harm_, {.display = long_work::ProgressDisplay::silent});
  }

  const scenario::Scenario scenario_ = eval::shipped_scenario("intersection_t1");
  const manoeuvre::Car car_ = prepare::default_car();
  const collision::HarmModel harm_ = eval::shipped_harm();
};

TEST_F(WhatifCells, OneOrTwoAxesAreRead) {
  EXPECT_EQ(axes_of({"grip=0.5:0.9:0.2"}, scenario_).value().size(), 1U);
  const auto two = axes_of({"grip=0.5:0.9:0.2", "ego.speed_mps=8:9:1"}, scenario_).value();
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[1].what, "ego.speed_mps");
}

TEST_F(WhatifCells, AxesThatMakeNoMapAreRefused) {
  EXPECT_THAT(complaint({"truck.distance_m"}),
              testing::StartsWith("--vary truck.distance_m: want"));
  EXPECT_EQ(complaint({"grip=0.5:0.9:0.2", "grip=0.3:0.5:0.2"}),
            "--vary: want two different numbers, got grip twice");
  EXPECT_EQ(complaint({"grip=0.301:0.7:0.001", "ego.speed_mps=5:24.9:0.1"}),
            "--vary: want at most 40000 scenes, got 80000");
}

TEST_F(WhatifCells, TheFirstAxisGoesFastest) {
  const auto both = tried({"grip=0.6:0.9:0.3", "ego.speed_mps=8:10:2"}).value().value();
  ASSERT_EQ(both.size(), 4U);
  const auto second = tried({"grip=0.9:0.9:1", "ego.speed_mps=8:8:1"}).value().value();
  const auto third = tried({"grip=0.6:0.6:1", "ego.speed_mps=10:10:1"}).value().value();
  EXPECT_EQ(both[1].harms, second[0].harms);
  EXPECT_EQ(both[2].harms, third[0].harms);
}

TEST_F(WhatifCells, WhereNoCellCanBeTheFirstReasonIsTold) {
  const auto none = tried({"truck1.mass_kg=-5:-4:1"});
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().message, HasSubstr("truck1.mass_kg=-5"));
}

TEST_F(WhatifCells, SomeThatCannotBeAreMarked) {
  const auto cells = tried({"truck1.mass_kg=-5:5000:5005"}).value().value();
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_FALSE(cells[0].possible);
  EXPECT_TRUE(cells[1].possible);
}

}  // namespace
}  // namespace saca::policy_study::whatif_cells_test
