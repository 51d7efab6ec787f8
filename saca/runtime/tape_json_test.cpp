#include "saca/runtime/tape_json.h"

#include <gmock/gmock.h>

#include <sstream>
#include <vector>

#include "saca/runtime/tape_for_test.h"

namespace saca::runtime::tape_json_test {
namespace {

using nlohmann::json;

std::vector<json> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<json> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(json::parse(line));
  }
  return lines;
}

TEST(TapeJson, IsAHeaderWhatWasBeforeTheStepsAndAnEnd) {
  TapedDrive drive;
  const PlanesSetup setup = drive.setup();
  const TapeContent content = drive.driven(setup, 60);
  const auto lines = lines_of(tape_text({tape_header(setup, intent::shipped_model()), content}));
  ASSERT_EQ(lines.size(), 60U + 3U);
  EXPECT_EQ(lines[0]["type"], "header");
  EXPECT_EQ(lines[0]["schema"], "saca.tape/6");
  EXPECT_EQ(lines[1]["type"], "before");
  EXPECT_EQ(lines[2]["forgotten"], "drive");
  for (std::size_t k = 0; k < 60; ++k) {
    EXPECT_EQ(lines[k + 2]["type"], "step");
    EXPECT_EQ(lines[k + 2]["number"], k);
    EXPECT_EQ(lines[k + 2]["scene"]["time_s"].get<double>(), content.steps[k].scene.time);
  }
  EXPECT_EQ(lines.back()["steps"], 60);
}

// A scene that breaks a rule is no JSON; that it came is.
TEST(TapeJson, ASceneThatBreaksARuleIsLeftOut) {
  TapeStep step;
  step.scene.grip = -1.0;
  step.reflex.refused_scene = true;
  TapeContent content;
  content.steps.push_back(step);
  const auto lines = lines_of(tape_text({{}, content}));
  EXPECT_TRUE(lines[2]["scene"].is_null());
  EXPECT_TRUE(lines[2]["reflex"]["refused_scene"].get<bool>());
}

// As they stand in reflex/verdict.h.
TEST(TapeJson, AVerdictHasTheHarmOfEachPlan) {
  reflex::Verdict verdict{.time = 1.5};
  verdict.plans.push_back({.plan = {manoeuvre::PolicyId::es_b_left, 7.5},
                           .drivable = true,
                           .harm = 1.0 / 3.0,
                           .contact = 0.25});
  EXPECT_EQ(
      verdict_json(verdict),
      json::parse(R"({"t_s": 1.5, "later": null, "under_way": null, "plans": [{"drivable": true,
              "harm": 0.3333333333333333, "contact": 0.25, "harm_as_seen": null,
              "plan": {"policy": 3, "target_speed_mps": 7.5, "strength": null}}]})"));
}

}  // namespace
}  // namespace saca::runtime::tape_json_test
