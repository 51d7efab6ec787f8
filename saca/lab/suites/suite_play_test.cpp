#include "saca/lab/suites/suite_play.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::suites::suite_play_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// Cars standing in the way, ever further; the third cannot be drawn.
class SuitePlayTest : public testing::Test {
 protected:
  SuitePlayTest() {
    fs::remove_all(folder_);
    request_ = {.name = "made",
                .count = 4,
                .seed = 2,
                .exact = true,
                .output = (folder_ / "out.h5").string(),
                .threads = 1};
  }
  ~SuitePlayTest() override { fs::remove_all(folder_); }

  SuiteBench bench() {
    EncounterSource source{
        .what = "standing cars", .count = request_.count, .notes = {"Made by hand."}, .at = {}};
    source.at = [this](std::uint64_t number) -> Result<eval::SuiteEncounter> {
      ++drawn_;
      if (number == 2) {
        return Error{Error::Code::out_of_range, "no such car"};
      }
      return eval::SuiteEncounter{
          .number = number,
          .family = "made",
          .scenario = eval::standing_car(19.0, 60.0 + static_cast<double>(number)),
          .twin = {}};
    };
    return {.source = std::move(source),
            .setup = std::make_shared<const runtime::PlanesSetup>(
                runtime::PlanesSetup{.forecast = {&car_, &harm_}, .clock = &clock_}),
            .intent = std::make_shared<const intent::Model>(intent::shipped_model()),
            .thinking = std::move(SuiteThinking::open({}, {}, {}, 1, clock_)).value(),
            .danger = nullptr,
            .imitators = std::make_shared<const eval::Imitators>()};
  }

  Result<std::optional<SuiteRun>> play(const std::vector<std::string>& methods) {
    return play_suite(bench(), request_, methods,
                      {.command = "suite",
                       .version = "1.2",
                       .built_from = "1.2 (commit abc)",
                       .display = long_work::ProgressDisplay::silent});
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
  fs::path folder_ = fs::path(testing::TempDir()) / "saca_suite_play_test";
  SuiteRequest request_;
  int drawn_ = 0;
};

TEST_F(SuitePlayTest, GivesARowForEachEncounter) {
  const auto played = play({"aeb", "nothing"});
  ASSERT_TRUE(played.has_value()) << played.error().message;
  const SuiteRun& run = played.value().value();
  EXPECT_THAT(run.methods, ElementsAre("aeb", "nothing"));
  EXPECT_THAT(run.notes, ElementsAre("Made by hand."));
  ASSERT_EQ(run.rows.size(), 4U);
  EXPECT_EQ(run.worked, 4);
  EXPECT_GE(run.seconds, 0.0);
  EXPECT_EQ(run.rows[2].fault, "no such car");
  EXPECT_EQ(run.rows[2].family, "?");
  EXPECT_EQ(run.rows[3].fault, "");
  EXPECT_LT(run.rows[0].risk.runs[0].harm, run.rows[0].risk.runs[1].harm);
  EXPECT_EQ(run.meta.at("meta.command"),
            "saca suite made --methods aeb,nothing --count 4 --split calibration --car "
            "compact_rwd_ev --seed 2 --exact");
  EXPECT_EQ(run.meta.at("meta.n"), "4");
  EXPECT_EQ(run.meta.at("meta.version"), "1.2");
  EXPECT_FALSE(run.meta.contains("meta.memory"));
  EXPECT_FALSE(run.tried_in(run.encounter_at(0).value())->tried.empty());
}

TEST_F(SuitePlayTest, GoesOnFromItsJournal) {
  request_.count = 2;
  const auto first = play({"aeb"});
  ASSERT_TRUE(first.has_value()) << first.error().message;
  EXPECT_EQ(drawn_, 2);
  request_.count = 4;
  const SuiteRun run = play({"aeb"}).value().value();
  EXPECT_EQ(drawn_, 4);
  EXPECT_EQ(run.worked, 2);
  ASSERT_EQ(run.rows.size(), 4U);
  EXPECT_EQ(eval::line_of(run.rows[1]), eval::line_of(first.value().value().rows[1]));
  request_.count = 1;
  EXPECT_EQ(play({"aeb"}).value().value().rows.size(), 1U);
  EXPECT_EQ(drawn_, 4);
}

TEST_F(SuitePlayTest, AJournalOfOtherWorkIsRefused) {
  request_.count = 1;
  ASSERT_TRUE(play({"aeb"}).has_value());
  const std::string journal = request_.output + ".journal";
  EXPECT_THAT(read_file(journal).value(),
              AllOf(HasSubstr("saca 1.2 (commit abc) suite of standing cars, intentions "),
                    HasSubstr(", compact_rwd_ev, seed 2, exact: aeb\n")));
  request_.no_twins = true;
  EXPECT_FALSE(play({"aeb"}).has_value()) << "rows with twins are others";
  request_.no_twins = false;
  const auto other = play({"nothing"});
  ASSERT_FALSE(other.has_value());
  EXPECT_EQ(other.error().code, Error::Code::malformed);
}

TEST_F(SuitePlayTest, AJournalWithoutALineIsRefused) {
  request_.count = 2;
  ASSERT_TRUE(play({"aeb"}).has_value());
  const std::string journal = request_.output + ".journal";
  std::string text = read_file(journal).value();
  const std::size_t line = text.find('\n') + 1;
  text.erase(line, text.find('\n', line) + 1 - line);  // that of encounter 0
  ASSERT_FALSE(write_file(journal, text).has_value());
  EXPECT_EQ(play({"aeb"}).error().message, journal + ": line 2: another encounter's");
}

TEST_F(SuitePlayTest, ReplaysWhatWasPlayed) {
  const EncounterSource source = bench().source;
  const auto exact = replay_of(source, request_, 1);
  ASSERT_TRUE(exact.has_value()) << exact.error().message;
  EXPECT_EQ(exact.value().file, "runs/made-calibration-1.toml");
  EXPECT_EQ(exact.value().command,
            "saca run runs/made-calibration-1.toml --pace lockstep --llm off --no-memory");
  EXPECT_EQ(exact.value().text, scenario::write_scenario(eval::standing_car(19.0, 61.0)));
  request_.exact = false;
  request_.thinking = {.memory = "bank.db", .model = "local", .untuned = ""};
  const auto drawn = replay_of(source, request_, 1).value();
  EXPECT_EQ(drawn.command,
            "saca run runs/made-calibration-1.toml --pace lockstep --llm local --danger off "
            "--no-learning --memory bank.db --seed " +
                std::to_string(eval::encounter_seed(2, 1)));
  EXPECT_NE(drawn.text, exact.value().text);  // with the usual perception
  EXPECT_EQ(replay_of(source, request_, 2).error().message, "no such car");
}

TEST(HowOf, RecordedDriversAreComparedInTheirOwnWorld) {
  EXPECT_FALSE(how_of({.name = "natural"}, {"aeb"}).exact);
  EXPECT_TRUE(how_of({.name = "natural", .exact = true}, {"aeb"}).exact);
  EXPECT_TRUE(how_of({.name = "100car"}, {"aeb"}).exact);
  EXPECT_EQ(how_of({.name = "natural", .seed = 9}, {"aeb"}).seed, 9U);
}

}  // namespace
}  // namespace saca::suites::suite_play_test
