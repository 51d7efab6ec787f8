#include "saca/lab/suites/suite_run.h"

#include <gmock/gmock.h>

namespace saca::suites::suite_run_test {
namespace {

TEST(Footnotes, SayWhatMetaHoldsByRisingKey) {
  EXPECT_THAT(footnotes_of({{"meta.seed", "7"}, {"meta.command", "saca suite a.b"}}),
              testing::ElementsAre("command: saca suite a.b", "seed: 7"));
  EXPECT_THAT(footnotes_of(nlohmann::json::object()), testing::IsEmpty());
}

}  // namespace
}  // namespace saca::suites::suite_run_test
