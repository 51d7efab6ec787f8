#include "saca/lab/scenario/turn.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"

namespace saca::scenario::turn_test {
namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

// A quarter of a circle leads as far ahead as aside, by its radius.
TEST(Turn, AQuarterLeadsByTheRadiusAheadAndAside) {
  const Turn left{.heading = 0.0, .angle = right_angle, .radius = 8.0};
  const Pose end = left.pose(left.arc_length());
  EXPECT_NEAR(end.p.x, 8.0, 1e-12);
  EXPECT_NEAR(end.p.y, 8.0, 1e-12);
  EXPECT_NEAR(end.yaw, right_angle, 1e-12);
  const Turn right{.heading = 0.0, .angle = -right_angle, .radius = 8.0};
  EXPECT_NEAR(right.pose(right.arc_length()).p.y, -8.0, 1e-12);
}

TEST(Turn, BeforeAndAfterTheArcItGoesStraightOn) {
  const Turn turn{.heading = std::numbers::pi, .angle = right_angle, .radius = 5.0};
  EXPECT_NEAR(turn.pose(-3.0).p.x, 3.0, 1e-12);  // comes from there
  const Pose end = turn.pose(turn.arc_length());
  const Pose beyond = turn.pose(turn.arc_length() + 2.0);
  EXPECT_NEAR(beyond.p.x - end.p.x, 0.0, 1e-12);
  EXPECT_NEAR(beyond.p.y - end.p.y, -2.0, 1e-12);  // to its left: down
  EXPECT_NEAR(beyond.yaw, -right_angle, 1e-12);
}

// Chords are shorter than arcs, by angle^2 / 24 of them: 0.05 s at 6 m/s on 6 m are 0.05 rad.
TEST(Turn, IsDrivenAtItsSpeed) {
  const Turn turn{.heading = 0.3, .angle = -1.2, .radius = 6.0};
  const Recording recording = recording_of(turn, {10.0, -4.0}, 1.0, 6.0, 4.0);
  for (std::size_t k = 1; k < recording.size(); ++k) {
    const double step = recording[k].time - recording[k - 1].time;
    const double way = norm(recording[k].X_WA.p - recording[k - 1].X_WA.p);
    EXPECT_NEAR(way / step, 6.0, 6.0 * 0.05 * 0.05 / 24.0 + 1e-9);
  }
  EXPECT_GE(recording.back().time, 4.0);
  EXPECT_NEAR(recording[20].X_WA.p.x, 10.0, 1e-9);  // at 1 s its arc begins
  EXPECT_NEAR(recording[20].X_WA.p.y, -4.0, 1e-9);
  EXPECT_NEAR(recording[25].yaw_rate, -1.0, 1e-12);  // speed by radius, to the right
}

TEST(Turn, RefusesWhatIsNoTurn) {
  EXPECT_THROW((void)recording_of({.heading = 0.0, .angle = 0.0, .radius = 5.0}, {}, 0.0, 5.0, 1.0),
               ContractViolation);
  EXPECT_THROW((void)recording_of({.heading = 0.0, .angle = 1.0, .radius = 0.0}, {}, 0.0, 5.0, 1.0),
               ContractViolation);
  EXPECT_THROW((void)recording_of({.heading = 0.0, .angle = 1.0, .radius = 5.0}, {}, 0.0, 0.0, 1.0),
               ContractViolation);
}

}  // namespace
}  // namespace saca::scenario::turn_test
