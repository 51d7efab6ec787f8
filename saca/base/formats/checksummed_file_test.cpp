#include "saca/base/formats/checksummed_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"

namespace saca::formats::checksummed_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A file of its own in the test's folder.
class ChecksummedFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::path(::testing::TempDir()) / (std::string("sealed_") + test->name());
  }
  void TearDown() override { fs::remove(path_); }

  [[nodiscard]] std::string bytes() const { return read_file(path_).value(); }
  void put(const std::string& text) const { ASSERT_EQ(write_file(path_, text), std::nullopt); }
  [[nodiscard]] std::string refusal() const {
    const auto problem = verify_checksum(path_, "saca.thing/2");
    return problem ? problem->message : "";
  }

  fs::path path_;
};

TEST_F(ChecksummedFile, IsWholeAsWritten) {
  ASSERT_EQ(write_checksummed(path_, "saca.thing/2", "body"), std::nullopt);
  EXPECT_EQ(verify_checksum(path_, "saca.thing/2"), std::nullopt);
  EXPECT_EQ(bytes().size(), 512U + 4U);
  // FNV-1a of "a", published: af63dc4c8601ec8c.
  ASSERT_EQ(write_checksummed(path_, "saca.thing/2", "a"), std::nullopt);
  EXPECT_EQ(bytes().substr(0, 46),
            "saca.thing/2\nbytes 1\nfnv1a af63dc4c8601ec8c\n" + std::string(2, '\0'));
}

TEST_F(ChecksummedFile, MayHaveAnEmptyBody) {
  ASSERT_EQ(write_checksummed(path_, "saca.thing/2", ""), std::nullopt);
  EXPECT_EQ(verify_checksum(path_, "saca.thing/2"), std::nullopt);
}

TEST_F(ChecksummedFile, TellsDamageAtEveryByte) {
  ASSERT_EQ(write_checksummed(path_, "saca.thing/2", "some body"), std::nullopt);
  const std::string whole = bytes();
  for (std::size_t i = 0; i < whole.size(); i += i < 60 || i > 500 ? 1 : 40) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    put(damaged);
    EXPECT_NE(refusal(), "") << i;
  }
}

TEST_F(ChecksummedFile, TellsWhereItIsCutOff) {
  ASSERT_EQ(write_checksummed(path_, "saca.thing/2", "some body"), std::nullopt);
  const std::string whole = bytes();
  for (const std::size_t size : {13U, 100U, 511U, 512U, 520U}) {
    put(whole.substr(0, size));
    EXPECT_THAT(refusal(), HasSubstr("cut off or damaged")) << size;
  }
  put(whole + "x");
  EXPECT_THAT(refusal(), HasSubstr("cut off or damaged"));
}

TEST_F(ChecksummedFile, TellsOtherVersionsAndKinds) {
  ASSERT_EQ(write_checksummed(path_, "saca.thing/3", "some body"), std::nullopt);
  EXPECT_THAT(refusal(), HasSubstr("want a file of saca.thing/2, got saca.thing/3"));
  ASSERT_EQ(write_checksummed(path_, "saca.other/2", "some body"), std::nullopt);
  EXPECT_THAT(refusal(), HasSubstr("got something else"));
  put("");
  EXPECT_THAT(refusal(), HasSubstr("an empty file"));
  put("\x89HDF\r\n\x1a\n and more");
  EXPECT_THAT(refusal(), HasSubstr("HDF5 of another kind"));
}

TEST_F(ChecksummedFile, NamesAFileThatIsNotThere) {
  EXPECT_THAT(refusal(), HasSubstr(path_.string()));
  EXPECT_EQ(verify_checksum(path_, "saca.thing/2")->code, Error::Code::unreadable);
}

TEST_F(ChecksummedFile, RefusesAFormatWithoutAVersion) {
  EXPECT_THROW((void)write_checksummed(path_, "thing", "body"), ContractViolation);
  EXPECT_THROW((void)verify_checksum(path_, "thing"), ContractViolation);
}

}  // namespace
}  // namespace saca::formats::checksummed_file_test
