#include "saca/thinking/memory/case_row.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/thinking/memory/cases_for_test.h"

namespace saca::memory::case_row_test {
namespace {

using testing::HasSubstr;

constexpr std::size_t harm_at = 3;

TEST(CaseRow, GivesBackACaseToTheLastBit) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    Case one = example_case(seed);
    one.id = 7;
    const Case again = case_from_cells(7, cells_of(one), "bank").value();
    EXPECT_EQ(again.id, 7);
    expect_same(again, one);
  }
}

TEST(CaseRow, NamesBankRowAndColumnOfWhatIsWrong) {
  Cells cells = cells_of(example_case(1));
  cells.at(harm_at) = std::string("much");
  const Error error = case_from_cells(7, cells, "bank").error();
  EXPECT_EQ(error.code, Error::Code::malformed);
  EXPECT_THAT(error.message,
              HasSubstr("bank: table cases, id 7: harm: want a finite number >= 0, got much"));
  for (const Cell& bad : {Cell(), Cell(-1.0), Cell(std::int64_t{-1}), Cell(std::nan("")),
                          Cell(std::numeric_limits<double>::infinity())}) {
    cells.at(harm_at) = bad;
    EXPECT_THAT(case_from_cells(7, cells, "bank").error().message, HasSubstr("harm: want"));
  }
}

// A database may keep a whole number as an integer.
TEST(CaseRow, TakesAWholeNumberForAnAmount) {
  Cells cells = cells_of(example_case(1));
  cells.at(harm_at) = std::int64_t{1};
  EXPECT_EQ(case_from_cells(7, cells, "bank").value().harm, 1.0);
}

TEST(CaseRow, TellsCellsAsText) {
  EXPECT_EQ(text_of(Cell()), "");
  EXPECT_EQ(text_of(std::int64_t{-3}), "-3");
  EXPECT_EQ(text_of(std::string("a b")), "a b");
  const double awkward = 0.1 + 0.2;
  EXPECT_EQ(std::stod(text_of(awkward)), awkward);
}

TEST(CaseRow, NamesEveryColumnOnceInEachStatement) {
  EXPECT_THAT(column_names(), testing::StartsWith("id, policy, target_speed_mps, best_policy,"));
  EXPECT_THAT(column_names(), testing::EndsWith("scene, strength, details"));
  EXPECT_THAT(parameters('$'), testing::EndsWith(", $11, $12"));
  EXPECT_THAT(assignments('?'), testing::StartsWith("policy = ?2, target_speed_mps = ?3"));
  EXPECT_THAT(assignments('?'), testing::EndsWith("details = ?12"));
  EXPECT_EQ(column_definition(case_columns.back(), {"I", "R", "T"}),
            "details T NOT NULL DEFAULT '{}'");
  EXPECT_EQ(column_definition(case_columns.at(1), {"I", "R", "T"}), "target_speed_mps R");
}

}  // namespace
}  // namespace saca::memory::case_row_test
