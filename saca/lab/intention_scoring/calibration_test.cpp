#include "saca/lab/intention_scoring/calibration.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"

namespace saca::intention_scoring::calibration_test {
namespace {

/// Labels that are drawn, and forecasts that are told of them, all heads alike.
struct Drawn {
  Sequence sequence;
  Forecasts forecasts;

  void add(std::size_t num, const ClassProbabilities& truth, const ClassProbabilities& told,
           std::uint32_t seed) {
    std::mt19937 random(seed);
    std::discrete_distribution<int> label(truth.begin(), truth.end());
    for (std::size_t i = 0; i < num; ++i) {
      sequence.observations.emplace_back();
      sequence.labels.push_back(static_cast<std::uint8_t>(label(random)));
      sequence.scored.push_back(true);
      for (auto& head : forecasts.at) {
        head.push_back(told);
      }
    }
  }
  [[nodiscard]] Calibrations best(double limit = 1e9) const {
    return best_calibrations(std::span(&sequence, 1), std::span(&forecasts, 1), limit);
  }
};

constexpr double sampling = 0.016;  // of shares of 6,000 labels: three standard deviations

TEST(Calibration, MakesForecastsThatAreTooSureHonest) {
  Drawn drawn;
  drawn.add(6'000, mostly(0, 0.8), mostly(0, 0.95), 5);
  for (const intent::Calibration& each : drawn.best()) {
    const auto honest = intent::calibrated(each, mostly(0, 0.95));
    EXPECT_NEAR(honest[0], 0.8, sampling);
    EXPECT_NEAR(honest[3], 0.04, sampling);
  }
}

TEST(Calibration, LeavesHonestForecastsAsTheyAre) {
  Drawn drawn;
  drawn.add(6'000, mostly(0, 0.7), mostly(0, 0.7), 6);
  drawn.add(6'000, mostly(3, 0.6), mostly(3, 0.6), 7);
  for (const intent::Calibration& each : drawn.best()) {
    EXPECT_NEAR(each.inverse_temperature, 1.0, 0.1);
    for (const double bias : each.bias) {
      EXPECT_NEAR(bias, 0.0, 0.2);
    }
  }
}

TEST(Calibration, TakesBackWhatIsToldOfAClassTooOften) {
  const ClassProbabilities truth{0.7, 0.05, 0.05, 0.1, 0.05, 0.05};
  const ClassProbabilities told{0.5, 0.05, 0.05, 0.3, 0.05, 0.05};
  Drawn drawn;
  drawn.add(6'000, truth, told, 8);
  const auto honest = intent::calibrated(drawn.best()[1], told);
  for (std::size_t k = 0; k < num_vehicle_classes; ++k) {
    EXPECT_NEAR(honest[k], truth[k], sampling) << k;
  }
}

/// One frame in ten may be of braking, and is in 45 of 100.
Drawn doubtful() {
  const ClassProbabilities maybe{0.55, 0.0, 0.0, 0.45, 0.0, 0.0};
  Drawn drawn;
  for (std::uint32_t i = 0; i < 200; ++i) {
    drawn.add(40, mostly(0, 1.0), mostly(0, 1.0), 2 * i);
    drawn.add(4, maybe, maybe, 2 * i + 1);
  }
  return drawn;
}

TEST(Calibration, NamesAClassFromLessThanOneHalfOn) {
  const Drawn drawn = doubtful();
  const Forecasts honest = calibrated(drawn.forecasts, drawn.best());
  // Named there, F1 of braking is 2 x 0.45 / (1 + 0.45); never named it is 0.
  const double f1 = *tally(drawn.sequence, honest, 0).confusion.f1(3);
  EXPECT_NEAR(f1, 0.62, 0.05);  // sampling: 800 labels
  EXPECT_LT(honest.at[0][40][3], 0.5);
  EXPECT_EQ(honest.named(0, 40), 3U);
  EXPECT_EQ(honest.named(0, 0), 0U);
}

TEST(Calibration, NamesNothingThatRaisesTooManyFalseAlarms) {
  const Drawn drawn = doubtful();
  const Calibrations quiet = drawn.best(0.0);
  EXPECT_EQ(calibrated(drawn.forecasts, quiet).named(0, 40), 0U);
  EXPECT_EQ(quiet[1].naming, drawn.best()[1].naming);  // the limit is that of now
}

TEST(Calibration, IsSymmetricInTheMirror) {
  Drawn drawn;
  drawn.add(3'000, {0.4, 0.3, 0.05, 0.15, 0.08, 0.02}, mostly(0, 0.5), 9);
  for (const intent::Calibration& each : drawn.best()) {
    for (const auto* numbers : {&each.bias, &each.naming}) {
      EXPECT_EQ((*numbers)[1], (*numbers)[2]);
      EXPECT_EQ((*numbers)[4], (*numbers)[5]);
    }
  }
}

TEST(CrossCalibrated, ASplitsOwnLabelsDoNotMatter) {
  std::vector<Sequence> sequences;
  std::vector<Forecasts> forecasts;
  std::vector<std::string> splits;
  for (std::uint32_t i = 0; i < 3; ++i) {
    Drawn drawn;
    drawn.add(500, mostly(0, 0.6 + 0.1 * i), mostly(0, 0.8), i);
    sequences.push_back(drawn.sequence);
    forecasts.push_back(drawn.forecasts);
    splits.push_back(std::to_string(i));
  }
  const auto before = cross_calibrated(sequences, splits, forecasts);
  for (std::uint8_t& label : sequences[1].labels) {
    label = 3;
  }
  const auto after = cross_calibrated(sequences, splits, forecasts);
  EXPECT_EQ(before[1].at, after[1].at);
  EXPECT_NE(before[0].at, after[0].at);
  EXPECT_NE(before[2].at, after[2].at);
}

TEST(Calibration, WantsSomethingToBeFittedTo) {
  Drawn drawn;
  EXPECT_THROW((void)drawn.best(), ContractViolation);
  drawn.add(20, mostly(0, 0.7), mostly(0, 0.7), 1);
  EXPECT_THROW((void)drawn.best(-1.0), ContractViolation);
  EXPECT_THROW((void)cross_calibrated(std::span(&drawn.sequence, 1), std::vector<std::string>{"a"},
                                      {drawn.forecasts}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::calibration_test
