#include "saca/lab/vehicle_study/atlas_check_run.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "saca/lab/installation/here_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::vehicle_study::atlas_check_run_test {
namespace {

using testing::HasSubstr;

class AtlasCheckRun : public testing::Test {
 protected:
  [[nodiscard]] static families::Family family(const std::string& name) {
    return families::load_family("scenarios/families", name).value();
  }

  const families::Splits splits_ = families::load_splits("scenarios/splits.toml").value();
};

TEST_F(AtlasCheckRun, TheTestSplitsSeedIsRefused) {
  const std::uint64_t test = splits_.seeds[static_cast<std::size_t>(families::Split::test)];
  const auto why = why_not_seed(splits_, test);
  ASSERT_TRUE(why.has_value());
  EXPECT_EQ(why->message, "--seed: want any but the test split's, got " + std::to_string(test));
  EXPECT_FALSE(why_not_seed(splits_, test + 1).has_value());
  EXPECT_FALSE(why_not_seed(splits_, std::nullopt).has_value());
}

TEST_F(AtlasCheckRun, AFamilyTakesTheSeedAskedForElseCalibrations) {
  EXPECT_EQ(seeded(family("one_way"), "one_way", splits_, 5).value().seed, 5U);
  EXPECT_EQ(seeded(family("one_way"), "one_way", splits_, std::nullopt).value().seed,
            splits_.seeds[static_cast<std::size_t>(families::Split::calibration)]);
  EXPECT_FALSE(seeded(family("merge"), "merge", splits_, std::nullopt).has_value())
      << "it is kept for the test split";
}

TEST_F(AtlasCheckRun, AllFamiliesAreReadWithTheirSeeds) {
  const auto families = families_to_check(installation::here_for_test(), 5);
  ASSERT_TRUE(families.has_value()) << families.error().message;
  ASSERT_EQ(families.value().size(), atlas_check_families.size());
  EXPECT_EQ(families.value().front().family.name, atlas_check_families.front());
  EXPECT_EQ(families.value().front().seed, 5U);
  EXPECT_FALSE(families_to_check(installation::here_for_test(),
                                 splits_.seeds[static_cast<std::size_t>(families::Split::test)])
                   .has_value());
}

TEST_F(AtlasCheckRun, NoFamilyOfTheTestSplitIsAmongThem) {
  for (const std::string& kept : splits_.test_only) {
    EXPECT_EQ(std::count(atlas_check_families.begin(), atlas_check_families.end(), kept), 0)
        << kept;
  }
}

TEST_F(AtlasCheckRun, GoesThroughTheFamiliesInTurnWhateverTheThreads) {
  const manoeuvre::Car& car = atlas::small_atlas_car();
  const collision::HarmModel harm = prepare::read_harm("data/harm.toml").value();
  AtlasCheck check{.families = {{family("crossing"), 1}, {family("lead_brakes"), 2}}, .scenes = 3};
  const auto one = check_atlas(check, atlas::small_atlas(), car, harm);
  std::vector<std::vector<eval::AtlasRow>> rows{
      eval::atlas_rows(check.families[0].family, 1, 0, atlas::small_atlas(), car, harm),
      eval::atlas_rows(check.families[1].family, 2, 0, atlas::small_atlas(), car, harm),
      eval::atlas_rows(check.families[0].family, 1, 1, atlas::small_atlas(), car, harm)};
  const eval::AtlasFigures wanted = eval::atlas_figures(rows);
  ASSERT_TRUE(one.has_value());
  EXPECT_GT(wanted.plans, 0);
  EXPECT_EQ(one->scenes, wanted.scenes);
  EXPECT_EQ(one->plans, wanted.plans);
  EXPECT_EQ(one->covered.share, wanted.covered.share);
  check.threads = 2;
  EXPECT_EQ(check_atlas(check, atlas::small_atlas(), car, harm)->plans, wanted.plans);
}

}  // namespace
}  // namespace saca::vehicle_study::atlas_check_run_test
