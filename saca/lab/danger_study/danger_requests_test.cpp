#include "saca/lab/danger_study/danger_requests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/lab/danger_study/weights.h"
#include "saca/lab/installation/here_for_test.h"

namespace saca::danger_study::danger_requests_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* shipped_weights = "models/danger/compact_rwd_ev.safetensors";

class DangerRequests : public testing::Test {
 protected:
  const installation::Installation here_ = installation::here_for_test();
  const fs::path file_ = fs::path(testing::TempDir()) / "danger_requests.safetensors";
  void TearDown() override { fs::remove(file_); }
};

TEST_F(DangerRequests, ShippedWeightsAreHeldAgainstDrives) {
  const auto checked = check_weights(here_, {shipped_weights, 4, 1, 1});
  ASSERT_TRUE(checked.has_value()) << checked.error().message;
  EXPECT_EQ(checked.value().car_name, "compact_rwd_ev");
  EXPECT_FALSE(checked.value().report.rows.empty());
  EXPECT_THAT(check_weights(here_, {"none.safetensors", 4, 1, 1}).error().message,
              HasSubstr("none.safetensors"));
}

TEST_F(DangerRequests, MarginsAreWrittenBesideTheirWeights) {
  const auto margins = fit_margins(here_, {shipped_weights, 4, 1, 1}, file_.string());
  ASSERT_TRUE(margins.has_value()) << margins.error().message;
  EXPECT_GE(margins.value().situations, 4);
  EXPECT_TRUE(read_network(file_).has_value());
  EXPECT_FALSE(fs::exists(file_.string() + ".margins.json"));  // all is counted
  EXPECT_THAT(fit_margins(here_, {shipped_weights, 4, 1, 1}, "/proc/nowhere/w").error().message,
              HasSubstr("/proc/nowhere"));
}

TEST_F(DangerRequests, AFolderWithoutPartsHasNoCoverage) {
  EXPECT_THAT(coverage_in(here_, {.folder = "nowhere"}).error().message, HasSubstr("nowhere"));
}

TEST_F(DangerRequests, EvasionsAreDrivenByWeightsOfTheirCar) {
  EXPECT_FALSE(network_by(here_, "", "compact_rwd_ev").value().has_value());
  EXPECT_TRUE(network_by(here_, shipped_weights, "compact_rwd_ev").value().has_value());
  EXPECT_THAT(network_by(here_, shipped_weights, "midsize_suv").error().message,
              HasSubstr("want weights of the car midsize_suv, got of compact_rwd_ev"));
}

}  // namespace
}  // namespace saca::danger_study::danger_requests_test
