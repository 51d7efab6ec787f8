#include "saca/lab/long_work/folder_hold.h"

#include <gtest/gtest.h>

#include <optional>

namespace saca::long_work::folder_hold_test {
namespace {

namespace fs = std::filesystem;

class FolderHolds : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(testing::TempDir()) / "folder_hold";
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
};

TEST_F(FolderHolds, AFreeFolderIsNotWaitedFor) {
  int waits = 0;
  {
    const FolderHold first(folder_, [&] { ++waits; });
  }
  {
    const FolderHold again(folder_, [&] { ++waits; });
  }  // the first one gave it back
  EXPECT_EQ(waits, 0);
}

TEST_F(FolderHolds, AHeldFolderIsWaitedForAndThatIsTold) {
  std::optional<FolderHold> other;
  other.emplace(folder_, [] {});
  int waits = 0;
  const FolderHold next(folder_, [&] {
    ++waits;
    other.reset();  // else this would wait for ever
  });
  EXPECT_EQ(waits, 1);
  EXPECT_FALSE(other.has_value());
}

TEST_F(FolderHolds, AHeldFolderIsRefusedWhereNobodyWaits) {
  std::optional<FolderHold> first = FolderHold::unless_held(folder_);
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(FolderHold::unless_held(folder_).has_value());
  first.reset();
  EXPECT_TRUE(FolderHold::unless_held(folder_).has_value());
  const FolderHold other(folder_, [] { ADD_FAILURE() << "it is free"; });
  EXPECT_FALSE(FolderHold::unless_held(folder_).has_value());
}

TEST_F(FolderHolds, WhatIsNoFolderIsNotHeld) {
  EXPECT_TRUE(FolderHold::unless_held(folder_ / "none").has_value());
  int waits = 0;
  const FolderHold first(folder_ / "none", [&] { ++waits; });
  const FolderHold second(folder_ / "none", [&] { ++waits; });
  EXPECT_EQ(waits, 0);
}

}  // namespace
}  // namespace saca::long_work::folder_hold_test
