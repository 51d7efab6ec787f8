#include "saca/lab/reach_study/danger_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::reach_study::danger_tables_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr world::Footprint body{.length = 4.5, .width = 1.8};

prepare::NamedCar usual_car() {
  return {"compact_rwd_ev", prepare::default_car()};
}

/// A table of a car at rest, on few points and of a moment, so that it is solved in one.
danger::DangerCase small_case() {
  danger::DangerCase wanted = tables_for(usual_car(), 0.9, {{body, 0.0}}).value().at(0);
  for (danger::Axis& axis : wanted.asked.grid.axes) {
    axis.points = (axis.points + 1) / 2;
  }
  wanted.asked.times = {0.2};
  return wanted;
}

class DangerTables : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(testing::TempDir()) / "danger_tables" /
                           testing::UnitTest::GetInstance()->current_test_info()->name();
  std::vector<std::string> noticed_;
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] TableStore store() {
    return {.place = [this](const std::string& table) { return folder_ / "car" / (table + ".h5"); },
            .notice = [this](const std::string& message) { noticed_.push_back(message); },
            .display = long_work::ProgressDisplay::silent};
  }
};

TEST_F(DangerTables, AreThoseOfTheBodies) {
  const auto cases = tables_for(usual_car(), 0.9, {{body, 3.0}});
  ASSERT_TRUE(cases.has_value());
  ASSERT_EQ(cases.value().size(), 2U);
  EXPECT_EQ(cases.value()[1].name, "car_5mps");
  prepare::NamedCar spinning = usual_car();
  spinning.name = "toy";
  spinning.car.cg_to_front_axle = 0.1;
  spinning.car.cg_to_rear_axle = 0.1;
  const auto refused = tables_for(spinning, 0.9, {{body, 3.0}});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, testing::StartsWith("toy: "));
}

TEST_F(DangerTables, AreSolvedOnceAndThenRead) {
  const auto first = ready_table(small_case(), store());
  ASSERT_TRUE(first.has_value()) << first.error().message;
  EXPECT_FALSE(first.value().was_there);
  EXPECT_EQ(first.value().file, folder_ / "car" / "car_0mps.h5");
  EXPECT_EQ(first.value().not_kept, std::nullopt);
  EXPECT_EQ(first.value().table.error.size(), danger::num_cells(first.value().table.grid));
  const auto again = ready_table(small_case(), store());
  ASSERT_TRUE(again.has_value());
  EXPECT_TRUE(again.value().was_there);
  EXPECT_EQ(again.value().table.values, first.value().table.values);
  EXPECT_THAT(noticed_, testing::IsEmpty());
}

TEST_F(DangerTables, AreSolvedAnewWhereTheFileIsAnother) {
  danger::DangerCase other = small_case();
  other.asked.text += "# of another car\n";
  ASSERT_TRUE(ready_table(other, store()).has_value());
  const auto table = ready_table(small_case(), store());
  EXPECT_FALSE(table.value().was_there);
  EXPECT_EQ(danger::read_solved(table.value().file).value().problem, small_case().asked.text);
}

TEST_F(DangerTables, AreUsedThoughTheyCannotBeKept) {
  fs::create_directories(folder_);
  ASSERT_EQ(write_file(folder_ / "car", "no folder"), std::nullopt);
  const auto tables = ready_tables({small_case()}, store());
  ASSERT_TRUE(tables.has_value());
  ASSERT_EQ(tables.value().size(), 1U);
  EXPECT_EQ(tables.value()[0].obstacle_speed, 0.0);
  EXPECT_THAT(noticed_, ElementsAre(HasSubstr("; the table is used, and solved again next time")));
  // The ego in the middle of the obstacle: lost.
  const danger::ValueTable& values = *tables.value()[0].values;
  EXPECT_GT(values.at({}).value, 0.0);
}

TEST_F(DangerTables, AreNoneOfNoCases) {
  EXPECT_TRUE(ready_tables({}, store()).value().empty());
}

}  // namespace
}  // namespace saca::reach_study::danger_tables_test
