#pragma once

// Cases and folders that the tests of this module share.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/onboard/match/example_scenes.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::banks {

/// On an empty road at this speed [m/s] one policy harms nobody, told and in truth; every other
/// harms by 0.1.
inline memory::Case best_is(manoeuvre::PolicyId policy, double speed, const std::string& source) {
  memory::Case one;
  one.scene = match::empty_road();
  one.scene.ego.v_B.x = speed;
  one.best = policy;
  one.plan = manoeuvre::default_plan(policy, speed);
  one.source = source;
  one.origin = memory::Origin::simulation;
  one.told.emplace();
  one.told->fill(0.1);
  one.told->at(manoeuvre::index(policy)) = 0.0;
  one.happened = one.told;
  return one;
}

/// An empty folder of this test.
class EmptyFolder {
 public:
  EmptyFolder() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            ("saca_banks_" + std::to_string(::getpid()) + "_" + test->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  EmptyFolder(const EmptyFolder&) = delete;
  EmptyFolder& operator=(const EmptyFolder&) = delete;
  ~EmptyFolder() { std::filesystem::remove_all(path_); }

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Writes cases into a file in it.
  [[nodiscard]] std::string with_cases(const std::string& name,
                                       const std::vector<memory::Case>& cases) const {
    std::vector<memory::Case> numbered = cases;
    for (std::size_t i = 0; i < numbered.size(); ++i) {
      numbered[i].id = static_cast<match::CaseId>(i + 1);
    }
    EXPECT_FALSE(write_file(file(name), memory::cases_text(numbered)));
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

}  // namespace saca::banks
