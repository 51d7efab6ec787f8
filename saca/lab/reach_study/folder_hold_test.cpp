#include "saca/lab/reach_study/folder_hold.h"

#include <gtest/gtest.h>

#include <optional>

namespace saca::reach_study::folder_hold_test {
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

TEST_F(FolderHolds, WhatIsNoFolderIsNotHeld) {
  int waits = 0;
  const FolderHold first(folder_ / "none", [&] { ++waits; });
  const FolderHold second(folder_ / "none", [&] { ++waits; });
  EXPECT_EQ(waits, 0);
}

}  // namespace
}  // namespace saca::reach_study::folder_hold_test
