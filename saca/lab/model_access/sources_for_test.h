#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "saca/base/core/file.h"
#include "saca/lab/model_access/open_model.h"
#include "saca/thinking/language_model/replay_model.h"
#include "saca/thinking/language_model/scripted_child_for_test.h"

namespace saca::model_access {

/// A folder with a program that runs a model, played by a shell script, with weights and replies.
class SourcesFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    // It writes down its arguments, says that it is ready, and stays.
    const std::string script = language_model::scripted_child("ready\nread -r end\n")[2];
    write("host", "#!/bin/sh\nprintf '%s ' \"$@\" >\"$0.arguments\"\n" + script);
    std::filesystem::permissions(folder_ / "host", std::filesystem::perms::owner_all);
    write("mine.gguf", "weights");
    write("other.gguf", "other weights");
    write("choice.json", R"({"weights": "mine.gguf", "flash_attention": true})");
    write("temperatures.toml", "[[weights]]\nname = \"mine\"\ntemperature = 2.5\n");
    language_model::RecordedReplies replies{.model = "m", .replies = {}};
    write("replies.json", language_model::json_text(replies));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    ASSERT_EQ(write_file(folder_ / name, text), std::nullopt);
  }

  [[nodiscard]] ModelSources sources() const {
    return {.host = folder_ / "host",
            .choice = folder_ / "choice.json",
            .harm = "data/harm.toml",
            .temperatures = folder_ / "temperatures.toml",
            .key = ""};
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("model_access_") +
       testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() + "_" +
       testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace saca::model_access
