#include "saca/lab/learned_danger/transition_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/base/formats/hdf5_reader.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::learned_danger::transition_file_test {
namespace {

class TransitionFile : public testing::Test {
 protected:
  TransitionFile() {
    const manoeuvre::Car car = prepare::default_car();
    const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};
    const danger::DangerModel model(danger::avoidance_of(car, 1.0), body, {});
    part_ = {.car = "compact_rwd_ev", .seed = 18446744073709551615U};
    part_.mixture.near_share = 0.0;
    part_.mixture.behaviours = {0.5, 0.25, 0.25, 0.0};
    part_.transitions = made_transitions(car, body, model, part_.mixture, {3, 9});
  }
  Part part_;
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("part_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".h5");
};

TEST_F(TransitionFile, HoldsAllThatWasWritten) {
  ASSERT_FALSE(write_part(path_, part_).has_value());
  const auto came = read_part(path_);
  ASSERT_TRUE(came.has_value()) << came.error().message;
  const Part& part = came.value();
  EXPECT_EQ(part.car, part_.car);
  EXPECT_EQ(part.seed, part_.seed);
  EXPECT_EQ(part.mixture.looks, part_.mixture.looks);
  EXPECT_EQ(part.mixture.behaviours, part_.mixture.behaviours);
  const Transitions& ours = part_.transitions;
  const Transitions& theirs = part.transitions;
  EXPECT_EQ(theirs.observations, ours.observations);
  EXPECT_EQ(theirs.next_observations, ours.next_observations);
  EXPECT_EQ(theirs.actions, ours.actions);
  EXPECT_EQ(theirs.h, ours.h);
  EXPECT_EQ(theirs.next_h, ours.next_h);
  EXPECT_EQ(theirs.settled, ours.settled);
  EXPECT_EQ(theirs.cut_off, ours.cut_off);
  EXPECT_EQ(theirs.drive, ours.drive);
  EXPECT_EQ(theirs.drives, 3U);
  EXPECT_EQ(theirs.situations, ours.situations);
}

// Who reads DSRL's data sets finds its arrays, and what they mean there.
TEST_F(TransitionFile, HasTheLayoutOfDsrl) {
  ASSERT_FALSE(write_part(path_, part_).has_value());
  formats::Hdf5Reader reader(path_.string(), path_);
  const std::size_t n = part_.transitions.size();
  for (const char* name : {"rewards", "costs", "terminals", "timeouts"}) {
    EXPECT_EQ(reader.extents(name), std::vector<std::size_t>{n}) << name;
  }
  EXPECT_EQ(reader.extents("observations"), (std::vector<std::size_t>{n, num_features}));
  std::vector<float> costs(n);
  reader.numbers<float>("costs", {n}, {costs.data()});
  ASSERT_FALSE(reader.problem().has_value());
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(costs[i] > 0.5F, part_.transitions.h[i] >= 0.0F);
  }
}

// A drive may meet nobody from which anything is learnt.
TEST_F(TransitionFile, IsNotMadeOfNothing) {
  std::filesystem::remove(path_);
  part_.transitions = {};
  part_.transitions.drives = 1;
  const auto problem = write_part(path_, part_);
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->code, Error::Code::out_of_range);
  EXPECT_NE(problem->message.find("got none of 1 drives"), std::string::npos) << problem->message;
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(TransitionFile, SaysWhatIsWrong) {
  std::filesystem::remove(path_);
  EXPECT_EQ(read_part(path_).error().code, Error::Code::unreadable);
  ASSERT_FALSE(write_part(path_, part_).has_value());
  std::string bytes = read_file(path_, many_bytes).value();
  bytes[bytes.size() / 2] ^= 1;
  ASSERT_FALSE(write_file(path_, bytes).has_value());
  const auto altered = read_part(path_);
  ASSERT_FALSE(altered.has_value());
  EXPECT_NE(altered.error().message.find("part_Says"), std::string::npos);
  EXPECT_TRUE(write_part(path_ / "part.h5", part_).has_value());
}

}  // namespace
}  // namespace saca::learned_danger::transition_file_test
