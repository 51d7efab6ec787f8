#include "saca/base/formats/hdf5_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <fstream>
#include <functional>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/formats/hdf5_writer.h"

namespace saca::formats::hdf5_reader_test {
namespace {

using Extents = std::vector<std::size_t>;
using testing::ElementsAre;

const std::vector<float> six{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.5F};

class Hdf5ReaderTest : public testing::Test {
 protected:
  Hdf5ReaderTest() {
    Hdf5Writer writer;
    writer.group("axis");
    writer.attribute(".", "count", std::int32_t{4});
    writer.attribute("axis", "first", -0.1);
    writer.attribute("axis", "name", std::string("\xc3\xa4"));
    writer.attribute("axis", "empty", std::string());
    writer.text("words", "two\nlines");
    writer.numbers<float>("numbers", Extents{2, 3}, {six.data()});
    std::ofstream(path_, std::ios::binary) << writer.bytes().value();
  }

  /// Changes the file with the library's own means.
  void edit(const std::function<void(hid_t)>& change) {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    change(file);
    ASSERT_GE(H5Fclose(file), 0);
  }

  /// What reading refuses with; "" when it does not.
  [[nodiscard]] std::string refusal(const std::function<void(Hdf5Reader&)>& reading) const {
    Hdf5Reader reader("a.h5", path_);
    reading(reader);
    return reader.problem() ? reader.problem()->message : "";
  }
  [[nodiscard]] std::string refusal_of_numbers(const Extents& extents) const {
    return refusal([&](Hdf5Reader& reader) { reader.want_numbers<float>("numbers", extents); });
  }

  std::string path_ = testing::TempDir() + "hdf5_reader_test_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
};

TEST_F(Hdf5ReaderTest, GivesBackWhatWasWritten) {
  Hdf5Reader reader("a.h5", path_);
  EXPECT_EQ(reader.whole(".", "count", 0, 4), 4);
  EXPECT_EQ(reader.number("axis", "first"), -0.1);
  EXPECT_EQ(reader.text_attribute("axis", "name"), "\xc3\xa4");
  EXPECT_EQ(reader.text_attribute("axis", "empty"), "");
  EXPECT_EQ(reader.text("words"), "two\nlines");
  EXPECT_THAT(reader.extents("numbers"), ElementsAre(2U, 3U));
  EXPECT_TRUE(reader.extents("words").empty());
  EXPECT_TRUE(reader.is_of<float>("numbers"));
  EXPECT_FALSE(reader.is_of<double>("numbers"));
  EXPECT_FALSE(reader.is_of<float>("none"));
  EXPECT_TRUE(reader.has("axis"));
  EXPECT_FALSE(reader.has("none"));
  std::vector<float> values(6);
  reader.numbers<float>("numbers", {2, 3}, {values.data() + 3, values.data()});
  EXPECT_THAT(values, ElementsAre(4.0F, 5.0F, 6.5F, 1.0F, 2.0F, 3.0F));
  EXPECT_FALSE(reader.problem());
}

TEST_F(Hdf5ReaderTest, TheFirstProblemStaysAndNothingIsReadAnyMore) {
  Hdf5Reader reader("a.h5", path_);
  EXPECT_EQ(reader.whole(".", "count", 5, 9), 5);  // within the range asked for
  EXPECT_EQ(reader.number("axis", "first"), 0.0);
  EXPECT_EQ(reader.text("words"), "");
  EXPECT_TRUE(reader.extents("numbers").empty());
  EXPECT_FALSE(reader.has("axis"));
  std::vector<float> values(6, 9.0F);
  reader.numbers<float>("numbers", {2, 3}, {values.data()});
  EXPECT_THAT(values, testing::Each(9.0F));
  reader.reject("grid", "another");
  ASSERT_TRUE(reader.problem());
  EXPECT_EQ(*reader.problem(),
            (Error{Error::Code::malformed,
                   "a.h5: attribute ./count: want a whole number in [5, 9], got 4"}));
}

TEST_F(Hdf5ReaderTest, RefusesWhatIsNotThere) {
  const auto none = [&](const auto& reading) { return refusal(reading); };
  EXPECT_EQ(none([](Hdf5Reader& r) { (void)r.number("axis", "last"); }),
            "a.h5: attribute axis/last: want a number, got none");
  EXPECT_EQ(none([](Hdf5Reader& r) { (void)r.whole("y", "n", 0, 1); }),
            "a.h5: attribute y/n: want a whole number in [0, 1], got none");
  EXPECT_EQ(none([](Hdf5Reader& r) { (void)r.text_attribute(".", "format"); }),
            "a.h5: attribute format: want a text, got none");
  EXPECT_EQ(none([](Hdf5Reader& r) { (void)r.text("title"); }),
            "a.h5: data set title: want one, got none");
  EXPECT_EQ(none([](Hdf5Reader& r) { r.want_numbers<double>("times", {1}); }),
            "a.h5: data set times: want one, got none");
}

TEST_F(Hdf5ReaderTest, RefusesWhatIsOfAnotherKind) {
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)r.number(".", "count"); }),
            "a.h5: attribute count: want a number, got another type or shape");
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)r.text_attribute("axis", "first"); }),
            "a.h5: attribute axis/first: want a text, got another type or shape");
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)r.text("numbers"); }),
            "a.h5: data set numbers: want a text, got something else");
  EXPECT_EQ(refusal([](Hdf5Reader& r) {
              r.want_numbers<double>("numbers", {2, 3});
            }),
            "a.h5: data set numbers: want numbers of 8 bytes, got another type");
  EXPECT_EQ(refusal_of_numbers({3, 2}), "a.h5: data set numbers: want 3 x 2 numbers, got 2 x 3");
  EXPECT_EQ(refusal([](Hdf5Reader& r) { r.want_numbers<float>("words", {1}); }),
            "a.h5: data set words: want 1 numbers, got one value");
}

// A text of any length is kept elsewhere in the file: it is not read.
TEST_F(Hdf5ReaderTest, RefusesTextsOfAnyLength) {
  edit([](hid_t file) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    const hid_t space = H5Screate(H5S_SCALAR);
    const char* const text = "long";
    const hid_t made = H5Acreate2(file, "format", type, space, H5P_DEFAULT, H5P_DEFAULT);
    ASSERT_GE(H5Awrite(made, type, &text), 0);
    H5Aclose(made);
    H5Sclose(space);
    H5Tclose(type);
  });
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)r.text_attribute(".", "format"); }),
            "a.h5: attribute format: want a text, got another type or shape");
}

TEST_F(Hdf5ReaderTest, RefusesWhatIsNoNumberAndSaysWhere) {
  edit([](hid_t file) {
    std::vector<float> values = six;
    values[4] = std::numeric_limits<float>::infinity();
    const hid_t set = H5Dopen2(file, "numbers", H5P_DEFAULT);
    ASSERT_GE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Dclose(set);
  });
  const std::string found = refusal([](Hdf5Reader& reader) {
    std::vector<float> values(6);
    reader.numbers<float>("numbers", {2, 3}, {values.data(), values.data() + 3});
  });
  EXPECT_EQ(found, "a.h5: data set numbers: want finite numbers, got inf at 1");  // of its part
}

TEST_F(Hdf5ReaderTest, TakesAllNumbersWhereAsked) {
  edit([](hid_t file) {
    std::vector<float> values = six;
    values[4] = std::numeric_limits<float>::quiet_NaN();
    const hid_t set = H5Dopen2(file, "numbers", H5P_DEFAULT);
    ASSERT_GE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Dclose(set);
  });
  std::vector<float> values(6);
  const std::string found = refusal([&](Hdf5Reader& reader) {
    reader.numbers<float>("numbers", {2, 3}, {values.data()}, Numbers::all);
  });
  EXPECT_EQ(found, "");
  EXPECT_EQ(values[3], six[3]);
  EXPECT_TRUE(std::isnan(values[4]));
}

TEST_F(Hdf5ReaderTest, TakesNoMemoryForNumbersThatAreNotThere) {
  for (const std::array<hsize_t, 2> shape :
       {std::array<hsize_t, 2>{2'000'000'000, 2'000}, std::array<hsize_t, 2>{0, 2'000}}) {
    edit([&](hid_t file) {  // none of them kept
      H5Ldelete(file, "numbers", H5P_DEFAULT);
      const std::array<hsize_t, 2> chunk{64, 64};
      const std::array<hsize_t, 2> most{H5S_UNLIMITED, H5S_UNLIMITED};
      const hid_t space = H5Screate_simple(2, shape.data(), most.data());
      const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
      H5Pset_chunk(layout, 2, chunk.data());
      const hid_t set =
          H5Dcreate2(file, "numbers", H5T_IEEE_F32LE, space, H5P_DEFAULT, layout, H5P_DEFAULT);
      ASSERT_GE(set, 0);
      H5Dclose(set);
      H5Pclose(layout);
      H5Sclose(space);
    });
    EXPECT_EQ(refusal_of_numbers({shape[0], shape[1]}), "a.h5: data set numbers: want " +
                                                            std::to_string(shape[0]) +
                                                            " x 2000 numbers, got fewer bytes");
  }
}

TEST_F(Hdf5ReaderTest, RefusesBytesThatAreNoFile) {
  const std::string whole = read_file(path_).value();
  for (const std::string& bytes : {std::string(), std::string("words"), whole.substr(0, 200)}) {
    std::ofstream(path_, std::ios::binary) << bytes;
    Hdf5Reader reader("a.h5", path_);
    ASSERT_TRUE(reader.problem());
    EXPECT_EQ(reader.problem()->message, "a.h5: file: want HDF5, got what HDF5 cannot open");
    EXPECT_FALSE(reader.has("axis"));
  }
}

TEST_F(Hdf5ReaderTest, RefusesPartsThatDoNotMakeTheWhole) {
  Hdf5Reader reader("a.h5", path_);
  std::vector<float> values(6);
  EXPECT_THROW(reader.numbers<float>("numbers", {2, 3}, {}), ContractViolation);
  EXPECT_THROW(reader.numbers<float>("numbers", {3, 2}, {values.data(), values.data()}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::formats::hdf5_reader_test
