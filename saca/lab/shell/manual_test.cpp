#include "saca/lab/shell/manual.h"

#include <gmock/gmock.h>

#include "saca/base/core/contract.h"
#include "saca/lab/shell/line_for_test.h"

namespace saca::shell::manual_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Manual small_manual() {
  return {.version = "1.2.3", .line = small_line(), .exit_codes = {{0, "done"}, {4, "no room"}}};
}

TEST(Troff, SeesNoCommandInAText) {
  EXPECT_EQ(troff(".TP"), "\\&.TP");
  EXPECT_EQ(troff("a\n'b"), "a\n\\&'b");
  EXPECT_EQ(troff("--x \\n a.b"), "\\-\\-x \\en a.b");
  EXPECT_EQ(troff(""), "");
}

TEST(TheProgramsPage, HasOptionsCommandsExitCodesAndEnvironment) {
  const ManualPage page = program_page(small_manual());
  EXPECT_EQ(page.name, "saca");
  EXPECT_THAT(page.text, StartsWith(".\\\" Made by `saca man`.\n"
                                    ".TH SACA 1 \"\" \"saca 1.2.3\" \"SACA\"\n.ad l\n"
                                    ".SH NAME\nsaca \\- Avoids crashes.\n"
                                    ".SH SYNOPSIS\n\\fBsaca\\fR [\\fIOPTION\\fR]... "
                                    "\\fICOMMAND\\fR ...\n.SH OPTIONS\n"));
  EXPECT_THAT(page.text, HasSubstr(".TP\n\\fB\\-q\\fR, \\fB\\-\\-quiet\\fR\nSays nothing\n"));
  EXPECT_THAT(page.text, HasSubstr(".SH COMMANDS\n.TP\n\\fBrun\\fR\nPlay it: don't wait\n"
                                   ".TP\n\\fBmemory\\fR\nWhat was met\n.SH EXIT STATUS\n"
                                   ".TP\n\\fB0\\fR\ndone\n.TP\n\\fB4\\fR\nno room\n"
                                   ".SH ENVIRONMENT\n.TP\n\\fBXDG_CACHE_HOME\\fR\n"));
  EXPECT_THAT(page.text, Not(HasSubstr("pace")));
}

TEST(ACommandsPage, TellsOfItsArgumentsAndWhatIsNeeded) {
  const ManualPage page = command_page(small_manual(), "saca run");
  EXPECT_EQ(page.name, "saca-run");
  EXPECT_THAT(page.text, HasSubstr(".TH SACA\\-RUN 1 "));
  EXPECT_THAT(page.text, HasSubstr("\\fBsaca run\\fR [\\fIOPTION\\fR]... \\fIscenario\\fR\n"));
  EXPECT_THAT(page.text, HasSubstr(".TP\n\\fIscenario\\fR\nA file (needed)\n"));
  EXPECT_THAT(page.text, HasSubstr(".TP\n\\fB\\-\\-pace\\fR \\fITEXT\\fR\n"
                                   "How fast. One of: real, lockstep.\n"));
  EXPECT_THAT(page.text, HasSubstr("\\fBsaca\\fR(1) for exit status"));
}

TEST(ACommandsPage, HoldsTheCommandsBelowIt) {
  const ManualPage page = command_page(small_manual(), "saca memory");
  EXPECT_THAT(page.text, HasSubstr("\\fBsaca memory\\fR \\fICOMMAND\\fR ...\n.br\n"
                                   "\\fBsaca memory list\\fR [\\fIOPTION\\fR]... "
                                   "[\\fIorder\\fR]\n"));
  EXPECT_THAT(page.text, HasSubstr(".SH \"saca memory list\"\nAll cases\n.TP\n\\fIorder\\fR\n"
                                   "One of: old, new.\n"));
  EXPECT_THROW((void)command_page(small_manual(), "saca rnu"), ContractViolation);
}

TEST(AllPages, AreThatOfTheProgramAndOneForEachCommand) {
  const auto pages = manual_pages(small_manual());
  ASSERT_EQ(pages.size(), 3U);
  EXPECT_EQ(pages[0].text, program_page(small_manual()).text);
  EXPECT_EQ(pages[1].name, "saca-run");
  EXPECT_EQ(pages[2].text, command_page(small_manual(), "saca memory").text);
}

}  // namespace
}  // namespace saca::shell::manual_test
