#include "saca/lab/network_training/task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/contract.h"

namespace saca::network_training::task_test {
namespace {

TEST(Batches, HoldEachPieceOnceAndLittleThatIsFilledUp) {
  std::vector<Piece> pieces(3'000);
  std::vector<std::size_t> order;
  std::int64_t known = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i].features = torch::zeros({static_cast<std::int64_t>(1 + i * 37 % 100), 1});
    known += pieces[i].features.size(0);
    order.push_back(pieces.size() - 1 - i);
  }
  std::vector<int> met(pieces.size());
  std::int64_t filled = 0;
  for (const auto& batch : batches_of(pieces, order, 900)) {
    std::int64_t longest = 0;
    for (const std::size_t i : batch) {
      ++met[i];
      longest = std::max(longest, pieces[i].features.size(0));
    }
    EXPECT_LE(longest * static_cast<std::int64_t>(batch.size()), 900);
    filled += longest * static_cast<std::int64_t>(batch.size());
  }
  EXPECT_THAT(met, testing::Each(1));
  EXPECT_LT(filled, known + known / 10);
  EXPECT_EQ(batches_of(pieces, {99, 0}, 1).size(), 2U);  // longer than a batch: by itself
  EXPECT_TRUE(batches_of(pieces, {}, 900).empty());
}

// Regression onto y = 2 x1 - x2: the smallest squares are 0, and these are the weights. Frames that
// are not known, and those that are filled up, have labels that would spoil it.
TEST(Task, LearnsWhatTheKnownLabelsSay) {
  torch::manual_seed(1);
  torch::nn::Linear linear(2, 1);
  std::vector<Piece> pieces;
  for (int i = 0; i < 40; ++i) {
    Piece piece{.features = torch::randn({5 + i % 3, 2}), .labels = {}, .known = {}, .taught = {}};
    piece.labels = (2.0 * piece.features.select(1, 0) - piece.features.select(1, 1)).unsqueeze(1);
    piece.known = torch::ones({piece.features.size(0), 1}, torch::kBool);
    piece.labels[4] = 100.0;
    piece.known[4] = false;
    pieces.push_back(piece);
  }
  const auto squares = [&](const Batch& batch) {
    const torch::Tensor off = linear(batch.features) - batch.labels;
    return (off * off).masked_select(batch.known).mean();
  };
  const Task task{.network = linear.ptr(),
                  .loss = [&](Batch& batch, std::mt19937_64&) { return squares(batch); },
                  .held_out_loss = squares,
                  .words = {}};
  const Schedule schedule{.seed = 1, .epochs = 60, .batch = 30, .step = 5e-2, .decay = 0.0};
  std::vector<Epoch> curve;
  ASSERT_FALSE(train(task, pieces, pieces, schedule, {}, [&](const Epoch& epoch) {
                 curve.push_back(epoch);
                 return true;
               }).has_value());
  EXPECT_EQ(curve.size(), 60U);
  EXPECT_LT(*curve.back().held_out, 1e-3);
  EXPECT_NEAR(linear->weight[0][0].item<double>(), 2.0, 0.02);
  EXPECT_NEAR(linear->weight[0][1].item<double>(), -1.0, 0.02);
}

TEST(Task, IsAContractThatThereAreLabels) {
  torch::nn::Linear linear(2, 1);
  const Task task{.network = linear.ptr(), .loss = {}, .held_out_loss = {}, .words = {}};
  EXPECT_THROW((void)train(task, {}, {}, {}, {}, [](const Epoch&) { return true; }),
               ContractViolation);
}

}  // namespace
}  // namespace saca::network_training::task_test
