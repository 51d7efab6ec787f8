#include "saca/thinking/language_model/prompt_lines.h"

#include <gtest/gtest.h>

namespace saca::language_model::prompt_lines_test {
namespace {

TEST(PromptLines, AreFoundByTheirBeginningAlone) {
  const std::string_view prompt = "car1: far\nno car2: x\ncar2: 3.0 m ahead\ncar22: near";
  EXPECT_EQ(rest_of_line(prompt, "car1: "), "far");
  EXPECT_EQ(rest_of_line(prompt, "car2: "), "3.0 m ahead");
  EXPECT_EQ(rest_of_line(prompt, "car22: "), "near");
  EXPECT_EQ(rest_of_line(prompt, "car3: "), "");
  EXPECT_EQ(rest_of_line("", "car3: "), "");
}

TEST(PromptLines, OfARoadUserAreReadPieceByPiece) {
  const ActorLine told = read_actor_line(
      "16 m ahead, 6.4 m left, moving right at 7.5 m/s, not seen now, lane change right 0.88, "
      "TTC 0.9 s, risk "
      "0.94");
  EXPECT_EQ(told.along, "16 m ahead");
  EXPECT_EQ(told.across, "6.4 m left");
  EXPECT_EQ(told.intention, "lane change right 0.88");
  EXPECT_EQ(told.conflict, "TTC 0.9 s");
  EXPECT_EQ(told.risk, "risk 0.94");
}

TEST(PromptLines, NobodyIsInTheWayOfWhomNoTimeIsTold) {
  const ActorLine told = read_actor_line("2.0 m behind, 3.0 m right, standing, maintain 0.90");
  EXPECT_EQ(told.along, "2.0 m behind");
  EXPECT_EQ(told.across, "3.0 m right");
  EXPECT_EQ(told.intention, "maintain 0.90");
  EXPECT_EQ(told.conflict, "");
  EXPECT_EQ(told.risk, "");
  EXPECT_EQ(read_actor_line("").along, "");
  EXPECT_EQ(read_actor_line("8.0 m long, 2.5 m wide, 16 m ahead, 0.0 m left, risk 0.94").intention,
            "");
}

}  // namespace
}  // namespace saca::language_model::prompt_lines_test
