#include "saca/lab/encounter/provenance.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/intent/model.h"

namespace saca::encounter::provenance_test {
namespace {

using nlohmann::json;

class ProvenanceTest : public testing::Test {
 protected:
  [[nodiscard]] json made() const {
    const encounter::Setup setup{
        .scenario = &scenario_, .car = &car_, .harm = &harm_, .intent = &intent_, .seed = 7};
    return made_json(setup, {.program = "saca 1",
                             .commit = "abc",
                             .date = "2026-11-24T12:00:00Z",
                             .command = "saca run x",
                             .file = "x.toml",
                             .digest = "00"});
  }

  scenario::Scenario scenario_{.name = "x", .car = "compact_rwd_ev"};
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  intent::Model intent_ = intent::read_model("models/intent/model.safetensors").value();
};

json digest(const json& made, const std::string& what) {
  for (const json& one : made.at("inputs")) {
    if (one.at("what") == what) {
      return one.at("digest");
    }
  }
  return "no such input";
}

TEST_F(ProvenanceTest, NamesWhatWasReadByItsContent) {
  const json before = made();
  EXPECT_EQ(before.at("seed"), 7);
  EXPECT_EQ(before.at("command"), "saca run x");
  EXPECT_EQ(digest(before, "scenario"), "00");
  EXPECT_TRUE(digest(before, "atlas").is_null());
  car_.mass += 1.0;
  harm_.ego_people += 0.5;
  EXPECT_NE(digest(made(), "car"), digest(before, "car"));
  EXPECT_NE(digest(made(), "harm"), digest(before, "harm"));
  EXPECT_EQ(digest(made(), "intentions"), digest(before, "intentions"));
}

TEST_F(ProvenanceTest, ContentIsAllButWhoMadeIt) {
  json record{{"schema", "saca.record/1"}, {"grip", 0.9}, {"made", made()}};
  const std::string digest = content_digest(record);
  EXPECT_EQ(content_digest(json::parse(record.dump())), digest);  // numbers come back
  record["made"]["date"] = "2027";
  record["timing"] = {{"reflex_us_max", 17.0}};
  EXPECT_EQ(content_digest(record), digest);
  record["grip"] = 0.8;
  EXPECT_NE(content_digest(record), digest);
}

}  // namespace
}  // namespace saca::encounter::provenance_test
