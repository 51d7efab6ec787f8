#include "saca/lab/network_training/training.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/intention_scoring/predict.h"
#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/simulated.h"
#include "saca/thinking/intent/features.h"
#include "saca/thinking/intent/model.h"

namespace saca::network_training::training_test {
namespace {

namespace fs = std::filesystem;

/// A training of seconds.
TrainingPlan short_plan() {
  return {.seed = 3, .epochs = 3, .batch = 900, .longest = 60};
}

std::string bytes_of(const LstmCrf& network) {
  return formats::tensor_bytes(model_tensors({network}));
}

fs::path state_file(const char* name) {
  const fs::path path = fs::path(testing::TempDir()) / name;
  fs::remove(path);
  return path;
}

const auto all_epochs = [](const Epoch&) { return true; };

TEST(Training, LearnsWhatIsThere) {
  const auto sequences = intention_scoring::simulated_sequences(60, 1, 1);
  const auto others = intention_scoring::simulated_sequences(30, 2, 1);
  TrainingPlan plan = short_plan();
  plan.epochs = 8;
  std::vector<Epoch> curve;
  const auto network = trained(sequences, others, plan, {}, [&](const Epoch& epoch) {
    curve.push_back(epoch);
    return true;
  });
  ASSERT_TRUE(network.has_value());
  ASSERT_EQ(curve.size(), 8U);
  EXPECT_LT(*curve.back().held_out, 0.6 * *curve.front().held_out);
  const auto model = intent::model_from(model_tensors({network.value()}), "model");
  ASSERT_TRUE(model.has_value());
  intention_scoring::Tally sum;
  const auto forecasts = intention_scoring::predicted(model.value(), others, 1);
  for (std::size_t i = 0; i < others.size(); ++i) {
    sum += intention_scoring::tally(others[i], forecasts[i], 0);
  }
  EXPECT_GT(*sum.confusion.recall(3), 0.5);  // braking: of six classes, one in six by guessing
}

TEST(Training, IsTheSameBytesWhetherStoppedOrNot) {
  const auto sequences = intention_scoring::simulated_sequences(20, 1, 1);
  const auto straight = trained(sequences, {}, short_plan(), {}, all_epochs);
  const fs::path state = state_file("saca_training_state.pt");
  const auto stopped = trained(sequences, {}, short_plan(), state,
                               [](const Epoch& epoch) { return epoch.number < 2; });
  ASSERT_TRUE(stopped.has_value());
  int first = 0;
  const auto resumed = trained(sequences, {}, short_plan(), state, [&](const Epoch& epoch) {
    first = first == 0 ? epoch.number : first;
    return true;
  });
  ASSERT_TRUE(resumed.has_value()) << resumed.error().message;
  EXPECT_EQ(first, 1);  // tells the whole curve
  EXPECT_NE(bytes_of(stopped.value()), bytes_of(straight.value()));
  EXPECT_EQ(bytes_of(resumed.value()), bytes_of(straight.value()));
}

TEST(Training, WillNotGoOnWithAnother) {
  const auto sequences = intention_scoring::simulated_sequences(10, 1, 1);
  const fs::path state = state_file("saca_training_other.pt");
  ASSERT_TRUE(trained(sequences, {}, short_plan(), state, all_epochs).has_value());
  TrainingPlan other = short_plan();
  other.seed = 4;
  EXPECT_THAT(trained(sequences, {}, other, state, all_epochs).error().message,
              testing::HasSubstr("is of another training"));
  TrainingPlan other_weights = short_plan();
  other_weights.label_weights = all_alike;
  EXPECT_THAT(trained(sequences, {}, other_weights, state, all_epochs).error().message,
              testing::HasSubstr("is of another training"));
  TrainingPlan other_noise = short_plan();
  other_noise.speed_noise = 0.4;
  EXPECT_THAT(trained(sequences, {}, other_noise, state, all_epochs).error().message,
              testing::HasSubstr("is of another training"));
  ASSERT_FALSE(write_file(state, "damaged").has_value());
  EXPECT_THAT(trained(sequences, {}, short_plan(), state, all_epochs).error().message,
              testing::HasSubstr("want the state of a training"));
}

TEST(Training, CalibrationsTakeThePlaceOfThoseThatAreThere) {
  formats::Tensors tensors = model_tensors({LstmCrf(0.0)});
  intention_scoring::Calibrations calibrations;
  calibrations[1] = {.inverse_temperature = 0.5,
                     .bias = {0.0, -0.5, -0.5, 0.25, 0.125, 0.125},
                     .naming = {1.0, 2.0, 2.0, 0.5, 1.0, 1.0}};
  set_calibrations(tensors, calibrations);
  const auto model = intent::model_from(tensors, "model");
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_EQ(model.value().calibrations[0].inverse_temperature, 1.0);
  EXPECT_EQ(model.value().calibrations[1].inverse_temperature, 0.5);
  EXPECT_EQ(model.value().calibrations[1].bias, calibrations[1].bias);
  EXPECT_EQ(model.value().calibrations[1].naming, calibrations[1].naming);
}

TEST(Pieces, LabelsAreThoseOfLater) {
  intention_scoring::Sequence sequence;
  for (int t = 0; t < 25; ++t) {
    sequence.observations.push_back({.speed = 10.0});
    sequence.labels.push_back(static_cast<std::uint8_t>(t >= 15 ? 3 : 0));
    sequence.scored.push_back(t != 14);
  }
  const auto pieces = pieces_of({sequence}, 20, PieceBegins::in_turn);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].features.size(0), 20);
  EXPECT_EQ(pieces[1].features.size(0), 5);
  EXPECT_EQ(pieces[0].labels[15][0].item<int>(), 3);
  EXPECT_EQ(pieces[0].labels[10][1].item<int>(), 3);  // 0.5 s ahead
  EXPECT_EQ(pieces[0].labels[5][2].item<int>(), 3);   // 1 s ahead
  EXPECT_FALSE(pieces[0].known[14][0].item<bool>());
  EXPECT_FALSE(pieces[0].known[9][1].item<bool>());
  EXPECT_TRUE(pieces[1].known[4][0].item<bool>());
  EXPECT_FALSE(pieces[1].known[0][1].item<bool>());  // frame 25 was never seen

  const auto with_late = pieces_of({sequence}, 20, PieceBegins::also_late);
  ASSERT_EQ(with_late.size(), 4U);
  EXPECT_EQ(with_late[1].features.size(0), 15);
  EXPECT_EQ(with_late[1].labels[10][0].item<int>(), 3);  // frame 15
  const auto memory = static_cast<std::int64_t>(intent::Feature::memory);
  EXPECT_EQ(with_late[1].features[0][memory].item<float>(), 0.0F);  // a stream that begins
}

intention_scoring::Forecasts all_predicted_as(std::size_t num_frames,
                                              const intention_scoring::ClassProbabilities& p) {
  intention_scoring::Forecasts forecasts;
  for (auto& head : forecasts.at) {
    head.assign(num_frames, p);
  }
  return forecasts;
}

TEST(Pieces, AreTaughtLabelsAndByItsShareWhatATeacherForetells) {
  intention_scoring::Sequence sequence;
  for (int t = 0; t < 25; ++t) {
    sequence.observations.push_back({.speed = 10.0});
    sequence.labels.push_back(static_cast<std::uint8_t>(t >= 15 ? 3 : 0));
    sequence.scored.push_back(true);
  }
  Lessons lessons{.share = 0.25,
                  .forecasts = {all_predicted_as(25, {0.0, 0.0, 0.0, 0.5, 0.5, 0.0}), {}}};
  lessons.forecasts[0].at[0][21] = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto pieces = pieces_of({sequence, sequence}, 20, PieceBegins::in_turn, lessons);
  ASSERT_EQ(pieces.size(), 4U);
  const auto taught = [](const Piece& piece, std::int64_t t, std::int64_t h, std::int64_t k) {
    return piece.taught[t][h][k].item<float>();
  };
  EXPECT_FLOAT_EQ(taught(pieces[0], 15, 0, 3), 0.75F + 0.125F);
  EXPECT_FLOAT_EQ(taught(pieces[0], 15, 0, 4), 0.125F);
  EXPECT_FLOAT_EQ(taught(pieces[0], 14, 0, 0), 0.75F);
  EXPECT_FLOAT_EQ(taught(pieces[1], 1, 0, 0), 0.25F);  // frame 21: of the second piece the second
  EXPECT_FLOAT_EQ(taught(pieces[1], 1, 0, 3), 0.75F);
  EXPECT_FLOAT_EQ(taught(pieces[0], 10, 1, 3), 0.75F + 0.125F);  // its label in half a second
  EXPECT_FLOAT_EQ(taught(pieces[2], 15, 0, 3), 1.0F);            // nobody teaches
  EXPECT_FALSE(pieces_of({sequence}, 20, PieceBegins::in_turn)[0].taught.defined());
  lessons.forecasts.pop_back();
  EXPECT_THROW((void)pieces_of({sequence, sequence}, 20, PieceBegins::in_turn, lessons),
               ContractViolation);
}

TEST(Training, LearnsFromATeacherWhatNoLabelSays) {
  const auto sequences = intention_scoring::simulated_sequences(20, 1, 1);
  Lessons lessons{.share = 1.0, .forecasts = {}};
  for (const auto& each : sequences) {  // of a teacher who is never sure
    lessons.forecasts.push_back(
        all_predicted_as(each.labels.size(), {0.5, 0.1, 0.1, 0.1, 0.1, 0.1}));
  }
  TrainingPlan plan = short_plan();
  plan.epochs = 8;
  const fs::path state = state_file("saca_training_taught.pt");
  const auto alone = trained(sequences, {}, plan, state, all_epochs);
  ASSERT_TRUE(alone.has_value());
  EXPECT_THAT(trained(sequences, {}, plan, state, all_epochs, lessons).error().message,
              testing::HasSubstr("is of another training"));
  const auto taught = trained(sequences, {}, plan, {}, all_epochs, lessons);
  ASSERT_TRUE(taught.has_value());
  const auto mean_surest = [&](const LstmCrf& network) {
    const auto model = intent::model_from(model_tensors({network}), "model");
    double sum = 0.0;
    double num = 0.0;
    for (const auto& each : intention_scoring::predicted(model.value(), sequences, 1)) {
      for (const auto& p : each.at[0]) {
        sum += *std::max_element(p.begin(), p.end());
        num += 1.0;
      }
    }
    return sum / num;
  };
  EXPECT_LT(mean_surest(taught.value()), mean_surest(alone.value()) - 0.05)
      << "of " << mean_surest(alone.value());
}

}  // namespace
}  // namespace saca::network_training::training_test
