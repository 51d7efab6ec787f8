#include "saca/lab/model_trials/model_info.h"

#include <gtest/gtest.h>

namespace saca::model_trials::model_info_test {
namespace {

nlohmann::json info_by_hand() {
  return model_info({.description = "a model",
                     .file = "a.gguf",
                     .weight_bytes = 3 * 1024 * 1024 / 2,
                     .resident_bytes = 2 * 1024 * 1024,
                     .threads = 4},
                    {.load_time = 0.5, .system_tokens = 700});
}

TEST(ModelInfo, IsInMebibytes) {
  EXPECT_EQ(info_by_hand(), (nlohmann::json{{"description", "a model"},
                                            {"file", "a.gguf"},
                                            {"weights_mib", 1.5},
                                            {"resident_mib", 2.0},
                                            {"threads", 4},
                                            {"load_s", 0.5},
                                            {"system_tokens", 700}}));
  EXPECT_EQ(model_info_json(info_by_hand()).at("schema"), "saca.model_info/1");
  EXPECT_EQ(model_info_json(info_by_hand()).size(), 8U);
}

TEST(ModelInfo, IsToldLineByLine) {
  EXPECT_EQ(model_info_text(info_by_hand()),
            "description    a model\n"
            "file           a.gguf\n"
            "load_s         0.5\n"
            "resident_mib   2.0\n"
            "system_tokens  700\n"
            "threads        4\n"
            "weights_mib    1.5\n");
}

}  // namespace
}  // namespace saca::model_trials::model_info_test
