#include "saca/lab/suites/suite_gallery.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::suite_gallery_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;

/// Pictures that only say which plan they are of.
report::SceneView named(const world::Scene& /*scene*/, const encounter::Hindsight& tried) {
  report::SceneView view;
  view.policy = tried.facts.plan.policy;
  return view;
}

/// A run whose encounters can be drawn again: braking and swerving to the left were tried.
SuiteRun drawable(std::vector<eval::SuiteRow> rows) {
  SuiteRun run = made_run({"aeb"}, std::move(rows));
  run.encounter_at = [](std::uint64_t number) -> Result<eval::SuiteEncounter> {
    return eval::SuiteEncounter{.number = number, .family = "a", .scenario = {}, .twin = {}};
  };
  run.tried_in = [](const eval::SuiteEncounter&) {
    eval::TriedScene scene;
    for (const PolicyId policy : {PolicyId::aeb, PolicyId::aes_left}) {
      scene.tried.emplace_back();
      scene.tried.back().facts.plan = {policy, std::nullopt};
    }
    return std::optional(scene);
  };
  return run;
}

TEST(SuiteGallery, ShowsWhereMostWasLostFirst) {
  SuiteRun run = drawable({made_row(0, "a", {0.2}, 0.1), made_row(1, "a", {0.5}, 0.1),
                           made_row(2, "a", {0.104}, 0.1),  // about as good as the best
                           failed_row(3, "a", "no road")});
  run.rows[1].risk.runs[0].met = "truck";
  run.rows[1].risk.runs[0].impact_speed = 7.25;
  run.rows[1].risk.runs[0].reason = "It had no plan.";
  SuiteRequest request;
  request.name = "natural";
  request.seed = 3;
  request.thinking.memory = "bank.db";
  const auto cards = gallery_of(run, request, named);
  ASSERT_EQ(cards.size(), 2U);
  EXPECT_EQ(cards[0].title, "a 1: regret 0.400");
  EXPECT_EQ(cards[1].title, "a 0: regret 0.100");
  EXPECT_THAT(cards[0].lines.at(0), HasSubstr("meets truck at 7.2 m/s, harm 0.500; "));
  EXPECT_THAT(cards[0].lines.at(0), HasSubstr("would have done 0.100. It had no plan."));
  EXPECT_EQ(cards[0].done.policy, PolicyId::aeb);
  EXPECT_EQ(cards[0].done.badge, "done");
  EXPECT_EQ(cards[0].best.policy, PolicyId::aes_left);
  EXPECT_EQ(cards[0].best.badge, "best");
  EXPECT_EQ(cards[0].command,
            "saca suite natural --split calibration --seed 3 --memory bank.db --replay 1");
}

TEST(SuiteGallery, ShowsTwelveAtMost) {
  std::vector<eval::SuiteRow> rows;
  for (std::uint64_t k = 0; k < 20; ++k) {
    rows.push_back(made_row(k, "a", {0.5}, 0.1));
  }
  EXPECT_EQ(gallery_of(drawable(rows), {}, named).size(), 12U);
}

TEST(SuiteGallery, PassesOverWhatCannotBeDrawn) {
  EXPECT_TRUE(gallery_of(made_run({"aeb"}, {made_row(0, "a", {0.5}, 0.1)}), {}, named).empty());
  SuiteRun run = drawable({made_row(0, "a", {0.5}, 0.1)});
  run.rows[0].risk.runs[0].plan->policy = PolicyId::es_b_right;  // which was not tried
  EXPECT_TRUE(gallery_of(run, {}, named).empty());
}

}  // namespace
}  // namespace saca::suites::suite_gallery_test
