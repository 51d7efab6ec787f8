#include "saca/lab/benchmarks/figures_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace saca::benchmarks::figures_text_test {
namespace {

TEST(FiguresText, ALineForEachInTheOrderOfTheirNames) {
  EXPECT_EQ(text_of({{"b.n", 12}, {"a.seconds", 0.0123456789}}),
            "a.seconds                                            0.0123457\n"
            "b.n                                                  12\n");
  EXPECT_EQ(text_of(nlohmann::json::object()), "");
}

}  // namespace
}  // namespace saca::benchmarks::figures_text_test
