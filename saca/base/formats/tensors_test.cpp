#include "saca/base/formats/tensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "saca/base/core/contract.h"

namespace saca::formats::tensors_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A file as the format's description says, put together by hand.
std::string file_of(const std::string& header, const std::vector<float>& numbers) {
  const std::uint64_t size = header.size();
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &size, 8);
  bytes += header;
  for (const float number : numbers) {
    std::string four(4, '\0');
    std::memcpy(four.data(), &number, 4);
    bytes += four;
  }
  return bytes;
}

std::string refusal(const std::string& bytes) {
  const auto found = read_tensors(bytes, "w.safetensors");
  return found.has_value() ? "accepted" : found.error().message;
}

TEST(Tensors, ReadsWhatTheFormatDescribes) {
  const auto found = read_tensors(
      file_of(
          R"({"b":{"dtype":"F32","shape":[],"data_offsets":[8,12]},)"
          R"("a":{"dtype":"F32","shape":[1,2],"data_offsets":[0,8]},"__metadata__":{"k":"v"}}  )",
          {1.0F, 2.0F, 3.0F}),
      "x");
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_THAT(found.value().tensors.at("a").values, ElementsAre(1.0F, 2.0F));
  EXPECT_THAT(found.value().tensors.at("b").values, ElementsAre(3.0F));
  EXPECT_EQ(found.value().words.at("k"), "v");
}

TEST(Tensors, ComeBackAsTheyWereWritten) {
  Tensors tensors;
  tensors.words["data"] = "made for a test";
  tensors.tensors["w"] = {{2, 3}, {0.0F, -1.5F, 3e-39F, 4e30F, 5.0F, 6.0F}};
  tensors.tensors["bias"] = {{2}, {7.0F, 8.0F}};
  const std::string bytes = tensor_bytes(tensors);
  const auto found = read_tensors(bytes, "x");
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_EQ(found.value().words, tensors.words);
  EXPECT_EQ(found.value().tensors.at("w").shape, tensors.tensors.at("w").shape);
  EXPECT_EQ(found.value().tensors.at("w").values, tensors.tensors.at("w").values);
  EXPECT_EQ(tensor_bytes(found.value()), bytes);
}

TEST(Tensors, TakesOnlyTheShapeThatIsWanted) {
  Tensors tensors;
  tensors.tensors["w"] = {{2, 1}, {1.0F, 2.0F}};
  EXPECT_TRUE(take(tensors, "w", {2, 1}, "f").has_value());
  EXPECT_EQ(take(tensors, "w", {1, 2}, "f").error().message,
            "f: tensor w: want a shape of [1, 2], got [2, 1]");
  EXPECT_EQ(take(tensors, "v", {1}, "f").error().message, "f: want a tensor v");
}

TEST(Tensors, TakesALayerWhole) {
  Tensors tensors;
  tensors.tensors["0.weight"] = {{1, 2}, {1.0F, 2.0F}};
  EXPECT_EQ(take_layer(tensors, "0", 1, 2, "f").error().message, "f: want a tensor 0.bias");
  tensors.tensors["0.bias"] = {{1}, {3.0F}};
  const auto taken = take_layer(tensors, "0", 1, 2, "f");
  ASSERT_TRUE(taken.has_value());
  EXPECT_EQ(taken.value().weight, (std::vector{1.0F, 2.0F}));
  EXPECT_EQ(taken.value().bias, std::vector{3.0F});
  EXPECT_EQ(taken.value().rows, 1U);
  EXPECT_EQ(taken.value().columns, 2U);
  EXPECT_EQ(take_layer(tensors, "0", 2, 1, "f").error().message,
            "f: tensor 0.weight: want a shape of [2, 1], got [1, 2]");
}

TEST(Tensors, RefusesWhatIsDamagedOrForeign) {
  EXPECT_THAT(refusal(""), HasSubstr("got one of 0 bytes"));
  EXPECT_THAT(refusal(std::string(100, '\xff')), HasSubstr("header of"));
  EXPECT_THAT(refusal(file_of("[1]", {})), HasSubstr("one JSON object"));
  EXPECT_THAT(refusal(file_of(R"({"a":{"dtype":"F16","shape":[1],"data_offsets":[0,4]}})", {1.0F})),
              HasSubstr("tensor a: want dtype F32"));
  EXPECT_THAT(refusal(file_of(R"({"a":{"dtype":"F32","shape":[0],"data_offsets":[0,4]}})", {1.0F})),
              HasSubstr("want a shape"));
  EXPECT_THAT(refusal(file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,4]}})", {1.0F})),
              HasSubstr("a shape of [2] does not take 4 bytes"));
  EXPECT_THAT(refusal(file_of(
                  R"({"a":{"dtype":"F32","shape":[2147483648,2147483648,4],"data_offsets":[0,4]}})",
                  {1.0F})),
              HasSubstr("does not take 4 bytes"));
  EXPECT_THAT(refusal(file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})", {1.0F})),
              HasSubstr("data_offsets up to 4"));
  EXPECT_THAT(
      refusal(file_of(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[4,8]}})", {1.0F, 2.0F})),
      HasSubstr("want it to begin at 0, got 4"));
  EXPECT_THAT(
      refusal(file_of(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})", {1.0F, 2.0F})),
      HasSubstr("want 4 bytes of numbers, got 8"));
  EXPECT_THAT(refusal(file_of(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})",
                              {std::numeric_limits<float>::quiet_NaN()})),
              HasSubstr("tensor a: want finite numbers"));
  EXPECT_THAT(refusal(file_of(R"({"__metadata__":{"a":1}})", {})), HasSubstr("want texts"));
}

TEST(Tensors, SurvivesAnyCut) {
  Tensors tensors;
  tensors.tensors["w"] = {{2}, {1.0F, 2.0F}};
  const std::string bytes = tensor_bytes(tensors);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(refusal(bytes.substr(0, size)), "accepted") << size;
  }
}

TEST(Tensors, WillNotWriteWhatItCouldNotRead) {
  Tensors tensors;
  tensors.tensors["w"] = {{2}, {1.0F}};
  EXPECT_THROW((void)tensor_bytes(tensors), ContractViolation);
}

}  // namespace
}  // namespace saca::formats::tensors_test
