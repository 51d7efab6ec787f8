#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {

/// Writes down what a model tells while it answers, with the second at which it does.
class NewsTest : public testing::Test {
 protected:
  ManualClock clock_;
  std::vector<std::string> news_;
  std::function<void(const Progress&)> record_ = [this](const Progress& p) {
    const auto at = std::chrono::duration_cast<std::chrono::seconds>(clock_.now()).count();
    news_.push_back(std::to_string(at) + " s: " + std::to_string(p.prompt) +
                    (p.answer != nullptr ? " answers" : " " + std::string(p.text)));
  };
};

}  // namespace saca::language_model
