#include "saca/lab/cases/example_sets.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/cases/cases_for_test.h"

namespace saca::cases::example_sets_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;
using testing::HasSubstr;

/// Two of the set for training, a twin among them; one for tests.
std::vector<ReplyExample> three_examples() {
  ReplyExample one{.record = "fars_1", .family = "rear_end", .prompt = "abc", .reply = "de"};
  one.admissible.set(index(PolicyId::aeb));
  ReplyExample twin = one;
  twin.is_twin = true;
  twin.choice = PolicyId::no_intervention;
  twin.admissible.set(index(PolicyId::no_intervention));
  ReplyExample other = one;
  other.set = ExampleSet::test;
  other.family = "crossing";
  return {one, twin, other};
}

ExampleSource source_by_hand() {
  ExampleSource source;
  source.cases = {case_by_hand()};
  source.recorded = 2;
  source.test_only = 3;
  source.tools = shipped().tools();
  return source;
}

TEST(ExampleSets, AreCounted) {
  const SetTallies tallies = set_tallies(three_examples());
  ASSERT_EQ(tallies.size(), 3U) << "the empty one, too";
  const SetTally& train = tallies.at(ExampleSet::train);
  EXPECT_EQ(train.examples, 2);
  EXPECT_EQ(train.twins, 1);
  EXPECT_EQ(train.choosable, 1) << "in the twin two are admissible";
  EXPECT_EQ(train.choices.at("NI"), 1);
  EXPECT_EQ(train.tokens, 2 * tallies.at(ExampleSet::test).tokens);
  EXPECT_GT(train.tokens, 0);
  EXPECT_EQ(tallies.at(ExampleSet::calibration).examples, 0);
}

// Keys as docs/formats.md has them.
TEST(ExampleSets, HaveFiguresAndATable) {
  const SetTallies tallies = set_tallies(three_examples());
  const nlohmann::json figures = sets_json(source_by_hand(), tallies, 4);
  EXPECT_EQ(figures.at("export.num_cases"), 1);
  EXPECT_EQ(figures.at("export.num_recorded"), 2);
  EXPECT_EQ(figures.at("export.num_test_only"), 3);
  EXPECT_EQ(figures.at("export.num_failed"), 4);
  EXPECT_EQ(figures.at("export.train.num_examples"), 2);
  EXPECT_EQ(figures.at("export.train.choice.AEB"), 1);
  EXPECT_EQ(figures.at("export.train.choice.T-D-L"), 0);
  EXPECT_EQ(figures.at("export.calibration.num_twins"), 0);
  const std::string text = sets_text(source_by_hand(), tallies, "sets");
  EXPECT_THAT(text, testing::StartsWith("set           examples  twins  choosable  tokens <=\n"));
  EXPECT_THAT(text, HasSubstr("\ntrain                2      1          1 "));
  EXPECT_THAT(text,
              HasSubstr("\nsets: of 1 cases; left out: 2 recorded, 3 of families for tests\n"));
}

TEST(ExampleSets, TellOfThemselvesInMarkdown) {
  const std::string card =
      data_card(source_by_hand(), set_tallies(three_examples()), "cases export a.jsonl", "1.2.3");
  EXPECT_THAT(card, HasSubstr("Made by `saca cases export a.jsonl` (version 1.2.3)."));
  EXPECT_THAT(card, HasSubstr("2 recorded emergencies, 3 cases of families"));
  EXPECT_THAT(card, HasSubstr("\n| train | rear_end | 2 |\n"));
  EXPECT_THAT(card, HasSubstr("\n| test | AEB | 1 |\n"));
  EXPECT_THAT(card, HasSubstr("FARS is in the public domain."));
}

TEST(ExampleSets, AreWrittenAFileEach) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "example_sets";
  std::filesystem::remove_all(folder);
  ASSERT_FALSE(
      write_sets(folder, three_examples(), SetFormat::local, "fixed part", "card").has_value());
  EXPECT_EQ(read_file(folder / "train.jsonl").value(),
            "{\"examples\":2,\"schema\":\"saca.reply_examples/1\"}\n" +
                to_json(three_examples()[0]).dump() + "\n" + to_json(three_examples()[1]).dump() +
                "\n");
  EXPECT_EQ(read_file(folder / "calibration.jsonl").value(),
            "{\"examples\":0,\"schema\":\"saca.reply_examples/1\"}\n");
  EXPECT_EQ(read_file(folder / "system.txt").value(), "fixed part");
  EXPECT_EQ(read_file(folder / "README.md").value(), "card");
  ASSERT_FALSE(write_sets(folder, three_examples(), SetFormat::openai, "fixed part", "card"));
  EXPECT_EQ(read_file(folder / "test.jsonl").value(),
            R"({"messages":[{"content":"fixed part","role":"system"},)"
            R"({"content":"abc","role":"user"},{"content":"de","role":"assistant"}]})"
            "\n");
  EXPECT_EQ(read_file(folder / "calibration.jsonl").value(), "");
  ASSERT_FALSE(write_file(folder / "file", "x").has_value());
  EXPECT_EQ(write_sets(folder / "file", {}, SetFormat::local, "", "")->code,
            Error::Code::unwritable);
}

TEST(ExampleSets, FormatsHaveNames) {
  EXPECT_EQ(set_format_from("local"), SetFormat::local);
  EXPECT_EQ(set_format_from("openai"), SetFormat::openai);
  EXPECT_EQ(set_format_from("chat"), std::nullopt);
}

TEST(ExampleSets, HoldTheExamplesOfAllCases) {
  ExampleSource source = source_by_hand();
  source.cases.push_back(case_by_hand());
  source.cases.back().kind.reset();
  const std::filesystem::path journal =
      std::filesystem::path(testing::TempDir()) / "example_sets_journal" / "journal";
  std::filesystem::remove(journal);
  const ExampleWork work{.journal = journal.string(),
                         .title = "saca cases export",
                         .display = long_work::ProgressDisplay::silent};
  const auto all = all_examples(source, work).value().value();
  ASSERT_FALSE(all.items.empty());
  EXPECT_EQ(all.items[0].record, "fars_2016_40001");
  EXPECT_EQ(all.problems.size(), 1U);
  const auto again = all_examples(source, work).value().value();  // from the journal
  ASSERT_EQ(again.items.size(), all.items.size());
  EXPECT_EQ(to_json(again.items[0]), to_json(all.items[0]));
  source.digest = 1;
  EXPECT_THAT(all_examples(source, work).error().message, HasSubstr("journal"));
}

}  // namespace
}  // namespace saca::cases::example_sets_test
