#include "saca/lab/long_work/items_row.h"

#include <gmock/gmock.h>

namespace saca::long_work::items_row_test {

/// Something with a document of its own.
struct Weight {
  double kilograms = 0.0;
  bool operator==(const Weight&) const = default;
};

/// Found by argument-dependent lookup.
static nlohmann::json to_json(const Weight& weight) {
  return {{"kg", weight.kilograms}};
}

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Result<Weight> weight_from(const nlohmann::json& document) {
  std::optional<Error> problem;
  formats::JsonReader reader(document, "", problem, "weight");
  const Weight weight{reader.number("kg")};
  if (problem) {
    return *problem;
  }
  return weight;
}

TEST(ItemsRow, ComesBackFromItsLine) {
  const ItemsRow<Weight> row{{{1.5}, {0.1}}, "one could not be weighed: \"heavy\""};
  const auto again = items_row<Weight>(items_line(row), weight_from);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again.value().items, row.items);
  EXPECT_EQ(again.value().problem, row.problem);
}

TEST(ItemsRow, IsRefusedWhereALineIsNone) {
  EXPECT_FALSE(items_row<Weight>("{", weight_from).has_value());
  EXPECT_THAT(items_row<Weight>(R"({"items":[]})", weight_from).error().message,
              HasSubstr("problem"));
  EXPECT_THAT(
      items_row<Weight>(R"({"items":[{"kg":"heavy"}],"problem":""})", weight_from).error().message,
      HasSubstr("kg"));
  EXPECT_THAT(
      items_row<Weight>(R"({"items":[],"problem":"","more":1})", weight_from).error().message,
      HasSubstr("more"));
}

TEST(ItemsRow, AllAreInTheOrderOfTheirRowsWithTheProblemsBeside) {
  const auto all = all_items<Weight>({{{{3.0}, {1.0}}, ""}, {{}, "broken"}, {{{2.0}}, "half"}});
  EXPECT_THAT(all.items, ElementsAre(Weight{3.0}, Weight{1.0}, Weight{2.0}));
  EXPECT_THAT(all.problems, ElementsAre("broken", "half"));
}

}  // namespace
}  // namespace saca::long_work::items_row_test
