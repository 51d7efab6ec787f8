#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace saca::report {

// What the verdicts over time say of a run, in whole sentences: part of explanation(). Each number
// stands in the record and is only rounded. Throws nlohmann::json::exception where a key is
// missing.

/// The name of a plan of a record, with the speed that it brakes to, or how hard it brakes.
[[nodiscard]] std::string plan_name(const nlohmann::json& plan);

/// Is it the same plan, to the same speed, as hard?
[[nodiscard]] bool is_same_plan(const nlohmann::json& a, const nlohmann::json& b);

/// Why a switch came when it did: from which verdict on the other plan was expected to harm less
/// than going on, and by how much. Empty where the record holds no verdict that it can be told by.
/// @param change  one of the record's switches
[[nodiscard]] std::vector<std::string> why_then(const nlohmann::json& record,
                                                const nlohmann::json& change);

/// Where nothing was switched: the most that another plan promised meanwhile. Empty where the
/// record holds no verdict of what was under way.
[[nodiscard]] std::vector<std::string> why_not_switched(const nlohmann::json& record);

}  // namespace saca::report
