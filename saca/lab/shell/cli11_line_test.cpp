#include "saca/lab/shell/cli11_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace saca::shell::cli11_line_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Cli11Line : public testing::Test {
 protected:
  Cli11Line() {
    line_.add_flag("--quiet", quiet_, "Less");
    CLI::App* const run = line_.add_subcommand("run", "Plays");
    run->add_option("scenario", text_, "Which")->required();
    run->add_option("-o,--output", text_, "Where");
    run->add_option("--pace", text_, "How fast")
        ->check(CLI::IsMember({"real", "lockstep"}))
        ->default_str("real");
    run->add_option("--secret", text_, "Hidden")->group("");
    run->add_option_group("which")->add_option("--event", text_, "One of a group");
    line_.add_subcommand("internal", "Hidden")->group("");
    line_.add_subcommand("memory", "Cases")->add_subcommand("list", "All");
  }
  CLI::App line_{"What it is for.", "saca"};
  bool quiet_ = false;
  std::string text_;
};

TEST_F(Cli11Line, HasEveryCommandBelowIt) {
  const LineDescription all = described(line_);
  std::vector<std::string> names;
  for (const CommandDescription& command : all) {
    names.push_back(command.name);
  }
  EXPECT_THAT(names, ElementsAre("saca", "saca run", "saca memory", "saca memory list"));
  EXPECT_EQ(all[0].about, "What it is for.");
  EXPECT_THAT(all[0].commands, ElementsAre("run", "memory"));
  EXPECT_THAT(all[3].commands, IsEmpty());
}

TEST_F(Cli11Line, HasTheOptionsOfACommand) {
  const LineDescription all = described(line_);
  const CommandDescription& run = all[1];
  ASSERT_EQ(run.positionals.size(), 1U);
  EXPECT_EQ(run.positionals[0].names.front(), "scenario");
  EXPECT_TRUE(run.positionals[0].needed);
  std::vector<std::vector<std::string>> names;
  for (const OptionDescription& option : run.options) {
    names.push_back(option.names);
  }
  // --help is CLI11's own; groups of options belong to their command; hidden ones are left out.
  EXPECT_THAT(names, ElementsAre(ElementsAre("-h", "--help"), ElementsAre("-o", "--output"),
                                 ElementsAre("--pace"), ElementsAre("--event")));
  EXPECT_THAT(run.options[2].choices, ElementsAre("real", "lockstep"));
  EXPECT_THAT(run.options[2].about, testing::HasSubstr("real"));
}

TEST_F(Cli11Line, WhyItCannotBeDoneNamesWhatWasLikelyMeant) {
  const auto why = [&](std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());
    try {
      line_.parse(std::move(words));
    } catch (const CLI::ParseError& problem) {
      return refusal(line_, problem);
    }
    return std::string("nothing");
  };
  EXPECT_THAT(why({"run", "s", "--event", "1", "--otput", "x"}), testing::HasSubstr("--output"));
  EXPECT_THAT(why({"rnu"}), testing::HasSubstr("run"));
  EXPECT_THAT(why({"run", "s", "--pace", "slow"}), testing::HasSubstr("--pace"));
}

}  // namespace
}  // namespace saca::shell::cli11_line_test
