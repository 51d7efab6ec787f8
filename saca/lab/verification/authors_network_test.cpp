#include "saca/lab/verification/authors_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/units.h"

namespace saca::verification::authors_network_test {
namespace {

using testing::HasSubstr;

using Arrays = std::map<std::string, NpyArray>;

NpyArray zeros(const std::vector<std::size_t>& shape) {
  std::size_t total = 1;
  for (const std::size_t extent : shape) {
    total *= extent;
  }
  return {shape, std::vector<double>(total, 0.0)};
}

/// One number passes through each hidden layer: value = weight x (input `which`, where above 0).
Arrays passing(std::size_t which, double weight) {
  Arrays arrays{{"MLP_0_Dense_0_kernel", zeros({4, 1})}, {"MLP_0_Dense_0_bias", zeros({1})},
                {"MLP_0_Dense_1_kernel", zeros({1, 1})}, {"MLP_0_Dense_1_bias", zeros({1})},
                {"OutputVDense_kernel", zeros({1, 1})},  {"OutputVDense_bias", zeros({1})}};
  arrays["MLP_0_Dense_0_kernel"].values[which] = 1.0;
  arrays["MLP_0_Dense_1_kernel"].values[0] = 1.0;
  arrays["OutputVDense_kernel"].values[0] = weight;
  return arrays;
}

std::string problem(const Arrays& arrays) {
  const auto network = AuthorsNetwork::from(arrays, "net.npz");
  return network.has_value() ? "" : network.error().message;
}

TEST(AuthorsNetwork, FileOfNumpyGivesNumpysValues) {
  // testdata/make_tiny_network.py wrote the file, and printed these (there in double precision)
  const auto network = read_authors_network("saca/lab/verification/testdata/tiny_network.npz");
  ASSERT_TRUE(network.has_value()) << network.error().message;
  const std::vector<AuthorsState> states{{-25.0, 4.0, from_degrees(20.0), 9.0},
                                         {-50.0, 0.0, 0.0, 0.0},
                                         {0.0, -8.0, from_degrees(-40.0), 18.0},
                                         {10.0, 1.0, from_degrees(90.0), 30.0}};
  const std::vector<double> values = network.value().values(states);
  const std::vector<double> by_numpy{-0.068645089, -0.136143283, 0.021291720, 0.227951713};
  ASSERT_EQ(values.size(), by_numpy.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], by_numpy[i], 2e-6) << i;  // single precision
  }
}

TEST(AuthorsNetwork, ManyStatesGiveWhatEachGivesAlone) {
  const auto network = read_authors_network("saca/lab/verification/testdata/tiny_network.npz");
  ASSERT_TRUE(network.has_value());
  std::vector<AuthorsState> states;
  for (int i = 0; i < 1'000; ++i) {
    states.push_back({-0.05 * i, 0.01 * i, 0.001 * i, 0.02 * i});
  }
  const std::vector<double> values = network.value().values(states);
  ASSERT_EQ(values.size(), states.size());
  for (const std::size_t i : {0U, 255U, 256U, 999U}) {
    EXPECT_NEAR(values[i], network.value().values({&states[i], 1})[0], 2e-6) << i;
  }
  EXPECT_TRUE(network.value().values({}).empty());
}

TEST(AuthorsNetwork, InputsAreScaledAsItsAuthorsDo) {
  const std::vector<AuthorsState> states{{-20.0, -2.0, from_degrees(-10.0), 9.0}};
  const std::vector<double> scaled{30.0 / 50.0, 2.0 / 8.0, 10.0 / 40.0, 9.0 / 18.0};
  for (std::size_t which = 0; which < scaled.size(); ++which) {
    const auto network = AuthorsNetwork::from(passing(which, 10.0), "net.npz");
    ASSERT_TRUE(network.has_value()) << network.error().message;
    EXPECT_NEAR(network.value().values(states)[0], 10.0 * scaled[which], 1e-5) << which;
  }
}

TEST(AuthorsNetwork, HiddenSumsBelowZeroCountAsZeroAndTheLastOneDoesNot) {
  const auto network = AuthorsNetwork::from(passing(0, -10.0), "net.npz");
  ASSERT_TRUE(network.has_value());
  const std::vector<AuthorsState> states{{-100.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}};
  EXPECT_EQ(network.value().values(states)[0], 0.0);  // its scaled x is -1
  EXPECT_EQ(network.value().values(states)[1], -10.0);
}

TEST(AuthorsNetwork, RangeIsWhatItIsScaledFor) {
  EXPECT_TRUE(in_authors_range({-25.0, -8.0, from_degrees(-39.9), 18.0}));
  EXPECT_TRUE(in_authors_range({0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(in_authors_range({0.1, 0.0, 0.0, 5.0}));
  EXPECT_FALSE(in_authors_range({-50.1, 0.0, 0.0, 5.0}));
  EXPECT_FALSE(in_authors_range({-5.0, 8.1, 0.0, 5.0}));
  EXPECT_FALSE(in_authors_range({-5.0, 0.0, from_degrees(41.0), 5.0}));
  EXPECT_FALSE(in_authors_range({-5.0, 0.0, 0.0, 18.1}));
  EXPECT_FALSE(in_authors_range({std::nan(""), 0.0, 0.0, 5.0}));
}

TEST(AuthorsNetwork, OtherArraysAreRefusedByName) {
  Arrays missing = passing(0, 1.0);
  missing.erase("MLP_0_Dense_1_bias");
  EXPECT_THAT(problem(missing), HasSubstr("net.npz: want the array MLP_0_Dense_1_bias"));
  Arrays more = passing(0, 1.0);
  more.emplace("OutputQDense_bias", zeros({1}));
  EXPECT_THAT(problem(more), HasSubstr("net.npz: want 6 arrays, got 7"));
  const std::vector<std::pair<std::pair<std::string, NpyArray>, std::string>> shapes{
      {{"MLP_0_Dense_0_kernel", zeros({3, 1})}, "want 4 x any number, got 3 x 1"},
      {{"MLP_0_Dense_0_kernel", zeros({4})}, "want 4 x any number, got 4"},
      {{"MLP_0_Dense_1_kernel", zeros({2, 1})}, "want 1 x any number, got 2 x 1"},
      {{"OutputVDense_kernel", zeros({1, 2})}, "want 1 x 1, got 1 x 2"},
      {{"OutputVDense_bias", zeros({})}, "want 1, got a single number"}};
  for (const auto& [array, words] : shapes) {
    Arrays arrays = passing(0, 1.0);
    arrays[array.first] = array.second;
    EXPECT_THAT(problem(arrays), HasSubstr("net.npz: " + array.first + ": " + words));
  }
}

TEST(AuthorsNetwork, FileThatIsNotThereIsNamed) {
  const auto network = read_authors_network("no/such/net.npz");
  ASSERT_FALSE(network.has_value());
  EXPECT_THAT(network.error().message, HasSubstr("no/such/net.npz"));
}

}  // namespace
}  // namespace saca::verification::authors_network_test
