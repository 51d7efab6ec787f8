#include "saca/lab/banks/bank_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "saca/lab/banks/bank_files.h"
#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::bank_statistics_test {
namespace {

using manoeuvre::PolicyId;
using memory::Situation;
using testing::HasSubstr;

/// By which a millisecond passes whenever it is looked at.
class TickingClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override {
    return looks_++ * std::chrono::milliseconds(1);
  }
  void wait_until(Time /*time*/) noexcept override {}

 private:
  mutable int looks_ = 0;
};

TEST(BankStatistics, AreMeasuredByTheClock) {
  const EmptyFolder folder;
  {
    memory::Store store = open_to_add(folder.file("bank")).value();
    ASSERT_TRUE(store
                    .add_all(std::vector{best_is(PolicyId::aeb, 10.0, "a"),
                                         best_is(PolicyId::aeb, 30.0, "b")})
                    .has_value());
  }
  const BankStatistics statistics = bank_statistics(folder.file("bank"), TickingClock()).value();
  EXPECT_EQ(statistics.name, folder.file("bank"));
  EXPECT_EQ(statistics.num_cases, 2U);
  EXPECT_DOUBLE_EQ(statistics.load, 0.001);
  EXPECT_DOUBLE_EQ(statistics.recall_median, 1'000.0);
  EXPECT_DOUBLE_EQ(statistics.recall_p99, 1'000.0);
  ASSERT_EQ(statistics.cells.size(), 7U * 4U) << "empty ones too";
  EXPECT_EQ(statistics.cells[1].cases, 1U) << "nobody, 8 to 14 m/s";
  EXPECT_EQ(statistics.cells[3].cases, 1U) << "nobody, 22 m/s and more";
}

TEST(BankStatistics, OfAnEmptyBankHaveNoTimes) {
  const EmptyFolder folder;
  ASSERT_TRUE(open_to_add(folder.file("bank")).has_value());
  const BankStatistics statistics = bank_statistics(folder.file("bank"), TickingClock()).value();
  EXPECT_EQ(statistics.num_cases, 0U);
  EXPECT_EQ(statistics.recall_median, 0.0);
  EXPECT_FALSE(bank_statistics(folder.file("none"), TickingClock()).has_value());
}

BankStatistics three_cells() {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {
      .name = "bank",
      .num_cases = 5,
      .load = 0.125,
      .recall_median = 20.0,
      .recall_p99 = 40.0,
      .cells = {
          {.situation = Situation::nobody, .speed_class = 0, .to_nearest = none},
          {.situation = Situation::oncoming,
           .speed_class = 3,
           .cases = 4,
           .braking_as_good = 1,
           .slippery = 2,
           .to_nearest = 1.5},
          {.situation = Situation::pedestrian, .speed_class = 1, .cases = 1, .to_nearest = none}}};
}

TEST(BankStatistics, ArePrintedForPrograms) {
  EXPECT_EQ(json_of(three_cells()), nlohmann::json::parse(R"({"schema": "saca.memory_stats/1",
      "file": "bank", "cases": 5, "load_s": 0.125, "recall_us": {"p50": 20.0, "p99": 40.0},
      "cells": [
       {"situation": "nobody", "from_mps": 0.0, "to_mps": 8.0, "cases": 0, "slippery": 0,
        "braking_as_good": 0, "to_nearest": null},
       {"situation": "oncoming", "from_mps": 22.0, "to_mps": null, "cases": 4, "slippery": 2,
        "braking_as_good": 1, "to_nearest": 1.5},
       {"situation": "pedestrian", "from_mps": 8.0, "to_mps": 14.0, "cases": 1, "slippery": 0,
        "braking_as_good": 0, "to_nearest": null}]})"));
}

TEST(BankStatistics, ArePrintedForPeople) {
  const std::string text = text_of(three_cells());
  EXPECT_THAT(text, testing::StartsWith("bank: 5 cases, opened in 0.12 s; asked in 20 us (median), "
                                        "40 us (p99)\n\n"));
  EXPECT_THAT(text, HasSubstr("\nnobody          below 8 m/s          none\n"));
  EXPECT_THAT(text, HasSubstr("\noncoming        22 m/s and more         4      50 %      25 %"
                              "        1.50\n"));
  EXPECT_THAT(text, HasSubstr("\npedestrian      8 to 14 m/s             1       0 %       0 %"
                              "           -\n"));
}

}  // namespace
}  // namespace saca::banks::bank_statistics_test
