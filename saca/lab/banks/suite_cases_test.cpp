#include "saca/lab/banks/suite_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/lab/installation/here_for_test.h"

namespace saca::banks::suite_cases_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(SuiteCases, AreMadeOfEncountersAndTheirTwins) {
  const fs::path journal = fs::path(testing::TempDir()) / "suite_cases.journal";
  fs::remove(journal);
  SuiteCasesRequest request{.from = {.name = "one_way",
                                     .count = 2,
                                     .split = "tuning",
                                     .journal = journal.string(),
                                     .threads = 1},
                            .draws = 2,
                            .no_twins = true};
  const auto built = suite_cases(installation::here_for_test(), request);
  ASSERT_TRUE(built.has_value()) << built.error().message;
  ASSERT_TRUE(built.value().has_value());
  EXPECT_EQ(built.value()->num_encounters, 2U);
  EXPECT_EQ(built.value()->cases.size(), 2U);
  EXPECT_EQ(command_text(request),
            "memory build one_way --split tuning --car compact_rwd_ev --seed 1 --draws 2 "
            "--no-twins");
  request.from.seed = 2;  // the journal is of other work
  EXPECT_THAT(suite_cases(installation::here_for_test(), request).error().message,
              HasSubstr("suite_cases.journal"));
  fs::remove(journal);
}

}  // namespace
}  // namespace saca::banks::suite_cases_test
