#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/levelset/solve.h"
#include "saca/lab/verification/known_systems.h"

// In a program of its own: a child begins with as little memory as can be, and its peak is that of
// what is asked.
namespace saca::levelset::solve_memory_test {
namespace {

namespace fs = std::filesystem;

/// What the system says of this process: VmRSS or VmHWM [bytes].
double own_memory(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    double kib = 0.0;
    if (word == key + ":" && file >> kib) {
      return 1024.0 * kib;
    }
  }
  return 0.0;
}

/// By how much the peak of a process of its own rises over what it begins with [bytes].
template <class Work>
double rise(const Work& work) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const double before = own_memory("VmRSS");
    work();
    const double rise = own_memory("VmHWM") - before;
    std::_Exit(::write(ends[1], &rise, sizeof(rise)) == sizeof(rise) ? 0 : 1);
  }
  double found = 0.0;
  EXPECT_EQ(::read(ends[0], &found, sizeof(found)), ssize_t{sizeof(found)});
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  return found;
}

/// Few steps on many cells: a value that moves slowly. It cannot be compressed.
Problem moving(int points, int snapshots) {
  Problem problem;
  problem.text = "moving";
  problem.grid.axes = {{.name = "x", .first = -1.0, .last = 1.0, .points = points},
                       {.name = "y", .first = -1.0, .last = 1.0, .points = points}};
  for (int i = 1; i <= snapshots; ++i) {
    problem.times.push_back(1e-6 * i);
  }
  problem.unsafe = [](std::span<const double> x) {
    return std::fmod(1e4 * std::sin(1e5 * (x[0] + 7.0 * x[1])), 1.0);
  };
  problem.in_floats = [](const danger::Grid& grid, Differences differences) {
    return verification::known_flow<float>(grid, verification::DoubleIntegrator{1.0}, differences);
  };
  problem.in_doubles = [](const danger::Grid& grid, Differences differences) {
    return verification::known_flow<double>(grid, verification::DoubleIntegrator{1.0}, differences);
  };
  return problem;
}

class Memory : public testing::Test {
 protected:
  Memory() {
    std::string name = (fs::temp_directory_path() / "saca_memory_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~Memory() override { fs::remove_all(folder_); }

  /// Solves and keeps all, from what an earlier one left; stops at a time.
  void solve_and_keep(const Problem& problem, const Scheme& scheme, double stop) const {
    const fs::path file = folder_ / "a.h5";
    std::optional<danger::Solution> begun;
    if (fs::exists(file)) {
      begun = danger::read_solved(file).value();
    }
    const auto solved = solve(
        problem, scheme, std::move(begun),
        {.step = [stop](double tau) { return tau < stop; },
         .keep =
             [&](const danger::Solution& so_far) { return danger::write_solved(file, so_far); }});
    if (!solved.has_value() || solved.value().complete == (stop < 1.0)) {
      std::_Exit(2);
    }
  }

  /// Beside the peak: enough, and not half as much again.
  void expect_predicted(const Problem& problem, const Scheme& scheme) const {
    fs::remove(folder_ / "a.h5");
    const auto told = static_cast<double>(memory_needed(problem, scheme));
    const double whole = rise([&] { solve_and_keep(problem, scheme, 1.0); });
    EXPECT_LE(whole, told);
    EXPECT_GE(whole, 0.67 * told);
    fs::remove(folder_ / "a.h5");
    const double late = 0.5 * (problem.times.back() + problem.times.front());
    EXPECT_LE(rise([&] { solve_and_keep(problem, scheme, late); }), told);
    EXPECT_LE(rise([&] { solve_and_keep(problem, scheme, 1.0); }), told);
  }

  fs::path folder_;
};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitised = true;
#else
constexpr bool sanitised = false;
#endif

TEST_F(Memory, OfSolvingIsForetold) {
  if (sanitised) {
    GTEST_SKIP() << "a sanitiser takes memory of its own";
  }
  const Scheme floats{.differences = Differences::upwind1, .steps = Steps::tvd_rk2, .threads = 2};
  Scheme doubles = floats;
  doubles.doubles = true;
  expect_predicted(moving(1000, 1), floats);
  expect_predicted(moving(500, 4), doubles);
}

}  // namespace
}  // namespace saca::levelset::solve_memory_test
