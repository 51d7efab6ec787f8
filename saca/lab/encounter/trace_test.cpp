#include "saca/lab/encounter/trace.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "saca/base/core/csv.h"
#include "saca/lab/encounter/wreck_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/runtime/wreck_for_test.h"

namespace saca::encounter::trace_test {
namespace {

using nlohmann::json;

/// A short film of a car that turns before a wreck, made by hand.
struct Film {
  manoeuvre::Car car = prepare::default_car();
  scenario::Scenario scenario{.name = "wreck", .title = "A wreck", .source = "made up", .car = "x"};
  Setup setup{.scenario = &scenario, .car = &car};
  Record record;

  Film() {
    scenario.actors.push_back({.id = 1, .footprint = {.length = 4.5, .width = 1.8}});
    for (int k = 0; k < 3; ++k) {
      Frame frame{.phase = k < 2 ? Phase::driving : Phase::manoeuvre,
                  .scene = runtime::wreck_ahead(car, 30.0)};
      frame.scene.time = 0.02 * k;
      frame.scene.ego.X_WB = {{0.4 * k, 1.0}, 0.5 * std::numbers::pi};
      frame.scene.actors[0].v_W = {3.0, 4.0};
      if (k == 1) {
        frame.conflict = 1.25;
      }
      frame.perceived = frame.scene;
      record.frames.push_back(frame);
    }
    record.events.push_back({0.02, arbitration::Plane::reflex, arbitration::EventKind::trigger,
                             "T1: \"now\"\nor never"});
  }
};

std::vector<json> parsed(const std::string& text) {
  std::vector<json> lines;
  std::string_view rest = text;
  while (!rest.empty()) {
    lines.push_back(json::parse(cut_line(rest)));
  }
  return lines;
}

TEST(Trace, IsAHeaderThenAFrameALineThenAnEventALine) {
  Film film;
  const auto lines = parsed(trace_jsonl(film.setup, film.record));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0]["type"], "header");
  EXPECT_EQ(lines[0]["schema"], "saca.trace/1");
  EXPECT_EQ(lines[0]["scenario"], "wreck");
  EXPECT_EQ(lines[0]["pace"], "lockstep");
  EXPECT_EQ(lines[0]["model"], "off");
  EXPECT_EQ(lines[0]["actors"][0]["id"], "car1");
  EXPECT_EQ(lines[0]["road"]["lane_width_m"], 3.5);
  EXPECT_EQ(lines[0]["ego"]["length_m"], manoeuvre::footprint(film.car).length);
  EXPECT_EQ(lines[1]["type"], "frame");
  EXPECT_EQ(lines[2]["t_s"], 0.02);
  EXPECT_EQ(lines[2]["phase"], "driving");
  EXPECT_EQ(lines[2]["conflict_s"], 1.25);
  EXPECT_TRUE(lines[3]["conflict_s"].is_null());
  EXPECT_EQ(lines[3]["phase"], "manoeuvre");
  EXPECT_EQ(lines[3]["ego"]["x_m"], 0.8);
  EXPECT_DOUBLE_EQ(lines[3]["ego"]["heading_deg"], 90.0);
  EXPECT_EQ(lines[3]["actors"][0]["id"], "car1");
  EXPECT_EQ(lines[3]["actors"][0]["speed_mps"], 5.0);
  EXPECT_FALSE(lines[3].contains("perceived"));
  EXPECT_EQ(lines[4]["type"], "event");
  EXPECT_EQ(lines[4]["kind"], "trigger");
  EXPECT_EQ(lines[4]["plane"], "reflex");
  EXPECT_EQ(lines[4]["text"], "T1: \"now\"\nor never");
}

TEST(Trace, TextThatIsNoUtf8IsStillJson) {
  Film film;
  film.record.events[0].text = "\xff\xfe";
  EXPECT_EQ(parsed(trace_jsonl(film.setup, film.record)).size(), 5U);
}

TEST(Trace, AsCsvHasARowForEachBodyAndFrameAboutTheCentresOfBodies) {
  Film film;
  const std::string text = trace_csv(film.setup, film.record);
  std::string_view rest = text;
  EXPECT_EQ(cut_line(rest), "t_s,id,kind,x_m,y_m,heading_deg,speed_mps,length_m,width_m,perceived");
  std::vector<std::vector<std::string_view>> rows;
  while (!rest.empty()) {
    rows.push_back(fields_of(cut_line(rest), ','));
    ASSERT_EQ(rows.back().size(), 10U);
  }
  ASSERT_EQ(rows.size(), 6U);
  const world::Footprint body = manoeuvre::footprint(film.car);
  EXPECT_EQ(rows[4][0], "0.04");
  EXPECT_EQ(rows[4][1], "ego");
  EXPECT_NEAR(*finite_number(rows[4][3]), 0.8, 1e-12);  // it heads north
  EXPECT_NEAR(*finite_number(rows[4][4]), 1.0 + body.centre_x, 1e-12);
  EXPECT_NEAR(*finite_number(rows[4][5]), 90.0, 1e-12);
  EXPECT_EQ(*finite_number(rows[4][6]), 20.0);
  EXPECT_EQ(*finite_number(rows[4][7]), body.length);
  EXPECT_EQ(rows[5][1], "car1");
  EXPECT_EQ(rows[5][2], "car");
  EXPECT_EQ(*finite_number(rows[5][3]), 30.0);
  EXPECT_EQ(*finite_number(rows[5][6]), 5.0);
  EXPECT_EQ(*finite_number(rows[5][8]), 1.8);
  EXPECT_EQ(rows[5][9], "0");
}

TEST(Trace, OfNothingIsAHeader) {
  Film film;
  film.record = {};
  EXPECT_EQ(parsed(trace_jsonl(film.setup, film.record)).size(), 1U);
  const std::string csv = trace_csv(film.setup, film.record);
  EXPECT_EQ(csv.find('\n'), csv.size() - 1);
}

TEST(Trace, TellsWhatWasPerceivedWhereItDiffersFromTheTruth) {
  Film film;
  world::Actor& known = film.record.frames[1].perceived.actors[0];
  known.X_WA.p.x = 31.0;
  known.position_sd = 0.5;
  known.existence = 0.75;
  known.age = 0.1;
  known.occluded = true;
  const auto lines = parsed(trace_jsonl(film.setup, film.record));
  EXPECT_FALSE(lines[1].contains("perceived"));
  ASSERT_TRUE(lines[2].contains("perceived"));
  const json& told = lines[2]["perceived"]["actors"][0];
  EXPECT_EQ(told["x_m"], 31.0);
  EXPECT_EQ(told["position_sd_m"], 0.5);
  EXPECT_EQ(told["existence"], 0.75);
  EXPECT_EQ(told["age_s"], 0.1);
  EXPECT_EQ(told["occluded"], true);
  EXPECT_EQ(lines[2]["actors"][0]["x_m"], 30.0);
  const std::string csv = trace_csv(film.setup, film.record);
  EXPECT_NE(csv.find("0.02,car1,car,31,0,0,5,4.5,1.8,1\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("0.02,car1,car,30,0,0,5,4.5,1.8,0\n"), std::string::npos) << csv;
}

TEST(Trace, CsvTellsThatNobodyIsPerceived) {
  Film film;
  film.record.frames.resize(1);
  film.record.frames[0].perceived.actors.clear();
  const std::string text = trace_csv(film.setup, film.record);
  std::string_view rest = text;
  std::vector<std::string> told;
  while (!rest.empty()) {
    const auto fields = fields_of(cut_line(rest), ',');
    told.push_back(std::string(fields[1]) + " " + std::string(fields.back()));
  }
  EXPECT_EQ(told, (std::vector<std::string>{"id perceived", "ego 0", "car1 0", "ego 1"}));
}

}  // namespace
}  // namespace saca::encounter::trace_test
