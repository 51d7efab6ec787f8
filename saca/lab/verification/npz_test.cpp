#include "saca/lab/verification/npz.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "saca/base/core/file.h"

namespace saca::verification::npz_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class Real>
std::string bytes_of(const std::vector<Real>& values) {
  std::string bytes(values.size() * sizeof(Real), '\0');
  if (!values.empty()) {
    std::memcpy(bytes.data(), values.data(), bytes.size());
  }
  return bytes;
}

/// After the description of the format: magic, version, length of the header, header, numbers.
std::string npy(const std::string& header, const std::string& data, int version = 1) {
  std::string all = "\x93NUMPY";
  all += static_cast<char>(version);
  all += '\0';
  for (int byte = 0; byte < (version == 1 ? 2 : 4); ++byte) {
    all += static_cast<char>(header.size() >> (8U * static_cast<unsigned>(byte)) & 0xFFU);
  }
  return all + header + data;
}

std::string dictionary(const std::string& type, const std::string& order,
                       const std::string& shape) {
  return fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}   \n", type, order,
                     shape);
}

const std::vector<float> six{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.5F};

class Npz : public testing::Test {
 protected:
  void add(const std::string& name, const std::string& bytes, zip_int32_t method = ZIP_CM_STORE) {
    contents_.emplace_back(std::make_pair(name, bytes));
    methods_.push_back(method);
  }
  std::string written() {
    int problem = 0;
    zip_t* const archive = zip_open(path_.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &problem);
    for (std::size_t i = 0; i < contents_.size(); ++i) {
      const auto& [name, bytes] = contents_[i];
      zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
      const zip_int64_t index = zip_file_add(archive, name.c_str(), source, 0);
      zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), methods_[i], 0);
    }
    EXPECT_EQ(zip_close(archive), 0);
    return path_;
  }
  std::string problem() const {
    const auto read = read_npz(path_);
    return read.has_value() ? "" : read.error().message;
  }

  std::string path_ = testing::TempDir() + "npz_test_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".npz";

 private:
  std::vector<std::pair<std::string, std::string>> contents_;
  std::vector<zip_int32_t> methods_;
};

TEST(Npy, RowsComeOneAfterTheOther) {
  for (const int version : {1, 2, 3}) {
    const auto array =
        parse_npy(npy(dictionary("<f4", "False", "(2, 3)"), bytes_of(six), version), "x");
    ASSERT_TRUE(array.has_value()) << array.error().message;
    EXPECT_THAT(array.value().shape, ElementsAre(2U, 3U));
    EXPECT_THAT(array.value().values, ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.5));
  }
}

TEST(Npy, ColumnsAreTurnedIntoRows) {  // the first index runs fastest in the file
  const auto array = parse_npy(npy(dictionary("<f4", "True", "(2, 3)"), bytes_of(six)), "x");
  ASSERT_TRUE(array.has_value()) << array.error().message;
  EXPECT_THAT(array.value().values, ElementsAre(1.0, 3.0, 5.0, 2.0, 4.0, 6.5));
}

TEST(Npy, DoublesVectorsAndSingleNumbersAreRead) {
  const std::vector<double> values{1e-300, -7.0};
  const auto vector = parse_npy(npy(dictionary("<f8", "False", "(2,)"), bytes_of(values)), "x");
  ASSERT_TRUE(vector.has_value()) << vector.error().message;
  EXPECT_EQ(vector.value().values, values);
  const auto one = parse_npy(npy(dictionary("<f8", "False", "()"), bytes_of<double>({3.0})), "x");
  ASSERT_TRUE(one.has_value()) << one.error().message;
  EXPECT_TRUE(one.value().shape.empty());
  EXPECT_THAT(one.value().values, ElementsAre(3.0));
}

TEST(Npy, WhatIsNotOfTheFormatIsRefusedByName) {
  const std::string data = bytes_of(six);
  const std::string good = dictionary("<f4", "False", "(2, 3)");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "want a .npy file"},
      {"PK\x03\x04 and more", "want a .npy file"},
      {npy(good, data, 4), "version 1.0 to 3.0"},
      {npy(good, data).substr(0, 9), "ends within its header"},
      {npy(good, data).substr(0, 40), "ends within its header"},
      {npy(good, data.substr(1)), "want 6 numbers of 4 bytes, got 23 bytes"},
      {npy(good, data + "!"), "got 25 bytes"},
      {npy(dictionary(">f4", "False", "(2, 3)"), data), "got '>f4'"},
      {npy(dictionary("|O", "False", "(2, 3)"), data), "got '|O'"},
      {npy(dictionary("<f4", "Maybe", "(2, 3)"), data), "fortran_order"},
      {npy(dictionary("<f4", "False", "(2, -3)"), data), "shape"},
      {npy(dictionary("<f4", "False", "(6)"), data), "shape"},
      {npy(dictionary("<f4", "False", "(99999999999999999999999, 3)"), data), "shape"},
      {npy(dictionary("<f4", "False", "(4294967296, 4294967296)"), data), "want fewer numbers"},
      {npy("{'descr': '<f4', 'shape': (2, 3)}", data), "descr, fortran_order and shape"},
      {npy("{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (2, 3)}", data),
       "descr, fortran_order and shape"},
      {npy(good.substr(0, 20), data), "descr, fortran_order and shape"},
      {npy(good + "x", data), "descr, fortran_order and shape"},
      {npy(dictionary("<f4", "False", "(1,)"), bytes_of<float>({nan})), "finite"},
  };
  for (const auto& [bytes, words] : cases) {
    const auto array = parse_npy(bytes, "net.npz: 'w.npy'");
    ASSERT_FALSE(array.has_value()) << words;
    EXPECT_EQ(array.error().code, Error::Code::malformed);
    EXPECT_THAT(array.error().message, HasSubstr(words));
    EXPECT_THAT(array.error().message, testing::StartsWith("net.npz: 'w.npy': "));
  }
}

TEST_F(Npz, StoredAndPackedEntriesAreRead) {
  add("kernel.npy", npy(dictionary("<f4", "False", "(2, 3)"), bytes_of(six)));
  add("bias.npy", npy(dictionary("<f4", "False", "(6,)"), bytes_of(six)), ZIP_CM_DEFLATE);
  const auto arrays = read_npz(written());
  ASSERT_TRUE(arrays.has_value()) << arrays.error().message;
  ASSERT_EQ(arrays.value().size(), 2U);
  EXPECT_THAT(arrays.value().at("kernel").shape, ElementsAre(2U, 3U));
  EXPECT_THAT(arrays.value().at("bias").values, ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.5));
}

TEST_F(Npz, BadEntryIsNamedWithItsFile) {
  add("kernel.npy", "no array");
  written();
  EXPECT_THAT(problem(), HasSubstr(path_ + ": 'kernel.npy': want a .npy file"));
}

TEST_F(Npz, OtherEntriesAreRefused) {
  add("readme.txt", "hello");
  written();
  EXPECT_THAT(problem(), HasSubstr("want entries that end in .npy, got 'readme.txt'"));
}

TEST_F(Npz, NoFileAndNoZipAreRefused) {
  path_ += ".missing";
  EXPECT_THAT(problem(), HasSubstr(path_));
  path_ = testing::TempDir() + "npz_test_text.npz";
  ASSERT_FALSE(write_file(path_, "this is no zip file").has_value());
  EXPECT_THAT(problem(), HasSubstr("want an .npz (zip) file"));
  ASSERT_FALSE(write_file(path_, "").has_value());
  EXPECT_THAT(problem(), HasSubstr(path_));
}

TEST_F(Npz, CutOrChangedFilesAreRefusedOrReadWhole) {  // never a crash
  add("a.npy", npy(dictionary("<f4", "False", "(2, 3)"), bytes_of(six)), ZIP_CM_DEFLATE);
  add("b.npy", npy(dictionary("<f4", "False", "(6,)"), bytes_of(six)));
  const auto read = read_file(written());
  ASSERT_TRUE(read.has_value());
  const std::string& whole = read.value();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_FALSE(parse_npz(whole.substr(0, length), "x").has_value()) << length;
  }
  for (std::size_t place = 0; place < whole.size(); ++place) {
    std::string changed = whole;
    changed[place] = static_cast<char>(~changed[place]);
    const auto arrays = parse_npz(changed, "x");
    if (arrays.has_value() && arrays.value().count("b") == 1) {  // the sum guards the numbers
      EXPECT_THAT(arrays.value().at("b").values, ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.5));
    }
  }
}

}  // namespace
}  // namespace saca::verification::npz_test
