#include "saca/lab/reach_study/case_solution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <span>

#include "saca/base/core/file.h"

namespace saca::reach_study::case_solution_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Mitchell's game on a few points, for a short while.
levelset::Problem small_game() {
  levelset::Problem problem = levelset::air3d_problem(levelset::air3d_grid(12, 12, 10));
  problem.times = {0.2, 0.4};
  return problem;
}

class CaseSolution : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(testing::TempDir()) / "case_solution" /
                           testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] CaseTask task() const {
    return {.name = "game",
            .output = folder_ / "made" / "a.h5",
            .scheme = {.with_error = false},
            .memory_mib = 100.0,
            .display = long_work::ProgressDisplay::silent};
  }
  [[nodiscard]] fs::path part() const { return folder_ / "made" / "a.h5.part"; }
};

TEST_F(CaseSolution, IsKeptWhereItWasAskedFor) {
  const auto solved = solve_case(small_game(), task());
  ASSERT_TRUE(solved.has_value()) << solved.error().message;
  EXPECT_TRUE(solved.value().solution.complete);
  EXPECT_FALSE(fs::exists(part()));
  const auto kept = danger::read_solved(task().output);
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept.value().times, (std::vector{0.2, 0.4}));
  EXPECT_EQ(kept.value().values, solved.value().solution.values);
}

TEST_F(CaseSolution, GoesOnWithWhatWasBegun) {
  levelset::Problem shorter = small_game();
  shorter.times.pop_back();
  const auto begun = levelset::solve(shorter, task().scheme, std::nullopt, {});
  ASSERT_TRUE(begun.has_value());
  fs::create_directories(part().parent_path());
  ASSERT_EQ(danger::write_solved(part(), begun.value()), std::nullopt);
  const auto solved = solve_case(small_game(), task());
  ASSERT_TRUE(solved.has_value()) << solved.error().message;
  const auto at_once = levelset::solve(small_game(), task().scheme, std::nullopt, {});
  EXPECT_EQ(solved.value().solution.values, at_once.value().values);
}

TEST_F(CaseSolution, RefusesToGoOnWithAnotherAndKeepsIt) {
  const auto other = levelset::solve(small_game(), {.cfl = 0.5, .with_error = false}, {}, {});
  fs::create_directories(part().parent_path());
  ASSERT_EQ(danger::write_solved(part(), other.value()), std::nullopt);
  const auto refused = solve_case(small_game(), task());
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("game: it was begun by"));
  EXPECT_TRUE(fs::exists(part()));
  ASSERT_EQ(write_file(part(), "nothing of the kind"), std::nullopt);
  EXPECT_THAT(solve_case(small_game(), task()).error().message, HasSubstr("a.h5.part"));
}

// 1440 floats, and what marching takes besides.
TEST_F(CaseSolution, RefusesWhatTakesTooMuchMemory) {
  CaseTask small = task();
  small.memory_mib = 0.001;
  const auto refused = solve_case(small_game(), small);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::out_of_range);
  EXPECT_THAT(refused.error().message, HasSubstr("game: 1440 cells take "));
  EXPECT_THAT(refused.error().message,
              HasSubstr("--memory-mib allows 0 MiB; take fewer points or snapshots"));
  EXPECT_FALSE(fs::exists(folder_ / "made"));
  small.scheme.doubles = true;
  EXPECT_THAT(why_too_large(small_game(), small).value().message,
              testing::EndsWith("snapshots, or no --double"));
  EXPECT_EQ(why_too_large(small_game(), task()), std::nullopt);
}

TEST_F(CaseSolution, WantsAFileToWrite) {
  CaseTask into_folder = task();
  into_folder.output = folder_;
  const auto refused = solve_case(small_game(), into_folder);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
  EXPECT_THAT(refused.error().message, HasSubstr("is a folder"));
  into_folder.output = "/dev/null";
  EXPECT_THAT(solve_case(small_game(), into_folder).error().message,
              HasSubstr("/dev/null: is no file, want a file"));
}

using CaseSolutionDeathTest = CaseSolution;

/// An interrupt stays one: it gets a process of its own.
TEST_F(CaseSolutionDeathTest, StopsAtAnInterruptAndKeepsWhatThereIs) {
  EXPECT_EXIT(
      {
        levelset::Problem problem = small_game();
        const auto in_floats = problem.in_floats;
        problem.in_floats = [in_floats](const danger::Grid& grid, levelset::Differences by) {
          (void)std::raise(SIGINT);  // once it is watched for
          return in_floats(grid, by);
        };
        const auto stopped = solve_case(problem, task());
        const bool right = !stopped.has_value() && stopped.error().code == Error::Code::too_late &&
                           stopped.error().message.find("of 0.4 s; the same command goes on from " +
                                                        part().string()) != std::string::npos &&
                           fs::exists(part());
        std::_Exit(right ? EXIT_SUCCESS : EXIT_FAILURE);
      },
      testing::ExitedWithCode(EXIT_SUCCESS), "");
  EXPECT_FALSE(fs::exists(task().output));
}

}  // namespace
}  // namespace saca::reach_study::case_solution_test
