#include "saca/lab/cases/crash_search.h"

#include <gtest/gtest.h>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::cases::crash_search_test {
namespace {

class CrashSearch : public testing::Test {
 protected:
  void SetUp() override {
    family_ = families::load_family("scenarios/families", "slower_lead").value();
    family_.ranges["follower_share"] = {0.0, 0.0, "test"};
  }
  void always(const std::string& key, double value) { family_.ranges[key] = {value, value, "t"}; }
  [[nodiscard]] CrashFound found(std::optional<collision::Face> struck, std::uint64_t tries) const {
    return find_crash(family_, struck, "compact_rwd_ev", car_, harm_, {.seed = 1, .most = tries});
  }

  families::Family family_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
};

TEST_F(CrashSearch, FindsTheCrashThatTheFamilyIsAbout) {
  const CrashFound one = found(collision::Face::front, 5);
  EXPECT_EQ(one.end, CrashEnd::happens);
  EXPECT_EQ(one.sample, 0U) << "who stands ahead is met at once";
  ASSERT_TRUE(one.as_written.contact.has_value());
  EXPECT_TRUE(one.as_written.contact->first_actor);
  EXPECT_EQ(one.as_written.contact->ego_face, collision::Face::front);
  const auto again =
      families::sample(family_, 1, one.sample, "compact_rwd_ev", scenario::standard_ego);
  EXPECT_EQ(again.value().scenario.name, one.scenario.name);
}

TEST_F(CrashSearch, WantsTheSideThatIsRecorded) {
  EXPECT_EQ(found(collision::Face::rear, 2).end, CrashEnd::does_not_happen);
  EXPECT_EQ(found(collision::Face::rear, 2).sample, 1U) << "all were tried";
}

TEST_F(CrashSearch, TellsWhereNobodyGetsInTheWay) {
  family_ = families::load_family("scenarios/families", "head_on").value();
  always("drift_to_m", 3.6);
  always("left_busy_share", 0.0);
  always("right_busy_share", 0.0);
  always("follower_share", 0.0);
  const CrashEnd end = found(std::nullopt, 2).end;
  EXPECT_TRUE(end == CrashEnd::never_triggers || end == CrashEnd::does_not_happen);
}

TEST_F(CrashSearch, TellsWhereNothingCanBeDrawn) {
  family_ = families::load_family("scenarios/families", "lead_brakes").value();
  always("gap_s", 0.0);  // bumpers touch from the start
  EXPECT_EQ(found(std::nullopt, 2).end, CrashEnd::cannot_be_drawn);
}

TEST_F(CrashSearch, HasNamesForItsEnds) {
  for (std::size_t i = 0; i < num_crash_ends; ++i) {
    const auto end = static_cast<CrashEnd>(i);
    EXPECT_EQ(crash_end_from(name(end)), end);
  }
}

}  // namespace
}  // namespace saca::cases::crash_search_test
