#include "saca/lab/network_training/place_mixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "saca/base/core/file.h"
#include "saca/base/formats/tensors.h"

namespace saca::network_training::place_mixture_test {
namespace {

namespace fs = std::filesystem;
using eval::MixtureModel;
using eval::PlaceExample;

const auto every_epoch = [](const Epoch&) { return true; };

/// Goes on at its speed; who has a lateral speed (feature) to the left ends 3 m to the left after
/// 3 s with 80 %, else where it is; the mirror likewise.
std::vector<std::vector<PlaceExample>> changing_lanes(int count, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> any;
  std::normal_distribution<double> normal;
  std::vector<std::vector<PlaceExample>> all;
  for (int i = 0; i < count; ++i) {
    const double side = any(rng) < 0.5 ? 1.0 : -1.0;
    const double ends = any(rng) < 0.8 ? 3.0 * side : 0.0;
    std::vector<PlaceExample> sequence(8);
    for (PlaceExample& one : sequence) {
      one.features[static_cast<std::size_t>(intent::Feature::lateral_speed)] =
          static_cast<float>(side);
      one.speed = 12.0;
      one.known = true;
      for (std::size_t k = 0; k < one.places.size(); ++k) {
        const double t = eval::forecast_times[k];
        one.places[k] = {12.0 * t + 0.2 * normal(rng), ends * t / 3.0 + 0.2 * normal(rng)};
      }
    }
    all.push_back(sequence);
  }
  return all;
}

Schedule quick() {
  return {.seed = 3, .epochs = 30, .batch = 120, .step = 1e-2};
}

std::string bytes_of(const PlaceMixture& network) {
  return formats::tensor_bytes(network->tensors());
}

// What the product computes from the weights is what was trained, and the loss is the score that
// forecasts are held against.
TEST(PlaceMixture, IsTheModelThatForetells) {
  torch::manual_seed(5);
  PlaceMixture network(0.0);
  network->eval();
  const auto model = MixtureModel::from(network->tensors(), "w");
  ASSERT_TRUE(model.has_value()) << model.error().message;
  const auto sequences = changing_lanes(1, 2);
  const auto pieces = place_pieces(sequences, 100);
  const Batch batch = batch_of(std::vector<const Piece*>{&pieces[0]});
  const torch::Tensor nll = mixture_nll(network->outputs(batch.features), batch.labels);
  intent::Encoder::State state;
  double sum = 0.0;
  for (std::size_t i = 0; i < sequences[0].size(); ++i) {
    const PlaceExample& one = sequences[0][i];
    const auto outputs = model.value().step(one.features, state);
    const eval::LikelyPlaces places = eval::places_of(outputs, one.speed, {});
    for (std::size_t k = 0; k < one.places.size(); ++k) {
      const double score = eval::score(places[k], one.places[k]).nll;
      const auto trained = nll[0][static_cast<std::int64_t>(i)][static_cast<std::int64_t>(k)];
      EXPECT_NEAR(trained.item<double>(), score, 1e-3 * (1.0 + std::abs(score)));
      sum += score;
    }
  }
  EXPECT_NEAR(network->loss(batch).item<double>(), sum / (8.0 * 4.0), 1e-2 * std::abs(sum));
}

// Two ways on, each known but for 0.2 m: the least mean negative logarithm is the entropy of the
// normal law, ln(2 pi e 0.04), and where the two lie apart that of the choice besides.
TEST(PlaceMixture, LearnsBothWaysAndTheirShares) {
  const auto pieces = place_pieces(changing_lanes(60, 1), 100);
  const auto others = place_pieces(changing_lanes(60, 2), 100);
  std::vector<Epoch> curve;
  const auto network = trained_mixture(pieces, others, quick(), 0.0, {}, [&](const Epoch& epoch) {
    curve.push_back(epoch);
    return true;
  });
  ASSERT_TRUE(network.has_value());
  const double entropy = std::log(2.0 * std::numbers::pi * std::numbers::e * 0.04);
  const double choice = -0.8 * std::log(0.8) - 0.2 * std::log(0.2);
  EXPECT_GT(*curve.back().held_out, entropy);
  EXPECT_LT(*curve.back().held_out, entropy + choice + 0.3);
  const auto model = MixtureModel::from(network.value()->tensors(), "w").value();
  for (const double side : {1.0, -1.0}) {
    intent::Encoder::State state;
    intent::Features features{};
    features[static_cast<std::size_t>(intent::Feature::lateral_speed)] = static_cast<float>(side);
    const auto places = eval::places_of(model.step(features, state), 12.0, {});
    double on_its_side = 0.0;
    for (const eval::LikelyPlace& one : places.back()) {
      on_its_side += side * one.p_W.y > 1.5 ? one.probability : 0.0;
    }
    EXPECT_NEAR(on_its_side, 0.8, 0.1);
  }
}

TEST(PlaceMixture, IsTheSameBytesWhetherStoppedOrNot) {
  const auto pieces = place_pieces(changing_lanes(20, 1), 100);
  Schedule schedule = quick();
  schedule.epochs = 4;
  const auto straight = trained_mixture(pieces, {}, schedule, 0.1, {}, every_epoch);
  const fs::path state = fs::path(testing::TempDir()) / "saca_places_state.pt";
  fs::remove(state);
  ASSERT_TRUE(trained_mixture(pieces, {}, schedule, 0.1, state, [](const Epoch& epoch) {
                return epoch.number < 2;
              }).has_value());
  const auto resumed = trained_mixture(pieces, {}, schedule, 0.1, state, every_epoch);
  ASSERT_TRUE(resumed.has_value()) << resumed.error().message;
  EXPECT_EQ(bytes_of(resumed.value()), bytes_of(straight.value()));
  EXPECT_FALSE(trained_mixture(pieces, {}, schedule, 0.2, state, every_epoch).has_value());
}

TEST(PlacePieces, AreCutAndKeepWhatIsKnown) {
  std::vector<PlaceExample> sequence(25);
  for (std::size_t t = 0; t < 20; ++t) {
    sequence[t].known = t >= 10;
    sequence[t].speed = static_cast<double>(t);
    sequence[t].places[3] = {30.0, -2.0};
  }
  const auto pieces = place_pieces({sequence}, 10);
  ASSERT_EQ(pieces.size(), 1U);  // 10 to 19; elsewhere nothing is known
  EXPECT_EQ(pieces[0].labels[3][0].item<double>(), 13.0);
  EXPECT_EQ(pieces[0].labels[0][7].item<double>(), 30.0);
  EXPECT_EQ(pieces[0].labels[0][8].item<double>(), -2.0);
  EXPECT_TRUE(pieces[0].known.all().item<bool>());
}

}  // namespace
}  // namespace saca::network_training::place_mixture_test
