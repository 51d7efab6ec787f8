#include "saca/lab/prepare/atlas_build.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <utility>

#include "saca/base/core/file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::prepare::atlas_build_test {
namespace {

// Few and short.
atlas::AtlasGrid tiny_grid() {
  const atlas::AtlasAxes::Axis none = atlas::axis_of({0.0});
  const atlas::AtlasAxes::Axis one = atlas::axis_of({0.9});
  atlas::AtlasAxes stop{atlas::axis_of({0.0, 3.0, 6.0}), one, none, atlas::axis_of({1.0})};
  for (double speed = 6.25; speed < 18.0; speed += 0.25) {  // more than are driven at once
    stop.speeds.push_back(speed);
  }
  const atlas::AtlasAxes swerve{atlas::axis_of({12.0}), one, atlas::axis_of({3.0}), none};
  atlas::AtlasAxes braked = swerve;
  braked.shares = atlas::axis_of({0.5});
  return {stop,   {atlas::axis_of({9.0}), one, none, none}, swerve, braked,
          swerve, {atlas::axis_of({12.0}), one, none, none}};
}

bool same(const std::vector<atlas::AtlasNode>& a, const std::vector<atlas::AtlasNode>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

atlas::AtlasNode node_of(std::size_t number) {
  return atlas_nodes(atlas::small_atlas_car(), tiny_grid(), {&number, 1}).front();
}

bool on(const AtlasProgress&) {
  return true;
}

// Goes on with a journal; and how many nodes that knew.
std::pair<AtlasNodes, std::size_t> resume(const std::filesystem::path& journal) {
  std::size_t remembered = 0;
  const auto note = [&](const AtlasProgress& progress) {
    remembered = progress.remembered;
    return true;
  };
  const AtlasNodes nodes =
      build_atlas(atlas::small_atlas_car(), tiny_grid(), 1, journal, note).value();
  return {nodes, remembered};
}

class AtlasBuild : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("saca_atlas_build_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(AtlasBuild, GivesTheSameBytesOnAnyNumberOfThreads) {
  const AtlasNodes one = build_atlas(atlas::small_atlas_car(), tiny_grid(), 1, {}, on).value();
  const AtlasNodes two = build_atlas(atlas::small_atlas_car(), tiny_grid(), 3, {}, on).value();
  EXPECT_TRUE(same(*one, *two));
}

TEST_F(AtlasBuild, GoesOnWhereItWasStopped) {
  const auto journal = folder_ / "journal";
  const AtlasNodes whole = build_atlas(atlas::small_atlas_car(), tiny_grid(), 1, {}, on).value();
  const AtlasNodes stopped =
      build_atlas(atlas::small_atlas_car(), tiny_grid(), 1, journal,
                  [](const AtlasProgress& progress) { return progress.done < 1; })
          .value();
  EXPECT_EQ(stopped, nullptr);
  const auto [resumed, remembered] = resume(journal);
  EXPECT_GT(remembered, 0U);
  EXPECT_LT(remembered, whole->size());
  EXPECT_TRUE(same(*whole, *resumed));
}

// A line of a journal that is no node is driven again.
TEST_F(AtlasBuild, PassesOverBrokenLinesOfItsJournal) {
  const auto journal = folder_ / "journal";
  const AtlasNodes whole =
      build_atlas(atlas::small_atlas_car(), tiny_grid(), 1, journal, on).value();
  std::string text = read_file(journal).value();
  const std::size_t first = text.find('\n') + 1;
  const std::size_t second = text.find('\n', first) + 1;
  const std::size_t third = text.find('\n', second) + 1;
  text[text.find(' ', first) + 7] = 'g';
  text.erase(third - 3, 2);
  text.insert(third - 2, "x7 00\n-1 00\n\n99 00\n5\n");
  ASSERT_EQ(write_file(journal, text), std::nullopt);
  const auto [resumed, remembered] = resume(journal);
  EXPECT_EQ(remembered, whole->size() - 2);
  EXPECT_TRUE(same(*whole, *resumed));
}

TEST_F(AtlasBuild, RefusesAJournalOfOtherWork) {
  const auto journal = folder_ / "journal";
  ASSERT_TRUE(build_atlas(atlas::small_atlas_car(), tiny_grid(), 1, journal, on).has_value());
  manoeuvre::Car other = atlas::small_atlas_car();
  other.mass += 1.0;
  const auto refused = build_atlas(other, tiny_grid(), 1, journal, on);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::malformed);
}

TEST_F(AtlasBuild, ANodeTellsHowItsDriveEnds) {
  const world::Scene scene = atlas::atlas_scene(6.0, 0.9);
  const manoeuvre::EgoMotion motion = manoeuvre::drive(
      atlas::small_atlas_car(), {manoeuvre::PolicyId::aeb, std::nullopt}, scene, 0.9, 20.0);
  const atlas::AtlasNode node = node_of(2);
  const double forward = node.path[0].back() * static_cast<double>(node.scale[0]);
  EXPECT_NEAR(forward, motion.track.X_WA.back().p.x, 0.02);  // the batch
  EXPECT_EQ(node.ended, 1U);
}

TEST_F(AtlasBuild, WhoStandsStaysAtOnce) {
  const atlas::AtlasNode node = node_of(0);
  EXPECT_EQ(node.end, 0.0F);
  EXPECT_EQ(node.scale[0], 0.0F);
  EXPECT_EQ(node.ended, 1U);
}

}  // namespace
}  // namespace saca::prepare::atlas_build_test
