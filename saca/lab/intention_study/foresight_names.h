#pragma once

#include <array>
#include <string_view>

#include "saca/lab/training/displacement.h"

namespace saca::intention_study {

/// In the order of `training::Foresight`.
constexpr std::array<std::string_view, training::num_foresights> foresight_names{
    "constant velocity", "lane keeping", "likeliest intention", "mean over intentions"};

}  // namespace saca::intention_study
