#include "saca/lab/shell/refusal.h"

#include <gmock/gmock.h>

#include "saca/lab/shell/line_for_test.h"

namespace saca::shell::refusal_test {
namespace {

using testing::ElementsAre;

TEST(Spelling, JoinsTheWordsOfAnOptionAndLeavesValuesAndFiles) {
  EXPECT_THAT(as_spelt({"run", "--at_s=a_b", "--x_y", "a_b", "-z_", "--", "--c_d"}),
              ElementsAre("run", "--at-s=a_b", "--x-y", "a_b", "-z_", "--", "--c_d"));
  EXPECT_THAT(as_spelt({}), testing::IsEmpty());
}

/// What is said of a line whose innermost command is this one of `small_line`.
std::string refused(std::size_t command, const std::vector<std::string>& left,
                    bool incomplete_or_left = true) {
  const LineDescription line = small_line();
  return refusal({.program = line[0],
                  .command = line[command],
                  .left = left,
                  .incomplete_or_left = incomplete_or_left,
                  .problem = "its reader's words"});
}

TEST(ARefusal, TellsWhichOptionWasLikelyMeant) {
  EXPECT_EQ(refused(1, {"--pac=real"}),
            "run: no option is called --pac; did you mean '--pace'? (`saca run --help`)");
  EXPECT_EQ(refused(3, {"x", "--at"}),
            "memory list: no option is called --at; did you mean '--at-s'? "
            "(`saca memory list --help`)");
}

TEST(ARefusal, TellsWhereAnOptionOfTheProgramStands) {
  EXPECT_EQ(refused(1, {"--quiet"}),
            "run: --quiet stands before the command: saca --quiet ... (`saca run --help`)");
}

TEST(ARefusal, TellsWhichCommandWasLikelyMeantOrThatNoneIsWanted) {
  EXPECT_EQ(refused(0, {"rnu"}), "no command is called 'rnu'; did you mean 'run'? (`saca --help`)");
  EXPECT_EQ(refused(1, {"-4"}), "run: want no more arguments, got '-4' (`saca run --help`)");
  EXPECT_EQ(refused(2, {}),
            "memory: a command is missing; want one of list (`saca memory --help`)");
}

TEST(ARefusal, ElseIsWhatTheReaderSays) {
  EXPECT_EQ(refused(1, {}), "run: its reader's words (`saca run --help`)");
  EXPECT_EQ(refused(1, {"--pac"}, false), "run: its reader's words (`saca run --help`)");
}

}  // namespace
}  // namespace saca::shell::refusal_test
