#include "saca/base/formats/short_numbers.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace saca::formats::short_numbers_test {
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

}  // namespace
}  // namespace saca::formats::short_numbers_test
