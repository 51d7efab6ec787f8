#include "saca/base/core/names.h"

#include <gtest/gtest.h>

namespace saca::names_test {
namespace {

enum class Colour { red, green };
constexpr std::array<std::string_view, 2> names{"red", "green"};

TEST(Names, GoThereAndBack) {
  EXPECT_EQ(name_of(Colour::green, names), "green");
  EXPECT_EQ(value_from<Colour>("green", names), Colour::green);
  EXPECT_EQ(value_from<Colour>("blue", names), std::nullopt);
  EXPECT_EQ(name_of(static_cast<Colour>(7), names), "?");
}

}  // namespace
}  // namespace saca::names_test
