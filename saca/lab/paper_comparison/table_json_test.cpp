#include "saca/lab/paper_comparison/table_json.h"

#include <gtest/gtest.h>

#include "saca/lab/paper_comparison/rows_for_test.h"

namespace saca::paper_comparison::table_json_test {
namespace {

using nlohmann::json;

TEST(TableJson, NamesTheTableTheMethodAndTheDraws) {
  json out = json::object();
  TableFigures figures = some_figures();
  figures.all[1].twins.emplace().false_trigger_loss = {
      .value = 0.5, .low = 0.5, .high = 0.5, .n = 12};
  add_figures(out, figures);
  EXPECT_EQ(out["tables.3.saca.collision_loss"], 0.75);
  EXPECT_EQ(out["tables.3.saca.collision_loss.n"], 12);
  EXPECT_EQ(out["tables.3.saca.collision_loss.ten_draws"], 0.5);
  EXPECT_EQ(out["tables.3.saca.collision_loss.ten_draws.n"], 10);
  EXPECT_EQ(out["tables.3.saca.collision_loss.in_time.n"], 2);
  EXPECT_FALSE(out.contains("tables.3.aeb.collision_loss.in_time"));
  EXPECT_DOUBLE_EQ(out["tables.3.aeb.harm"].get<double>(), 0.1);
  EXPECT_DOUBLE_EQ(out["tables.3.saca.harm_over_aeb.ten_draws"].get<double>(), -0.05);
  EXPECT_EQ(out["tables.3.aeb.false_trigger_loss"], 0.5);
  EXPECT_FALSE(out.contains("tables.3.saca.false_trigger_loss"));  // there are no twins
}

TEST(TableJson, RepliesStandUnderTableIV) {
  json out = json::object();
  add_figures(out, some_replies());
  EXPECT_EQ(out["tables.4.3.model.asked"], 20);
  EXPECT_EQ(out["tables.4.3.model.done"], 18);
  EXPECT_EQ(out["tables.4.3.model.ended"], 17);
  EXPECT_EQ(out["tables.4.3.model.in_time"], 12);
  EXPECT_EQ(out["tables.4.3.model.seconds"], 3.26);
  EXPECT_EQ(out["tables.4.3.model.tokens.n"], 10);
  EXPECT_EQ(out["tables.4.3.model.least_seconds"], 2.75);
}

TEST(TableJson, WithoutReplyThereAreCountsAlone) {
  json out = json::object();
  add_figures(out, TimedModel{.table = "table_2", .title = "", .key = "untuned", .times = {}});
  EXPECT_EQ(out["tables.4.2.untuned.asked"], 0);
  EXPECT_FALSE(out.contains("tables.4.2.untuned.least_seconds"));
  EXPECT_FALSE(out.contains("tables.4.2.untuned.seconds"));
}

}  // namespace
}  // namespace saca::paper_comparison::table_json_test
