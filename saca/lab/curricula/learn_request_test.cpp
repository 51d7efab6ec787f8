#include "saca/lab/curricula/learn_request.h"

#include <gtest/gtest.h>

#include "saca/lab/suites/thinking_options.h"

namespace saca::curricula::learn_request_test {
namespace {

LearnRequest of(const std::string& name) {
  LearnRequest request;
  request.from.name = name;
  request.from.count = 200;
  return request;
}

TEST(LearnRequest, AFolderOfScenariosIsKnownByItsLastName) {
  EXPECT_EQ(suite_of(of("balanced")), "balanced");
  EXPECT_EQ(suite_of(of("my/own/scenes")), "scenes");
  EXPECT_EQ(usual_folder(of("my/own/scenes")), "runs/learn-scenes-calibration");
}

TEST(LearnRequest, TheCommandHasAllThatChangesWhatIsLearnt) {
  LearnRequest request = of("balanced");
  EXPECT_EQ(
      command_text(request),
      "learn balanced --count 200 --seeds 5 --split calibration --car compact_rwd_ev --seed 1 "
      "--lies 0.05");
  request.from.exact = true;
  request.from.no_twins = true;
  request.empty_memory = true;
  request.lies = 0.5;
  request.from.thinking.model = "local";
  EXPECT_EQ(
      command_text(request),
      "learn balanced --count 200 --seeds 5 --split calibration --car compact_rwd_ev --seed 1 "
      "--lies 0.5 --exact --no-twins --empty-memory" +
          suites::thinking_text({.memory = "", .model = "local"}));
}

}  // namespace
}  // namespace saca::curricula::learn_request_test
