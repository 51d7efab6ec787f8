#include "saca/lab/intention_scoring/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/intention_scoring/predict.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"
#include "saca/thinking/intent/network_for_test.h"

namespace saca::intention_scoring::evaluation_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Six groups of one sequence each: M, then FB; all scored.
std::vector<Sequence> six() {
  std::vector<Sequence> all;
  for (int group = 0; group < 6; ++group) {
    Sequence sequence{
        .name = std::to_string(group), .site = "here", .group = std::to_string(group)};
    for (int t = 0; t < 40; ++t) {
      sequence.observations.push_back({.speed = 10.0 + group});
      sequence.labels.push_back(t < 20 ? 0 : 3);
      sequence.scored.push_back(true);
    }
    sequence.braking_times = {2.0};
    all.push_back(sequence);
  }
  return all;
}

/// What is predicted for each frame is what is there `late` frames before it.
std::vector<Forecasts> late_by(const std::vector<Sequence>& sequences, std::size_t late) {
  std::vector<Forecasts> all(sequences.size());
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    for (std::size_t head = 0; head < num_heads; ++head) {
      for (std::size_t t = 0; t < sequences[i].labels.size(); ++t) {
        const std::size_t later = std::min(t + frames_ahead[head], sequences[i].labels.size() - 1);
        ClassProbabilities sure{};
        sure[sequences[i].labels[later - std::min(late, later)]] = 1.0;
        all[i].at[head].push_back(sure);
      }
    }
  }
  return all;
}

TEST(Figures, OfAPerfectForecastArePerfect) {
  const auto sequences = six();
  const Figures figures = figures_of(sequences, late_by(sequences, 0), recorded_classes, 1);
  for (const auto& interval : figures.macro_f1) {
    ASSERT_TRUE(interval.has_value());
    EXPECT_EQ(interval->value, 1.0);
    EXPECT_EQ(interval->low, 1.0);
  }
  EXPECT_EQ(figures.illegal_steps, 0U);
  EXPECT_EQ(figures.alarms.per_hour(), 0.0);
  EXPECT_GT(*figures.brakings.quantile(0.5), 0.9);  // told 1 s ahead
}

TEST(Differences, OfLogLossAreThoseCountedByHand) {
  const auto sequences = six();
  std::vector<Forecasts> sure;
  std::vector<Forecasts> doubtful;
  for (const Sequence& sequence : sequences) {
    Forecasts at_09;
    Forecasts at_05;
    for (std::size_t head = 0; head < num_heads; ++head) {
      for (const std::uint8_t label : sequence.labels) {
        at_09.at[head].push_back(mostly(label, 0.9));
        at_05.at[head].push_back(mostly(label, 0.5));
      }
    }
    sure.push_back(at_09);
    doubtful.push_back(at_05);
  }
  const auto difference = log_loss_difference(sequences, sure, doubtful, 0, 1);
  ASSERT_TRUE(difference.has_value());
  EXPECT_NEAR(difference->value, std::log(0.5) - std::log(0.9), 1e-12);
  EXPECT_NEAR(difference->low, difference->high, 1e-12);  // all groups alike
}

TEST(Figures, OfALateForecastAreThoseCountedByHand) {
  const auto sequences = six();
  const Figures figures = figures_of(sequences, late_by(sequences, 4), recorded_classes, 1);
  // Of 40 frames 4 of FB are called M: M 20 of 24 called so, all found; FB 16 of 20 found.
  const double of_m = 2.0 * 20.0 / (20.0 + 24.0);
  const double of_fb = 2.0 * 16.0 / (20.0 + 16.0);
  EXPECT_NEAR(figures.macro_f1[0]->value, 0.5 * (of_m + of_fb), 1e-12);
  const auto difference = macro_f1_difference(sequences, late_by(sequences, 0),
                                              late_by(sequences, 4), 0, recorded_classes, 1);
  EXPECT_NEAR(difference->value, 1.0 - 0.5 * (of_m + of_fb), 1e-12);
  EXPECT_GT(difference->low, 0.0);
}

TEST(Figures, StepsToTheOtherSideAreForbidden) {
  const ForbiddenSteps steps = structurally_forbidden();
  EXPECT_TRUE(steps[1][2]);
  EXPECT_TRUE(steps[4][5]);
  EXPECT_TRUE(steps[2][4]);
  EXPECT_FALSE(steps[1][0]);
  EXPECT_FALSE(steps[3][5]);
}

/// A folder with models that say what they have left out.
class Models : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  void add(const std::string& file, const std::string& left_out, std::uint32_t seed) const {
    formats::Tensors tensors;
    intent::add_random_network(tensors, "0.", seed);
    tensors.tensors["networks"] = {{1}, {1.0F}};
    tensors.tensors["chain.start"] = {{3, 6}, std::vector<float>(18, 0.0F)};
    tensors.tensors["chain.transition"] = {{3, 6, 6}, std::vector<float>(108, 0.0F)};
    tensors.tensors["sharpness"] = {{3}, {1.0F, 1.0F, 1.0F}};
    tensors.tensors["bias"] = {{3, 6}, std::vector<float>(18, 0.0F)};
    tensors.tensors["naming"] = {{3, 6}, std::vector<float>(18, 1.0F)};
    if (!left_out.empty()) {
      tensors.words["left_out"] = left_out;
    }
    ASSERT_FALSE(write_file(folder_ / file, formats::tensor_bytes(tensors)).has_value());
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / "saca_models_by_left_out";
};

TEST_F(Models, EachForetellsWhatItHasNotSeen) {
  add("a.safetensors", "part-0", 1);
  add("b.safetensors", "part-1", 2);
  const auto models = read_models(folder_);
  ASSERT_TRUE(models.has_value()) << models.error().message;
  const auto sequences = six();
  std::vector<std::string> splits;
  for (int i = 0; i < 6; ++i) {
    splits.push_back(i % 2 == 0 ? "part-0" : "part-1");
  }
  const auto all = predicted_unseen(models.value(), sequences, splits, 2);
  ASSERT_TRUE(all.has_value());
  for (std::size_t i = 0; i < 6; ++i) {
    const auto expected =
        predicted(models.value().at(splits[i]), std::span(&sequences[i], 1), 1).front();
    EXPECT_EQ(all.value()[i].at, expected.at);
  }
  splits[3] = "part-2";
  EXPECT_THAT(predicted_unseen(models.value(), sequences, splits, 1).error().message,
              HasSubstr("left out part-2, got none"));
}

TEST_F(Models, RefusesWhatCannotBeToldApart) {
  EXPECT_THAT(read_models(folder_).error().message, HasSubstr("want a folder with models"));
  add("a.safetensors", "", 1);
  EXPECT_THAT(read_models(folder_).error().message, HasSubstr("want metadata left_out"));
  add("a.safetensors", "part-0", 1);
  add("b.safetensors", "part-0", 2);
  EXPECT_THAT(read_models(folder_).error().message, HasSubstr("leaves out part-0 as well"));
}

}  // namespace
}  // namespace saca::intention_scoring::evaluation_test
