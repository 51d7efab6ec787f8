#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <optional>
#include <string>

#include "saca/onboard/match/example_scenes.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/scene_json.h"
#include "saca/thinking/memory/store.h"

namespace saca::memory {

// What the tests of this module's tables share.

/// A change to what this says.
inline Store::Change becomes(const Case& changed) {
  return [changed](Case& one) {
    one = changed;
    return true;
  };
}

inline Case example_case(std::uint32_t seed) {
  std::mt19937 rng(seed);
  Case one;
  one.scene = match::random_scene(rng, static_cast<int>(seed % 9));
  one.plan = {manoeuvre::PolicyId::es_b_right, 0.1 * seed};
  one.best = manoeuvre::PolicyId::aeb;
  one.harm = 0.3 / (seed + 1.0);
  one.best_harm = 0.1 / (seed + 1.0);
  one.collision_loss = 1.0 / 3.0;
  one.review = "stopped 0.4 m later than forecast; \"wet\" – 'perhaps'";
  one.source = "case " + std::to_string(seed);
  one.origin = Origin::simulation;
  one.trust = seed % 2 == 0 ? Trust::trusted : Trust::unchecked;
  one.count = static_cast<int>(seed) + 1;
  one.worst_harm = 2.0 / 3.0;
  one.told = PolicyHarms{0.1, 0.2, std::nullopt, 1.0 / 7.0};
  one.lessons = {"braking alone was too late"};
  return one;
}

inline void expect_same(const Case& a, const Case& b) {
  EXPECT_EQ(to_json(a.scene), to_json(b.scene));  // all numbers to the last bit, see its own test
  EXPECT_EQ(a.plan, b.plan);
  EXPECT_EQ(a.best, b.best);
  EXPECT_EQ(a.harm, b.harm);
  EXPECT_EQ(a.best_harm, b.best_harm);
  EXPECT_EQ(a.collision_loss, b.collision_loss);
  EXPECT_EQ(a.review, b.review);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(details_json(a), details_json(b));
}

/// A process that adds cases and reports the id of each, once it is safe, through a pipe.
class Adder {
 public:
  Adder(const std::string& place, int num_cases) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    process_ = ::fork();
    if (process_ == 0) {
      auto opened = Store::open(place);
      if (!opened.has_value()) {
        ::_exit(2);
      }
      Store store = std::move(opened).value();
      for (int i = 0; i < num_cases; ++i) {
        const auto id = store.add(example_case(static_cast<std::uint32_t>(i)));
        if (!id.has_value() ||
            ::write(ends[1], &id.value(), sizeof(match::CaseId)) != sizeof(match::CaseId)) {
          ::_exit(1);
        }
      }
      ::_exit(0);
    }
    ::close(ends[1]);
    report_ = ends[0];
  }
  ~Adder() { ::close(report_); }
  Adder(const Adder&) = delete;
  Adder& operator=(const Adder&) = delete;

  /// The next id; nullopt when the process has ended.
  [[nodiscard]] std::optional<match::CaseId> next() const {
    match::CaseId id = 0;
    return ::read(report_, &id, sizeof(id)) == sizeof(id) ? std::optional(id) : std::nullopt;
  }

  void kill_after(std::chrono::microseconds delay) const {
    const timespec pause{0, std::chrono::nanoseconds(delay).count()};
    ::nanosleep(&pause, nullptr);
    ::kill(process_, SIGKILL);
  }

  /// @return  its exit status; -1 when it was killed
  [[nodiscard]] int wait() const {
    int status = 0;
    ::waitpid(process_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = 0;
  int report_ = -1;
};

}  // namespace saca::memory
