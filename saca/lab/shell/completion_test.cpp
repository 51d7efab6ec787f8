#include "saca/lab/shell/completion.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/shell/line_for_test.h"

namespace saca::shell::completion_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Whether bash takes the script and then offers these words, each followed by a space.
std::string offered(const std::string& line, const std::string& last) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::string("completion_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  EXPECT_EQ(write_file(file, bash_completion(small_line()) + "\nCOMP_WORDS=(" + line + " '" + last +
                                 "')\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_saca\n" +
                                 "echo -n \"${COMPREPLY[*]}\" > " + file.string() + ".out\n"),
            std::nullopt);
  EXPECT_EQ(std::system(("bash " + file.string()).c_str()), 0);
  return read_file(file.string() + ".out").value();
}

TEST(Bash, OffersCommandsOptionsAndTheWordsThatOneTakes) {
  EXPECT_EQ(offered("saca", ""), "run memory");
  EXPECT_EQ(offered("saca memory", "l"), "list");
  EXPECT_EQ(offered("saca run", "--"), "--pace --report");
  EXPECT_EQ(offered("saca run --pace", "l"), "lockstep");
  EXPECT_EQ(offered("saca run --pace =", "r"), "real");
  EXPECT_EQ(offered("saca memory list", "n"), "new");
}

TEST(Bash, AsksTheProgramForScenariosOnlyWhereOneIsWanted) {
  const std::string script = bash_completion(small_line());
  EXPECT_THAT(script, HasSubstr("    \"saca run\")\n      options=\"--pace --report\"\n"
                                "      words=\"$(saca scenarios 2>/dev/null | cut -d\" \" -f1)\" "
                                ";;\n"));
  EXPECT_THAT(script, HasSubstr("\"saca memory list\")\n      options=\"--at-s\"\n"
                                "      words=\"old new\" ;;\n"));
}

TEST(Zsh, HasWordsWithWhatTheyDoColonsAndQuotesEscaped) {
  const std::string script = zsh_completion(small_line());
  EXPECT_THAT(script, HasSubstr("#compdef saca\n"));
  EXPECT_THAT(script, HasSubstr("'run:Play it: don'\\''t wait' 'memory:What was met'"));
  EXPECT_THAT(script,
              HasSubstr("    (\"saca run --pace\")\n      compadd -- real lockstep; return"));
  EXPECT_THAT(script, HasSubstr("    (\"saca run --report\")\n      _files; return ;;\n"));
  EXPECT_THAT(script, Not(HasSubstr("--quiet\")\n      _files")));  // a flag takes nothing
}

TEST(Zsh, TakesAWordWithAColonApartFromWhatItDoes) {
  LineDescription line = small_line();
  line[0].options = {{.names = {"--a:b"}, .about = "c"}};
  EXPECT_THAT(zsh_completion(line), HasSubstr(" '--a\\:b:c'"));
}

TEST(Fish, HasALineForEachWordAndOption) {
  const std::string script = fish_completion(small_line());
  EXPECT_THAT(script,
              HasSubstr("            case \"saca run\" \"saca memory\" \"saca memory list\"\n"));
  EXPECT_THAT(script,
              HasSubstr("complete -c saca -n 'test (__saca_command) = \"saca\"' -f -a memory"
                        " -d 'What was met'\n"));
  EXPECT_THAT(script, HasSubstr("= \"saca\"' -s q -l quiet -d 'Says nothing'\n"));
  EXPECT_THAT(script, HasSubstr("= \"saca run\"' -l pace -x -a 'real lockstep' -d 'How fast'\n"));
  EXPECT_THAT(script, HasSubstr("= \"saca run\"' -l report -r -d 'Where the page goes'\n"));
  EXPECT_THAT(script, HasSubstr("= \"saca memory list\"' -f -a 'old new'\n"));
}

}  // namespace
}  // namespace saca::shell::completion_test
