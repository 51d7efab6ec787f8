#include "saca/base/formats/hdf5_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <fstream>
#include <numeric>

#include "saca/base/core/contract.h"

namespace saca::formats::hdf5_writer_test {
namespace {

using Extents = std::vector<std::size_t>;
using testing::ElementsAre;

std::vector<float> counted(std::size_t size) {
  std::vector<float> values(size);
  std::iota(values.begin(), values.end(), 0.0F);
  return values;
}

/// What the library itself makes of the bytes, as a file.
class Hdf5WriterTest : public testing::Test {
 protected:
  void reopen(Hdf5Writer& writer) {
    std::ofstream(path_, std::ios::binary) << writer.bytes().value();
    file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    ASSERT_GE(file_, 0);
  }
  ~Hdf5WriterTest() override {
    if (file_ >= 0) {
      H5Fclose(file_);
    }
  }
  template <class Value>
  Value attribute(const char* object, const char* name, hid_t type) const {
    const hid_t found = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT);
    Value value{};
    EXPECT_GE(H5Aread(found, type, &value), 0) << name;
    H5Aclose(found);
    return value;
  }
  template <class Value>
  std::vector<Value> numbers(const char* name, hid_t type, std::size_t size) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT);
    std::vector<Value> values(size);
    EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    H5Dclose(set);
    return values;
  }

  std::string path_ = testing::TempDir() + "hdf5_writer_test_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
  hid_t file_ = H5I_INVALID_HID;
};

TEST_F(Hdf5WriterTest, OthersFindAttributesOfTheFileAndOfItsGroups) {
  {
    Hdf5Writer writer;
    writer.group("axis");
    writer.attribute(".", "version", std::int32_t{-7});
    writer.attribute("axis", "first", 0.1);
    writer.attribute("axis", "name", std::string("course"));
    reopen(writer);
  }
  EXPECT_EQ(attribute<std::int32_t>(".", "version", H5T_NATIVE_INT32), -7);
  EXPECT_EQ(attribute<double>("axis", "first", H5T_NATIVE_DOUBLE), 0.1);
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, 7);
  H5Tset_cset(text, H5T_CSET_UTF8);
  using Seven = std::array<char, 7>;
  EXPECT_EQ((attribute<Seven>("axis", "name", text)), (Seven{'c', 'o', 'u', 'r', 's', 'e', '\0'}));
  H5Tclose(text);
}

TEST_F(Hdf5WriterTest, PartsLieOneAfterAnotherAlongTheFirstAxis) {
  const std::vector<float> values = counted(6);
  const std::vector<double> doubles{0.1, 0.2};
  {
    Hdf5Writer writer;
    writer.numbers<float>("swapped", Extents{2, 3}, {values.data() + 3, values.data()});
    writer.numbers<double>("doubles", Extents{2}, {doubles.data()});
    reopen(writer);
  }
  EXPECT_THAT(numbers<float>("swapped", H5T_NATIVE_FLOAT, 6), ElementsAre(3, 4, 5, 0, 1, 2));
  EXPECT_EQ(numbers<double>("doubles", H5T_NATIVE_DOUBLE, 2), doubles);
}

TEST_F(Hdf5WriterTest, CompressesWhatFillsSeveralChunks) {
  const Extents extents{40, 30, 70, 5};
  const std::vector<float> values = counted(420'000);
  {
    Hdf5Writer writer;
    writer.numbers<float>("values", extents, {values.data()});
    ASSERT_LT(writer.bytes().value().size(), values.size() * sizeof(float) / 2);
    reopen(writer);
  }
  EXPECT_EQ(numbers<float>("values", H5T_NATIVE_FLOAT, values.size()), values);
}

// Else the same values, a second later, make another file.
TEST_F(Hdf5WriterTest, NotesNoTimeOfWriting) {
  const std::vector<float> values = counted(6);
  {
    Hdf5Writer writer;
    writer.group("group");
    writer.text("text", "words");
    writer.numbers<float>("numbers", Extents{6}, {values.data()});
    reopen(writer);
  }
  for (const char* const name : {"group", "text", "numbers"}) {
    H5O_info_t about{};
    ASSERT_GE(H5Oget_info_by_name2(file_, name, &about, H5O_INFO_TIME, H5P_DEFAULT), 0) << name;
    EXPECT_EQ(about.mtime, 0) << name;
  }
}

TEST(Hdf5Writer, HasNoBytesAfterWhatCannotBe) {
  Hdf5Writer writer;
  EXPECT_TRUE(writer.bytes());
  writer.attribute("nowhere", "first", 1.0);
  EXPECT_FALSE(writer.bytes());
  writer.group("somewhere");
  EXPECT_FALSE(writer.bytes());
}

TEST(Hdf5Writer, RefusesPartsThatDoNotMakeTheWhole) {
  const float value = 1.0F;
  Hdf5Writer writer;
  EXPECT_THROW(writer.numbers<float>("a", Extents{3}, {&value, &value}), ContractViolation);
  EXPECT_THROW(writer.numbers<float>("a", Extents{3}, {}), ContractViolation);
  EXPECT_THROW(writer.numbers<float>("a", Extents{}, {&value}), ContractViolation);
}

}  // namespace
}  // namespace saca::formats::hdf5_writer_test
