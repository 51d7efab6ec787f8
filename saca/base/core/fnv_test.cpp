#include "saca/base/core/fnv.h"

#include <gmock/gmock.h>

#include <cstdint>

namespace saca::fnv_test {
namespace {

// The authors' own test vectors (FNV-1a, 64 bits).
TEST(Fnv, IsThePublishedFunctionOfBytes) {
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325U);
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8U);
}

// Three words, the last of them the bits of 1/3.
TEST(Fnv, OfDoublesTakesTheirBitsInOrder) {
  struct Values {
    double a = 0.0;
    double b = -0.0;
    double c = 1.0 / 3.0;
  };
  Fnv doubles;
  doubles.add_doubles(Values{});
  Fnv words;
  for (const std::uint64_t bits :
       {std::uint64_t{0}, std::uint64_t{0x8000000000000000U}, std::uint64_t{0x3fd5555555555555U}}) {
    words.add(bits);
  }
  EXPECT_EQ(doubles.value(), words.value());
}

}  // namespace
}  // namespace saca::fnv_test
