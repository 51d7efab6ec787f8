#include "saca/lab/installation/shipped_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/file.h"
#include "saca/lab/installation/here_for_test.h"

namespace saca::installation::shipped_files_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(ShippedFiles, AreFoundByNameAndByPath) {
  const Installation here = here_for_test();
  EXPECT_EQ(find_scenario(here, "one_way").value(), "./scenarios/one_way.toml");
  EXPECT_EQ(find_scenario(here, "scenarios/one_way.toml").value(), "scenarios/one_way.toml");
  EXPECT_EQ(find_car(here, "small_fwd_car").value(), "./data/vehicles/small_fwd_car.toml");
  EXPECT_EQ(find_reach_case(here, "paper_ellipse").value(), "./data/reach/paper_ellipse.toml");
  EXPECT_EQ(read_family(here, "head_on").value().name, "head_on");
  EXPECT_EQ(regulation_place(here, "r152"), "./data/protocols/r152.toml");
}

TEST(ShippedFiles, WhatIsNotThereIsToldWithWhatWasLikelyMeant) {
  const Installation here = here_for_test();
  const auto message = [](const auto& result) { return result.error().message; };
  EXPECT_THAT(message(find_car(here, "small_fwd_cra")),
              AllOf(HasSubstr("small_fwd_cra: no car is there"), HasSubstr("small_fwd_car")));
  EXPECT_THAT(message(find_scenario(here, "nothing_like_it")), HasSubstr("`saca scenarios` lists"));
  EXPECT_THAT(message(find_scenario(here, "intersection_t")), HasSubstr("intersection_t1"));
  EXPECT_THAT(message(read_family(here, "headon")), HasSubstr("head_on"));
  // Files of the same folders that are something else, and what cannot be a name.
  for (const char* const name : {"splits", "", "scenarios", "one_way.json", "nowhere/one_way"}) {
    EXPECT_FALSE(find_scenario(here, name).has_value()) << name;
  }
  EXPECT_FALSE(read_family(here, "suites").has_value());
}

TEST(ShippedFiles, AFolderThatIsNotThereIsNoEmptyOne) {
  const Installation nowhere{.root = "/nowhere"};
  EXPECT_THROW((void)shipped_scenarios(nowhere), fs::filesystem_error);
  EXPECT_THAT(find_car(nowhere, "compact_rwd_ev").error().message, HasSubstr("no car is there"));
}

TEST(ShippedFiles, AreListedByName) {
  const auto files = shipped_scenarios(here_for_test());
  EXPECT_TRUE(std::is_sorted(files.begin(), files.end()));
  EXPECT_THAT(files, Contains(fs::path("./scenarios/one_way.toml")));
  EXPECT_THAT(files, Not(Contains(fs::path("./scenarios/splits.toml"))));
}

TEST(ShippedFiles, SplitsHaveTheirSeeds) {
  EXPECT_TRUE(read_splits(here_for_test()).has_value());
}

TEST(ScenarioDigest, IsFnv1aOfTheBytes) {
  const fs::path file = fs::path(testing::TempDir()) / "digest.toml";
  ASSERT_EQ(write_file(file, "foobar"), std::nullopt);
  // The published value of FNV-1a (64 bits) of "foobar": draft-eastlake-fnv, appendix C.
  EXPECT_EQ(scenario_digest(here_for_test(), file.string()).value(), "85944171f73967e8");
  fs::remove(file);
  EXPECT_FALSE(scenario_digest(here_for_test(), file.string()).has_value());
}

}  // namespace
}  // namespace saca::installation::shipped_files_test
