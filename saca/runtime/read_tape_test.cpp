#include "saca/runtime/read_tape.h"

#include <gmock/gmock.h>

#include <fmt/core.h>

#include <cstring>
#include <functional>
#include <sstream>

#include "saca/base/core/fnv.h"
#include "saca/runtime/tape_for_test.h"

namespace saca::runtime::read_tape_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// A tape of a drive with a decision, read only once.
class ReadTape : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    TapedDrive drive;
    const PlanesSetup setup = drive.setup();
    TapeHeader header = tape_header(setup, intent::shipped_model());
    header.program = "0.1.0";
    header.car = "compact_rwd_ev";
    header.seed = 18446744073709551615U;
    header.forced = manoeuvre::Plan{manoeuvre::PolicyId::es_b_right, 1.0 / 3.0};
    TapeContent content = drive.driven(setup, 190);
    content.dropped = 165;  // the trigger and what is around it
    content.steps.erase(content.steps.begin(), content.steps.begin() + 165);
    reflex::CachedPlan cached{.at_trigger = match::features(content.steps[3].scene),
                              .trigger = content.steps[3].scene.time + 1.0 / 3.0,
                              .plan = {manoeuvre::PolicyId::aes_left, std::nullopt},
                              .source = reflex::Source::memory,
                              .preview = 2};
    content.steps[3].plans.emplace().push_back(cached);
    content.plans.push_back(cached);
    tape_ = new TapeFile{header, content};
    text_ = new std::string(tape_text(*tape_));
  }
  static void TearDownTestSuite() {
    delete tape_;
    delete text_;
  }
  static std::string refusal(const std::string& text) {
    const auto tape = read_tape(text, "a.tape");
    return tape.has_value() ? "" : tape.error().message;
  }
  /// The text with one line replaced, and the digest of the altered lines.
  static std::string with_line(std::size_t number, const std::function<void(json&)>& alter) {
    std::istringstream lines(*text_);
    std::string text;
    std::size_t k = 0;
    for (std::string line; std::getline(lines, line);) {
      ++k;
      json node = json::parse(line);
      if (k == number) {
        alter(node);
      }
      if (node["type"] == "end") {
        Fnv hash;
        hash.add(text);
        node["digest"] = fmt::format("{:016x}", hash.value());
      }
      text += node.dump() + '\n';
    }
    return text;
  }

  static const TapeFile* tape_;
  static const std::string* text_;
};
const TapeFile* ReadTape::tape_ = nullptr;
const std::string* ReadTape::text_ = nullptr;

TEST_F(ReadTape, ComesBackToTheLastBit) {
  const auto read = read_tape(*text_, "a.tape");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(tape_text(read.value()), *text_);
  const TapeStep& step = read.value().content.steps.at(3);
  const TapeStep& original = tape_->content.steps.at(3);
  EXPECT_EQ(std::memcmp(&step.scene.ego, &original.scene.ego, sizeof step.scene.ego), 0);
  EXPECT_EQ(step.beliefs[0].at, original.beliefs[0].at);
  EXPECT_EQ((*step.plans)[0].at_trigger.ego.log_grip, (*original.plans)[0].at_trigger.ego.log_grip);
  EXPECT_EQ(read.value().header.seed, 18446744073709551615U);
  EXPECT_EQ(read.value().header.forced, tape_->header.forced);
}

TEST_F(ReadTape, HoldsADecisionAndVerdicts) {
  const auto read = read_tape(*text_, "a.tape").value();
  const auto count = [&](auto&& has) {
    return std::count_if(read.content.steps.begin(), read.content.steps.end(), has);
  };
  EXPECT_EQ(count([](const TapeStep& step) { return step.decision.has_value(); }), 1);
  EXPECT_GE(count([](const TapeStep& step) { return step.verdict.has_value(); }), 1);
}

TEST_F(ReadTape, CutAnywhereItIsRefusedInOneLine) {
  for (std::size_t size = 0; size < text_->size(); size += 499) {
    const std::string message = refusal(text_->substr(0, size));
    EXPECT_THAT(message, StartsWith("a.tape:")) << size;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_THAT(refusal(text_->substr(0, text_->rfind("{\"digest\""))), HasSubstr("cut short"));
  EXPECT_NE(refusal(text_->substr(0, text_->size() - 1)), "");
}

TEST_F(ReadTape, OneAlteredBitAnywhereIsNoticed) {
  std::string text = *text_;
  for (std::size_t at = 0; at < text.size(); at += 503) {
    const char before = text[at];
    text[at] = static_cast<char>(before ^ 1);
    EXPECT_THAT(refusal(text), StartsWith("a.tape:")) << at;
    text[at] = before;
  }
}

TEST_F(ReadTape, NamesLineKeyWantedAndGot) {
  EXPECT_EQ(refusal(""), "a.tape: want a tape (saca.tape/6), got an empty file");
  EXPECT_EQ(refusal("\xff\n"),
            "a.tape:1: want one JSON object of a tape (saca.tape/6), got \"\\ufffd\"");
  EXPECT_THAT(refusal("{\"schema\": \"saca.record/1\"}\n"),
              StartsWith("a.tape:1: type: is missing"));
  EXPECT_EQ(refusal(with_line(1, [](json& line) { line["schema"] = "saca.tape/7"; })),
            "a.tape:1: schema: want saca.tape/6, got \"saca.tape/7\"");
  EXPECT_EQ(refusal(with_line(2, [](json& line) { line["lost"] = -1; })),
            "a.tape:2: lost: want an integer from 0 to 18446744073709551615, got -1");
  EXPECT_THAT(refusal(with_line(3, [](json& line) { line["scene"]["grip"] = 7; })),
              HasSubstr("a.tape:3: scene: "));
  EXPECT_EQ(refusal(with_line(4, [](json& line) { line["number"] = 0; })),
            "a.tape:4: number: want more than 165, got 0");
  EXPECT_EQ(refusal(with_line(5, [](json& line) { line.erase("finished"); })),
            "a.tape:5: finished: is missing");
  EXPECT_EQ(refusal(with_line(5, [](json& line) { line["more"] = 1; })),
            "a.tape:5: more: is not known");
  EXPECT_THAT(refusal(with_line(5, [](json& line) { line["beliefs"][0].erase(0); })),
              HasSubstr("a.tape:5: beliefs[0]: want 24 finite numbers"));
  EXPECT_EQ(refusal(with_line(5, [](json& line) { line["beliefs"].clear(); })),
            "a.tape:5: beliefs: want one for each of the scene's 1 actors, got 0");
  EXPECT_LT(refusal(with_line(5, [](json& line) { line[std::string(500'000, 'k')] = 1; })).size(),
            300U);
  EXPECT_THAT(refusal("{\"type\":" + std::string(500'000, '[') + "\n"),
              HasSubstr("a.tape:1: want one JSON object of a tape"));
  EXPECT_THAT(refusal(*text_ + "{}\n"), HasSubstr("want nothing after the end of the tape"));
}

}  // namespace
}  // namespace saca::runtime::read_tape_test
