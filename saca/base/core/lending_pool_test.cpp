#include "saca/base/core/lending_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "saca/base/core/parallel.h"

namespace saca::lending_pool_test {
namespace {

TEST(LendingPool, LendsEachThingOnce) {
  LendingPool<std::string> pool({"a", "b"});
  const auto one = pool.lend();
  auto other = pool.lend();
  EXPECT_NE(*one, *other);
  const std::string back = *other;
  other.reset();
  EXPECT_EQ(*pool.lend(), back);
}

TEST(LendingPool, HoldsSomething) {
  EXPECT_THROW(LendingPool<int>({}), ContractViolation);
}

TEST(LendingPoolThreads, NoThingIsLentTwiceAtOnce) {
  struct Thing {
    int users = 0;  // not atomic: a race would be seen by the thread sanitiser
  };
  LendingPool<Thing> pool(std::vector<Thing>(2));
  std::atomic<int> problems = 0;
  in_parallel(2'000, 5, [&](std::size_t) {
    const auto loan = pool.lend();
    problems += ++loan->users == 1 ? 0 : 1;
    --loan->users;
  });
  EXPECT_EQ(problems, 0);
}

}  // namespace
}  // namespace saca::lending_pool_test
