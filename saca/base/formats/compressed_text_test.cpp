#include "saca/base/formats/compressed_text.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "saca/base/core/file.h"

namespace saca::formats {
namespace {

namespace fs = std::filesystem;

class CompressedText : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        ("saca_gz_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path compressed(const std::string& text) const {
    fs::path file = folder_ / "text.gz";
    gzFile out = gzopen(file.c_str(), "wb9");
    EXPECT_EQ(gzwrite(out, text.data(), static_cast<unsigned>(text.size())),
              static_cast<int>(text.size()));
    EXPECT_EQ(gzclose(out), Z_OK);
    return file;
  }

  fs::path folder_;
};

TEST_F(CompressedText, IsReadToTheLastByte) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) {
    text += std::to_string(i * i % 7919) + '\n';
  }
  const auto read = read_compressed(compressed(text), text.size());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read.value(), text);
}

TEST_F(CompressedText, PlainTextIsReadAsItIs) {
  const fs::path file = folder_ / "plain.jsonl";
  ASSERT_FALSE(write_file(file, "{}\n"));
  const auto read = read_compressed(file, 100);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read.value(), "{}\n");
}

TEST_F(CompressedText, MoreThanIsWantedIsRefused) {
  const auto read = read_compressed(compressed(std::string(1'000'000, 'a')), 999'999);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, Error::Code::malformed);
  EXPECT_NE(read.error().message.find("at most 999999 bytes"), std::string::npos);
}

TEST_F(CompressedText, EndingTooSoonIsDamage) {
  const fs::path file = compressed(std::string(10'000, 'a') + "b");
  fs::resize_file(file, fs::file_size(file) - 9);
  const auto read = read_compressed(file, 100'000);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, Error::Code::malformed);
  EXPECT_NE(read.error().message.find("text.gz: is damaged"), std::string::npos);
}

TEST_F(CompressedText, AFlippedByteIsDamage) {
  const fs::path file = compressed("what was met before, what was met before");
  std::string bytes = read_file(file, 1'000).value();
  bytes[bytes.size() - 6] = static_cast<char>(bytes[bytes.size() - 6] ^ 1);  // of the checksum
  ASSERT_FALSE(write_file(file, bytes));
  const auto read = read_compressed(file, 100'000);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, Error::Code::malformed);
}

TEST_F(CompressedText, BytesAfterTheEndAreDamage) {
  const fs::path file = compressed("text");
  ASSERT_FALSE(write_file(file, read_file(file).value() + "more"));
  const auto read = read_compressed(file, 100'000);
  ASSERT_FALSE(read.has_value());
  EXPECT_NE(read.error().message.find("goes on after its end"), std::string::npos);
}

TEST_F(CompressedText, WhatIsNotThereIsTold) {
  for (const fs::path& file : {folder_ / "none.gz", folder_}) {
    const auto read = read_compressed(file, 100);
    ASSERT_FALSE(read.has_value());
    EXPECT_EQ(read.error().code, Error::Code::unreadable);
    EXPECT_NE(read.error().message.find(file.string()), std::string::npos);
  }
}

}  // namespace
}  // namespace saca::formats
