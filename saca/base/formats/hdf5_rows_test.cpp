#include "saca/base/formats/hdf5_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

#include "saca/base/core/contract.h"

namespace saca::formats::hdf5_rows_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Hdf5RowsTest : public testing::Test {
 protected:
  Hdf5RowsTest() {
    Hdf5Writer writer;
    write_row(writer, "numbers", {1.0, -2.5, 4.0});
    write_row(writer, "counts", {0.0, 3.0, 4.0});
    write_row(writer, "flags", {1.0, 0.0, 1.0});
    write_row(writer, "unknown", {1.0, std::numeric_limits<double>::quiet_NaN()});
    write_lines(writer, "lines", std::vector<std::string>{"a", "", "b c"});
    writer.numbers<double>("square", {1, 1}, {square_.data()});
    std::ofstream(path_, std::ios::binary) << writer.bytes().value();
  }

  [[nodiscard]] std::string refusal(const std::function<void(Hdf5Reader&)>& reading) const {
    Hdf5Reader reader("a.h5", path_);
    reading(reader);
    return reader.problem() ? reader.problem()->message : "";
  }

  std::vector<double> square_{1.0};
  std::string path_ = testing::TempDir() + "hdf5_rows_test_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
};

TEST_F(Hdf5RowsTest, GivesBackWhatWasWritten) {
  Hdf5Reader reader("a.h5", path_);
  EXPECT_EQ(row_size(reader, "numbers"), 3U);
  EXPECT_THAT(read_row(reader, "numbers", 3), ElementsAre(1.0, -2.5, 4.0));
  EXPECT_THAT(read_counts(reader, "counts", 3, 0), ElementsAre(0U, 3U, 4U));
  EXPECT_THAT(read_parts(reader, "counts", 3, 0, 7), ElementsAre(0U, 3U, 4U));
  EXPECT_THAT(read_flags(reader, "flags", 3), ElementsAre(true, false, true));
  EXPECT_THAT(read_lines(reader, "lines", 3), ElementsAre("a", "", "b c"));
  EXPECT_TRUE(std::isnan(read_row(reader, "unknown", 2, Numbers::all)[1]));
  EXPECT_FALSE(reader.problem());
}

TEST_F(Hdf5RowsTest, RefusesAndSaysWhat) {
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)row_size(r, "square"); }),
            "a.h5: data set square: want a row of numbers, got another shape");
  EXPECT_THAT(refusal([](Hdf5Reader& r) { (void)read_row(r, "numbers", 2); }), HasSubstr("want 2"));
  EXPECT_THAT(refusal([](Hdf5Reader& r) { (void)read_row(r, "unknown", 2); }),
              HasSubstr("finite numbers"));
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)read_counts(r, "numbers", 3, 0); }),
            "a.h5: data set numbers: want whole numbers from 0 on, got -2.5");
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)read_counts(r, "counts", 3, 1); }),
            "a.h5: data set counts: want whole numbers from 1 on, got 0");
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)read_parts(r, "counts", 3, 0, 8); }),
            "a.h5: data set counts: want counts of 8 together, got 7");
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)read_flags(r, "counts", 3); }),
            "a.h5: data set counts: want 0 or 1, got 3");
  EXPECT_EQ(refusal([](Hdf5Reader& r) { (void)read_lines(r, "lines", 2); }),
            "a.h5: data set lines: want 2 lines, got 3");
}

TEST_F(Hdf5RowsTest, AfterAProblemSizesAreThoseAskedFor) {
  Hdf5Reader reader("a.h5", path_);
  reader.reject("a", "b");
  EXPECT_EQ(row_size(reader, "numbers"), 0U);
  EXPECT_THAT(read_row(reader, "numbers", 2), ElementsAre(0.0, 0.0));
  EXPECT_THAT(read_counts(reader, "counts", 1, 1), ElementsAre(1U));
  EXPECT_THAT(read_lines(reader, "lines", 0), IsEmpty());
}

TEST(Hdf5Rows, AreNotEmptyAndLinesAreOne) {
  Hdf5Writer writer;
  EXPECT_THROW(write_row(writer, "a", {}), ContractViolation);
  EXPECT_THROW(write_lines(writer, "b", std::vector<std::string>{"two\nlines"}), ContractViolation);
}

}  // namespace
}  // namespace saca::formats::hdf5_rows_test
