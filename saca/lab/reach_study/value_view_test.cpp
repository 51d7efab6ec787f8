#include "saca/lab/reach_study/value_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "saca/lab/reach_study/solution_for_test.h"

namespace saca::reach_study::value_view_test {
namespace {

using testing::ElementsAre;

constexpr double pi = std::numbers::pi;

std::string refusal(const ViewRequest& request) {
  const auto view = view_of(disc_solution(), request, "d/a.h5");
  return view.has_value() ? "" : view.error().message;
}

TEST(AxisValue, IsANameAndANumber) {
  EXPECT_EQ(axis_value("speed=12").value(), (AxisValue{"speed", 12.0}));
  EXPECT_EQ(axis_value("course=-1.5e1").value(), (AxisValue{"course", -15.0}));
  for (const char* const text : {"", "speed", "speed=", "=3", "speed=1m", "speed= 1", "a=b=1"}) {
    const auto refused = axis_value(text);
    ASSERT_FALSE(refused.has_value()) << text;
    EXPECT_EQ(refused.error().message,
              "--at: want NAME=NUMBER, such as speed=12, got '" + std::string(text) + "'");
  }
}

TEST(AxisValue, CourseAndSpeedComeFirst) {
  EXPECT_THAT(
      axis_values(20.0, 12.0, {"v=1"}).value(),
      ElementsAre(AxisValue{"course", 20.0}, AxisValue{"speed", 12.0}, AxisValue{"v", 1.0}));
  EXPECT_TRUE(axis_values({}, {}, {}).value().empty());
  EXPECT_FALSE(axis_values({}, {}, {"v=1", "v"}).has_value());
}

TEST(ValueView, IsOfTheMiddleAndTheEndUnlessAskedOtherwise) {
  const auto view = view_of(disc_solution(), {.at = {}, .time = {}, .zoom = 2.0}, "d/a.h5");
  ASSERT_TRUE(view.has_value());
  EXPECT_EQ(view.value().title, "disc");
  EXPECT_EQ(view.value().others, (danger::State{0.0, 0.0, 0.0, 9.0}));  // course is about 0
  EXPECT_EQ(view.value().time, 1U);
  EXPECT_EQ(view.value().zoom, 2.0);
}

TEST(ValueView, IsOfWhatWasAskedForInItsUnits) {
  const ViewRequest request{.at = {{"course", 90.0}, {"speed", 3.0}}, .time = 0.5004, .zoom = 1.0};
  const auto view = view_of(disc_solution(), request, "d/a.h5");
  ASSERT_TRUE(view.has_value());
  EXPECT_DOUBLE_EQ(view.value().others[2], pi / 2.0);
  EXPECT_EQ(view.value().others[3], 3.0);
  EXPECT_EQ(view.value().time, 0U);
  EXPECT_EQ(described(disc_solution(), view.value()),
            "V over x and y at course 90 deg, speed 3 m/s, horizon 0.5 s");
}

TEST(ValueView, TakesTheFilesNameWhereTheCaseHasNone) {
  danger::Solution solved = disc_solution();
  solved.problem.clear();
  solved.complete = false;
  const auto view = view_of(solved, {}, "d/own.h5");
  ASSERT_TRUE(view.has_value());
  EXPECT_EQ(view.value().title, "own");
  EXPECT_THAT(described(solved, view.value()),
              testing::EndsWith("horizon 1 s (stopped before its end)"));
}

// At 1 s the disc has 3.1 m: 60 % of the 10 m to the side hold it up to a zoom of about 2.
TEST(ValueView, ShowsAllDangerByItself) {
  const auto view = view_of(disc_solution(), {}, "a.h5");
  ASSERT_TRUE(view.has_value());
  EXPECT_NEAR(view.value().zoom, 2.0, 0.1);
}

TEST(ValueView, RefusesWhatIsNotThere) {
  EXPECT_EQ(refusal({.at = {{"speed", 19.0}}}), "d/a.h5: speed: want 0 m/s to 18 m/s, got 19 m/s");
  EXPECT_EQ(refusal({.at = {{"course", 541.0}}}),
            "d/a.h5: course: want -180 deg to 180 deg, got 541 deg");
  EXPECT_EQ(refusal({.at = {{"course", 539.0}}}), "");  // a turn more is the same
  EXPECT_EQ(refusal({.at = {{"speed", 1.0}, {"speed", 1.0}}}), "d/a.h5: speed is asked for twice");
  EXPECT_EQ(refusal({.at = {{"x", 1.0}}}),
            "d/a.h5: no axis 'x' beyond the plane that is shown; the axes are x, y, course, "
            "speed, the first two are the plane");
  EXPECT_EQ(refusal({.at = {}, .time = 0.7}), "d/a.h5: --time-s: want one of 0.5, 1, got 0.7");
}

TEST(ValueView, WantsAPlane) {
  danger::Solution line{.grid = {{{.name = "x", .first = 0.0, .last = 3.0, .points = 4}}},
                        .times = {1.0}};
  line.values = danger::Snapshots<float>{{0.0F, 0.0F, 0.0F, 0.0F}};
  const auto refused = view_of(line, {}, "a.h5");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message, "a.h5: want a grid of at least two axes to show, got one");
}

}  // namespace
}  // namespace saca::reach_study::value_view_test
