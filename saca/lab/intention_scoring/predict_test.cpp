#include "saca/lab/intention_scoring/predict.h"

#include <gtest/gtest.h>

#include "saca/thinking/intent/network_for_test.h"

namespace saca::intention_scoring::predict_test {
namespace {

TEST(Predicted, IsWhatAStreamTellsFrameByFrame) {
  formats::Tensors tensors;
  intent::add_random_network(tensors, "", 3);
  intent::Model model;
  model.networks.push_back(intent::Network::from(tensors, "", "w").value());
  model.calibrations[1].naming[3] = 2.0;
  std::vector<Sequence> sequences(3);
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    for (std::size_t t = 0; t < 10 + i; ++t) {
      sequences[i].observations.push_back({.speed = 10.0 + static_cast<double>(t * i),
                                           .offset = 0.1,
                                           .lateral_speed = 0.0,
                                           .heading = 0.0,
                                           .lane_width = 3.5});
    }
  }
  const auto all = predicted(model, sequences, 2);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].naming[1][3], 2.0);
  EXPECT_EQ(all[0].naming[0][3], 1.0);
  intent::Stream stream;
  for (std::size_t t = 0; t < sequences[2].observations.size(); ++t) {
    const intent::HorizonScores told = stream.step(model, sequences[2].observations[t]);
    for (std::size_t head = 0; head < num_heads; ++head) {
      EXPECT_EQ(all[2].at[head][t], told[head]);
    }
  }
}

}  // namespace
}  // namespace saca::intention_scoring::predict_test
