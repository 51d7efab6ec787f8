#include "saca/lab/intention_scoring/simulated.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"

namespace saca::intention_scoring::simulated_test {
namespace {

/// Seen without errors and at once.
DrivePlan seen_truly(double speed) {
  DrivePlan plan;
  plan.speed.speed = speed;
  plan.perception = {};
  return plan;
}

std::string letters_of(const Sequence& sequence) {
  std::string text;
  for (const std::uint8_t label : sequence.labels) {
    text += "MLRBlr"[label];
  }
  return text;
}

TEST(SimulatedSequences, AreWholeAndDifferent) {
  std::set<std::string> names;
  for (const Sequence& sequence : simulated_sequences(50, 1, 2)) {
    EXPECT_NO_THROW(expect_whole(sequence));
    EXPECT_TRUE(sequence.simulated);
    EXPECT_GE(sequence.labels.size(), 80U);
    EXPECT_LE(sequence.labels.size(), 141U);
    names.insert(sequence.name);
    for (const intent::Observation& seen : sequence.observations) {
      EXPECT_TRUE(std::isfinite(seen.speed) && seen.speed >= 0.0);
      EXPECT_TRUE(std::isfinite(seen.acceleration + seen.yaw_rate + seen.lateral_speed));
      EXPECT_LE(std::abs(seen.offset), 0.5 * seen.lane_width);
      EXPECT_GE(seen.gap, 0.0);
      EXPECT_EQ(std::isinf(seen.gap), std::isnan(seen.gap_speed));
    }
  }
  EXPECT_EQ(names.size(), 50U);
}

TEST(SimulatedSequences, DependOnTheSeedAlone) {
  const auto a = simulated_sequences(6, 3, 1);
  const auto b = simulated_sequences(6, 3, 2);
  const auto c = simulated_sequences(6, 4, 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].labels, b[i].labels);
    ASSERT_EQ(a[i].observations.size(), b[i].observations.size());
    for (std::size_t t = 0; t < a[i].observations.size(); ++t) {
      EXPECT_EQ(a[i].observations[t].speed, b[i].observations[t].speed);
      EXPECT_EQ(a[i].observations[t].offset, b[i].observations[t].offset);
    }
  }
  EXPECT_NE(a[0].observations[0].speed, c[0].observations[0].speed);
  EXPECT_TRUE(simulated_sequences(0, 1, 1).empty());
  EXPECT_THROW((void)simulated_sequences(1, 1, 0), ContractViolation);
}

TEST(SimulatedSequences, HoldEveryClassAndBothSidesAlike) {
  Confusion shares;  // of the truth with itself
  double left = 0.0;
  double right = 0.0;
  for (const Sequence& sequence : simulated_sequences(300, 2, 2)) {
    for (const std::uint8_t label : sequence.labels) {
      ++shares.counts.at(label).at(label);
    }
    const std::string text = letters_of(sequence);
    left += text.find_first_of("Ll") != std::string::npos ? 1.0 : 0.0;
    right += text.find_first_of("Rr") != std::string::npos ? 1.0 : 0.0;
  }
  const auto total = static_cast<double>(shares.total());
  EXPECT_GT(static_cast<double>(shares.truly(0)) / total, 0.4);
  for (std::size_t c = 1; c < num_vehicle_classes; ++c) {
    EXPECT_GT(static_cast<double>(shares.truly(c)) / total, 0.015) << c;
    EXPECT_LT(static_cast<double>(shares.truly(c)) / total, 0.3) << c;
  }
  // About 110 of 300 go to each side; their difference has a standard deviation below sqrt(220).
  EXPECT_NEAR(left, right, 40.0);
}

TEST(SimulatedSequence, ErrorsHaveTheSizesOfItsPerception) {
  double square = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    DrivePlan plan = seen_truly(20.0);
    plan.perception = {.position_sd = 0.2, .velocity_sd = 0.1, .correlation_time = 0.1};
    for (const intent::Observation& seen : simulated_sequence(plan, seed, "a").observations) {
      square += seen.offset * seen.offset;
      ++count;
    }
  }
  // 6,000 values, independent after some 0.2 s: a standard error of about 1.5 %.
  EXPECT_NEAR(std::sqrt(square / count), 0.2, 0.01);
}

TEST(SimulatedSequence, IsTheTruthWithoutErrors) {
  DrivePlan plan = seen_truly(20.0);
  plan.speed.brakings = {{.start = 3.0, .build_up = 0.4, .deceleration = 4.0}};
  plan.lead = LeadPlan{.gap = 60.0, .speed = {.speed = 18.0}};
  const Sequence sequence = simulated_sequence(plan, 1, "a");
  const auto& seen = sequence.observations;
  ASSERT_EQ(seen.size(), 101U);
  EXPECT_NEAR(seen[20].speed, 20.0, 1e-9);
  EXPECT_NEAR(seen[20].gap, 60.0 - 2.0 * 2.0, 1e-6);
  EXPECT_NEAR(seen[20].gap_speed, -2.0, 1e-9);
  EXPECT_NEAR(seen[20].offset, 0.0, 1e-9);
  EXPECT_NEAR(seen[45].acceleration, -4.0, 1e-6) << "held for 0.5 s and more";
  EXPECT_NEAR(seen[32].acceleration, -4.0 * (0.2 / 0.4) * 0.1 / 0.5, 0.05) << "0.1 s^2 of ramp";
  // It falls below -2 m/s^2 half way up the ramp, 3.2 s.
  ASSERT_EQ(sequence.braking_times.size(), 1U);
  EXPECT_NEAR(sequence.braking_times[0], 3.2, 0.1 + 1e-9) << "frames are 0.1 s apart";
  EXPECT_TRUE(std::isnan(seen[20].brake)) << "does not share its pedals";
}

TEST(SimulatedSequence, CrossesTheLaneBoundHalfWay) {
  DrivePlan plan = seen_truly(20.0);
  plan.shifts = {{.start = 2.0, .duration = 4.0, .aside = 3.5}};
  const Sequence sequence = simulated_sequence(plan, 1, "a");
  ASSERT_EQ(sequence.crossing_times.size(), 1U);
  EXPECT_NEAR(sequence.crossing_times[0], 4.0, 0.011);
  EXPECT_EQ(letters_of(sequence).find_first_not_of("ML"), std::string::npos);
  EXPECT_EQ(sequence.labels[40], 1);
  // The offset jumps by a lane's width, the speed to the side does not.
  EXPECT_NEAR(sequence.observations[39].offset - sequence.observations[42].offset, 3.5,
              0.3 * 1.875 * 3.5 / 4.0);
  EXPECT_NEAR(sequence.observations[40].lateral_speed, 1.875 * 3.5 / 4.0, 1e-6);
  EXPECT_NEAR(std::tan(sequence.observations[40].heading), 1.875 * 3.5 / 4.0 / 20.0, 1e-6);
  EXPECT_FALSE(sequence.scored[static_cast<std::size_t>(letters_of(sequence).find('L'))]);
}

TEST(SimulatedSequence, KeepsItsLaneInACurve) {
  DrivePlan plan = seen_truly(20.0);
  plan.curvature = 1.0 / 400.0;
  plan.lead = LeadPlan{.gap = 40.0, .speed = {.speed = 20.0}};
  const auto seen = simulated_sequence(plan, 1, "a").observations;
  for (const std::size_t t : {0U, 50U, 100U}) {
    EXPECT_NEAR(seen[t].offset, 0.0, 1e-6);
    EXPECT_NEAR(seen[t].heading, 0.0, 1e-9);
    EXPECT_NEAR(seen[t].yaw_rate, 20.0 / 400.0, 1e-9);
    EXPECT_NEAR(seen[t].lateral_speed, 0.0, 1e-9);
    EXPECT_NEAR(seen[t].gap, 40.0, 1e-6);
  }
}

/// Way to one side, by frames, of the motion that holds a frame: neighbours in which it goes on.
double way_of_motion(const std::vector<double>& lateral, std::size_t frame, double side) {
  const auto goes_on = [&](std::size_t from) {
    return side * (lateral[from + 1] - lateral[from]) > 0.2 * frame_step;
  };
  std::size_t begin = frame;
  std::size_t end = frame;
  while (begin > 0 && goes_on(begin - 1)) {
    --begin;
  }
  while (end + 1 < lateral.size() && goes_on(end)) {
    ++end;
  }
  return side * (lateral[end] - lateral[begin]);
}

TEST(SimulatedSequence, LabelsAreWhatTheTrueMotionDoes) {
  std::size_t sides = 0;
  std::size_t brakings = 0;
  for (std::uint64_t i = 0; i < 120; ++i) {
    std::mt19937_64 rng(1000 + i);
    const DrivePlan plan = draw_plan(rng);
    const Sequence sequence = simulated_sequence(plan, 1, "a");
    const DriveMotion motion = drive(plan);
    std::vector<double> lateral;
    for (std::size_t t = 0; t < sequence.labels.size(); ++t) {
      lateral.push_back(motion.aside[DriveMotion::before + 10 * t]);
    }
    for (std::size_t t = 1; t + 1 < lateral.size(); ++t) {
      if (!sequence.scored[t]) {
        continue;
      }
      // Away from changes by 0.2 s what is true now was true 0.1 s ago and will be.
      const std::string_view letter(&"MLRBlr"[sequence.labels[t]], 1);
      const std::size_t now = DriveMotion::before + 10 * t;
      const double slower = (motion.speed[now - 5] - motion.speed[now + 5]) / frame_step;
      const double speed = (lateral[t + 1] - lateral[t - 1]) / (2.0 * frame_step);
      if (letter.find_first_of("Blr") == 0) {
        ASSERT_GT(slower, 1.0 - 0.1) << i << " " << t;
        ++brakings;
      }
      if (letter.find_first_of("LRlr") == 0) {
        const double side = letter.find_first_of("Ll") == 0 ? 1.0 : -1.0;
        ASSERT_GT(side * speed, 0.2 - 0.05) << i << " " << t;
        ASSERT_GT(way_of_motion(lateral, t, side), 1.0 - 0.1) << i << " " << t;
        ++sides;
      } else if (std::abs(speed) > 0.5) {
        ASSERT_LT(way_of_motion(lateral, t, speed < 0.0 ? -1.0 : 1.0), 1.0) << i << " " << t;
      }
    }
  }
  EXPECT_GT(sides, 300U);
  EXPECT_GT(brakings, 300U);
}

TEST(SimulatedSequence, PedalsGoBeforeWhatTheyCause) {
  DrivePlan plan = seen_truly(20.0);
  plan.shares_pedals = true;
  plan.speed.brakings = {{.start = 3.0, .build_up = 0.2, .deceleration = 5.0}};
  const auto seen = simulated_sequence(plan, 1, "a").observations;
  EXPECT_EQ(seen[28].brake, 0.0);
  EXPECT_GT(seen[28].throttle, 0.0);
  EXPECT_GT(seen[30].brake, 0.2) << "0.15 s later the car slows down with 3.75 m/s^2";
  EXPECT_EQ(seen[30].throttle, 0.0);
  EXPECT_NEAR(seen[30].acceleration, 0.0, 1e-6);
}

TEST(SimulatedSequence, MirrorsItsLabels) {
  std::size_t turned_frames = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    std::mt19937_64 rng(i);
    DrivePlan plan = draw_plan(rng);
    plan.perception = {};
    const Sequence there = simulated_sequence(plan, 1, "a");
    const Sequence turned = simulated_sequence(mirrored(plan), 1, "a");
    constexpr std::array<std::uint8_t, num_vehicle_classes> other{0, 2, 1, 3, 5, 4};
    ASSERT_EQ(there.labels.size(), turned.labels.size());
    for (std::size_t t = 0; t < there.labels.size(); ++t) {
      ASSERT_EQ(there.labels[t], other.at(turned.labels[t]));
      ASSERT_NEAR(there.observations[t].lateral_speed, -turned.observations[t].lateral_speed, 1e-9);
      ASSERT_NEAR(there.observations[t].speed, turned.observations[t].speed, 1e-9);
      turned_frames += there.labels[t] != turned.labels[t] ? 1U : 0U;
    }
    EXPECT_EQ(there.crossing_times, turned.crossing_times);
  }
  EXPECT_GT(turned_frames, 200U);
}

}  // namespace
}  // namespace saca::intention_scoring::simulated_test
