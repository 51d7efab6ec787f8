#include "saca/lab/vehicle_study/package_build.h"

#include <gmock/gmock.h>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/reflex/vehicle_package.h"

namespace saca::vehicle_study::package_build_test {
namespace {

namespace fs = std::filesystem;

class PackageBuild : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(write_file(atlas_, atlas::atlas_bytes(atlas::small_atlas_car(), atlas::small_grid(),
                                                    atlas::small_nodes())),
              std::nullopt);
  }
  [[nodiscard]] PackageParts parts(const std::string& name) const {
    return {.car_name = name,
            .car = &atlas::small_atlas_car(),
            .harm = &harm_,
            .atlas = atlas_,
            .remedy = " (do this)"};
  }

  const collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  const fs::path atlas_ = fs::path(testing::TempDir()) / "package_build.atlas";
};

TEST_F(PackageBuild, IsReadByAVehicle) {
  const fs::path file = fs::path(testing::TempDir()) / "a.vehicle";
  ASSERT_EQ(write_file(file, package_of(parts("a_car")).value()), std::nullopt);
  const auto package = reflex::read_vehicle_package(file);
  ASSERT_TRUE(package.has_value()) << package.error().message;
  EXPECT_EQ(package.value().name, "a_car");
  EXPECT_EQ(package.value().atlas.nodes().size(), atlas::small_nodes().size());
}

TEST_F(PackageBuild, ANameMayHave63BytesAndNoMore) {
  EXPECT_TRUE(package_of(parts(std::string(63, 'x'))).has_value());
  const auto longer = package_of(parts(std::string(64, 'x')));
  ASSERT_FALSE(longer.has_value());
  EXPECT_EQ(longer.error().code, Error::Code::out_of_range);
  EXPECT_THAT(longer.error().message,
              testing::EndsWith("x: want a car's name of at most 63 bytes, got 64"));
}

TEST_F(PackageBuild, AnAtlasThatCannotBeUsedIsToldWithTheRemedy) {
  PackageParts missing = parts("a_car");
  missing.atlas = "no_such.atlas";
  EXPECT_EQ(package_of(missing).error().code, Error::Code::unreadable);
  EXPECT_THAT(package_of(missing).error().message, testing::EndsWith(" (do this)"));
  manoeuvre::Car heavier = atlas::small_atlas_car();
  heavier.mass += 100.0;
  PackageParts other = parts("a_car");
  other.car = &heavier;
  EXPECT_EQ(package_of(other).error().code, Error::Code::out_of_range);
  EXPECT_THAT(package_of(other).error().message, testing::EndsWith(" (do this)"));
}

}  // namespace
}  // namespace saca::vehicle_study::package_build_test
