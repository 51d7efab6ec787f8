#include "saca/lab/curricula/start_digest.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "saca/base/core/fnv.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/cases_for_test.h"

namespace saca::curricula::start_digest_test {
namespace {

TEST(StartDigest, NamesTheCasesAndHowManyThereAre) {
  const StartDigest none = digest_of({}, {});
  EXPECT_EQ(none.start, fmt::format("0 cases ({:016x})", fnv1a(memory::cases_text({}))));
  EXPECT_EQ(none.all, fnv1a(memory::cases_text({})));
  const std::vector<memory::Case> two{memory::example_case(1), memory::example_case(2)};
  EXPECT_EQ(digest_of(two, {}).start,
            fmt::format("2 cases ({:016x})", fnv1a(memory::cases_text(two))));
}

TEST(StartDigest, WhatCasesAreMadeWithChangesTheWholeAlone) {
  const std::vector<memory::MadeWith> car{{.what = "car", .name = "a", .digest = "12"}};
  const std::vector<memory::MadeWith> other{{.what = "car", .name = "a", .digest = "13"}};
  EXPECT_EQ(digest_of({}, car).start, digest_of({}, other).start);
  EXPECT_NE(digest_of({}, car).all, digest_of({}, other).all);
  EXPECT_EQ(digest_of({}, car).all, fnv1a(memory::cases_text({}) + "12"));
}

}  // namespace
}  // namespace saca::curricula::start_digest_test
