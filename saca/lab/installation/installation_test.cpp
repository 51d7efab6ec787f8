#include "saca/lab/installation/installation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "saca/base/core/file.h"

namespace saca::installation::installation_test {
namespace {

namespace fs = std::filesystem;

class InstallationFolder : public testing::Test {
 protected:
  const fs::path folder_ = fs::weakly_canonical(testing::TempDir()) / "installation";
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const fs::path& file) const {
    fs::create_directories((folder_ / file).parent_path());
    ASSERT_EQ(write_file(folder_ / file, "x"), std::nullopt);
  }
};

TEST_F(InstallationFolder, IsFoundBesideTheBuildFolderAndInShare) {
  write("build/release/saca");
  EXPECT_FALSE(find_installation(folder_ / "build/release/saca").has_value());
  write("data/harm.toml");
  const auto built = find_installation(folder_ / "build/release/saca");
  ASSERT_TRUE(built.has_value());
  EXPECT_EQ(built.value().root, folder_);
  EXPECT_EQ(built.value().model_host, folder_ / "build/release/saca-model-host");

  write("bin/saca");
  write("share/saca/data/harm.toml");
  const auto installed = find_installation(folder_ / "bin/saca");
  ASSERT_TRUE(installed.has_value());
  EXPECT_EQ(installed.value().root, folder_ / "share/saca");
}

TEST_F(InstallationFolder, WhatIsMadeLiesInTheCacheUnlessItWasInstalled) {
  const Installation here{.root = folder_, .cache = "/cache"};
  EXPECT_EQ(kept_place(here, "atlases/a.atlas"), "/cache/atlases/a.atlas");
  write("atlases/a.atlas");
  EXPECT_EQ(kept_place(here, "atlases/a.atlas"), folder_ / "atlases/a.atlas");
  EXPECT_EQ(kept_place({.root = folder_}, "b"), folder_ / "b");  // no cache
}

TEST(Cache, IsTheUsersOwn) {
  const char* const before = std::getenv("XDG_CACHE_HOME");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(usual_cache(), "/somewhere/saca");
  ::setenv("XDG_CACHE_HOME", "", 1);  // as if it were not set
  if (const char* const home = std::getenv("HOME")) {
    EXPECT_EQ(usual_cache(), fs::path(home) / ".cache/saca");
  }
  before == nullptr ? ::unsetenv("XDG_CACHE_HOME") : ::setenv("XDG_CACHE_HOME", kept.c_str(), 1);
}

TEST(Version, HasTheCommit) {
  EXPECT_EQ(version_text({.version = "0.1.0", .commit = "13bf"}), "0.1.0 (commit 13bf)");
}

}  // namespace
}  // namespace saca::installation::installation_test
