#include "saca/lab/model_access/local_choice.h"

#include <gtest/gtest.h>

#include <string>

#include "saca/base/core/file.h"

namespace saca::model_access::local_choice_test {
namespace {

namespace fs = std::filesystem;

class AChoice : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(testing::TempDir()) / "local_choice_test";
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    ASSERT_EQ(write_file(folder_ / "a.gguf", "weights"), std::nullopt);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] LocalChoice read(const std::string& text) const {
    EXPECT_EQ(write_file(folder_ / "choice.json", text), std::nullopt);
    return local_choice(folder_ / "choice.json");
  }
};

TEST_F(AChoice, NamesWeightsBesideIt) {
  const LocalChoice plain = read(R"({"weights": "a.gguf", "processor": "x"})");
  EXPECT_EQ(plain.weights, folder_ / "a.gguf");
  EXPECT_FALSE(plain.flash_attention);
  EXPECT_TRUE(read(R"({"weights": "a.gguf", "flash_attention": true})").flash_attention);
}

TEST_F(AChoice, IsNoneWhereWeightsOrFileCannotBeUsed) {
  EXPECT_FALSE(local_choice(folder_ / "nothing.json").weights.has_value());
  EXPECT_FALSE(read(R"({"weights": "b.gguf"})").weights.has_value());
  EXPECT_FALSE(read(R"({"weights": 4})").weights.has_value());
  EXPECT_FALSE(read(R"(["a.gguf"])").weights.has_value());
  EXPECT_FALSE(read("{").weights.has_value());
  EXPECT_FALSE(read(R"({"flash_attention": 1})").flash_attention);
}

}  // namespace
}  // namespace saca::model_access::local_choice_test
