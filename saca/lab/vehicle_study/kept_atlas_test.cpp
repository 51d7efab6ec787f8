#include "saca/lab/vehicle_study/kept_atlas.h"

#include <gmock/gmock.h>

#include "saca/base/core/file.h"
#include "saca/lab/installation/here_for_test.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::vehicle_study::kept_atlas_test {
namespace {

namespace fs = std::filesystem;

class KeptAtlasFile : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] static AtlasBuild build() {
    return {.grid = atlas::small_grid(), .display = long_work::ProgressDisplay::silent};
  }

  const manoeuvre::Car& car_ = atlas::small_atlas_car();
  const fs::path folder_ = fs::path(testing::TempDir()) / "kept_atlas";
  const fs::path file_ = folder_ / "cache" / "a.atlas";
};

TEST_F(KeptAtlasFile, IsBuiltIntoAFolderThatIsMadeAndLeavesNoJournal) {
  const auto atlas = build_atlas_file(car_, file_, build()).value().value();
  EXPECT_EQ(atlas.nodes().size(), atlas::small_nodes().size());
  EXPECT_TRUE(atlas::read_atlas(file_, car_).has_value());
  EXPECT_FALSE(fs::exists(file_.string() + ".journal"));
}

TEST_F(KeptAtlasFile, AFileThatCannotBeWrittenIsAnError) {
  fs::create_directories(file_);  // a folder has its name
  const auto atlas = build_atlas_file(car_, file_, build());
  ASSERT_FALSE(atlas.has_value());
  EXPECT_EQ(atlas.error().code, Error::Code::unwritable);
}

TEST_F(KeptAtlasFile, WhatIsThereIsReadAndWhatIsNotIsBuiltAndKept) {
  EXPECT_FALSE(read_or_build_atlas(car_, file_, build()).not_kept.has_value());
  const auto written = fs::last_write_time(file_);
  const KeptAtlas again = read_or_build_atlas(car_, file_, build());
  EXPECT_EQ(again.atlas.nodes().size(), atlas::small_nodes().size());
  EXPECT_EQ(fs::last_write_time(file_), written) << "it is read, not built";
  manoeuvre::Car heavier = car_;
  heavier.mass += 100.0;
  (void)read_or_build_atlas(heavier, file_, build());
  EXPECT_TRUE(atlas::read_atlas(file_, heavier).has_value()) << "another car's is built anew";
}

TEST_F(KeptAtlasFile, OneThatCannotBeKeptIsUsedAllTheSame) {
  fs::create_directories(file_);
  const KeptAtlas atlas = read_or_build_atlas(car_, file_, build());
  EXPECT_EQ(atlas.atlas.nodes().size(), atlas::small_nodes().size());
  ASSERT_TRUE(atlas.not_kept.has_value());
  EXPECT_EQ(atlas.not_kept->code, Error::Code::unwritable);
}

TEST(UsualAtlas, IsBuiltOnceAndKeptInTheCache) {
  installation::Installation here = installation::here_for_test();
  std::vector<std::string> noticed;
  here.notice = [&](const std::string& what) { noticed.push_back(what); };
  fs::remove_all(here.cache);
  const auto inputs = installation::read_inputs(here, "compact_rwd_ev").value();
  const fs::path place = atlas_place(here, "compact_rwd_ev");
  EXPECT_EQ(place, here.cache / "atlases/compact_rwd_ev.atlas");
  const atlas::Atlas built = usual_atlas(here, inputs);
  EXPECT_TRUE(fs::exists(place));
  const auto written = fs::last_write_time(place);
  EXPECT_EQ(usual_atlas(here, inputs).nodes().size(), built.nodes().size());
  EXPECT_EQ(fs::last_write_time(place), written);
  EXPECT_THAT(noticed, testing::IsEmpty());

  // Where it cannot be kept, it is used all the same, and that is said.
  here.cache = "/proc/nowhere";
  EXPECT_EQ(usual_atlas(here, inputs).nodes().size(), built.nodes().size());
  EXPECT_THAT(noticed, testing::ElementsAre(testing::HasSubstr("built again next time")));
}

}  // namespace
}  // namespace saca::vehicle_study::kept_atlas_test
