#include "saca/thinking/intent/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <type_traits>

#include "saca/base/core/file.h"
#include "saca/thinking/intent/network_for_test.h"

namespace saca::intent::model_test {
namespace {

using testing::HasSubstr;

static_assert(std::is_trivially_copyable_v<Stream>);

/// The same numbers for each horizon.
formats::Tensor symmetric(std::array<float, num_classes> numbers) {
  formats::Tensor tensor{{num_horizons, num_classes}, {}};
  for (std::size_t h = 0; h < num_horizons; ++h) {
    tensor.values.insert(tensor.values.end(), numbers.begin(), numbers.end());
  }
  return tensor;
}

formats::Tensors random_tensors(std::uint32_t seed, int num_networks) {
  formats::Tensors tensors;
  for (int i = 0; i < num_networks; ++i) {
    add_random_network(tensors, std::to_string(i) + ".", seed + static_cast<std::uint32_t>(i));
  }
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0.0F, 1.0F);
  formats::Tensor start{{num_horizons, num_classes}, {}};
  formats::Tensor transition{{num_horizons, num_classes, num_classes}, {}};
  start.values.resize(num_horizons * num_classes);
  transition.values.resize(num_horizons * num_classes * num_classes);
  for (auto* each : {&start.values, &transition.values}) {
    for (float& x : *each) {
      x = normal(random);
    }
  }
  tensors.tensors["networks"] = {{1}, {static_cast<float>(num_networks)}};
  tensors.tensors["chain.start"] = start;
  tensors.tensors["chain.transition"] = transition;
  tensors.tensors["sharpness"] = {{num_horizons}, {1.0F, 0.8F, 0.6F}};
  tensors.tensors["bias"] = symmetric({0.0F, -0.5F, -0.5F, 0.3F, 0.1F, 0.1F});
  tensors.tensors["naming"] = symmetric({1.0F, 2.0F, 2.0F, 0.7F, 1.4F, 1.4F});
  return tensors;
}

std::vector<Observation> random_drive(std::uint32_t seed, std::size_t num) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<Observation> drive(num);
  for (Observation& each : drive) {
    each = {.speed = 20.0 + normal(random),
            .acceleration = normal(random),
            .yaw_rate = 0.1 * normal(random),
            .offset = normal(random),
            .lateral_speed = normal(random),
            .heading = 0.05 * normal(random),
            .lane_width = 3.5,
            .gap = 30.0 + 10.0 * normal(random),
            .gap_speed = normal(random)};
  }
  return drive;
}

TEST(Stream, TellsTheSharpenedMarginalOfTheMeanEmissionsSoFar) {
  const formats::Tensors tensors = random_tensors(5, 2);
  const auto model = model_from(tensors, "w");
  ASSERT_TRUE(model.has_value()) << model.error().message;
  Stream stream;
  ObservationHistory memory;
  std::array<Network::State, 2> states;
  std::array<std::vector<Scores>, num_horizons> emissions;
  for (const Observation& seen : random_drive(1, 25)) {
    const HorizonScores told = stream.step(model.value(), seen);
    memory.add(seen);
    const Emissions a = model.value().networks[0].step(memory.features(), states[0]);
    const Emissions b = model.value().networks[1].step(memory.features(), states[1]);
    for (std::size_t h = 0; h < num_horizons; ++h) {
      Scores mean;
      for (std::size_t k = 0; k < num_classes; ++k) {
        mean[k] = 0.5 * (a[h][k] + b[h][k]);
      }
      emissions[h].push_back(mean);
      const Scores expected = marginals(model.value().chains[h], emissions[h]).back();
      const double power = static_cast<double>(tensors.tensors.at("sharpness").values[h]);
      const std::vector<float>& bias = tensors.tensors.at("bias").values;
      Scores honest;
      for (std::size_t k = 0; k < num_classes; ++k) {
        honest[k] = std::pow(expected[k], power) * std::exp(static_cast<double>(bias[k]));
      }
      const double sum = std::accumulate(honest.begin(), honest.end(), 0.0);
      for (std::size_t k = 0; k < num_classes; ++k) {
        EXPECT_NEAR(told[h][k], honest[k] / sum, 1e-9);
      }
    }
  }
}

TEST(Stream, IsADistributionWhateverIsSeen) {
  const auto model = model_from(random_tensors(9, 1), "w");
  ASSERT_TRUE(model.has_value());
  std::mt19937 random(4);
  std::cauchy_distribution<double> wild(0.0, 50.0);
  std::bernoulli_distribution known(0.5);
  Stream stream;
  for (int i = 0; i < 300; ++i) {
    const auto some = [&] { return known(random) ? wild(random) : not_known; };
    const HorizonScores told = stream.step(model.value(), {.speed = std::abs(wild(random)),
                                                           .acceleration = wild(random),
                                                           .offset = some(),
                                                           .lateral_speed = wild(random),
                                                           .heading = wild(random),
                                                           .lane_width = 3.5,
                                                           .gap = some(),
                                                           .gap_speed = wild(random)});
    for (const Scores& each : told) {
      double sum = 0.0;
      for (const double p : each) {
        EXPECT_GE(p, 0.0);
        sum += p;
      }
      EXPECT_NEAR(sum, 1.0, 1e-9);
    }
  }
}

TEST(Stream, OfAMirroredDriveTellsTheMirrorImage) {
  // Only of chains that are symmetric themselves.
  formats::Tensors tensors = random_tensors(6, 1);
  for (float& each : tensors.tensors["chain.start"].values) {
    each = 0.0F;
  }
  for (float& each : tensors.tensors["chain.transition"].values) {
    each = 0.3F;
  }
  const auto model = model_from(tensors, "w");
  ASSERT_TRUE(model.has_value());
  Stream here;
  Stream there;
  for (Observation seen : random_drive(8, 30)) {
    const HorizonScores told = here.step(model.value(), seen);
    for (double* each : {&seen.yaw_rate, &seen.offset, &seen.lateral_speed, &seen.heading}) {
      *each = -*each;
    }
    const HorizonScores other = there.step(model.value(), seen);
    for (std::size_t h = 0; h < num_horizons; ++h) {
      const Scores expected = mirrored(told[h]);
      for (std::size_t k = 0; k < num_classes; ++k) {
        EXPECT_NEAR(other[h][k], expected[k], 1e-12);
      }
    }
  }
}

TEST(NamedClass, IsThatOfTheGreatestProduct) {
  EXPECT_EQ(named_class({1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, {0.1, 0.3, 0.1, 0.3, 0.1, 0.1}), 1U);
  EXPECT_EQ(named_class({1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, {0.5, 0.3, 0.0, 0.2, 0.0, 0.0}), 0U);
  EXPECT_EQ(named_class({1.0, 1.5, 1.5, 3.0, 1.0, 1.0}, {0.5, 0.3, 0.0, 0.2, 0.0, 0.0}), 3U);
}

TEST(Model, NobodyChangesSidesAtOnce) {
  const auto model = model_from(random_tensors(2, 1), "w");
  ASSERT_TRUE(model.has_value());
  for (const Crf& chain : model.value().chains) {
    for (const auto& [from, to] :
         {std::pair(4, 5), std::pair(5, 4), std::pair(1, 2), std::pair(2, 4), std::pair(1, 5)}) {
      EXPECT_EQ(chain.transition[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)],
                forbidden);
    }
    EXPECT_GT(chain.transition[4][1], forbidden);
    EXPECT_GT(chain.transition[4][3], forbidden);
  }
}

TEST(Model, WeightsThatDifferInOnePlaceHaveAnotherDigest) {
  const formats::Tensors tensors = random_tensors(3, 2);
  const std::uint64_t whole = digest(model_from(tensors, "w").value());
  EXPECT_EQ(digest(model_from(tensors, "w").value()), whole);
  for (const auto& [name, tensor] : tensors.tensors) {
    if (name == "networks") {
      continue;
    }
    formats::Tensors other = tensors;
    float& last = other.tensors[name].values.back();
    last = std::nextafter(last, 0.0F);
    EXPECT_NE(digest(model_from(other, "w").value()), whole) << name;
  }
}

TEST(Model, RefusesFilesThatAreNone) {
  formats::Tensors tensors = random_tensors(1, 1);
  tensors.tensors["networks"].values = {5.0F};
  EXPECT_THAT(model_from(tensors, "f").error().message, HasSubstr("want 1 to 4, got 5"));
  tensors.tensors["networks"].values = {2.0F};
  EXPECT_THAT(model_from(tensors, "f").error().message, HasSubstr("want a tensor 1.input.weight"));
  tensors = random_tensors(1, 1);
  tensors.tensors["sharpness"].values[1] = 0.0F;
  EXPECT_THAT(model_from(tensors, "f").error().message, HasSubstr("sharpness: want > 0, got 0"));
  tensors = random_tensors(1, 1);
  tensors.tensors["naming"].values[4] = 0.0F;
  EXPECT_THAT(model_from(tensors, "f").error().message, HasSubstr("naming: want > 0, got 0"));
  tensors.tensors.erase("chain.start");
  EXPECT_THAT(model_from(tensors, "f").error().message, HasSubstr("want a tensor chain.start"));
  EXPECT_THAT(read_model("no/such/file").error().message, HasSubstr("no/such/file"));
}

}  // namespace
}  // namespace saca::intent::model_test
