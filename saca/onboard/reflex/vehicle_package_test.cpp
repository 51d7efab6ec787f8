#include "saca/onboard/reflex/vehicle_package.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/reflex/reflex_plane.h"

namespace saca::reflex::vehicle_package_test {
namespace {

using testing::HasSubstr;

class Package : public testing::Test {
 protected:
  static const std::string& atlas_file() {
    static const std::string bytes =
        atlas_bytes(atlas::small_atlas_car(), atlas::small_grid(), atlas::small_nodes());
    return bytes;
  }
  static const collision::HarmModel& harm() {
    static const collision::HarmModel model = prepare::read_harm("data/harm.toml").value();
    return model;
  }
  static std::string good() {
    return vehicle_package_bytes("a car", atlas::small_atlas_car(), harm(), atlas_file());
  }
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() /
            (std::string("saca_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
             ".vehicle");
    std::filesystem::remove(path_);  // of a run that was cut short
  }
  void TearDown() override { std::filesystem::remove(path_); }

  Result<VehiclePackage> read(const std::string& bytes) {
    EXPECT_EQ(write_file(path_, bytes), std::nullopt);
    return read_vehicle_package(path_);
  }
  std::string complaint(const std::string& bytes) {
    const auto result = read(bytes);
    return result.has_value() ? "read" : result.error().message;
  }
  std::filesystem::path path_;
};

TEST_F(Package, HoldsWhatWasWrittenToTheLastBit) {
  const auto package = read(good());
  ASSERT_TRUE(package.has_value()) << package.error().message;
  EXPECT_EQ(package.value().name, "a car");
  EXPECT_EQ(std::memcmp(&package.value().car, &atlas::small_atlas_car(), sizeof(manoeuvre::Car)),
            0);
  EXPECT_EQ(std::memcmp(&package.value().harm, &harm(), sizeof(collision::HarmModel)), 0);
  const auto nodes = package.value().atlas.nodes();
  ASSERT_EQ(nodes.size(), atlas::small_nodes().size());
  EXPECT_EQ(std::memcmp(nodes.data(), atlas::small_nodes().data(), nodes.size_bytes()), 0);
}

// Whoever swaps or cuts the file later hurts nobody: all of it is in memory.
TEST_F(Package, DecidesAfterItsFileIsCutAsBefore) {
  const auto package = read(good());
  ASSERT_TRUE(package.has_value());
  const auto verdict = [&] {
    AtlasJudge judge(package.value().car, package.value().atlas, package.value().harm);
    world::Scene scene = atlas::atlas_scene(12.5, 0.85);
    world::Actor wreck{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
    wreck.X_WA.p = {20.0, 0.0};
    scene.actors.push_back(wreck);
    return judge.judge(scene).value();
  };
  const Verdict before = verdict();
  std::filesystem::resize_file(path_, 100);
  const Verdict after = verdict();
  ASSERT_EQ(before.plans.size(), after.plans.size());
  ASSERT_GT(before.plans.size(), 0U);
  for (std::size_t i = 0; i < before.plans.size(); ++i) {
    EXPECT_EQ(before.plans[i].harm, after.plans[i].harm);
  }
}

TEST_F(Package, IsRefusedWhereverItIsCut) {
  const std::string bytes = good();
  for (std::size_t i = 0; i <= 40; ++i) {
    const std::size_t size = i * (bytes.size() - 1) / 40;
    EXPECT_THAT(complaint(bytes.substr(0, size)), HasSubstr(path_.string() + ": ")) << size;
  }
  EXPECT_THAT(complaint(bytes + "x"), HasSubstr("it is not whole"));
  EXPECT_THAT(complaint(""), HasSubstr("got 0"));
}

TEST_F(Package, IsRefusedWhateverByteIsAltered) {
  const std::string bytes = good();
  const std::size_t head = bytes.size() - atlas_file().size();
  for (std::size_t i = 0; i < bytes.size(); i += i < head ? 1 : bytes.size() / 40) {
    std::string altered = bytes;
    altered[i] = static_cast<char>(altered[i] ^ 0x10);
    EXPECT_NE(complaint(altered), "read") << i;
  }
}

TEST_F(Package, NamesWhatIsWrong) {
  EXPECT_THAT(complaint(std::string(good()).replace(0, 8, "SACAATLS")),
              HasSubstr("is no vehicle package"));
  EXPECT_THAT(complaint(std::string(good()).replace(8, 1, "\7")),
              HasSubstr("want version 1, got 7"));
  manoeuvre::Car other = atlas::small_atlas_car();
  other.mass += 1.0;
  EXPECT_THAT(complaint(vehicle_package_bytes("other", other, harm(), atlas_file())),
              HasSubstr("its atlas: is of another car"));
  const auto missing = read_vehicle_package("no_such.vehicle");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, Error::Code::unreadable);
}

TEST_F(Package, IsNotMadeOfWhatCannotBeRead) {
  manoeuvre::Car broken = atlas::small_atlas_car();
  broken.brake_lag = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)vehicle_package_bytes("a", broken, harm(), atlas_file()), ContractViolation);
  EXPECT_THROW((void)vehicle_package_bytes(std::string(64, 'a'), atlas::small_atlas_car(), harm(),
                                           atlas_file()),
               ContractViolation);
  EXPECT_EQ(read(vehicle_package_bytes(std::string(63, 'a'), atlas::small_atlas_car(), harm(),
                                       atlas_file()))
                .value()
                .name,
            std::string(63, 'a'));
}

}  // namespace
}  // namespace saca::reflex::vehicle_package_test
