#include "saca/lab/tune/fit_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "saca/base/core/csv.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/tune/fit_drive.h"

namespace saca::tune::fit_log_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const vehicle::Vehicle& usual_car() {
  static const vehicle::Vehicle car = prepare::default_vehicle();
  return car;
}

const Log& good(TestKind kind) {
  static const Log brake = drive_test(usual_car(), {.kind = TestKind::brake});
  static const Log steer = drive_test(usual_car(), {.kind = TestKind::steer});
  return kind == TestKind::brake ? brake : steer;
}

std::string verdict(std::string_view text) {
  const auto log = read_log(text, "log.csv", usual_car());
  return log.has_value() ? "accepted" : log.error().message;
}

// What is said of a good log with one thing spoilt.
std::string verdict(TestKind kind, const std::function<void(Log&)>& spoil) {
  Log log = good(kind);
  spoil(log);
  return verdict(write_log(log));
}

void scale(Log& log, Signal signal, double factor) {
  for (Series& series : log.measured) {
    for (double& value : series.values) {
      value *= series.signal == signal ? factor : 1.0;
    }
  }
}

void cut(Log& log, std::size_t begin, std::size_t end) {
  const auto keep = [begin, end](auto& values) {
    values.resize(end);
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(begin));
  };
  keep(log.time);
  keep(log.command);
  for (Series& series : log.measured) {
    keep(series.values);
  }
}

TEST(ReadLog, GivesBackWhatWasWritten) {
  for (const TestKind kind : {TestKind::brake, TestKind::steer}) {
    const Log& written = good(kind);
    const Log read = read_log(write_log(written), "log.csv", usual_car()).value();
    EXPECT_EQ(read.kind, kind);
    EXPECT_EQ(read.event, written.event);
    EXPECT_TRUE(read.motor_known);
    ASSERT_EQ(read.measured.size(), written.measured.size());
    ASSERT_GT(read.time.size(), written.time.size() / 2);  // at rest it is cut
    for (std::size_t row = 0; row < read.time.size(); ++row) {
      EXPECT_DOUBLE_EQ(read.time[row], written.time[row]);
      EXPECT_NEAR(read.command[row].brake_torque[0], written.command[row].brake_torque[0], 0.01);
      for (std::size_t k = 0; k < read.measured.size(); ++k) {
        EXPECT_EQ(read.measured[k].signal, written.measured[k].signal);
        EXPECT_NEAR(read.measured[k].values[row], written.measured[k].values[row], 1e-3);
      }
    }
  }
}

TEST(ReadLog, NamesAMissingColumn) {
  EXPECT_THAT(verdict("time_s\n0\n"), HasSubstr("log.csv: column speed_mps is missing"));
  EXPECT_THAT(verdict("speed_mps\n0\n"), HasSubstr("column time_s is missing"));
  EXPECT_THAT(verdict(TestKind::steer,
                      [](Log& log) {
                        std::erase_if(log.measured,
                                      [](const Series& s) { return s.signal == Signal::yaw_rate; });
                      }),
              HasSubstr("column yaw_rate_degps is missing"));
  std::string less;  // the rear right brake's column and the motor's are cut off
  const std::string whole = write_log(good(TestKind::brake));
  for (std::string_view rest = whole; !rest.empty();) {
    std::string_view line = cut_line(rest);
    line = line.substr(0, line.rfind(','));
    less += std::string(line.substr(0, line.rfind(','))) + "\n";
  }
  EXPECT_THAT(verdict(less), HasSubstr("and the other three wheels, or none of them"));
}

TEST(ReadLog, WantsATimeThatIncreasesInSeconds) {
  EXPECT_THAT(verdict(TestKind::steer, [](Log& log) { log.time[7] = log.time[6]; }),
              AllOf(StartsWith("log.csv:9: time_s"), HasSubstr("got 0 s")));
  EXPECT_THAT(verdict(TestKind::steer, [](Log& log) { std::swap(log.time[7], log.time[8]); }),
              StartsWith("log.csv:10: time_s"));
  EXPECT_THAT(verdict(TestKind::steer,
                      [](Log& log) {
                        for (double& time : log.time) {
                          time *= 1000.0;  // ms
                        }
                      }),
              StartsWith("log.csv:3: time_s: want"));
}

TEST(ReadLog, WantsEnoughBeforeAndAfter) {
  EXPECT_THAT(verdict(TestKind::steer, [](Log& log) { cut(log, 0, 15); }),
              HasSubstr("at least 20 rows"));
  EXPECT_THAT(verdict(TestKind::brake, [](Log& log) { cut(log, log.event - 5, log.time.size()); }),
              HasSubstr("0.2 s before braking begins"));
  EXPECT_THAT(verdict(TestKind::brake, [](Log& log) { cut(log, log.event, log.time.size()); }),
              HasSubstr("0.2 s before braking begins"));
  EXPECT_THAT(verdict(TestKind::steer, [](Log& log) { cut(log, 0, log.event + 20); }),
              HasSubstr("0.5 s of driving after the step begins"));
}

TEST(ReadLog, WantsOneTestOfTheTwo) {
  const auto no_command = [](Log& log) {
    for (vehicle::Command& command : log.command) {
      command = {};
    }
  };
  EXPECT_THAT(verdict(TestKind::brake, no_command), HasSubstr("got no braking"));
  EXPECT_THAT(verdict(TestKind::steer, no_command), HasSubstr("no step of steering_command_deg"));
  EXPECT_THAT(verdict(TestKind::steer,
                      [](Log& log) {
                        for (std::size_t row = log.event; row < log.command.size(); ++row) {
                          log.command[row].brake_torque.fill(500.0);
                        }
                      }),
              HasSubstr("got braking and a step of steering in one"));
  EXPECT_THAT(verdict(TestKind::steer,
                      [](Log& log) {  // a ramp of 2 deg/s is no step
                        for (std::size_t row = 0; row < log.command.size(); ++row) {
                          log.command[row].steering = from_degrees(1.9) * log.time[row];
                        }
                      }),
              HasSubstr("no step of"));
}

TEST(ReadLog, SeesWrongUnitsAndSigns) {
  const TestKind brake = TestKind::brake;
  const TestKind steer = TestKind::steer;
  const auto scaled = [](Signal signal, double factor) {
    return [=](Log& log) { scale(log, signal, factor); };
  };
  EXPECT_THAT(verdict(brake, scaled(Signal::speed, 3.6)), HasSubstr("a speed in km/h"));
  EXPECT_THAT(verdict(brake, scaled(Signal::a_x, 1.0 / 9.81)), HasSubstr("an acceleration in g"));
  EXPECT_THAT(verdict(brake, scaled(Signal::a_x, -1.0)), HasSubstr("ISO 8855"));
  EXPECT_THAT(verdict(steer, scaled(Signal::speed, 3.6)), HasSubstr("a speed in km/h"));
  EXPECT_THAT(verdict(steer, scaled(Signal::yaw_rate, from_degrees(1.0))),
              HasSubstr("an angle in rad"));
  EXPECT_THAT(verdict(steer, scaled(Signal::a_y, 1.0 / 9.81)), HasSubstr("an acceleration in g"));
  EXPECT_THAT(verdict(steer, scaled(Signal::a_y, -1.0)), HasSubstr("ISO 8855"));
  EXPECT_THAT(verdict(brake, scaled(Signal::speed, 30.0)), HasSubstr("log.csv:2: speed_mps: want"));
}

// With nothing but the one signal that a test needs, the commands contradict a wrong unit.
TEST(ReadLog, SeesWrongUnitsInTheLeastThatALogMayHold) {
  const auto only = [](Log& log, Signal kept) {
    std::erase_if(log.measured, [kept](const Series& series) {
      return series.signal != Signal::speed && series.signal != kept;
    });
  };
  EXPECT_EQ(verdict(TestKind::brake, [&](Log& log) { only(log, Signal::speed); }), "accepted");
  EXPECT_THAT(verdict(TestKind::brake,
                      [&](Log& log) {
                        only(log, Signal::speed);
                        scale(log, Signal::speed, 3.6);
                      }),
              HasSubstr("speed_mps: want at most"));
  EXPECT_EQ(verdict(TestKind::steer, [&](Log& log) { only(log, Signal::yaw_rate); }), "accepted");
  EXPECT_THAT(verdict(TestKind::steer,
                      [&](Log& log) {
                        only(log, Signal::yaw_rate);
                        scale(log, Signal::yaw_rate, from_degrees(1.0));
                      }),
              HasSubstr("an angle in rad"));
  EXPECT_THAT(verdict(TestKind::steer,
                      [&](Log& log) {
                        only(log, Signal::yaw_rate);
                        for (vehicle::Command& command : log.command) {
                          command.steering *= 15.0;
                        }
                      }),
              HasSubstr("steering wheel"));
}

TEST(ReadLog, WantsSpeedAndItsLoss) {
  EXPECT_THAT(verdict(TestKind::brake,
                      [](Log& log) {
                        for (double& speed : log.measured.front().values) {
                          speed = 20.0;
                        }
                      }),
              HasSubstr("lost by braking"));
  EXPECT_THAT(verdict(TestKind::steer, [](Log& log) { scale(log, Signal::speed, 0.1); }),
              HasSubstr("at least 5 m/s"));
}

}  // namespace
}  // namespace saca::tune::fit_log_test
