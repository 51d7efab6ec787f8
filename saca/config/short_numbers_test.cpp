#include "saca/config/short_numbers.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace saca::config::short_numbers_test {
namespace {

using nlohmann::json;

TEST(ShortNumbers, AreThoseThatAPersonWouldWrite) {
  const json document{{"sum", 0.1 + 0.2},
                      {"nothing", -1.4e-17},
                      {"list", {3 * 0.2, 1, "0.30000000000000004", nullptr, true}},
                      {"deep", {{{"share", 1.0000000000000002}}}}};
  EXPECT_EQ(with_short_numbers(document).dump(),
            R"({"deep":[{"share":1.0}],"list":[0.6,1,"0.30000000000000004",null,true],)"
            R"("nothing":0.0,"sum":0.3})");
}

TEST(ShortNumbers, LeaveIntegersAndOrderAsTheyAre) {
  const nlohmann::ordered_json document{{"z", 9007199254740993}, {"a", 0.7 + 0.1}};
  EXPECT_EQ(with_short_numbers(document).dump(), R"({"z":9007199254740993,"a":0.8})");
}

// The library writes 0.138596096278 as 0.13859609627800001.
TEST(ShortNumbers, AreShortThoughTheLibraryMissesTheShortestText) {
  ASSERT_EQ(json(0.138596096278).dump(), "0.13859609627800001");
  EXPECT_EQ(with_short_numbers(json(0.138596096278)).dump(), "0.13859609628");
}

TEST(ShortNumbers, CountsDigits) {
  EXPECT_EQ(significant_digits("-0.00123"), 3);
  EXPECT_EQ(significant_digits("120.5e-17"), 4);
  EXPECT_EQ(significant_digits("0.0"), 0);
  EXPECT_EQ(significant_digits("null"), 0);
}

}  // namespace
}  // namespace saca::config::short_numbers_test
