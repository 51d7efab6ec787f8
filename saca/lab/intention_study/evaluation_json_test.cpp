#include "saca/lab/intention_study/evaluation_json.h"

#include <gmock/gmock.h>

#include "saca/lab/intention_study/figures_for_test.h"

namespace saca::intention_study::evaluation_json_test {
namespace {

using nlohmann::json;

TEST(AMethod, HasFiguresOfEachHorizonAndClass) {
  const json method = method_json(small_evaluation().comparisons[0].methods[0]);
  EXPECT_EQ(method["method"], "ours");
  ASSERT_EQ(method["heads"].size(), 3U);
  const json& now = method["heads"][0];
  EXPECT_EQ(now["ahead_s"], 0.0);
  EXPECT_EQ(method["heads"][2]["ahead_s"], 1.0);
  EXPECT_EQ(now["macro_f1"], (json{{"value", 0.5}, {"low", 0.25}, {"high", 0.75}}));
  EXPECT_EQ(now["classes"]["FB"]["frames"], 4);
  EXPECT_EQ(now["classes"]["FB"]["recall"], 0.25);
  EXPECT_DOUBLE_EQ(now["classes"]["FB"]["precision"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(now["classes"].size(), 6U);
  EXPECT_EQ(now["confusion"][3], (json{3, 0, 0, 1, 0, 0}));
  EXPECT_EQ(method["illegal_steps"], 7);
  EXPECT_EQ(method["hours"], 0.5);
  EXPECT_EQ(method["false_alarms_per_hour"], 8.0);  // 4 in half an hour
}

TEST(AMethod, HasActsAndLeadTimes) {
  const json method = method_json(small_evaluation().comparisons[0].methods[0]);
  EXPECT_EQ(method["acts"].size(), 5U);  // M is none
  EXPECT_EQ(method["acts"]["FB"]["acts"], 2);
  EXPECT_EQ(method["acts"]["FB"]["found"], 1);
  EXPECT_EQ(method["acts"]["FB"]["recall_by_age"][0],
            (json{{"from_s", 0.0}, {"frames", 4}, {"recall", 0.25}}));
  EXPECT_EQ(method["warning_before_braking"]["events"], 3);
  EXPECT_DOUBLE_EQ(method["warning_before_braking"]["share_warned"].get<double>(), 2.0 / 3.0);
  EXPECT_EQ(method["warning_before_braking"]["median_s"], 0.4);
}

TEST(AMethod, WithoutAFigureHasNull) {
  const json method = method_json(small_evaluation().comparisons[0].methods[0]);
  EXPECT_TRUE(method["ours_less_this"].is_null());
  EXPECT_TRUE(method["heads"][0]["log_loss_ours_less_this"].is_null());
  EXPECT_TRUE(method["heads"][1]["macro_f1"].is_null());
  EXPECT_TRUE(method["heads"][0]["classes"]["LC"]["recall"].is_null());
  EXPECT_TRUE(method["warning_before_line"]["median_s"].is_null());
  EXPECT_TRUE(method["acts"]["FB"]["recall_by_age"][4]["recall"].is_null());
}

TEST(AnEvaluation, HoldsComparisonsAndDisplacements) {
  const json document = evaluation_json(small_evaluation());
  EXPECT_EQ(document["schema"], "saca.intent_eval/1");
  ASSERT_EQ(document["comparisons"].size(), 1U);
  EXPECT_EQ(document["comparisons"][0]["title"], "Recorded");
  EXPECT_EQ(document["comparisons"][0]["methods"][1]["ours_less_this"]["value"], 0.125);
  ASSERT_EQ(document["displacements"].size(), 2U * 4U * 3U);
  const json& lane_keeping = document["displacements"][5];
  EXPECT_EQ(lane_keeping, (json{{"vehicles", "all"},
                                {"foresight", "lane keeping"},
                                {"ahead_s", 3},
                                {"frames", 2},
                                {"mean_m", 4.0},
                                {"rms_m", 5.0}}));  // of 1 and 7
  EXPECT_EQ(document["displacements"][12]["vehicles"], "acting");
  EXPECT_EQ(document["displacements"][12]["mean_m"], 2.0);
}

}  // namespace
}  // namespace saca::intention_study::evaluation_json_test
