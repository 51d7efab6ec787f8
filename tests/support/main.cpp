// What every test program begins with: a temporary folder of its own (testing::TempDir()), so that
// two runs at a time, of two clones or two users, do not meet in it. It is removed in the end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  std::error_code problem;
  std::string folder = std::filesystem::temp_directory_path(problem) / "saca_test_XXXXXX";
  if (problem || mkdtemp(folder.data()) == nullptr ||
      setenv("TEST_TMPDIR", folder.c_str(), 1) != 0) {
    std::cerr << folder << ": no temporary folder can be made\n";
    return 1;
  }
  const int failed = RUN_ALL_TESTS();
  std::filesystem::remove_all(folder, problem);
  return failed;
}
