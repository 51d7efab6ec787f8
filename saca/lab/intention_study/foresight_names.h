#pragma once

#include <array>
#include <string_view>

#include "saca/lab/intention_scoring/displacement.h"

namespace saca::intention_study {

/// In the order of `intention_scoring::Foresight`.
constexpr std::array<std::string_view, intention_scoring::num_foresights> foresight_names{
    "constant velocity", "lane keeping", "likeliest intention", "mean over intentions"};

}  // namespace saca::intention_study
