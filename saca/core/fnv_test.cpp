#include "saca/core/fnv.h"

#include <gmock/gmock.h>

#include <string_view>

namespace saca::fnv_test {
namespace {

std::uint64_t hash(std::string_view text) {
  Fnv fnv;
  fnv.add(text);
  return fnv.value();
}

// The authors' own test vectors (FNV-1a, 64 bits).
TEST(Fnv, IsThePublishedFunctionOfBytes) {
  EXPECT_EQ(hash(""), 0xcbf29ce484222325U);
  EXPECT_EQ(hash("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(hash("foobar"), 0x85944171f73967e8U);
}

}  // namespace
}  // namespace saca::fnv_test
