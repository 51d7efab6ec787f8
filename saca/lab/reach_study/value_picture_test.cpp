#include "saca/lab/reach_study/value_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/reach_study/solution_for_test.h"

namespace saca::reach_study::value_picture_test {
namespace {

const report::ValueView at_the_end{.title = "disc", .others = {0.0, 0.0, 0.0, 9.0}, .time = 1};

TEST(ValuePicture, IsAPng) {
  const auto picture = value_picture(disc_solution(), at_the_end);
  ASSERT_TRUE(picture.has_value());
  EXPECT_THAT(picture.value(), testing::StartsWith("\x89PNG\r\n\x1a\n"));
}

TEST(ValuePicture, ShowsTheSnapshotAndTheCourse) {
  const std::string usual = value_picture(disc_solution(), at_the_end).value();
  EXPECT_EQ(usual, value_picture(disc_solution(), at_the_end).value());
  report::ValueView earlier = at_the_end;
  earlier.time = 0;
  EXPECT_NE(usual, value_picture(disc_solution(), earlier).value());
  report::ValueView turned = at_the_end;
  turned.others[2] = 0.5;
  EXPECT_NE(usual, value_picture(disc_solution(), turned).value());
}

// 2.1 m and 3.1 m of the 10 m to the side lie within 60 % up to a zoom of 2.9 and of 1.9.
TEST(ValuePicture, ZoomsAsFarAsAllDangerCanBeSeen) {
  report::ValueView view = at_the_end;
  EXPECT_NEAR(zoom_on_danger(disc_solution(), view), 1.94, 0.05);
  view.time = 0;
  EXPECT_NEAR(zoom_on_danger(disc_solution(), view), 2.86, 0.1);
}

}  // namespace
}  // namespace saca::reach_study::value_picture_test
