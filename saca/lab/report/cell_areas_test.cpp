#include "saca/lab/report/cell_areas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/contract.h"

namespace saca::report::cell_areas_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(CellAreas, TheNameOfARectangleGoesToItsMiddle) {
  const std::vector<int> keys(5 * 7, 3);
  EXPECT_THAT(area_centres(keys, 7), ElementsAre(2 * 7 + 3));
}

TEST(CellAreas, CornersDoNotJoin) {
  EXPECT_THAT(area_centres(std::vector{1, 2, 2, 1}, 2), ElementsAre(0, 1, 2, 3));
}

TEST(CellAreas, OneKeyInTwoPlacesIsTwoAreas) {
  EXPECT_THAT(area_centres(std::vector{1, 1, 1, 2, 1, 1, 1}, 7), ElementsAre(1, 3, 5));
}

TEST(CellAreas, AnAreaIsNamedWhereItIsWidest) {
  // A thin arm with a block of 3 x 3 at its end. Two cells of the block are two steps from outside;
  // the one towards the arm is nearer to the middle of all.
  const std::vector<int> keys{0, 0, 0, 0, 0, 1, 1, 1,  //
                              1, 1, 1, 1, 1, 1, 1, 1,  //
                              0, 0, 0, 0, 0, 1, 1, 1};
  const auto centres = area_centres(keys, 8);
  ASSERT_EQ(centres.size(), 3U);
  EXPECT_EQ(centres[1], 8U + 5U);
}

TEST(CellAreas, ARingIsNamedOnItself) {
  std::vector<int> keys(25, 1);
  for (const std::size_t inner : {6U, 7U, 8U, 11U, 12U, 13U, 16U, 17U, 18U}) {
    keys[inner] = 2;
  }
  const auto centres = area_centres(keys, 5);
  ASSERT_EQ(centres.size(), 2U);
  EXPECT_EQ(keys[centres[0]], 1);
  EXPECT_EQ(centres[1], 12U);
}

TEST(CellAreas, RefusesBrokenRows) {
  EXPECT_THAT(area_centres({}, 3), IsEmpty());
  EXPECT_THROW((void)area_centres(std::vector{1, 2, 3}, 2), ContractViolation);
  EXPECT_THROW((void)area_centres(std::vector{1}, 0), ContractViolation);
}

}  // namespace
}  // namespace saca::report::cell_areas_test
