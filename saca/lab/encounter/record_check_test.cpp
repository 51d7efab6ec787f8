#include "saca/lab/encounter/record_check.h"

#include <gmock/gmock.h>

#include "saca/lab/encounter/provenance.h"

namespace saca::encounter::record_check_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json input(const std::string& what, const std::string& name, const json& digest) {
  return {{"what", what}, {"name", name}, {"digest", digest}};
}

/// A record made from a scenario, a car and an atlas.
json record() {
  json record{{"schema", "saca.record/1"}, {"grip", 0.9}};
  record["made"] = {
      {"program", "saca 1"},
      {"commit", "abc"},
      {"date", "2026-11-24T12:00:00Z"},
      {"command", "saca run x"},
      {"content", content_digest(record)},
      {"inputs", json::array({input("scenario", "x", "01"), input("car", "a_car", "02"),
                              input("atlas", "a_car", "03")})}};
  return record;
}

/// All of it is here, as it was.
InputsHere all_here() {
  return {.inputs = json::array({input("car", "a_car", "02"), input("atlas", "a_car", "03")}),
          .digest_of = [](const std::string&) { return Result<std::string>("01"); }};
}

TEST(RecordCheck, ARecordNamesWhatIsToBeRead) {
  json made = record().at("made");
  EXPECT_EQ(recorded_inputs(made).car, "a_car");
  EXPECT_TRUE(recorded_inputs(made).with_atlas);
  made["inputs"][2]["digest"] = nullptr;
  EXPECT_FALSE(recorded_inputs(made).with_atlas);
  made["inputs"] = json::array();
  EXPECT_EQ(recorded_inputs(made).car, "");
  EXPECT_FALSE(recorded_inputs(made).with_atlas);
}

TEST(RecordCheck, WhatIsAsItWasIsTheSame) {
  const RecordCheck check = check_record(record(), all_here());
  EXPECT_TRUE(check.is_unchanged());
  EXPECT_TRUE(check.is_same());
  EXPECT_EQ(text_of(check),
            "Made by saca 1 (abc), 2026-11-24T12:00:00Z:\n  saca run x\n"
            "  content      as it was written\n"
            "  scenario     x: the same here\n"
            "  car          a_car: the same here\n"
            "  atlas        a_car: the same here\n");
  const json all = json_of(check);
  EXPECT_EQ(all.at("schema"), "saca.verification/1");
  EXPECT_EQ(all.at("command"), "saca run x");
  EXPECT_EQ(all.at("same"), true);
  EXPECT_EQ(all.at("inputs").at(1), json({{"what", "car"},
                                          {"name", "a_car"},
                                          {"recorded", "02"},
                                          {"here", "02"},
                                          {"same", true}}));
}

TEST(RecordCheck, AChangedRecordIsNotWhatWasWritten) {
  json changed = record();
  changed["grip"] = 0.8;
  const RecordCheck check = check_record(changed, all_here());
  EXPECT_FALSE(check.is_unchanged());
  EXPECT_FALSE(check.is_same());
  EXPECT_THAT(text_of(check), HasSubstr("content      has been changed since\n"));
  EXPECT_EQ(json_of(check).at("content").at("here"), content_digest(changed));
}

TEST(RecordCheck, WhatIsOtherwiseOrNotHereIsToldByItself) {
  InputsHere here = all_here();
  here.inputs = Result<json>(json::array({input("car", "a_car", "77")}));
  here.digest_of = [](const std::string& name) -> Result<std::string> {
    return Error{Error::Code::unreadable, name + ": is not there"};
  };
  const RecordCheck check = check_record(record(), here);
  EXPECT_TRUE(check.is_unchanged());
  EXPECT_FALSE(check.is_same());
  EXPECT_THAT(text_of(check), HasSubstr("  scenario     x: not here: x: is not there\n"
                                        "  car          a_car: another one here\n"
                                        "  atlas        a_car: not here: \n"));
  here.inputs = Error{Error::Code::unreadable, "a_car: no such car"};
  EXPECT_THAT(text_of(check_record(record(), here)),
              HasSubstr("  car          a_car: not here: a_car: no such car\n"));
}

TEST(RecordCheck, WhatIsNotWholeThrows) {
  json no_content = record();
  no_content["made"].erase("content");
  EXPECT_THROW((void)recorded_inputs(no_content.at("made")), json::exception);
  for (const char* const key : {"program", "commit", "date", "command", "content"}) {
    json without = record();
    without["made"].erase(key);
    EXPECT_THROW((void)check_record(without, all_here()), json::exception) << key;
    without["made"][key] = 3;
    EXPECT_THROW((void)check_record(without, all_here()), json::exception) << key;
  }
  json no_digest = record();
  no_digest["made"]["inputs"][0].erase("digest");
  EXPECT_THROW((void)check_record(no_digest, all_here()), json::exception);
}

}  // namespace
}  // namespace saca::encounter::record_check_test
